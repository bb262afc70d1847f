#include <gnomon/config/Report.h>

#include <algorithm>
#include <tuple>

#include "Checks.h"

namespace gnomon::config {

std::vector<Finding> findings(const Config& config) {
    std::vector<Finding> all = validate(config);
    checkServers(config, all);
    // The rest calculates with what is right so far.
    if (!hasError(all)) {
        checkCover(config, all);
        checkGeometry(config, all);
    }
    std::stable_sort(all.begin(), all.end(), [](const Finding& a, const Finding& b) {
        return std::tie(a.place.line, a.place.column) < std::tie(b.place.line, b.place.column);
    });
    return all;
}

}  // namespace gnomon::config

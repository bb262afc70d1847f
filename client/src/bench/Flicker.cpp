#include "Flicker.h"

#include <gnomon/base/Error.h>
#include <gnomon/truth/Truth.h>

#include <cstdlib>

namespace gnomon::client {

void Flicker::add(const image::Image& truth, const image::Image& factor) {
    const auto pixels = truth.pixels.size();
    GNOMON_EXPECTS(truth.channels == 1 && factor.channels == 1 && factor.pixels.size() == pixels &&
                       (!last_ || last_->truth.pixels.size() == pixels),
                   "factor images of one path have one size");
    for (std::size_t i = 0; last_ && i < pixels; ++i) {
        const int now = truth.pixels[i];
        const int before = last_->truth.pixels[i];
        if (now == truth::noSurface || before == truth::noSurface ||
            std::abs(now - before) > truthStays || (now > 127) != (before > 127))
            continue;
        const int a = last_->factor.pixels[i];
        const int b = factor.pixels[i];
        ++sum_.counted;
        if ((a > 127) != (b > 127)) ++sum_.flipped;
        change_ += static_cast<std::uint64_t>(std::abs(a - b));
    }
    last_ = Frame{.truth = truth, .factor = factor};
}

FlickerError Flicker::found() const noexcept {
    FlickerError all = sum_;
    if (all.counted > 0)
        all.meanChange = static_cast<double>(change_) / 255.0 / static_cast<double>(all.counted);
    return all;
}

}  // namespace gnomon::client

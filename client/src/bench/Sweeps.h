#pragma once

#include "Plan.h"

namespace gnomon::client {

/// Techniques times map sizes, sizes outermost; those without maps once.
std::vector<Variant> variantsOf(const std::vector<std::string>& techniques,
                                const std::vector<int>& mapSizes, const Registry& registry);

/// The sweep of that name. Errors as chaptersOf().
Result<std::vector<Chapter>> sweep(const PlanOptions& options, const Registry& registry);

}  // namespace gnomon::client

#include <atomic>

#include "Backends.h"

namespace gnomon::gl {
namespace {

/// The dispatch table that the families fight over is a global of the process (Mesa's libglapi),
/// so what guards it cannot be owned by an object: the one global of this module.
std::atomic<Family>& familyInUse() {
    static std::atomic<Family> family{Family::none};
    return family;
}

tl::unexpected<Error> refuse(Family wanted) {
    const bool osmesa = wanted == Family::osmesa;
    return fail(Errc::context,
                std::string{osmesa ? "osmesa" : "egl and glfw"} +
                    " cannot be used: this process already made " +
                    (osmesa ? "an egl or glfw" : "an osmesa") +
                    " context, and both share Mesa's dispatch table; use another process");
}

}  // namespace

Result<void> checkFamily(Family wanted) {
    const auto used = familyInUse().load();
    if (used != Family::none && used != wanted) return refuse(wanted);
    return {};
}

Result<void> claimFamily(Family family) {
    auto expected = Family::none;
    if (!familyInUse().compare_exchange_strong(expected, family) && expected != family)
        return refuse(family);
    return {};
}

}  // namespace gnomon::gl

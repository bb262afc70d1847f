#pragma once

#include <gnomon/gl/Context.h>

#include <string_view>

namespace gnomon::gl {

// One file each; `auto` is made of these three. @pre options.gpu fits the back end.
Result<std::unique_ptr<Context>> createEgl(const ContextOptions& options);
Result<std::unique_ptr<Context>> createOsmesa(const ContextOptions& options);
Result<std::unique_ptr<Context>> createGlfw(const ContextOptions& options);

/// Back ends that can live in one process. GLFW's contexts come from the system's GL, as EGL's do.
enum class Family : unsigned char { none, system, osmesa };

/// Refuses @p wanted when the process already made a context of the other family.
Result<void> checkFamily(Family wanted);
/// Records that the process is about to make a context of @p family current, for ever.
/// Errors as checkFamily().
Result<void> claimFamily(Family family);

/// "DISPLAY=:0", or why there is none. Empty variables count as unset.
struct DisplayVariables {
    bool any = false;
    std::string text = {};
};
DisplayVariables displayVariables();

}  // namespace gnomon::gl

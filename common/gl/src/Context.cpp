#include <fmt/core.h>
#include <gnomon/gl/Context.h>

#include <array>
#include <cstdlib>
#include <utility>

#include "Backends.h"
#include "DebugLog.h"

namespace gnomon::gl {
namespace {

using Made = Result<std::unique_ptr<Context>>;

constexpr std::array words{std::pair{Backend::egl, std::string_view{"egl"}},
                           std::pair{Backend::osmesa, std::string_view{"osmesa"}},
                           std::pair{Backend::glfw, std::string_view{"glfw"}},
                           std::pair{Backend::automatic, std::string_view{"auto"}}};

std::string glString(const Api& gl, GLenum which) {
    const auto* text = gl.GetString(which);
    return text != nullptr ? reinterpret_cast<const char*>(text) : "unknown";
}

Made createOne(Backend backend, const ContextOptions& options) {
    if (options.gpu >= 0 && backend != Backend::egl)
        return fail(Errc::context,
                    fmt::format("{} cannot choose a GPU: gpu is {}, only egl takes one",
                                name(backend), options.gpu));
    switch (backend) {
        case Backend::egl:
            return createEgl(options);
        case Backend::osmesa:
            return createOsmesa(options);
        case Backend::glfw:
            return createGlfw(options);
        case Backend::automatic:
            break;
    }
    GNOMON_EXPECTS(false, "auto is resolved by its caller");
    return {};
}

/// Why glfw is not even tried by `auto`; empty if it is.
std::string reasonAgainstGlfw(const ContextOptions& options) {
    if (!options.wantsWindow) return "no window is wanted";
    if (const auto display = displayVariables(); !display.any) return display.text;
    return {};
}

void append(std::string& list, std::string_view backend, std::string_view fate) {
    list += fmt::format("{}{} {}", list.empty() ? "" : "; ", backend, fate);
}

}  // namespace

std::string_view name(Backend backend) noexcept {
    for (const auto& [value, word] : words)
        if (value == backend) return word;
    return "unknown";
}

Result<Backend> parseBackend(std::string_view word) {
    for (const auto& [value, known] : words)
        if (known == word) return value;
    return fail(Errc::config,
                fmt::format("back end is \"{}\", must be egl, osmesa, glfw or auto", word));
}

DisplayVariables displayVariables() {
    DisplayVariables found;
    for (const char* variable : {"WAYLAND_DISPLAY", "DISPLAY"}) {
        const char* value = std::getenv(variable);
        if (value == nullptr || *value == '\0') continue;
        found.any = true;
        found.text += fmt::format("{}{}={}", found.text.empty() ? "" : ", ", variable, value);
    }
    if (!found.any) found.text = "neither DISPLAY nor WAYLAND_DISPLAY is set";
    return found;
}

Context::Context(Backend backend) : backend_{backend} {}
Context::~Context() = default;

std::vector<std::string> Context::takeDebugErrors() {
    return debugLog_ ? debugLog_->take() : std::vector<std::string>{};
}

Result<void> Context::finish(const GetProcedure& getProcedure, std::string_view device,
                             bool debug) {
    auto loaded = loadApi(getProcedure);
    if (!loaded) return tl::unexpected{std::move(loaded).error()};
    api_ = *std::move(loaded);
    renderer_ = glString(api_, GL_RENDERER);
    description_ = fmt::format("{}: {}, {}, OpenGL {}", name(backend_), device, renderer_,
                               glString(api_, GL_VERSION));
    if (debug) {
        debugLog_ = std::make_unique<DebugLog>();
        debugLog_->attach(api_);
    }
    return {};
}

Result<std::unique_ptr<Context>> createContext(const ContextOptions& options) {
    if (options.gpu < -1)
        return fail(Errc::context, fmt::format("gpu is {}, must be -1 (the default) or the number "
                                               "of an EGL device",
                                               options.gpu));
    if (options.backend != Backend::automatic) return createOne(options.backend, options);

    std::string before;
    for (const auto backend : {Backend::glfw, Backend::egl, Backend::osmesa}) {
        if (backend == Backend::glfw) {
            if (const auto reason = reasonAgainstGlfw(options); !reason.empty()) {
                append(before, "glfw", "not tried (" + reason + ")");
                continue;
            }
        }
        auto made = createOne(backend, options);
        if (made) {
            const auto why = backend == Backend::glfw
                                 ? "a window is wanted, " + displayVariables().text
                                 : before;
            (*made)->description_ += fmt::format(" [auto chose {}: {}]", name(backend), why);
            return made;
        }
        append(before, name(backend), "failed (" + made.error().text() + ")");
    }
    return fail(Errc::context, "no back end gives an OpenGL 4.5 core context: " + before);
}

}  // namespace gnomon::gl

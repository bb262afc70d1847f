#include <fmt/core.h>

#include <array>
#include <cstdlib>
#include <optional>
#include <utility>

#include "Backends.h"
#include "EglDevices.h"

namespace gnomon::gl {
namespace {

using Made = Result<std::unique_ptr<Context>>;

/// A display to try. Displays are never terminated: eglTerminate would end the other contexts of
/// this process too, and the driver frees them at exit.
struct Candidate {
    EGLDisplay display = EGL_NO_DISPLAY;
    std::string name = {};
};

class EglContext final : public Context {
public:
    EglContext(EGLDisplay display, EGLContext context)
        : Context{Backend::egl}, display_{display}, context_{context} {}
    ~EglContext() override {
        doneCurrent();
        eglDestroyContext(display_, context_);
    }
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

    void makeCurrent() override {
        if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE)
            throw Failure{Errc::context, "cannot make the egl context current: " + eglErrorName() +
                                             " (is it current on another thread?)"};
    }
    void doneCurrent() noexcept override {
        eglBindAPI(EGL_OPENGL_API);  // "current" is kept per thread and per API
        if (eglGetCurrentContext() == context_)
            eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    Result<void> load(std::string_view device, bool debug) {
        return finish([](const char* name) { return eglGetProcAddress(name); }, device, debug);
    }

private:
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

/// A config for a driver that cannot make contexts without one. Nothing is ever drawn to it.
EGLConfig anyConfig(EGLDisplay display, const char* extensions) {
    if (contains(extensions, "EGL_KHR_no_config_context")) return EGL_NO_CONFIG_KHR;
    constexpr std::array<EGLint, 5> attributes{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                               EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_NONE};
    EGLConfig config = EGL_NO_CONFIG_KHR;
    EGLint count = 0;
    eglChooseConfig(display, attributes.data(), &config, 1, &count);
    return config;
}

Made createOn(const Candidate& candidate, bool debug) {
    const auto failed = [&](std::string_view doing, std::string_view why) {
        return fail(Errc::context, fmt::format("{} on {}: {}", doing, candidate.name, why));
    };
    EGLint major = 0;
    EGLint minor = 0;
    if (eglInitialize(candidate.display, &major, &minor) == EGL_FALSE)
        return failed("cannot start EGL", eglErrorName());
    const char* extensions = eglQueryString(candidate.display, EGL_EXTENSIONS);
    if (!contains(extensions, "EGL_KHR_surfaceless_context"))
        return failed("cannot make a context without a window",
                      "the driver has no EGL_KHR_surfaceless_context");
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE)
        return failed("cannot use OpenGL (rather than OpenGL ES)", eglErrorName());

    const std::array<EGLint, 9> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                           4,
                                           EGL_CONTEXT_MINOR_VERSION,
                                           5,
                                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                           EGL_CONTEXT_OPENGL_DEBUG,
                                           debug ? EGL_TRUE : EGL_FALSE,
                                           EGL_NONE};
    EGLContext handle =
        eglCreateContext(candidate.display, anyConfig(candidate.display, extensions),
                         EGL_NO_CONTEXT, attributes.data());
    if (handle == EGL_NO_CONTEXT)
        return failed("cannot make an OpenGL 4.5 core context", eglErrorName());
    auto context = std::make_unique<EglContext>(candidate.display, handle);

    if (auto claimed = claimFamily(Family::system); !claimed)
        return tl::unexpected{std::move(claimed).error()};
    try {
        context->makeCurrent();
    } catch (const Failure& failure) {
        return tl::unexpected{failure.error()};
    }
    if (auto loaded = context->load(candidate.name, debug); !loaded)
        return tl::unexpected{std::move(loaded).error()};
    return context;
}

Candidate onDevice(const std::vector<EglDevice>& devices, std::size_t index) {
    const auto& device = devices[index];
    return {.display = eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, device.handle, nullptr),
            .name = fmt::format("device {} ({})", index, device.name)};
}

bool isSoftware(const Context& context) {
    for (const char* renderer : {"llvmpipe", "softpipe", "swrast"})
        if (context.renderer().find(renderer) != std::string::npos) return true;
    return false;
}

bool softwareIsWanted() {
    const char* value = std::getenv("LIBGL_ALWAYS_SOFTWARE");
    return value != nullptr && std::string_view{value} != "0" && std::string_view{value} != "false";
}

Made createDefault(const std::vector<EglDevice>& devices, bool debug) {
    std::string failures;
    const auto attempt = [&](const Candidate& candidate) -> Made {
        if (candidate.display == EGL_NO_DISPLAY) {
            failures +=
                fmt::format("{}no display for {}", failures.empty() ? "" : "; ", candidate.name);
            return fail(Errc::context, {});
        }
        auto made = createOn(candidate, debug);
        if (!made) failures += (failures.empty() ? "" : "; ") + made.error().what;
        return made;
    };

    const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    std::unique_ptr<Context> software;
    if (contains(client, "EGL_MESA_platform_surfaceless")) {
        auto made = attempt({.display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA,
                                                              EGL_DEFAULT_DISPLAY, nullptr),
                             .name = "surfaceless"});
        // Mesa's surfaceless display cannot see a GPU of another vendor, whose devices can.
        if (made && (!isSoftware(**made) || softwareIsWanted())) return made;
        if (made) software = *std::move(made);
    }
    for (const bool wantSoftware : {false, true}) {
        for (std::size_t i = 0; i < devices.size(); ++i) {
            if (devices[i].software != wantSoftware || (software && wantSoftware)) continue;
            auto made = attempt(onDevice(devices, i));
            if (made && !(software && isSoftware(**made))) return made;
        }
    }
    if (software) {
        software->makeCurrent();
        return software;
    }
    auto made = attempt({.display = eglGetDisplay(EGL_DEFAULT_DISPLAY), .name = "default display"});
    if (made) return made;
    return fail(Errc::context, "egl: " + failures);
}

}  // namespace

Result<std::unique_ptr<Context>> createEgl(const ContextOptions& options) {
    if (auto free = checkFamily(Family::system); !free)
        return tl::unexpected{std::move(free).error()};
    const auto devices = eglDevices();
    if (options.gpu < 0) return createDefault(devices, options.debug);

    const auto index = static_cast<std::size_t>(options.gpu);
    if (index >= devices.size())
        return fail(Errc::context, fmt::format("egl: there is no gpu {}; devices found: {}",
                                               options.gpu, listed(devices)));
    return createOn(onDevice(devices, index), options.debug);
}

}  // namespace gnomon::gl

#include <dlfcn.h>
#include <fmt/core.h>

#include <array>
#include <cstdint>
#include <utility>

#include "Backends.h"

namespace gnomon::gl {
namespace {

// From <GL/osmesa.h>, which cannot be included: it declares the gl* functions themselves.
constexpr int osmesaFormat = 0x22;
constexpr int osmesaProfile = 0x33;
constexpr int osmesaCoreProfile = 0x34;
constexpr int osmesaContextMajor = 0x36;
constexpr int osmesaContextMinor = 0x37;
using OsmesaHandle = struct osmesa_context*;

constexpr const char* libraryName = "libOSMesa.so.8";

struct Library {
    OsmesaHandle (*createContextAttribs)(const int* attributes, OsmesaHandle share) = nullptr;
    void (*destroyContext)(OsmesaHandle context) = nullptr;
    GLboolean (*makeCurrent)(OsmesaHandle context, void* buffer, GLenum type, GLsizei width,
                             GLsizei height) = nullptr;
    OsmesaHandle (*currentContext)() = nullptr;
    Procedure (*getProcAddress)(const char* name) = nullptr;
};

template <class Function>
bool find(void* library, const char* name, Function& function) {
    function = reinterpret_cast<Function>(::dlsym(library, name));
    return function != nullptr;
}

/// Opens the library for good: what it registers at exit must stay loaded.
Result<Library> openLibrary() {
    void* handle = ::dlopen(libraryName, RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) return fail(Errc::context, fmt::format("osmesa: {}", ::dlerror()));
    Library library;
    if (!find(handle, "OSMesaCreateContextAttribs", library.createContextAttribs) ||
        !find(handle, "OSMesaDestroyContext", library.destroyContext) ||
        !find(handle, "OSMesaMakeCurrent", library.makeCurrent) ||
        !find(handle, "OSMesaGetCurrentContext", library.currentContext) ||
        !find(handle, "OSMesaGetProcAddress", library.getProcAddress))
        return fail(Errc::context,
                    fmt::format("osmesa: {} is too old: {}", libraryName, ::dlerror()));
    return library;
}

class OsmesaContext final : public Context {
public:
    OsmesaContext(const Library& library, OsmesaHandle context)
        : Context{Backend::osmesa}, library_{library}, context_{context} {}
    ~OsmesaContext() override {
        doneCurrent();
        library_.destroyContext(context_);
    }
    OsmesaContext(const OsmesaContext&) = delete;
    OsmesaContext& operator=(const OsmesaContext&) = delete;

    void makeCurrent() override {
        if (library_.makeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, side, side) == 0)
            throw Failure{Errc::context, "cannot make the osmesa context current"};
    }
    void doneCurrent() noexcept override {
        if (library_.currentContext() == context_) library_.makeCurrent(nullptr, nullptr, 0, 0, 0);
    }
    Result<void> load(bool debug) {
        return finish([this](const char* name) { return library_.getProcAddress(name); },
                      libraryName, debug);
    }

private:
    static constexpr GLsizei side = 8;  // texels; framebuffer 0 must exist but is never drawn to

    Library library_ = {};
    OsmesaHandle context_ = nullptr;
    std::array<std::uint8_t, std::size_t{4}* side* side> pixels_ = {};
};

}  // namespace

Result<std::unique_ptr<Context>> createOsmesa(const ContextOptions& options) {
    if (auto free = checkFamily(Family::osmesa); !free)
        return tl::unexpected{std::move(free).error()};
    auto library = openLibrary();
    if (!library) return tl::unexpected{std::move(library).error()};
    constexpr std::array<int, 9> attributes{osmesaFormat,
                                            GL_RGBA,
                                            osmesaProfile,
                                            osmesaCoreProfile,
                                            osmesaContextMajor,
                                            4,
                                            osmesaContextMinor,
                                            5,
                                            0};
    OsmesaHandle handle = library->createContextAttribs(attributes.data(), nullptr);
    if (handle == nullptr)
        return fail(Errc::context,
                    fmt::format("osmesa: {} gives no OpenGL 4.5 core context", libraryName));
    auto context = std::make_unique<OsmesaContext>(*library, handle);
    if (auto claimed = claimFamily(Family::osmesa); !claimed)
        return tl::unexpected{std::move(claimed).error()};
    try {
        context->makeCurrent();
    } catch (const Failure& failure) {
        return tl::unexpected{failure.error()};
    }
    if (auto loaded = context->load(options.debug); !loaded)
        return tl::unexpected{std::move(loaded).error()};
    return context;
}

}  // namespace gnomon::gl

#ifdef __SANITIZE_ADDRESS__
// OSMesa frees its framebuffers in no case (Mesa 22.3, five blocks for one context, seen in a C
// program of five calls). Only its own allocations are hidden from the leak checker.
// NOLINTBEGIN(bugprone-reserved-identifier): the checker prescribes these names
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_options();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa.so\n"; }
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }
// NOLINTEND(bugprone-reserved-identifier)
#endif

// A program that makes contexts and prints what came of it, one `key value` a line.
//   gl-probe clear BACKEND [GPU]     what the context is, and one pixel of a cleared framebuffer
//   gl-probe auto [window]           the same for `auto`, wanting a window or not
//   gl-probe both FIRST SECOND       the second back end after the first, in one process
//   gl-probe window SCREENSHOT       windows; the virtual display keeps its picture in that file

#include <fmt/core.h>
#include <gnomon/gl/Context.h>
#include <gnomon/gl/Handle.h>

#include <array>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "WindowProbe.h"

namespace gnomon::gl {
namespace {

void clearAndReport(Context& context) {
    const auto& gl = context.api();
    const Texture colour{gl, GL_TEXTURE_2D};
    gl.TextureStorage2D(colour.id(), 1, GL_RGBA8, 4, 4);
    const Framebuffer framebuffer{gl};
    gl.NamedFramebufferTexture(framebuffer.id(), GL_COLOR_ATTACHMENT0, colour.id(), 0);
    constexpr std::array<float, 4> wanted{0.2F, 0.4F, 0.6F, 0.8F};  // 51, 102, 153, 204 of 255
    gl.ClearNamedFramebufferfv(framebuffer.id(), GL_COLOR, 0, wanted.data());
    std::array<std::uint8_t, 4> pixel{};
    gl.GetTextureSubImage(colour.id(), 0, 3, 3, 0, 1, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, 4,
                          pixel.data());
    fmt::print("pixel {} {} {} {}\n", pixel[0], pixel[1], pixel[2], pixel[3]);
}

void report(Context& context) {
    const auto& gl = context.api();
    std::array<GLint, 3> version{};
    gl.GetIntegerv(GL_MAJOR_VERSION, &version[0]);
    gl.GetIntegerv(GL_MINOR_VERSION, &version[1]);
    gl.GetIntegerv(GL_CONTEXT_PROFILE_MASK, &version[2]);
    fmt::print("backend {}\ndescription {}\nversion {}.{}\nprofile {}\n", name(context.backend()),
               context.description(), version[0], version[1],
               version[2] == GL_CONTEXT_CORE_PROFILE_BIT ? "core" : "other");
    clearAndReport(context);
    for (const auto& message : context.takeDebugErrors()) fmt::print("debug {}\n", message);

    gl.Enable(GL_RGBA8);  // not a capability
    fmt::print("mistakes {}\n", context.takeDebugErrors().size());
    gl.GetError();
}

/// The context must be able to move to another thread and back.
void visitThread(Context& context) {
    context.doneCurrent();
    std::jthread{[&context] {
        context.makeCurrent();
        clearAndReport(context);
        context.doneCurrent();
    }}.join();
    context.makeCurrent();
}

void clear(const ContextOptions& options) {
    const auto context = orThrow(createContext(options));
    report(*context);
    visitThread(*context);
}

void both(Backend first, Backend second) {
    const auto context = orThrow(createContext({.backend = first}));
    const auto other = createContext({.backend = second});
    fmt::print("second {}\n", other ? "made" : other.error().text());
    context->makeCurrent();
    clearAndReport(*context);
}

int run(const std::vector<std::string>& words) {
    if (words.size() >= 2 && words[0] == "clear") {
        ContextOptions options{.backend = orThrow(parseBackend(words[1])), .debug = true};
        if (words.size() == 3) options.gpu = std::stoi(words[2]);
        clear(options);
    } else if (!words.empty() && words[0] == "auto") {
        clear({.debug = true, .wantsWindow = words.size() == 2});
    } else if (words.size() == 3 && words[0] == "both") {
        both(orThrow(parseBackend(words[1])), orThrow(parseBackend(words[2])));
    } else if (words.size() == 2 && words[0] == "window") {
        probeWindows(words[1]);
    } else {
        fmt::print(stderr, "usage: see BackendProbe.cpp\n");
        return 2;
    }
    return 0;
}

}  // namespace
}  // namespace gnomon::gl

int main(int count, char** arguments) {
    try {
        return gnomon::gl::run({arguments + 1, arguments + count});
    } catch (const gnomon::Failure& failure) {
        fmt::print("error {}\n", failure.what());
        return 1;
    }
}

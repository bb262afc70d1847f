// gnomon-demo-scene: writes one of the project's own scenes.
#include <fmt/format.h>
#include <gnomon/base/Error.h>
#include <gnomon/demo/Export.h>
#include <gnomon/demo/Scenes.h>

#include <charconv>
#include <cstdio>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace {

using namespace gnomon;

constexpr std::string_view usage =
    "usage: gnomon-demo-scene --scene plaza|grove [--seed N] --out FILE.glb|FILE.obj\n";

struct Arguments {
    std::string scene = {};
    std::uint64_t seed = 1;
    std::string out = {};
};

Result<Arguments> parsed(std::span<char*> words) {
    Arguments arguments;
    for (std::size_t i = 0; i < words.size(); i += 2) {
        const std::string_view name = words[i];
        if (name != "--scene" && name != "--seed" && name != "--out") {
            return fail(
                Errc::config,
                fmt::format("command line: unknown option '{}', expected --scene, --seed or --out",
                            name));
        }
        if (i + 1 == words.size())
            return fail(Errc::config, fmt::format("command line: {} has no value", name));
        const std::string_view value = words[i + 1];
        if (name == "--scene") arguments.scene = value;
        if (name == "--out") arguments.out = value;
        if (name == "--seed") {
            const auto [end, error] =
                std::from_chars(value.data(), value.data() + value.size(), arguments.seed);
            if (error != std::errc{} || end != value.data() + value.size()) {
                return fail(
                    Errc::config,
                    fmt::format(
                        "command line: --seed is '{}', expected a whole number from 0 to 2^64 - 1",
                        value));
            }
        }
    }
    if (arguments.scene != "plaza" && arguments.scene != "grove") {
        return fail(
            Errc::config,
            fmt::format("command line: --scene is '{}', expected plaza or grove", arguments.scene));
    }
    if (!arguments.out.ends_with(".glb") && !arguments.out.ends_with(".obj")) {
        return fail(
            Errc::config,
            fmt::format("command line: --out is '{}', expected a name ending in .glb or .obj",
                        arguments.out));
    }
    return arguments;
}

Result<void> written(const std::string& path, std::string_view bytes) {
    std::ofstream file{path, std::ios::binary};
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file) {
        return fail(Errc::file, fmt::format("{}: cannot write {} bytes", path, bytes.size()),
                    std::error_code{errno, std::generic_category()});
    }
    return {};
}

void run(const Arguments& arguments) {
    const demo::Scene scene =
        arguments.scene == "plaza" ? demo::plaza(arguments.seed) : demo::grove(arguments.seed);
    if (arguments.out.ends_with(".obj")) {
        orThrow(written(arguments.out, demo::toObj(scene)));
    } else {
        const std::vector<std::uint8_t> glb = demo::toGlb(scene);
        orThrow(written(arguments.out, {reinterpret_cast<const char*>(glb.data()), glb.size()}));
    }
    fmt::print("{}: {} triangles drawn, {} nodes, {} meshes, {} materials, {} images, {} lights\n",
               arguments.out, demo::trianglesDrawn(scene), scene.nodes.size(), scene.meshes.size(),
               scene.materials.size(), scene.images.size(), scene.lights.size());
}

}  // namespace

int main(int count, char** words) {
    const std::span all{words, static_cast<std::size_t>(count)};
    if (count == 2 && std::string_view{words[1]} == "--help") {
        std::fputs(usage.data(), stdout);
        return 0;
    }
    const Result<Arguments> arguments = parsed(all.subspan(1));
    if (!arguments) {
        fmt::print(stderr, "gnomon-demo-scene: {}\n{}", arguments.error().text(), usage);
        return 2;
    }
    try {
        run(*arguments);
        return 0;
    } catch (const std::exception& problem) {
        fmt::print(stderr, "gnomon-demo-scene: {}\n", problem.what());
        return 1;
    }
}

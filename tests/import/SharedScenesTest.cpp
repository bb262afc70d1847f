// What the importer makes of the development scenes and of the hostile files beside the source
// folder, where they are.
#include <gnomon/import/Import.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

#include "Model.h"
#include "ProgramRun.h"
#include "format/Sanitizer.h"

namespace gnomon::importer {
namespace {

std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> out;
    std::stringstream stream{line};
    for (std::string cell; std::getline(stream, cell, '|');) {
        const auto first = cell.find_first_not_of(' ');
        out.push_back(first == std::string::npos
                          ? ""
                          : cell.substr(first, cell.find_last_not_of(' ') - first + 1));
    }
    return out;
}

/// Rows of the manifest's tables, by the first column.
struct Manifest {
    struct Scene {
        std::uint64_t drawn = 0;
        std::array<double, 6> box = {};
    };
    std::map<std::string, Scene> scenes = {};
    std::map<std::string, std::string> wanted = {};  ///< of bad files: what is to happen
};

Manifest readManifest() {
    Manifest manifest;
    std::ifstream in{sharedScenes() / "MANIFEST.md"};
    bool bad = false;
    for (std::string line; std::getline(in, line);) {
        if (line.rfind("## bad", 0) == 0) bad = true;
        const auto c = cells(line);
        if (c.size() < 4) continue;
        if (bad && std::isdigit(static_cast<unsigned char>(c[1][0])) != 0 && c[2] != "side file")
            manifest.wanted[c[1]] = c[2];
        const auto slash = c[2].find(" / ");
        if (bad || slash == std::string::npos || c.size() < 10) continue;
        Manifest::Scene scene;
        auto number = c[2].substr(slash + 3);
        std::erase(number, ',');
        if (number.empty() || std::isdigit(static_cast<unsigned char>(number[0])) == 0) continue;
        scene.drawn = std::stoull(number);
        auto& b = scene.box;
        if (std::sscanf(c[9].c_str(), "(%lf, %lf, %lf) .. (%lf, %lf, %lf)", &b[0], &b[1], &b[2],
                        &b[3], &b[4], &b[5]) != 6)
            continue;
        manifest.scenes[c[1]] = scene;
    }
    return manifest;
}

TEST(SharedScenes, ComeOutAsTheirManifestSays) {
    if (sharedScenes().empty())
        GTEST_SKIP() << "there is no shared/scenes beside the source folder";
    const auto manifest = readManifest();
    ASSERT_GT(manifest.scenes.size(), 30U);
    for (const auto& [name, scene] : manifest.scenes) {
        if (name.find("draco") != std::string::npos) continue;
        SCOPED_TRACE(name);
        const auto start = std::chrono::steady_clock::now();
        const auto list = importScene(sharedScenes() / "dev" / name);
        const auto seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        if (!list) {
            ADD_FAILURE() << list.error().text();
            continue;
        }
        const Model model{*list};
        std::printf("%6.2f s  %8llu triangles  %2zu warnings  %s\n", seconds,
                    static_cast<unsigned long long>(model.imported().trianglesDrawn.get()),
                    model.warnings().size(), name.c_str());
        for (const auto* geometry : model.all<scene::Geometry>())
            EXPECT_EQ(faultsOf(*geometry), "");
        // The manifest does not expand instances; we do.
        const bool instances = name.find("SimpleInstancing") != std::string::npos;
        EXPECT_EQ(model.imported().trianglesDrawn, instances ? 125 * scene.drawn : scene.drawn);
        for (int axis = 0; axis < 3 && !instances; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            // Four digits, as written.
            EXPECT_NEAR(model.imported().boundsMin.get()[axis], scene.box[a],
                        std::max(6e-4 * std::abs(scene.box[a]), 6e-5));
            EXPECT_NEAR(model.imported().boundsMax.get()[axis], scene.box[a + 3],
                        std::max(6e-4 * std::abs(scene.box[a + 3]), 6e-5));
        }
    }
}

TEST(SharedScenes, ThatCannotBeReadAreRefusedClearly) {
    if (sharedScenes().empty())
        GTEST_SKIP() << "there is no shared/scenes beside the source folder";
    const auto draco = importScene(sharedScenes() / "dev/bicycle/bicycle_draco.gltf");
    ASSERT_FALSE(draco);
    EXPECT_NE(draco.error().what.find("Draco"), std::string::npos);
    const auto numbers = importScene(sharedScenes() / "dev/obj_cases/number_formats.obj");
    ASSERT_FALSE(numbers);
    EXPECT_NE(numbers.error().what.find("is not a number"), std::string::npos);
}

/// What the manifest's words ask of the exit code.
std::optional<int> wantedCode(const std::string& words) {
    const auto begins = [&](const char* text) { return words.rfind(text, 0) == 0; };
    const bool choice = words.find(" or ") != std::string::npos;
    if (begins("refuse") && !choice) return 1;
    if (begins("valid") || begins("draw untextured") || begins("untextured")) return 0;
    if (begins("drop ") || begins("empty picture") || begins("ignore the camera")) return 0;
    return {};
}

TEST(HostileFiles, AreRefusedOrReadInTimeAndMemoryAndNeverCrash) {
    if (sharedScenes().empty())
        GTEST_SKIP() << "there is no shared/scenes beside the source folder";
    const auto manifest = readManifest();
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator{sharedScenes() / "bad"}) {
        const auto name = entry.path().filename().string();
        ++files;
        SCOPED_TRACE(name);
        const auto run = runImporter({entry.path().string(), "--output", "-"});
        EXPECT_EQ(run.signal, 0);
        EXPECT_LT(run.seconds, 10.0);
        if (!reservesAddressSpace) {
            EXPECT_LT(run.peakBytes, std::uint64_t{2} << 30U);
        }
        EXPECT_TRUE(run.code == 0 || run.code == 1) << run.code;
        if (run.code == 1) {
            EXPECT_EQ(std::count(run.errors.begin(), run.errors.end(), '\n'), 1) << run.errors;
            EXPECT_NE(run.errors.find(name + ": "), std::string::npos) << run.errors;
            EXPECT_EQ(run.outputBytes, 0U);
        } else {
            EXPECT_EQ(run.errors, "");
            const auto list = importScene(entry.path());
            ASSERT_TRUE(list) << list.error().text();
            const Model model{*list};
            for (const auto* geometry : model.all<scene::Geometry>())
                EXPECT_EQ(faultsOf(*geometry), "");
            std::printf("loads: %s", name.c_str());
            for (const auto& warning : model.warnings()) std::printf(" | %s", warning.c_str());
            std::printf("\n");
        }
        const auto wanted = manifest.wanted.find(name);
        if (wanted == manifest.wanted.end()) continue;
        if (const auto code = wantedCode(wanted->second)) {
            EXPECT_EQ(run.code, *code) << "wanted: " << wanted->second << "; said: " << run.errors;
        }
        if (run.code == 1) std::printf("refuses: %s", run.errors.c_str());
    }
    EXPECT_EQ(files, 81U);  // with side files
}

}  // namespace
}  // namespace gnomon::importer

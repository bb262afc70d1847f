#include <gnomon/base/Process.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace gnomon {
namespace {

struct Outcome {
    int code = -1;
    std::string errors = {};
};

Outcome run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), GNOMON_BIN_DIR "/gnomon-demo-scene");
    Child child = orThrow(Child::start({.arguments = std::move(arguments)}));
    Outcome outcome;
    char buffer[512];
    for (ssize_t got = 0; (got = ::read(child.errors(), buffer, sizeof buffer)) > 0;) {
        outcome.errors.append(buffer, static_cast<std::size_t>(got));
    }
    const int status = child.wait(std::chrono::steady_clock::now() + std::chrono::seconds{120});
    if (WIFEXITED(status)) outcome.code = WEXITSTATUS(status);
    return outcome;
}

struct Refusal {
    const char* name = "";
    std::vector<std::string> arguments = {};
    int code = 2;
    const char* says = "";
};

const Refusal refusals[] = {
    {"unknownScene",
     {"--scene", "forum", "--out", "x.glb"},
     2,
     "--scene is 'forum', expected plaza or grove"},
    {"badSeed", {"--scene", "grove", "--seed", "12x", "--out", "x.glb"}, 2, "--seed is '12x'"},
    {"badEnding", {"--scene", "grove", "--out", "x.png"}, 2, "--out is 'x.png'"},
    {"missingValue", {"--scene", "grove", "--out"}, 2, "--out has no value"},
    {"unknownOption", {"--colour", "red"}, 2, "unknown option '--colour'"},
    {"noFolder",
     {"--scene", "grove", "--out", "/no/such/folder/x.obj"},
     1,
     "/no/such/folder/x.obj: cannot write"},
};

class EveryRefusal : public testing::TestWithParam<Refusal> {};

TEST_P(EveryRefusal, SaysWhatWasFound) {
    const Outcome outcome = run(GetParam().arguments);
    EXPECT_EQ(outcome.code, GetParam().code);
    EXPECT_NE(outcome.errors.find(GetParam().says), std::string::npos) << outcome.errors;
}

INSTANTIATE_TEST_SUITE_P(All, EveryRefusal, testing::ValuesIn(refusals),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(DemoSceneProgram, WritesTheSameFileTwice) {
    const std::filesystem::path folder =
        std::filesystem::path{testing::TempDir()} / ("demo-scene-" + std::to_string(::getpid()));
    std::filesystem::create_directory(folder);
    const auto written = [&](const char* name) {
        const std::filesystem::path path = folder / name;
        const Outcome outcome = run({"--scene", "grove", "--seed", "9", "--out", path.string()});
        EXPECT_EQ(outcome.code, 0) << outcome.errors;
        std::ifstream file{path, std::ios::binary};
        return std::string{std::istreambuf_iterator<char>{file}, {}};
    };
    const std::string first = written("a.obj");
    EXPECT_GT(first.size(), 1'000'000U);
    EXPECT_TRUE(first == written("b.obj"));
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace gnomon

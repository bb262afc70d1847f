// `gnomon bench` from outside: a small scene, two views, a peer that is a shell script.
#include <fmt/format.h>
#include <gnomon/base/Process.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace gnomon {
namespace {

namespace fs = std::filesystem;

struct Ended {
    int status = -1;
    std::string out = {};
    std::string err = {};
};

std::string readAll(int file) {
    std::string text;
    std::array<char, 4096> buffer{};
    for (;;) {
        const auto count = ::read(file, buffer.data(), buffer.size());
        if (count <= 0) return text;
        text.append(buffer.data(), static_cast<std::size_t>(count));
    }
}

class BenchProgram : public testing::Test {
protected:
    BenchProgram() : folder_{fs::path{testing::TempDir()} / fmt::format("bench-{}", ::getpid())} {
        fs::create_directories(folder_);
        // Ground of 8 x 8 m, and a plate of 2 x 2 m one metre above it.
        write("scene.obj",
              "v -4 0 -4\nv -4 0 4\nv 4 0 4\nv 4 0 -4\nv -1 1 -1\nv -1 1 1\nv 1 1 1\nv 1 1 -1\n"
              "f 1 2 3 4\nf 5 6 7 8\n");
        write("views.jsonl",
              "{\"name\": \"above\", \"eye\": [0, 6, 6], \"center\": [0, 0, 0], \"sun\": [0.3, 1, "
              "0.2]}\n{\"name\": \"lamp\", \"eye\": [3, 5, 3], \"center\": [0, 0, 0], \"point\": "
              "[1, 5, 0]}\n");
    }
    ~BenchProgram() override { fs::remove_all(folder_); }

    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream{folder_ / name} << text;
        return (folder_ / name).string();
    }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    Ended run(std::vector<std::string> words) const {
        words.insert(words.begin(), {GNOMON_BIN_DIR "/gnomon", "bench"});
        auto child = orThrow(Child::start({.arguments = std::move(words)}));
        Ended ended;
        ended.out = readAll(child.output());
        ended.err = readAll(child.errors());
        const int status = child.wait(std::chrono::steady_clock::now() + std::chrono::seconds{60});
        ended.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        return ended;
    }
    nlohmann::json tables() const {
        std::ifstream in{folder_ / "t.json"};
        return nlohmann::json::parse(in)["tables"];
    }
    /// A peer that lights everything and says that a frame takes a quarter of a second.
    std::string peer(const std::string& atFrame) const {
        const auto file =
            write("peer",
                  "#!/bin/sh\n[ \"$1\" = --list ] && { echo Bright; echo Other; exit 0; }\n"
                  "echo ready\nwhile read word rest; do case $word in\n"
                  "frame) " +
                      atFrame +
                      ";;\n"
                      "factor) { printf 'P5\\n%s %s\\n255\\n' \"$4\" \"$5\"; head -c $(($4 * $5)) "
                      "/dev/zero |"
                      " tr '\\0' '\\377'; } > \"$rest\"; echo factor;;\n"
                      "*) echo $word;; esac; done\n");
        ::chmod(file.c_str(), 0755);
        return file;
    }

    fs::path folder_;
};

TEST_F(BenchProgram, MakesATableForEachViewSizeAndMotion) {
    // Lists end with their word, so that the scene may stand anywhere.
    const auto ended = run({"--views",
                            path("views.jsonl"),
                            "--map-size",
                            "256",
                            "--size",
                            "64x48,48x32",
                            "--motion",
                            "static,dynamic",
                            "--technique",
                            "none,std",
                            path("scene.obj"),
                            "--frames",
                            "3",
                            "--flicker",
                            "3",
                            "--no-peer",
                            "--json",
                            path("t.json"),
                            "--csv",
                            path("t.csv"),
                            "--report",
                            path("report")});
    ASSERT_EQ(ended.status, 0) << ended.err << ended.out;
    const auto all = tables();
    ASSERT_EQ(all.size(), 8U);
    for (const auto& table : all) {
        ASSERT_EQ(table["runs"].size(), 2U);
        const auto& none = table["runs"][0];
        const auto& standard = table["runs"][1];
        EXPECT_GT(none["wrong"], 0.01) << table["view"];
        EXPECT_LT(standard["wrong"], none["wrong"]);
        EXPECT_GT(standard["frame_ms"][1], 0.0);
        EXPECT_EQ(none["ratio"][1], 1.0);
        EXPECT_EQ(none["flicker_camera"]["share"], 0.0) << "it never changes";
        EXPECT_GT(none["flicker_light"]["counted"], 1000);
        if (table["dynamic"])
            EXPECT_GT(standard["map_texels"], 0) << "drawn in every frame";
        else
            EXPECT_EQ(standard["map_texels"], 0) << "kept";
    }
    int plots = 0;
    for (const auto& file : fs::directory_iterator{folder_ / "report"})
        plots += file.path().filename().string().starts_with("plot-") ? 1 : 0;
    EXPECT_EQ(plots, 16) << "SVG and PNG of each table";
    EXPECT_TRUE(fs::exists(folder_ / "report" / "index.html"));
}

TEST_F(BenchProgram, ViewsOfSeveralScenesGoToTheirOwn) {
    fs::copy_file(path("scene.obj"), path("other.obj"));
    const auto views =
        write("two.jsonl", "{\"name\": \"both\"}\n{\"name\": \"one\", \"scene\": \"other\"}\n");
    const auto walk = write("walk.jsonl",
                            "{\"time\": 0, \"eye\": [0, 6, 6], \"center\": [0, 0, 0]}\n"
                            "{\"time\": 1, \"eye\": [3, 6, 6], \"center\": [0, 0, 0]}\n");
    const auto ended =
        run({path("scene.obj"), path("other.obj"), "--views", views, "--size", "64x48",
             "--technique", "std", "--map-size", "64", "--frames", "2", "--flicker", "4", "--path",
             walk, "--no-peer", "--json", path("t.json")});
    ASSERT_EQ(ended.status, 0) << ended.err << ended.out;
    std::vector<std::string> found;
    for (const auto& table : tables())
        found.push_back(table["scene"].get<std::string>() + " " + table["view"].get<std::string>());
    EXPECT_EQ(found,
              (std::vector<std::string>{"scene.obj both", "other.obj both", "other.obj one"}));
    EXPECT_GT(tables()[0]["runs"][0]["flicker_camera"]["share"], 0.0)
        << "64 texels on 8 m, and strides of a metre";
}

TEST_F(BenchProgram, APeerTakesTurnsWithUs) {
    const auto ended = run({path("scene.obj"), "--views", path("views.jsonl"), "--size", "64x48",
                            "--technique", "std", "--map-size", "64", "--frames", "4", "--peer",
                            peer("echo frame 250"), "--json", path("t.json")});
    ASSERT_EQ(ended.status, 0) << ended.err << ended.out;
    const auto all = tables();
    ASSERT_EQ(all.size(), 2U);
    ASSERT_EQ(all[0]["runs"].size(), 3U);
    const auto& bright = all[0]["runs"][1];
    EXPECT_EQ(bright["technique"], "peer Bright");
    EXPECT_EQ(bright["peer"], true);
    EXPECT_EQ(bright["frame_ms"][1], 250.0);
    EXPECT_GT(bright["ratio"][1], 1.0);
    EXPECT_GT(bright["wrong"], all[0]["runs"][0]["wrong"]) << "it has no shadow";
    EXPECT_EQ(all[1]["runs"].size(), 1U) << "peers know suns alone";
    EXPECT_NE(ended.out.find("one sun alone"), std::string::npos);
}

TEST_F(BenchProgram, GoesOnWithoutAPeerThatFails) {
    const std::vector<std::string> words{
        path("scene.obj"), "--size", "64x48",  "--technique",  "std",   "--map-size", "64",
        "--frames",        "4",      "--json", path("t.json"), "--peer"};
    for (const std::string& program : {peer("echo 'peer: the screen is gone' >&2; exit 1"),
                                       std::string{"/bin/false"}, std::string{"/no/such/peer"}}) {
        auto all = words;
        all.push_back(program);
        const auto ended = run(all);
        ASSERT_EQ(ended.status, 0) << ended.err << ended.out;
        EXPECT_NE(ended.out.find("warning: "), std::string::npos) << ended.out;
        EXPECT_NE(ended.out.find("going on without"), std::string::npos) << ended.out;
        EXPECT_EQ(tables()[0]["runs"].size(), 1U);
    }
}

TEST_F(BenchProgram, WrongUsageIsOneLineAndCodeTwo) {
    const std::string scene = path("scene.obj");
    const auto broken = write("broken.jsonl", "{\"name\": \"a\"}\n{\"name\": \"b\", \"fov\": 1}\n");
    const std::vector<std::vector<std::string>> wrong{
        {},
        {scene, "--sweep", "thseis"},
        {scene, "--sweep", "thesis", "--technique", "std"},
        {scene, "--technique", "sdt"},
        {scene, "--motion", "slow"},
        {scene, "--size", "64x48,64"},
        {scene, "--map-size", "1"},
        {scene, "--views", broken},
        {scene, "--views", path("views.jsonl"), "--sun", "0,1,0"}};
    for (const auto& words : wrong) {
        const auto ended = run(words);
        EXPECT_EQ(ended.status, 2) << fmt::format("{}", fmt::join(words, " ")) << ended.err;
        EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
    }
    EXPECT_NE(run({scene, "--views", broken}).err.find("broken.jsonl:2: "), std::string::npos);
    // The scene of a view is not among those named, or is not there at all: failures.
    const auto other = write("other.jsonl", "{\"name\": \"a\", \"scene\": \"grove\"}\n");
    EXPECT_EQ(run({scene, "--views", other}).status, 1);
    EXPECT_EQ(run({"/no/such/scene.obj", "--frames", "1"}).status, 1);
}

}  // namespace
}  // namespace gnomon

#include <gnomon/image/Compare.h>
#include <gnomon/image/Png.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "WallTest.h"

namespace gnomon::wall {
namespace {

class Run : public WallTest {
protected:
    /// Some machines have no EGL; then a server says so and the wall does not start.
    static bool withoutEgl(Program& run) {
        return run.wait() == 1 && run.errors().size() == 1 &&
               run.errors()[0].find("exit code 1") != std::string::npos &&
               run.output().find("EGL") != std::string::npos;
    }
    /// How many pixels differ by more than that in some channel.
    static double differing(const image::Image& a, const image::Image& b, int threshold) {
        return orThrow(image::compare(a, b, threshold)).share * a.width * a.height;
    }
};

TEST_F(Run, TellsItsFramesAsJson) {
    const auto json = folder.path("run.json");
    Program run{{"run", file, "--backend", "none", "--frames", "200", "--json", json}};
    ASSERT_EQ(run.wait(), 0) << testing::PrintToString(run.errors());
    EXPECT_TRUE(run.errors().empty());
    std::ifstream in{json};
    const auto told = nlohmann::json::parse(in);
    EXPECT_EQ(told["frames"], 200);
    for (const char* key : {"median", "p99", "max"})
        EXPECT_GT(told["frame_ms"][key].get<double>(), 0.0) << key;
    for (const char* key : {"median", "p99"})
        EXPECT_GE(told["skew_ms"][key].get<double>(), 0.0) << key;
    // A still scene: a header and nothing else.
    EXPECT_GT(told["bytes_per_frame"].get<double>(), 8.0);
    EXPECT_LT(told["bytes_per_frame"].get<double>(), 200.0);
    ASSERT_EQ(told["servers"].size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(told["servers"][i]["name"], names[i]);
        EXPECT_EQ(told["servers"][i]["lost"], 0);
        EXPECT_EQ(told["servers"][i]["rejoined"], 0);
    }
}

TEST_F(Run, SaysWhatItWouldStart) {
    Program run{{"run", file, "--backend", "egl", "--dry-run"}};
    ASSERT_EQ(run.wait(), 0);
    for (const auto& name : names) {
        EXPECT_NE(run.output().find("--name " + name + " --listen 127.0.0.1:0 --backend egl"),
                  std::string::npos)
            << run.output();
        EXPECT_TRUE(serversNamed(name).empty());
    }
}

TEST_F(Run, WritesTheWallsPicture) {
    // The upper half of the background is red, the lower half blue, more or less.
    const auto wall = folder.write(
        "colours.toml", text() + "[render]\nbackground = [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]\n");
    const auto out = folder.path("wall.png");
    Program run{{"run", wall, "--backend", "egl", "--frames", "3", "--out", out}};
    if (withoutEgl(run)) GTEST_SKIP() << "no EGL here: " << run.errors()[0];
    ASSERT_EQ(run.wait(), 0) << testing::PrintToString(run.errors()) << run.output();
    const auto picture = orThrow(image::readPng(out));
    EXPECT_EQ(picture.width, 160);
    EXPECT_EQ(picture.height, 80);
    for (const int x : {1, 79, 80, 158}) {
        const auto at = [&](int y, int channel) {
            return picture.pixels[static_cast<std::size_t>((y * 160 + x) * 3 + channel)];
        };
        EXPECT_GT(at(1, 0), 220) << x;
        EXPECT_LT(at(1, 2), 80) << x;
        EXPECT_GT(at(78, 2), 220) << x;
        EXPECT_LT(at(78, 0), 80) << x;
    }
}

TEST_F(Run, FitsShadowsToTheDepthThatAllServersSee) {
    const auto scene = folder.write("scene.obj",
                                    "v -9 0 -9\nv 9 0 -9\nv 9 0 9\nv -9 0 9\nf 4 3 2 1\n"
                                    "v -1 0 -1\nv 1 0 -1\nv 1 2 0\nv -1 2 0\nf 5 6 7 8\n");
    const std::vector<std::string> sun{"--sun", "0.4,1,0.3"};
    std::map<std::string, image::Image> pictures;
    for (const std::string use : {"off", "previous", "exact"}) {
        const auto wall = folder.write(
            use + ".toml", text() + "[shadow]\ntechnique = \"lispsm\"\nmap_size = 256\n" +
                               "depth_range = \"" + use + "\"\n");
        const auto out = folder.path(use + ".png");
        std::vector<std::string> words{"run", wall,       "--scene", scene,   "--backend",
                                       "egl", "--frames", "6",       "--out", out};
        words.insert(words.end(), sun.begin(), sun.end());
        Program run{words};
        if (withoutEgl(run)) GTEST_SKIP() << "no EGL here: " << run.errors()[0];
        ASSERT_EQ(run.wait(), 0) << testing::PrintToString(run.errors()) << run.output();
        pictures[use] = orThrow(image::readPng(out));
        if (use == "previous") continue;  // there is no frame before a single picture
        const auto one = folder.path(use + "-one.png");
        words = {"shot", scene, "--wall", wall, "--backend", "egl", "--out", one};
        words.insert(words.end(), sun.begin(), sun.end());
        Program shot{words};
        ASSERT_EQ(shot.wait(), 0) << testing::PrintToString(shot.errors()) << shot.output();
        EXPECT_LE(differing(pictures[use], orThrow(image::readPng(one)), 2), 1.5) << use;
    }
    // The whole ground is in the view's volume, half of it below the picture's edge.
    EXPECT_GT(differing(pictures["off"], pictures["exact"], 2), 0.5) << "another fit";
    EXPECT_LT(differing(pictures["previous"], pictures["exact"], 60), 60.0) << "the same shadow";
}

TEST_F(Run, TilesOfAnotherSizeOnRequest) {
    const auto out = folder.path("wall.png");
    Program run{
        {"run", file, "--backend", "egl", "--frames", "1", "--tile", "32x24", "--out", out}};
    if (withoutEgl(run)) GTEST_SKIP() << "no EGL here: " << run.errors()[0];
    ASSERT_EQ(run.wait(), 0) << testing::PrintToString(run.errors());
    const auto picture = orThrow(image::readPng(out));
    EXPECT_EQ(picture.width, 64);
    EXPECT_EQ(picture.height, 24);
}

TEST_F(Run, FollowsACameraPathToItsEnd) {
    const auto path =
        folder.write("way.jsonl",
                     "{\"time\": 0, \"eye\": [0,0,5], \"center\": [0,0,0], \"up\": [0,1,0]}\n"
                     "{\"time\": 2, \"eye\": [5,0,0], \"center\": [0,0,0], \"up\": [0,1,0]}\n");
    Program run{{"run", file, "--backend", "none", "--frames", "20", "--path", path, "--technique",
                 "none"}};
    EXPECT_EQ(run.wait(), 0) << testing::PrintToString(run.errors());
}

TEST_F(Run, CheckDescribesTheWall) {
    const auto svg = folder.path("wall.svg");
    Program check{{"check", file, "--svg", svg}};
    ASSERT_EQ(check.wait(), 0) << testing::PrintToString(check.errors());
    for (const auto& name : names) EXPECT_NE(check.output().find(name), std::string::npos);
    std::ifstream in{svg};
    std::string first;
    std::getline(in, first);
    EXPECT_NE(first.find("<"), std::string::npos);
    Program hosts{{"check", file, "--hosts"}};
    EXPECT_EQ(hosts.wait(), 0);
    EXPECT_EQ(hosts.output(), "localhost\n");
}

}  // namespace
}  // namespace gnomon::wall

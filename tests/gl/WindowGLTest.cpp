#include <gnomon/gl/Window.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>

#include "GLTest.h"
#include "Probe.h"

namespace gnomon::gl {
namespace {

std::optional<std::string> findProgram(const std::string& program) {
    const char* path = std::getenv("PATH");
    std::istringstream folders{path != nullptr ? path : ""};
    for (std::string folder; std::getline(folders, folder, ':');)
        if (const auto file = std::filesystem::path{folder} / program;
            ::access(file.c_str(), X_OK) == 0)
            return file.string();
    return {};
}

/// A virtual display of 640 x 480 that keeps its picture in a file.
class WindowGLTest : public testing::Test {
protected:
    void SetUp() override {
        const auto xvfb = findProgram("Xvfb");
        if (!xvfb) GTEST_SKIP() << "the program Xvfb is not installed";
        std::string pattern =
            (std::filesystem::temp_directory_path() / "gnomon-xvfb-XXXXXX").string();
        ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
        auto started =
            Child::start({.arguments = {*xvfb, "-displayfd", "1", "-screen", "0", "640x480x24",
                                        "-nolisten", "tcp", "-fbdir", pattern}});
        ASSERT_TRUE(started) << started.error().text();
        server_.emplace(*std::move(started));
        const auto number = readPipe(server_->output(), '\n');  // written once it listens
        ASSERT_FALSE(number.empty()) << "Xvfb did not start: " << readPipe(server_->errors());
        display_ = "DISPLAY=:" + number.substr(0, number.find('\n'));
    }
    void TearDown() override {
        server_.reset();
        if (!folder_.empty()) std::filesystem::remove_all(folder_);
    }

    std::vector<std::string> environment() const { return {display_, "WAYLAND_DISPLAY="}; }
    std::string screenshot() const { return folder_ / "Xvfb_screen0"; }

private:
    std::filesystem::path folder_;
    std::optional<Child> server_;
    std::string display_;
};

TEST_F(WindowGLTest, GlfwGives45CoreAndClears) {
    const auto run = runProbe({"clear", "glfw"}, environment());
    ASSERT_TRUE(run.succeeded) << run.problem;
    EXPECT_EQ(value(run, "backend"), "glfw");
    EXPECT_EQ(value(run, "profile"), "core");
    EXPECT_EQ(value(run, "pixel"), "51 102 153 204");
    EXPECT_EQ(value(run, "debug"), "(no debug)");
    EXPECT_EQ(value(run, "mistakes"), "1");
}

TEST_F(WindowGLTest, AutoTakesGlfwWhenAWindowIsWanted) {
    const auto run = runProbe({"auto", "window"}, environment());
    ASSERT_TRUE(run.succeeded) << run.problem;
    EXPECT_EQ(value(run, "backend"), "glfw");
    EXPECT_PRED_FORMAT2(contains, value(run, "description"),
                        "[auto chose glfw: a window is wanted, DISPLAY=:");
    EXPECT_EQ(value(runProbe({"auto"}, environment()), "backend"), "egl");
}

TEST_F(WindowGLTest, AWindowShowsATextureUprightAndAtOnce) {
    const auto run = runProbe({"window", screenshot()}, environment());
    ASSERT_TRUE(run.succeeded) << run.problem;
    EXPECT_EQ(value(run, "firstSize"), "64x48");
    EXPECT_EQ(value(run, "firstTop"), "200 150 100");
    EXPECT_EQ(value(run, "firstBottom"), "10 20 30");
    EXPECT_EQ(value(run, "secondTop"), "4 5 6");
    EXPECT_EQ(value(run, "secondBottom"), "1 2 3");
    EXPECT_EQ(value(run, "noTexture"), "window: there is no texture 12345");
    EXPECT_PRED_FORMAT2(contains, value(run, "depthTexture"), "a 2D colour texture is needed");
    EXPECT_EQ(value(run, "fullscreen"), "640x480");
    EXPECT_EQ(value(run, "swapGroup"), "the driver offers no swap groups (GLX_NV_swap_group)");
    EXPECT_PRED_FORMAT2(contains, value(run, "noMonitor"),
                        "there is no monitor 7; monitors found: 0: ");
    EXPECT_PRED_FORMAT2(contains, value(run, "noMonitor"), "640x480 at 0,0");
    EXPECT_EQ(value(run, "debug"), "(no debug)");
}

TEST_F(WindowGLTest, InputArrivesInOrder) {
    const auto run = runProbe({"window", screenshot()}, environment());
    ASSERT_TRUE(run.succeeded) << run.problem;
    std::istringstream lines{run.output};
    std::string events;
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("event ")) events += line + "\n";
    EXPECT_EQ(events,
              "event key code=65 action=1 mods=1 at=0,0\n"
              "event motion code=0 action=0 mods=0 at=5,6\n"
              "event button code=0 action=1 mods=0 at=5,6\n"
              "event motion code=0 action=0 mods=0 at=9,10\n"  // the later of two
              "event scroll code=0 action=0 mods=0 at=0,1\n"
              "event resize code=0 action=0 mods=0 at=80,60\n"
              "event close code=0 action=0 mods=0 at=0,0\n");
}

TEST(Window, OnlyGlfwOpensOne) {
    const auto context = createContext({.backend = Backend::egl});
    ASSERT_TRUE(context) << context.error().text();
    const auto window = openWindow(**context, {.title = "left"});
    ASSERT_FALSE(window);
    EXPECT_EQ(window.error().what,
              "window \"left\": the egl back end shows no windows, only glfw does");
}

}  // namespace
}  // namespace gnomon::gl

// A server that comes back shows the right picture with its second frame.
#include <gnomon/client/Application.h>
#include <gnomon/config/Load.h>
#include <gnomon/image/Compare.h>

#include <algorithm>

#include "FaultTest.h"

namespace gnomon::faults {
namespace {

using client::Application;

const math::dvec3 before{3.0, 4.0, 6.0};
const math::dvec3 after{-5.0, 3.0, 4.0};
const math::dvec3 middle{0.0, 0.5, 0.0};

class Picture : public FaultTest, public testing::WithParamInterface<Way> {
protected:
    /// Null, where this machine has no EGL.
    std::unique_ptr<Application> start() {
        const auto scene = folder.write("scene.obj",
                                        "v -9 0 -9\nv 9 0 -9\nv 9 0 9\nv -9 0 9\nf 4 3 2 1\n"
                                        "v -1 0 -1\nv 1 0 -1\nv 1 2 0\nv -1 2 0\nf 5 6 7 8\n"
                                        "v 2 0 1\nv 3 0 1\nv 2.5 2 1.5\nf 9 10 11\n");
        const auto wall =
            folder.write("wall.toml", text("timeout = 5.0", "") +
                                          "[shadow]\ntechnique = \"lispsm\"\nmap_size = 256\n");
        auto app = std::make_unique<Application>(
            orThrow(config::loadConfig(wall)),
            client::ApplicationOptions{.backend = "egl",
                                       .server = GNOMON_BIN_DIR "/gnomon-server"});
        orThrow(app->load(scene));
        app->addDefaultSun();
        look(*app, before);
        const auto started = app->start();
        if (!started) {
            if (started.error().what.find("EGL") == std::string::npos)
                throw Failure{started.error()};
            return {};
        }
        return app;
    }
    static void look(Application& app, const math::dvec3& eye) { app.setView(eye, middle); }
    image::Image capture(Application& app) {
        const auto pictures = orThrow(app.capture(0.0));
        EXPECT_EQ(pictures.size(), 1U);
        EXPECT_TRUE(pictures[0].missing.empty());
        return pictures[0].image;
    }
    static double differing(const image::Image& a, const image::Image& b) {
        return orThrow(image::compare(a, b, 2)).share;
    }
    static image::Image half(const image::Image& whole) {
        image::Image right{.width = whole.width / 2, .height = whole.height, .channels = 3};
        const auto row = static_cast<std::size_t>(whole.width) * 3;
        for (int y = 0; y < whole.height; ++y) {
            const auto end = whole.pixels.begin() +
                             static_cast<std::ptrdiff_t>(row * static_cast<std::size_t>(y + 1));
            right.pixels.insert(right.pixels.end(), end - static_cast<std::ptrdiff_t>(row / 2),
                                end);
        }
        return right;
    }
    static bool has(const std::vector<std::string>& names, const std::string& name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    }
    /// Shows frames until this is so.
    template <class Predicate>
    static net::FrameResult showUntil(Application& app, Predicate&& enough) {
        const auto limit = std::chrono::steady_clock::now() + wall::patience;
        for (;;) {
            const auto result = app.frame(0.0);
            if (enough(result)) return result;
            if (std::chrono::steady_clock::now() > limit)
                throw Failure{Errc::timeout, "it never happened"};
        }
    }
};

TEST_P(Picture, IsRightWithinTwoFramesOfTheReturn) {
    const auto app = start();
    if (!app) GTEST_SKIP() << "no EGL here";
    look(*app, after);
    const auto expected = capture(*app);
    look(*app, before);
    const auto stale = capture(*app);
    ASSERT_GT(differing(half(expected), half(stale)), 0.05) << "a stale picture would pass";

    const pid_t victim = processOf(right());
    ASSERT_EQ(::kill(victim, GetParam().signal), 0);
    showUntil(*app, [&](const auto& result) { return has(result.droppedNow, right()); });
    look(*app, after);  // it does not see this
    app->frame(0.0);
    if (GetParam().signal == SIGSTOP) ::kill(victim, SIGCONT);
    const auto back =
        showUntil(*app, [&](const auto& result) { return has(result.joinedNow, right()); });

    const auto next = app->frame(0.0, true);
    EXPECT_LE(next.n, back.shown + 2);
    const auto pictures = orThrow(app->pictures(next.n, 60s));
    ASSERT_EQ(pictures.size(), 1U);
    EXPECT_TRUE(pictures[0].missing.empty());
    EXPECT_EQ(differing(pictures[0].image, expected), 0.0);
    std::printf("[  FIGURES ] back with frame %llu, right in frame %llu\n",
                static_cast<unsigned long long>(back.shown),
                static_cast<unsigned long long>(next.n));
    app->shutdown();
}

INSTANTIATE_TEST_SUITE_P(All, Picture,
                         testing::Values(Way{"killed", SIGKILL},
                                         Way{"stoppedAndContinued", SIGSTOP}),
                         [](const auto& row) { return std::string{row.param.name}; });

}  // namespace
}  // namespace gnomon::faults

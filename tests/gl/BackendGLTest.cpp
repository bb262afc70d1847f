#include <gnomon/gl/Context.h>
#include <gtest/gtest.h>

#include <string>

#include "Probe.h"

namespace gnomon::gl {
namespace {

const std::string noDisplay = "DISPLAY=";
const std::string noWayland = "WAYLAND_DISPLAY=";
const std::string noEgl = "__EGL_VENDOR_LIBRARY_FILENAMES=/nowhere";  // glvnd finds no driver

/// A 4.5 core context that clears to the right colour, also on another thread, without complaint,
/// and that reports the one mistake the probe makes on purpose.
void expectWorking(const ProbeRun& run) {
    ASSERT_TRUE(run.succeeded) << run.problem;
    EXPECT_EQ(value(run, "version").substr(0, 2), "4.") << run.output;
    EXPECT_GE(value(run, "version"), "4.5");
    EXPECT_EQ(value(run, "profile"), "core");
    EXPECT_EQ(value(run, "pixel"), "51 102 153 204");
    EXPECT_EQ(value(run, "debug"), "(no debug)");
    EXPECT_EQ(value(run, "mistakes"), "1");
}

void expectError(const ProbeRun& run, const std::string& part) {
    EXPECT_FALSE(run.succeeded) << run.output;
    EXPECT_PRED_FORMAT2(contains, value(run, "error"), part) << run.problem;
}

TEST(Backend, WordsRoundTripAndOthersAreRefused) {
    for (const auto backend : {Backend::egl, Backend::osmesa, Backend::glfw, Backend::automatic})
        EXPECT_EQ(parseBackend(name(backend)).value(), backend);
    const auto wrong = parseBackend("EGL");
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.error().code, Errc::config);
    EXPECT_EQ(wrong.error().what, "back end is \"EGL\", must be egl, osmesa, glfw or auto");
}

TEST(Backend, EglGives45CoreAndClears) {
    const auto run = runProbe({"clear", "egl"}, {noDisplay, noWayland});
    expectWorking(run);
    EXPECT_EQ(value(run, "backend"), "egl");
    EXPECT_PRED_FORMAT2(contains, value(run, "description"), ", OpenGL 4.");
}

TEST(Backend, OsmesaGives45CoreAndClears) {
    const auto run = runProbe({"clear", "osmesa"}, {noDisplay, noWayland});
    expectWorking(run);
    EXPECT_EQ(value(run, "backend"), "osmesa");
}

TEST(Backend, EglTakesAGpuByNumber) {
    const auto run = runProbe({"clear", "egl", "0"});
    if (value(run, "error").find("devices found: none") != std::string::npos)
        GTEST_SKIP() << "this machine's EGL lists no devices";
    expectWorking(run);
    EXPECT_PRED_FORMAT2(contains, value(run, "description"), "device 0 (");
}

TEST(Backend, AGpuOutOfRangeListsTheDevices) {
    const auto run = runProbe({"clear", "egl", "99"});
    expectError(run, "egl: there is no gpu 99; devices found: ");
    if (value(run, "error").find("devices found: none") == std::string::npos) {
        EXPECT_PRED_FORMAT2(contains, value(run, "error"), "devices found: 0: ");
    }
}

TEST(Backend, OnlyEglTakesAGpu) {
    for (const std::string backend : {"osmesa", "glfw"})
        expectError(runProbe({"clear", backend, "0"}),
                    backend + " cannot choose a GPU: gpu is 0, only egl takes one");
    expectError(runProbe({"clear", "egl", "-2"}), "gpu is -2, must be -1");
}

TEST(Backend, WithoutAnEglDriverTheErrorSaysWhatWasTried) {
    expectError(runProbe({"clear", "egl"}, {noEgl}), "egl: ");
}

TEST(Backend, WithoutADisplayGlfwNamesTheVariables) {
    expectError(runProbe({"clear", "glfw"}, {noDisplay, noWayland}),
                "glfw: no display to open: neither DISPLAY nor WAYLAND_DISPLAY is set");
    expectError(runProbe({"clear", "glfw"}, {"DISPLAY=:nowhere", noWayland}),
                "glfw: cannot open the display (DISPLAY=:nowhere): ");
}

TEST(Backend, AutoTakesEglFirstAndExplainsItself) {
    const auto run = runProbe({"auto"}, {noDisplay, noWayland});
    expectWorking(run);
    EXPECT_PRED_FORMAT2(contains, value(run, "description"),
                        "[auto chose egl: glfw not tried (no window is wanted)]");
}

TEST(Backend, AutoFallsBackToOsmesaAndSaysWhy) {
    const auto run = runProbe({"auto", "window"}, {noDisplay, noWayland, noEgl});
    expectWorking(run);
    EXPECT_EQ(value(run, "backend"), "osmesa");
    EXPECT_PRED_FORMAT2(contains, value(run, "description"),
                        "[auto chose osmesa: glfw not tried (neither DISPLAY nor WAYLAND_DISPLAY "
                        "is set); egl failed (egl: ");
}

TEST(Backend, AutoTriesADisplayThatIsSetAndWanted) {
    const auto run = runProbe({"auto", "window"}, {"DISPLAY=:nowhere", noWayland});
    expectWorking(run);
    EXPECT_EQ(value(run, "backend"), "egl");
    EXPECT_PRED_FORMAT2(contains, value(run, "description"),
                        "glfw failed (glfw: cannot open the display (DISPLAY=:nowhere)");
}

TEST(Backend, OneProcessUsesOneFamily) {
    for (const auto& [first, second] :
         {std::pair{"egl", "osmesa"}, std::pair{"osmesa", "egl"}, std::pair{"osmesa", "glfw"}}) {
        const auto run = runProbe({"both", first, second}, {noDisplay, noWayland});
        ASSERT_TRUE(run.succeeded) << run.problem;
        EXPECT_PRED_FORMAT2(contains, value(run, "second"), "this process already made an ");
        EXPECT_EQ(value(run, "pixel"), "51 102 153 204") << "the first context must still work";
    }
}

TEST(Backend, OneProcessMayHaveSeveralContexts) {
    const auto run = runProbe({"both", "egl", "egl"});
    ASSERT_TRUE(run.succeeded) << run.problem;
    EXPECT_EQ(value(run, "second"), "made");
    EXPECT_EQ(value(run, "pixel"), "51 102 153 204");
}

}  // namespace
}  // namespace gnomon::gl

#include <gtest/gtest.h>

#include "Walls.h"

namespace gnomon::config {
namespace {

// smallWall with one text replaced, and the error that must come first.
struct Broken {
    const char* name = "";
    const char* from = "";
    const char* to = "";
    const char* error = "";
};

void PrintTo(const Broken& broken, std::ostream* out) { *out << broken.name; }

constexpr Broken brokenWalls[] = {
    {.name = "syntax",
     .from = "head = [0.0",
     .to = "head = [0.0,,",
     .error = "wall.toml:3:13: not TOML: "},
    {.name = "keyTwice",
     .from = "eye_separation",
     .to = "head",
     .error = "wall.toml:4:8: not TOML: cannot redefine existing array 'head'"},
    {.name = "eyeSeparationNegative",
     .from = "0.063",
     .to = "-0.06",
     .error = "wall.toml:4:18: user: eye_separation is -0.06 m, must be >= 0"},
    {.name = "eyeSeparationAText",
     .from = "0.063",
     .to = "\"6 cm\"",
     .error = "wall.toml:4:18: user: eye_separation is \"6 cm\", must be a number"},
    {.name = "notFinite",
     .from = "0.063",
     .to = "nan",
     .error = "wall.toml:4:18: user: eye_separation is nan, must be a finite number"},
    {.name = "headOfTwoNumbers",
     .from = "[0.0, 1.7, 3.0]",
     .to = "[0.0, 1.7]",
     .error = "wall.toml:3:8: user: head is a list of 2 values, must be a list of 3 numbers"},
    {.name = "forwardVertical",
     .from = "eye_separation = 0.063",
     .to = "forward = [0, -1, 0]",
     .error = "wall.toml:4:11: user: forward is [0.0, -1.0, 0.0], must not be vertical or zero"},
    {.name = "headBehind",
     .from = "1.7, 3.0]",
     .to = "1.7, -0.5]",
     .error = "wall.toml:3:8: user: an eye is 0.5 m behind the plane of screen \"front\""},
    {.name = "headOnThePlane",
     .from = "1.7, 3.0]",
     .to = "1.7, 0]",
     .error = "wall.toml:3:8: user: an eye is on the plane of screen \"front\""},
    {.name = "misspelledKey",
     .from = "eye_separation",
     .to = "eye_seperation",
     .error = "wall.toml:4:1: user: unknown key \"eye_seperation\", did you mean "
              "\"eye_separation\"?"},
    {.name = "camelCaseKey",
     .from = "eye_separation",
     .to = "eyeSeparation",
     .error = "wall.toml:4:1: user: unknown key \"eyeSeparation\", did you mean "
              "\"eye_separation\"?"},
    {.name = "keyOfAnotherTable",
     .from = "pipeline = 1",
     .to = "map_size = 512",
     .error = "wall.toml:6:1: sync: unknown key \"map_size\", it belongs in [shadow]"},
    {.name = "keyOfNoTable",
     .from = "pipeline = 1",
     .to = "fish = 1",
     .error = "wall.toml:6:1: sync: unknown key \"fish\", known in [sync]: timeout, start_timeout, "
              "on_timeout, pipeline"},
    {.name = "misspelledTable",
     .from = "[shadow]",
     .to = "[shadows]",
     .error = "wall.toml:7:2: unknown key \"shadows\", did you mean \"shadow\"?"},
    {.name = "tableNotATable",
     .from = "[sync]\npipeline = 1\n",
     .to = "sync = 3\n",
     .error = "wall.toml:5:1: user: unknown key \"sync\""},
    {.name = "screenNotAList",
     .from = "[[screen]]",
     .to = "[screen]",
     .error = "wall.toml:10:1: screen is a table, must be a list of tables, [[...screen]]"},
    {.name = "pipelineTooDeep",
     .from = "pipeline = 1",
     .to = "pipeline = 3",
     .error = "wall.toml:6:12: sync: pipeline is 3 frames, must be 0 to 2"},
    {.name = "pipelineNotWhole",
     .from = "pipeline = 1",
     .to = "pipeline = 1.5",
     .error = "wall.toml:6:12: sync: pipeline is 1.5, must be a whole number"},
    {.name = "timeoutZero",
     .from = "pipeline = 1",
     .to = "timeout = 0",
     .error = "wall.toml:6:11: sync: timeout is 0.0 s, must be > 0 and <= 86400"},
    {.name = "onTimeoutUnknown",
     .from = "pipeline = 1",
     .to = "on_timeout = \"dorp\"",
     .error = "wall.toml:6:14: sync: on_timeout is \"dorp\", must be \"drop\" or \"wait\", did you "
              "mean \"drop\"?"},
    {.name = "launchUnknown",
     .from = "pipeline = 1",
     .to = "[cluster]\nlaunch = \"shh\"",
     .error = "wall.toml:7:10: cluster: launch is \"shh\", must be \"none\", \"ssh\", \"slurm\" or "
              "\"mpi\", did you mean \"ssh\"?"},
    {.name = "serverThatIsAnOption",
     .from = "pipeline = 1",
     .to = "[cluster]\nserver = \"-oProxyCommand=x\"",
     .error = "wall.toml:7:10: cluster: server is \"-oProxyCommand=x\", must be a program"},
    {.name = "optionsInOneText",
     .from = "pipeline = 1",
     .to = "[cluster]\noptions = \"-p 2222\"",
     .error = "wall.toml:7:11: cluster: options is \"-p 2222\", must be a list of texts"},
    {.name = "optionOfTwoLines",
     .from = "pipeline = 1",
     .to = "[cluster]\noptions = [\"a\\nb\"]",
     .error =
         "wall.toml:7:11: cluster: options is [\"a\\u000ab\"], must be 1 to 256 bytes of text on "
         "one line"},
    {.name = "mapTooSmall",
     .from = "1024",
     .to = "8",
     .error = "wall.toml:9:12: shadow: map_size is 8 texels, must be 16 to 16384"},
    {.name = "mapBeyondInt",
     .from = "1024",
     .to = "99999999999",
     .error = "wall.toml:9:12: shadow: map_size is 99999999999, must be a whole number from"},
    {.name = "tooManyCascades",
     .from = "map_size = 1024",
     .to = "cascades = 9",
     .error = "wall.toml:9:12: shadow: cascades is 9, must be 2 to 8"},
    {.name = "depthRangeUnknown",
     .from = "map_size = 1024",
     .to = "depth_range = \"fast\"",
     .error = "wall.toml:9:15: shadow: depth_range is \"fast\", must be \"off\", \"previous\" or "
              "\"exact\""},
    {.name = "rangeAtItsLimit",
     .from = "map_size = 1024",
     .to = "range = 0.8",
     .error = "wall.toml:9:9: shadow: range is 0.8, must be > 0 and < 0.8"},
    {.name = "techniqueUnknown",
     .from = "\"std\"",
     .to = "\"lipsm\"",
     .error = "wall.toml:8:13: shadow: technique is \"lipsm\", must be \"std\", "},
    {.name = "filterUnknown",
     .from = "\"std\"",
     .to = "\"csm+pfc\"",
     .error = "wall.toml:8:13: shadow: technique is \"csm+pfc\", must have a filter after the "
              "'+': \"hard\", \"pcf\", \"ppcf\", \"rotated\", \"hardware\", \"square\", "
              "\"vsm\", \"evsm\", \"vsm16\", \"evsm16\" or \"gauss\", did you mean \"pcf\"?"},
    {.name = "samplesThree",
     .from = "[[screen]]",
     .to = "[render]\nsamples = 3\n[[screen]]",
     .error = "wall.toml:11:11: render: samples is 3, must be 1, 2, 4 or 8"},
    {.name = "farBeforeNear",
     .from = "[[screen]]",
     .to = "[render]\nnear = 2\nfar = 1\n[[screen]]",
     .error = "wall.toml:12:7: render: far is 1.0 m, must be > near, 2.0 m"},
    {.name = "backgroundOfTwoNumbers",
     .from = "[[screen]]",
     .to = "[render]\nbackground = [0, 1]\n[[screen]]",
     .error = "wall.toml:11:14: render: background is a list of 2 values, must be [red, "},
    {.name = "cornerMissing",
     .from = "upper_left = [-1.0, 2.0, 0.0]\n",
     .to = "",
     .error = "wall.toml:10:1: screen \"front\": upper_left is missing"},
    {.name = "screenWithoutHeight",
     .from = "upper_left = [-1.0, 2.0, 0.0]",
     .to = "upper_left = [-1.0, 1.0, 0.0]",
     .error = "wall.toml:14:14: screen \"front\": upper_left is 0 m from lower_left, the screen "
              "must have a height"},
    {.name = "screenASlanted",
     .from = "upper_left = [-1.0, 2.0, 0.0]",
     .to = "upper_left = [0.0, 2.0, 0.0]",
     .error = "wall.toml:14:14: screen \"front\": its lower and left edge are at 45.00 degrees, "
              "must be 90"},
    {.name = "bezelAndOverlap",
     .from = "tiles = [2, 1]",
     .to = "tiles = [2, 1]\nbezel = [0.01, 0]\noverlap = [8, 0]",
     .error = "wall.toml:17:11: screen \"front\": overlap is [8, 0], bezel is [0.01, 0.0], only "
              "one of them can be"},
    {.name = "bezelsFillTheScreen",
     .from = "tiles = [2, 1]",
     .to = "tiles = [2, 1]\nbezel = [2.0, 0]",
     .error =
         "wall.toml:16:9: screen \"front\": bezels (1 of 2 m) leave nothing of its width of 2 m"},
    {.name = "overlapAsWideAsATile",
     .from = "tiles = [2, 1]",
     .to = "tiles = [2, 1]\noverlap = [400, 0]",
     .error = "wall.toml:16:11: screen \"front\": overlap is 400 pixels of a tile's width of 400, "
              "must be less"},
    {.name = "noTiles",
     .from = "tiles = [2, 1]",
     .to = "tiles = [0, 1]",
     .error = "wall.toml:15:9: screen \"front\": tiles is [0, 1], must be 1 to 64"},
    {.name = "serverNameTwice",
     .from = "name = \"east\"",
     .to = "name = \"west\"",
     .error = "wall.toml:25:8: server \"west\": there is another server of that name (line 17), "
              "each needs its own"},
    {.name = "serverNameAnOption",
     .from = "\"east\"",
     .to = "\"-rf\"",
     .error = "wall.toml:25:8: server \"-rf\": name is \"-rf\", must be 1 to 64 letters"},
    {.name = "noHostAndNoLookup",
     .from = "host = \"pc2\"",
     .to = "host = \"\"",
     .error =
         "wall.toml:26:8: server \"east\": host is \"\", must be a host name or an IP address, "
         "for [cluster] has no lookup"},
    {.name = "lookupNoGroup",
     .from = "[sync]",
     .to = "[cluster]\nlookup = \"10.0.0.1:7430\"\n[sync]",
     .error =
         "wall.toml:6:10: cluster: lookup is \"10.0.0.1:7430\", must be an IPv4 multicast group "
         "and a port, such as 239.255.74.30:7430"},
    {.name = "lookupNoPort",
     .from = "[sync]",
     .to = "[cluster]\nlookup = \"239.255.74.30\"\n[sync]",
     .error = "wall.toml:6:10: cluster: lookup is \"239.255.74.30\", must be"},
    {.name = "hostAnOption",
     .from = "\"pc2\"",
     .to = "\"-oProxyCommand=x\"",
     .error = "wall.toml:26:8: server \"east\": host is \"-oProxyCommand=x\", must be a host name"},
    {.name = "onePortTwice",
     .from = "\"pc2\"",
     .to = "\"pc1\"",
     .error = "wall.toml:26:8: server \"east\": pc1 port 7430 is taken by server \"west\", each "
              "needs its own"},
    {.name = "portZeroFarAway",
     .from = "host = \"pc2\"",
     .to = "host = \"pc2\"\nport = 0",
     .error = "wall.toml:27:8: server \"east\": port is 0, must be 1 to 65535 on another machine "
              "(pc2)"},
    {.name = "portTooLarge",
     .from = "host = \"pc2\"",
     .to = "host = \"pc2\"\nport = 65536",
     .error = "wall.toml:27:8: server \"east\": port is 65536, must be 0 to 65535"},
    {.name = "noWindow",
     .from = "[[server]]\nname = \"east\"",
     .to = "[[server]]\nname = \"none\"\n[[server]]\nname = \"east\"",
     .error = "wall.toml:24:1: server \"none\": has 0 windows, must have 1 to 16"},
    {.name = "windowTooLarge",
     .from = "size = [400, 400]",
     .to = "size = [16385, 400]",
     .error = "wall.toml:20:8: server \"west\", window: size is [16385, 400] pixels, must be 1 to "
              "16384"},
    {.name = "viewportOutside",
     .from = "tile = [0, 0]",
     .to = "tile = [0, 0]\nrect = [200, 0, 400, 400]",
     .error = "wall.toml:24:8: server \"west\", window, viewport: rect is [200.0, 0.0, 400.0, "
              "400.0], 400 x 400 pixels at 200, 0 of a window of 400 x 400, must lie in it"},
    {.name = "viewportEmpty",
     .from = "tile = [0, 0]",
     .to = "tile = [0, 0]\nrect = [0, 0, 0, 1]",
     .error = "wall.toml:24:8: server \"west\", window, viewport: rect is [0.0, 0.0, 0.0, 1.0], 0 "
              "x 400 pixels at 0, 0 of a window of 400 x 400, must have at least one pixel"},
    {.name = "viewportHalfAPixel",
     .from = "tile = [0, 0]",
     .to = "tile = [0, 0]\nrect = [0, 0, 200.5, 1]",
     .error = "wall.toml:24:8: server \"west\", window, viewport: rect is [0.0, 0.0, 200.5, 1.0], "
              "must be shares of the window up to 1 or whole pixels above"},
    {.name = "unknownScreen",
     .from = "screen = \"front\"",
     .to = "screen = \"frnot\"",
     .error = "wall.toml:22:10: server \"west\", window, viewport: there is no screen \"frnot\", "
              "did you mean \"front\"?"},
    {.name = "tileOutside",
     .from = "tile = [1, 0]",
     .to = "tile = [1, 1]",
     .error = "wall.toml:31:8: server \"east\", window, viewport: tile is [1, 1], screen \"front\" "
              "has 2 x 1, counted from [0, 0]"},
    {.name = "tileTwice",
     .from = "tile = [1, 0]",
     .to = "tile = [0, 0]",
     .error = "wall.toml:31:8: server \"east\", window, viewport: tile [0, 0] of screen \"front\" "
              "is shown to the mono eye by server \"west\" already"},
    {.name = "twoTileSizes",
     .from = "400]\n[[server.window.viewport]]\nscreen = \"front\"\ntile = [1",
     .to = "300]\n[[server.window.viewport]]\nscreen = \"front\"\ntile = [1",
     .error = "wall.toml:28:8: server \"east\", window, viewport: shows 400 x 300 pixels, must be "
              "400 x 400 as in server \"west\": all tiles of screen \"front\" have one size"},
    {.name = "monoAndStereo",
     .from = "tile = [1, 0]",
     .to = "tile = [1, 0]\neye = \"left\"",
     .error = "wall.toml:32:7: server \"east\", window, viewport: eye is \"left\", server \"west\" "
              "shows screen \"front\" to \"mono\": a screen is either mono or left and right"},
    {.name = "eyeUnknown",
     .from = "tile = [1, 0]",
     .to = "eye = \"both\"",
     .error = "wall.toml:31:7: server \"east\", window, viewport: eye is \"both\", must be "
              "\"left\", \"right\" or \"mono\""},
};

class BrokenWall : public testing::TestWithParam<Broken> {};

TEST_P(BrokenWall, IsRefusedWithItsPlaceOnOneLine) {
    const std::string text = replaced(smallWall, GetParam().from, GetParam().to);
    ASSERT_NE(text, smallWall) << "the case replaces nothing";
    const auto config = parseConfig(text, "wall.toml");
    ASSERT_FALSE(config);
    EXPECT_EQ(config.error().code, Errc::config);
    EXPECT_EQ(config.error().what.rfind(GetParam().error, 0), 0U) << config.error().what;
    EXPECT_EQ(config.error().what.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(All, BrokenWall, testing::ValuesIn(brokenWalls),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(BrokenWalls, AllErrorsAreCollectedAndTheFirstIsTold) {
    std::string text = replaced(smallWall, "0.063", "-1");
    text = replaced(text, "1024", "1");
    text = replaced(text, "tiles = [2, 1]", "tile = [2, 1]");
    const Inspection inspection = inspectConfig(text, "wall.toml");
    EXPECT_FALSE(inspection.config);
    ASSERT_EQ(inspection.findings.size(), 3U) << allText(inspection.findings);
    EXPECT_EQ(inspection.findings[0].place.line, 4);
    EXPECT_EQ(inspection.findings[1].place.line, 9);
    EXPECT_EQ(inspection.findings[2].place.line, 15);
    const Error error = parseConfig(text, "wall.toml").error();
    EXPECT_EQ(error.what, inspection.findings[0].text() + "; and 2 more");
}

TEST(BrokenWalls, ATextWithoutAnythingNeedsScreensAndServers) {
    const Inspection inspection = inspectConfig("", "wall.toml");
    EXPECT_EQ(allText(inspection.findings),
              "wall.toml:1:1: no [[screen]], a wall has at least one\n"
              "wall.toml:1:1: no [[server]] or [[server_grid]], a wall has at least one\n");
}

}  // namespace
}  // namespace gnomon::config

#pragma once

#include <gnomon/config/Finding.h>
#include <gnomon/config/Place.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// A wall as written in a TOML file: who stands in front of it, its screens, and which render
/// server shows which tile to which eye. docs/config.md is the reference of every key; a member
/// is called like its key, in camel case.
///
/// Room coordinates: metres, right-handed, y up; a viewer of a plain wall looks toward -z.
namespace gnomon::config {

using Point = std::array<double, 3>;   ///< metres, or a direction of any length
using Colour = std::array<double, 3>;  ///< sRGB, 0 to 1
using Cells = std::array<int, 2>;      ///< x then y: columns and rows, or width and height

enum class Eye : std::uint8_t { mono, left, right };
enum class OnTimeout : std::uint8_t { drop, wait };
enum class DepthRange : std::uint8_t { off, previous, exact };
enum class Launch : std::uint8_t { none, ssh, slurm, mpi };
enum class Compress : std::uint8_t { automatic, never, always };

std::string_view name(Eye eye) noexcept;
std::string_view name(OnTimeout action) noexcept;
std::string_view name(DepthRange use) noexcept;
std::string_view name(Launch how) noexcept;
std::string_view name(Compress use) noexcept;

/// Port of a server on another machine unless the file says otherwise.
inline constexpr int defaultPort = 7430;

struct User {
    Point head = {0.0, 1.7, 3.0};  ///< between the eyes; where it starts if it is tracked
    Point forward = {0.0, 0.0, -1.0};
    double eyeSeparation = 0.063;  ///< metres
    Origin origin = {};
    bool operator==(const User&) const = default;
};

struct Sync {
    double timeout = 1.0;        ///< seconds a server may be late after the others
    double startTimeout = 60.0;  ///< seconds for loading and shader compilation
    OnTimeout onTimeout = OnTimeout::drop;
    int pipeline = 1;  ///< frames in flight
    /// Windows swap at one refresh where drivers can. Absent: where the wall waits for late
    /// servers.
    std::optional<bool> swapGroup = {};
    Origin origin = {};
    bool operator==(const Sync&) const = default;
};

/// How other machines are reached. What is on this machine is started without any of it.
struct Cluster {
    std::optional<std::string> key = {};    ///< as written; see keyPath(). Absent: the usual file
    Launch launch = Launch::none;           ///< none: the servers are running already
    std::string server = "gnomon-server";   ///< the program over there
    std::vector<std::string> options = {};  ///< for ssh, srun or mpirun, before anything else
    int relay = 0;  ///< servers that anyone sends payloads to; 0: the client sends to all
    Compress compress = Compress::automatic;  ///< of payloads and snapshots
    /// GROUP:PORT, where servers without a host are asked for by name. Absent: those are local.
    std::optional<std::string> lookup = {};
    Origin origin = {};
    bool operator==(const Cluster&) const = default;
};

struct Shadow {
    bool on = true;
    std::string technique = "std";  ///< FIT[+FILTER] or a single word
    /// Texels per side. Absent: 512, raised to what fits into what the screen shows.
    std::optional<int> mapSize = {};
    std::array<double, 4> color = {0, 0, 0, 1};  ///< sRGB, and how much of it
    std::optional<double> offsetBias = {};       ///< absent: derived from the map
    std::optional<double> offsetFactor = {};     ///< absent: derived from the map
    double range = 0.3;  ///< share of the view in front of the focus line, trapezoidal maps only
    int cascades = 4;    ///< of csm
    std::optional<double> frameBudget = {};  ///< of auto, milliseconds
    std::optional<double> errorBudget = {};  ///< of auto, percent
    double softness = 0.0;                   ///< metres; 0: from the light
    int kernelWidth = 8;                     ///< of square, texels
    int kernelSamples = 0;                   ///< of square, a row; 0: all
    bool qualityMode = false;
    DepthRange depthRange = DepthRange::off;  ///< how fits learn how deep the view really is
    Origin origin = {};
    bool operator==(const Shadow&) const = default;
};

/// A picture laid over every screen after the shadows.
struct Foreground {
    std::string image = {};                         ///< as written; see imagePath()
    std::array<double, 2> position = {0.02, 0.02};  ///< of its lower left corner, share of screen
    double height = 0.1;                            ///< share of the screen's height
    Origin origin = {};
    bool operator==(const Foreground&) const = default;
};

struct Render {
    int samples = 1;  ///< per pixel: 1, 2, 4 or 8
    std::array<Colour, 2> background = {{{0.24, 0.33, 0.48}, {0.74, 0.79, 0.84}}};  ///< top, bottom
    std::optional<double> near = {};  ///< metres, world scale; absent: from the scene
    std::optional<double> far = {};
    std::optional<Foreground> foreground = {};
    Origin origin = {};
    bool operator==(const Render&) const = default;
};

/// A flat rectangle in the room, lit by one or more tiles.
struct Screen {
    std::string name = {};
    Point lowerLeft = {};  ///< corners of the whole lit area, with bezels, as its viewer sees it
    Point lowerRight = {};
    Point upperLeft = {};
    Cells tiles = {1, 1};                  ///< columns, rows
    std::array<double, 2> bezel = {0, 0};  ///< metres between the lit areas of neighbours
    Cells overlap = {0, 0};                ///< pixels shared by neighbours
    Origin origin = {};
    bool operator==(const Screen&) const = default;
};

/// The part of a window that shows one tile to one eye.
struct Viewport {
    std::string screen = {};
    Cells tile = {0, 0};  ///< column, row; row 0 is the top row
    Eye eye = Eye::mono;
    /// left, bottom, width, height; a number up to 1 is a share of the window, above 1 pixels
    std::array<double, 4> rect = {0, 0, 1, 1};
    Origin origin = {};
    bool operator==(const Viewport&) const = default;
};

struct Window {
    Cells size = {0, 0};      ///< pixels
    Cells position = {0, 0};  ///< pixels from the upper left of the monitor
    bool fullscreen = false;
    int monitor = 0;
    std::optional<int> gpu = {};  ///< absent: the server's
    std::vector<Viewport> viewports = {};
    Origin origin = {};
    bool operator==(const Window&) const = default;
};

/// One render process.
struct Server {
    std::string name = {};
    std::string host = "localhost";  ///< empty: looked up by name, see Cluster::lookup
    int port = 0;  ///< 0: chosen by the system, on this machine only; or looked up
    int gpu = -1;  ///< -1: the system's choice
    std::vector<Window> windows = {};
    Origin origin = {};
    bool operator==(const Server&) const = default;
};

struct Config {
    std::string name = "wall";
    User user = {};
    Sync sync = {};
    Cluster cluster = {};
    Shadow shadow = {};
    Render render = {};
    std::vector<Screen> screens = {};
    std::vector<Server> servers = {};  ///< grids are expanded: first [[server]], then grids
    Origin origin = {};
    bool operator==(const Config&) const = default;
};

/// What is wrong with one struct's own values, and with those inside it. What needs the rest of
/// the configuration (names, tiles, eyes) is in findings() of Report.h.
std::vector<Finding> validate(const User& user);
std::vector<Finding> validate(const Sync& sync);
std::vector<Finding> validate(const Cluster& cluster);
std::vector<Finding> validate(const Shadow& shadow);
std::vector<Finding> validate(const Render& render);
std::vector<Finding> validate(const Screen& screen);
std::vector<Finding> validate(const Server& server);
std::vector<Finding> validate(const Config& config);

std::optional<std::size_t> screenIndex(const Config& config, std::string_view screenName);

/// localhost, 127.x.x.x or ::1.
bool isLocal(std::string_view host);
/// Whether nobody knows where it is before it answers to its name.
inline bool isLookedUp(const Server& server) { return server.host.empty(); }

/// The GPU a window is on: its own, else its server's; -1: the system's choice.
int gpuOf(const Server& server, const Window& window);

/// An image named in the configuration is looked for beside its file.
std::string imagePath(const Foreground& foreground);
/// So is the key. Empty where none is named.
std::string keyPath(const Cluster& cluster);

}  // namespace gnomon::config

#include <fmt/format.h>
#include <gnomon/client/CameraPath.h>
#include <gnomon/config/Layout.h>
#include <gnomon/config/Load.h>
#include <gnomon/config/Report.h>
#include <gnomon/image/Png.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "ClusterAccess.h"
#include "Console.h"
#include "FrameTrace.h"
#include "Interrupt.h"
#include "RunOptions.h"
#include "Statistics.h"

namespace gnomon::client {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr double framesPerSecond = 60.0;  // of a run with --frames: what it shows does not depend
                                          // on how fast it is

/// Puts in place of auto what is best here, for a whole screen on the pixels of a tile.
void measureTechnique(config::Config& wall, const RunOptions& options, Console& console) {
    if (!options.choose || options.dryRun || options.scene.empty() || wall.screens.empty()) return;
    ShotOptions shot{.scene = options.scene,
                     .view = options.view,
                     .lights = options.lights,
                     .shadow = options.shadow,
                     .wall = options.config};
    // Where the servers draw, if they do.
    if (options.backend != "none") shot.backend = options.backend;
    const auto& tiles = wall.screens.front().tiles;
    const auto canvas = orThrow(config::canvas(wall, 0));
    const auto tile = options.tile.value_or(config::Cells{canvas.tileSize[0], canvas.tileSize[1]});
    shot.tile = {std::max(64, tile[0] / std::max(1, tiles[0])),
                 std::max(64, tile[1] / std::max(1, tiles[1]))};
    const Choice choice = options.choose(shot);
    wall.shadow.technique = choice.chosen.technique;
    if (choice.chosen.mapSize > 0) wall.shadow.mapSize = choice.chosen.mapSize;
    wall.shadow.qualityMode = wall.shadow.qualityMode || choice.chosen.quality;
    console.line("auto: " + choice.why);
}

config::Config loadWall(const RunOptions& options, Console& console) {
    const auto inspection = orThrow(config::inspectFile(options.config));
    if (config::hasError(inspection.findings)) throw Failure{config::toError(inspection.findings)};
    for (const auto& finding : inspection.findings) console.line(finding.text());
    GNOMON_EXPECTS(inspection.config.has_value(), "a configuration without errors has a value");
    config::Config wall = *inspection.config;
    options.shadow.apply(wall.shadow);
    if (options.view.near) wall.render.near = options.view.near;
    if (options.view.far) wall.render.far = options.view.far;
    if (wall.shadow.technique == "auto") measureTechnique(wall, options, console);
    return wall;
}

ApplicationOptions applicationOptions(const RunOptions& options, Console& console) {
    ApplicationOptions made;
    made.local = options.local;
    made.tileSize = options.tile;
    made.backend = options.backend;
    made.key = options.key;
    made.log = [&console](LogLevel level, const std::string& line) { console.log(level, line); };
    return made;
}

/// Of a server that somebody else must have started.
std::string expectedOf(const config::Config& config, const config::Server& server) {
    if (config::isLookedUp(server))
        return fmt::format("{}: expected to be running and looked up on {} (udp)", server.name,
                           config.cluster.lookup.value());
    return fmt::format("{}: expected to be running at {}:{}", server.name, server.host,
                       server.port);
}

int dryRun(const config::Config& wall, const ApplicationOptions& options, Console& console) {
    const auto config = orThrow(adjusted(wall, options));
    const auto key = orThrow(findKeyFile(config, options));
    for (const auto& command : launchCommands(config, options, key)) console.line(command.text());
    for (const auto& server : config.servers)
        if (isAwaited(config, server)) console.line("# " + expectedOf(config, server));
    return 0;
}

/// Who is not there yet, for people.
std::string waitingFor(const std::vector<net::ServerStatus>& servers) {
    for (const auto& server : servers) {
        if (server.state == net::ServerState::member) continue;
        const auto label = net::labelOf(server.address);
        // An error begins with it already.
        return server.text.starts_with(label) ? server.text : label + ": " + server.text;
    }
    return {};
}

class Runner {
public:
    Runner(const RunOptions& options, Console& console)
        : options_{options},
          console_{console},
          path_{loadPath(options)},
          trace_{openTrace()},
          app_{loadWall(options, console), applicationOptions(options, console)} {}

    int run() {
        loadScene();
        const Interrupt interrupt;
        if (!start(interrupt)) return 0;
        const net::FrameResult last = frames(interrupt);
        console_.line(statistics_.summary());
        if (trace_) trace_->finish();
        if (!options_.out.empty()) writePictures(last);
        if (!options_.json.empty()) writeJson();
        app_.shutdown();
        return 0;
    }

private:
    static std::optional<CameraPath> loadPath(const RunOptions& options) {
        if (options.path.empty()) return {};
        return orThrow(CameraPath::load(options.path));
    }

    std::unique_ptr<FrameTrace> openTrace() const {
        if (options_.trace.empty()) return {};
        return std::make_unique<FrameTrace>(
            options_.trace, [&](const std::string& why) { console_.log(LogLevel::warning, why); });
    }

    void loadScene() {
        if (options_.view.size || options_.view.fovy)
            console_.line(
                "note: --size and --fovy mean nothing on a wall: screens and head decide");
        const std::string title = "loading " + options_.scene.filename().string();
        SceneOptions scene{.file = options_.scene, .lights = options_.lights};
        if (!scene.file.empty())
            scene.progress = [&](double share, const std::string& what) {
                // The last word is ours, below.
                console_.progress(title, std::min(share, 0.99), what);
            };
        orThrow(app_.loadScene(scene));
        if (const auto& model = app_.scene().model) {
            console_.progress(title, 1.0, fmt::format("{} triangles", model->triangles));
            for (const auto& warning : model->warnings)
                console_.log(LogLevel::warning, model->source + ": " + warning);
        }
        app_.showAll();
        if (const auto look = options_.view.look()) app_.setView(*look);
        if (path_) app_.setView(path_->at(path_->start()));
        app_.animate(0.0);
    }

    /// False where a signal came first.
    bool start(const Interrupt& interrupt) {
        for (const auto& server : app_.config().servers)
            if (isAwaited(app_.config(), server)) console_.line(expectedOf(app_.config(), server));
        auto said = Clock::now();
        std::string before;
        const auto progress = [&](const std::vector<net::ServerStatus>& servers) {
            const auto waiting = waitingFor(servers);
            const auto now = Clock::now();
            if (waiting.empty() || waiting == before || now - said < 2s) return;
            console_.line("waiting for " + waiting);
            said = now;
            before = waiting;
        };
        const auto started = app_.start(progress, [&] { return !interrupt.requested(); });
        if (interrupt.requested()) return false;
        orThrow(Result<void>{started});
        // Local servers have said so themselves.
        for (const auto& server : app_.status())
            if (!server.address.lookup.empty() || !config::isLocal(server.address.host))
                console_.line(fmt::format("{}: {}", server.address.name, server.description));
        return true;
    }

    /// Seconds of the application's clock at frame @p i, 0 for the first.
    double timeOf(std::uint64_t i, Clock::time_point begun) const {
        if (!options_.frames) return std::chrono::duration<double>(Clock::now() - begun).count();
        if (!path_ || *options_.frames < 2) return static_cast<double>(i) / framesPerSecond;
        return (path_->end() - path_->start()) * static_cast<double>(i) /
               static_cast<double>(*options_.frames - 1);
    }

    net::FrameResult frames(const Interrupt& interrupt) {
        const auto begun = Clock::now();
        net::FrameResult result;
        for (std::uint64_t i = 0; !options_.frames || i < *options_.frames; ++i) {
            const bool stop = interrupt.requested() || windowClosed();
            const bool last = stop || (options_.frames && i + 1 == *options_.frames);
            if (stop && options_.out.empty()) break;
            const double time = timeOf(i, begun);
            app_.animate(time);
            if (path_) app_.setView(path_->at(path_->start() + time));
            result = app_.frame(time, last && !options_.out.empty());
            const auto now = Clock::now();
            const auto servers = app_.status();
            statistics_.add(result, servers, now);
            if (trace_) trace_->add(result, servers, now);
            tell(result, i, now);
            if (stop) break;
        }
        return result;
    }

    void tell(const net::FrameResult& result, std::uint64_t i, Clock::time_point now) {
        // The number that servers and their messages know the frame by.
        const std::uint64_t n = result.shown;
        for (const auto& name : result.droppedNow)
            console_.log(LogLevel::warning, fmt::format("frame {} goes on without {}", n, name));
        // All of them joined to make the first frame.
        for (const auto& name : i == 0 ? std::vector<std::string>{} : result.joinedNow)
            console_.line(fmt::format("frame {}: {} takes part", n, name));
        if (const auto line = statistics_.line(now)) console_.line(*line);
        if (!options_.frames) return;
        const double share = static_cast<double>(i + 1) / static_cast<double>(*options_.frames);
        console_.progress("frames", share, {});
    }

    bool windowClosed() {
        for (const auto& event : app_.takeEvents())
            if (event.event.kind == net::EventKind::close) return true;
        return false;
    }

    void writePictures(const net::FrameResult& last) {
        if (last.n == 0) throw Failure{Errc::file, "no frame was shown, so there is no picture"};
        const auto pictures = orThrow(app_.pictures(last.n, 30s));
        for (const auto& picture : pictures) {
            for (const auto& server : picture.missing)
                console_.log(LogLevel::warning,
                             fmt::format("{}: the tile of server \"{}\" is missing", picture.screen,
                                         server));
            const auto file = pictureFile(options_.out, pictures, picture);
            orThrow(image::writePng(file, picture.image));
            console_.line("wrote " + file.string());
        }
    }

    void writeJson() {
        std::ofstream out{options_.json};
        out << statistics_.json(app_.status(), app_.totals()).dump(2) << "\n";
        out.flush();
        if (!out)
            throw Failure{
                Error{.code = Errc::file,
                      .what = fmt::format("{}: cannot be written", options_.json.string()),
                      .cause = {errno, std::generic_category()}}};
    }

    const RunOptions& options_;
    Console& console_;
    // Before the servers: a broken one starts nothing.
    const std::optional<CameraPath> path_;
    const std::unique_ptr<FrameTrace> trace_;
    Application app_;
    Statistics statistics_ = {};
};

}  // namespace

int run(const RunOptions& options) {
    Console console;
    // A reader that goes away ends nothing: the wall runs for those who look at it.
    ::signal(SIGPIPE, SIG_IGN);
    console.detach(options.log);
    if (options.dryRun)
        return dryRun(loadWall(options, console), applicationOptions(options, console), console);
    return Runner{options, console}.run();
}

}  // namespace gnomon::client

#pragma once

#include <gnomon/client/Launcher.h>
#include <gnomon/client/SceneSetup.h>
#include <gnomon/client/WallPicture.h>
#include <gnomon/client/WallSetup.h>
#include <gnomon/net/HubTypes.h>

#include <functional>
#include <memory>
#include <optional>

namespace gnomon::client {

struct ApplicationOptions {
    bool local = false;  ///< all servers as processes of this machine, whatever the hosts say
    std::optional<config::Cells> tileSize = {};  ///< pixels of every tile; absent: the config's
    std::string backend = "auto";                ///< of local servers: egl osmesa glfw none auto
    std::filesystem::path server = {};  ///< empty: gnomon-server beside the running program
    std::filesystem::path key = {};     ///< cluster key file; empty: the config's, or the usual one
    /// Container types of the application's own.
    std::function<void(field::TypeRegistry&)> addTypes = {};
    LogCallback log = {};
};

/// The config as the options want it: local, with other tiles.
Result<config::Config> adjusted(config::Config config, const ApplicationOptions& options);

/// An application on a wall: its scene, the room, the servers, and frames.
///
///     Application app{"configs/local-2x2.toml", {.local = true}};
///     const auto model = orThrow(app.load("model.glb"));
///     app.addDefaultSun();
///     app.showAll();
///     orThrow(app.start());
///     for (int n = 0; n < 1000; ++n) app.frame(n / 60.0);
///
/// Everything belongs to the thread that made it.
class Application {
public:
    using StatusCallback = std::function<void(const std::vector<net::ServerStatus>&)>;

    /// Builds the wall's containers and starts the local servers, which warm up while a scene is
    /// loaded. @throws Failure Errc::config, Errc::file, Errc::process
    explicit Application(config::Config config, ApplicationOptions options = {});
    explicit Application(const std::filesystem::path& config, ApplicationOptions options = {});
    /// As shutdown().
    ~Application();
    Application(const Application&) = delete;
    Application& operator=(const Application&) = delete;

    /// Where the application's containers live; edit them freely between frames.
    field::Aspect& aspect() noexcept;
    const config::Config& config() const noexcept;
    const WallContainers& wall() const noexcept;
    /// What all viewports show; models and lights are put below it.
    const scene::Node& sceneRoot() const;
    /// Where to add nodes of one's own, so that the added lights light them.
    const scene::Node& content() const;
    const PreparedScene& scene() const noexcept;

    /// A file's scene, added to the content.
    Result<Model> load(const std::filesystem::path& file, const ProgressCallback& progress = {});
    /// A file with its light as `gnomon run` shows it: see prepareScene(). For an empty content.
    Result<void> loadScene(const SceneOptions& options);
    field::Ref<scene::Node> addLight(const LightOption& light, const Brightness& brightness = {});
    field::Ref<scene::Node> addDefaultSun();

    /// Plays all the model's animations from now on, see AnimationPlayer.
    void play(const Model& model);
    /// Puts what is played where it is at @p time, seconds.
    void animate(double time);

    /// Places the room in the world, see worldFromRoom(); near and far follow.
    void setView(const Look& look);
    void setView(const math::dvec3& eye, const math::dvec3& center,
                 const math::dvec3& up = {0.0, 1.0, 0.0}, double scale = 1.0);
    /// The model's first camera, else all of the content.
    void showAll();
    const Look& view() const noexcept;

    /// Hands the scene over and waits until every server shows it: at most the config's
    /// sync.start_timeout. Errors name who is missing, and why.
    /// @param keepGoing  asked several times a second; false gives up (Errc::timeout)
    Result<void> start(const StatusCallback& progress = {},
                       const std::function<bool()>& keepGoing = {});
    /// Commits what was edited and shows it; see ClientHub::frame(). @pre start() succeeded
    /// @param time     seconds, for shaders
    /// @param capture  the pictures are kept for pictures(n)
    net::FrameResult frame(double time, bool capture = false);
    /// The wall's pictures of a frame that was captured.
    Result<std::vector<WallPicture>> pictures(std::uint64_t n, std::chrono::milliseconds limit);
    /// Shows a frame and returns its pictures.
    Result<std::vector<WallPicture>> capture(double time);

    std::vector<net::InputEventFrom> takeEvents();
    /// In the order of the config; local servers from when they first listened.
    std::vector<net::ServerStatus> status() const;
    net::HubTotals totals() const;
    /// Process ids of the local servers, in the order of the config; -1 where one is not running.
    std::vector<int> processes() const;
    /// Ends the connections and the local servers; a few seconds at most.
    void shutdown();

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace gnomon::client

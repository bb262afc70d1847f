#include <gnomon/client/AnimationPlayer.h>
#include <gnomon/client/Application.h>
#include <gnomon/config/Adjust.h>
#include <gnomon/config/Load.h>
#include <gnomon/scene/Types.h>

#include <algorithm>

#include "ServerLink.h"

namespace gnomon::client {

using field::Ref;

namespace {

field::TypeRegistry makeTypes(const ApplicationOptions& options) {
    field::TypeRegistry types;
    scene::addTypes(types);
    if (options.addTypes) options.addTypes(types);
    return types;
}

/// The space of the application's containers; the session's own is 1.
constexpr std::uint16_t applicationSpace = 2;

}  // namespace

Result<config::Config> adjusted(config::Config config, const ApplicationOptions& options) {
    if (options.local) config = config::localized(config);
    if (!options.tileSize) return config;
    return config::withTileSize(config, (*options.tileSize)[0], (*options.tileSize)[1]);
}

class Application::Impl {
public:
    Impl(config::Config given, ApplicationOptions options)
        : config_{orThrow(adjusted(std::move(given), options))},
          types_{makeTypes(options)},
          aspect_{types_, applicationSpace} {
        scene_.tree = makeSceneTree(aspect_);
        wall_ = orThrow(buildWall(aspect_, config_, scene_.tree.root));
        link_.emplace(config_, types_, options);
    }

    void derive() { setDepthRange(aspect_, wall_, config_, depthRange(scene_.bounds, look_.eye)); }

    const scene::Node& node(Ref<scene::Node> ref) const {
        const auto* found = aspect_.get(ref);
        GNOMON_EXPECTS(found != nullptr, "the application destroyed the scene's upper end");
        return *found;
    }

    const config::Config config_;
    field::TypeRegistry types_;
    field::Aspect aspect_;
    PreparedScene scene_ = {};
    WallContainers wall_ = {};
    AnimationPlayer player_ = {};
    Look look_ = {};
    std::optional<ServerLink> link_ = {};  // last, so that its threads end first
};

Application::Application(config::Config config, ApplicationOptions options)
    : impl_{std::make_unique<Impl>(std::move(config), std::move(options))} {}
Application::Application(const std::filesystem::path& config, ApplicationOptions options)
    : Application{orThrow(config::loadConfig(config)), std::move(options)} {}
Application::~Application() = default;

field::Aspect& Application::aspect() noexcept { return impl_->aspect_; }
const config::Config& Application::config() const noexcept { return impl_->config_; }
const WallContainers& Application::wall() const noexcept { return impl_->wall_; }
const PreparedScene& Application::scene() const noexcept { return impl_->scene_; }
const Look& Application::view() const noexcept { return impl_->look_; }
const scene::Node& Application::sceneRoot() const { return impl_->node(impl_->scene_.tree.root); }
const scene::Node& Application::content() const { return impl_->node(impl_->scene_.tree.content); }

Result<Model> Application::load(const std::filesystem::path& file,
                                const ProgressCallback& progress) {
    auto model = loadModel(impl_->aspect_, impl_->scene_.tree, file, progress);
    if (!model) return model;
    impl_->scene_.bounds.add(model->bounds);
    if (!impl_->scene_.model) impl_->scene_.model = *model;
    impl_->derive();
    return model;
}

Result<void> Application::loadScene(const SceneOptions& options) {
    auto prepared = prepareScene(impl_->aspect_, impl_->scene_.tree, options);
    if (!prepared) return tl::unexpected{prepared.error()};
    impl_->scene_ = *std::move(prepared);
    if (impl_->scene_.model) play(*impl_->scene_.model);
    impl_->derive();
    return {};
}

Ref<scene::Node> Application::addLight(const LightOption& light, const Brightness& brightness) {
    return client::addLight(impl_->aspect_, impl_->scene_.tree, light, brightness);
}

Ref<scene::Node> Application::addDefaultSun() {
    impl_->scene_.defaultSun = true;
    return client::addDefaultSun(impl_->aspect_, impl_->scene_.tree);
}

void Application::play(const Model& model) { impl_->player_.play(impl_->aspect_, model); }
void Application::animate(double time) { impl_->player_.animate(impl_->aspect_, time); }

void Application::setView(const Look& look) {
    impl_->look_ = look;
    client::setView(impl_->aspect_, impl_->wall_, impl_->config_, look);
    impl_->derive();
}

void Application::setView(const math::dvec3& eye, const math::dvec3& center, const math::dvec3& up,
                          double scale) {
    setView(Look{.eye = eye, .center = center, .up = up, .scale = scale});
}

void Application::showAll() {
    setView(defaultView(impl_->aspect_, impl_->scene_, wallOpening(impl_->config_),
                        wallDistance(impl_->config_))
                .look);
}

Result<void> Application::start(const StatusCallback& progress,
                                const std::function<bool()>& keepGoing) {
    return impl_->link_->start(impl_->aspect_.commit(), progress, keepGoing);
}

net::FrameResult Application::frame(double time, bool capture) {
    return impl_->link_->frame(impl_->aspect_.commit(), time, capture);
}

Result<std::vector<WallPicture>> Application::pictures(std::uint64_t n,
                                                       std::chrono::milliseconds limit) {
    const auto tiles = impl_->link_->hub().takeImages(n, std::chrono::steady_clock::now() + limit);
    if (!tiles) return tl::unexpected{tiles.error()};
    std::vector<net::Image> images;
    for (const auto& tile : *tiles) images.push_back(tile.image);
    return assembleWall(impl_->config_, impl_->wall_, images);
}

Result<std::vector<WallPicture>> Application::capture(double time) {
    const auto shown = frame(time, true);
    return pictures(shown.n, impl_->link_->startTimeout());
}

std::vector<net::InputEventFrom> Application::takeEvents() {
    return impl_->link_->hub().takeEvents();
}
std::vector<net::ServerStatus> Application::status() const {
    auto all = impl_->link_->hub().status();  // in the order they were connected
    const auto& servers = impl_->config_.servers;
    const auto place = [&](const net::ServerStatus& status) {
        return std::find_if(servers.begin(), servers.end(), [&](const config::Server& server) {
            return server.name == status.address.name;
        });
    };
    std::sort(all.begin(), all.end(),
              [&](const auto& a, const auto& b) { return place(a) < place(b); });
    return all;
}
net::HubTotals Application::totals() const { return impl_->link_->hub().totals(); }
std::vector<int> Application::processes() const { return impl_->link_->processes(); }
void Application::shutdown() { impl_->link_->shutdown(); }

}  // namespace gnomon::client

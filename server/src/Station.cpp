#include "Station.h"

namespace gnomon::server {

Station::Station(gl::Backend backend, int gpu, bool wantsWindow)
    : context_{orThrow(
          gl::createContext({.backend = backend, .gpu = gpu, .wantsWindow = wantsWindow}))} {}

Station::~Station() {
    context_->makeCurrent();
    windows_.clear();
    renderer_.reset();
}

void Station::attach(const field::Aspect& scene, std::function<void(std::string)> report) {
    context_->makeCurrent();
    renderer_.reset();
    report_ = report;
    renderer_ = std::make_unique<render::Renderer>(*context_, scene, std::move(report));
}

void Station::update(const field::Applied& applied) {
    context_->makeCurrent();
    renderer_->update(applied);
    for (const field::Id id : applied.destroyed) windows_.erase(id);
}

Result<render::FrameStatistics> Station::draw(const scene::Window& window, double time) {
    context_->makeCurrent();
    auto drawn = renderer_->draw(window, time);
    renderer_->finish();
    return drawn;
}

Result<std::optional<shadow_fit::DepthSpan>> Station::depthSpan(const scene::Window& window,
                                                                bool drawn) {
    context_->makeCurrent();
    return renderer_->depthSpan(window, drawn);
}

image::Image Station::read(const scene::Window& window) {
    context_->makeCurrent();
    return renderer_->read(window);
}

Result<gl::Window*> Station::windowOf(const scene::Window& window) {
    // A window whose place or size changed is opened anew.
    field::Writer shape;
    using Traits = field::FieldTraits<glm::ivec2>;
    Traits::write(shape, window.size);
    Traits::write(shape, window.position);
    shape.scalar(window.swapGroup.get());
    shape.scalar(window.fullscreen.get());
    shape.scalar(window.monitor.get());
    Shown& shown = windows_[window.id()];
    auto now = shape.take();
    if (shown.window && shown.shape == now) return shown.window.get();
    shown.window.reset();
    gl::WindowOptions options{
        .title = window.title.get().empty() ? "Gnomon: " + window.server.get() : window.title.get(),
        .width = window.size->x,
        .height = window.size->y,
        .fullscreen = window.fullscreen,
        .monitor = window.fullscreen ? window.monitor.get() : -1};
    options.position = gl::WindowPosition{window.position->x, window.position->y};
    options.decorated = false;
    options.swapGroup = window.swapGroup;
    auto opened = gl::openWindow(*context_, options);
    if (!opened) return tl::unexpected{std::move(opened).error()};
    (*opened)->setSwapInterval(1);
    if (const auto& text = (*opened)->swapGroup(); !text.empty() && report_)
        report_(options.title + ": " + text);
    shown = {.window = std::move(*opened), .shape = std::move(now)};
    return shown.window.get();
}

Result<void> Station::present(const scene::Window& window) {
    if (!hasDisplay()) return {};
    context_->makeCurrent();
    auto shown = windowOf(window);
    if (!shown) return tl::unexpected{std::move(shown).error()};
    const unsigned picture = renderer_->colorTexture(window);
    if (picture == 0) return {};
    return (*shown)->present(picture, window.size->x, window.size->y);
}

std::vector<Station::Event> Station::takeEvents() {
    std::vector<Event> all;
    for (auto& [id, shown] : windows_) {
        if (!shown.window) continue;
        for (const gl::InputEvent& event : shown.window->takeEvents())
            all.push_back({.window = id, .event = event});
    }
    return all;
}

}  // namespace gnomon::server

#include "WallBuilder.h"

#include <gnomon/image/Png.h>

#include <cmath>

#include "Color.h"

namespace gnomon::client {

using field::edit;
using field::Ref;

namespace {

scene::Eye toEye(config::Eye eye) {
    switch (eye) {
        case config::Eye::left:
            return scene::Eye::left;
        case config::Eye::right:
            return scene::Eye::right;
        case config::Eye::mono:
            break;
    }
    return scene::Eye::mono;
}

/// rgba8 pixels of an image with 1, 3 or 4 channels.
std::vector<std::uint8_t> toRgba(const image::Image& image) {
    const auto channels = static_cast<std::size_t>(image.channels);
    std::vector<std::uint8_t> rgba;
    rgba.reserve(image.pixels.size() / channels * 4);
    for (std::size_t at = 0; at + channels <= image.pixels.size(); at += channels) {
        for (std::size_t c = 0; c < 3; ++c)
            rgba.push_back(image.pixels[at + (channels == 1 ? 0 : c)]);
        rgba.push_back(channels == 4 ? image.pixels[at + 3] : std::uint8_t{255});
    }
    return rgba;
}

}  // namespace

WallBuilder::WallBuilder(field::Aspect& aspect, const config::Config& config, Ref<scene::Node> root)
    : aspect_{aspect}, config_{config}, root_{root}, eyeCameras_(config.screens.size()) {}

Result<void> WallBuilder::addRoom() {
    const auto& user = aspect_.create<scene::User>();
    {
        const math::dvec3 head = toVector(config_.user.head);
        const math::dmat4 headFromRoom =
            math::lookAt(head, head + toVector(config_.user.forward), math::dvec3{0.0, 1.0, 0.0});
        auto e = edit(user);
        e->roomFromHead = math::toAffine(glm::inverse(headFromRoom));
        e->eyeSeparation = config_.user.eyeSeparation;
    }
    made_.user = user;
    made_.navigation = aspect_.create<scene::Navigation>();
    for (const auto& from : config_.screens) {
        const auto& screen = aspect_.create<scene::Screen>();
        auto e = edit(screen);
        e->name = from.name;
        e->lowerLeft = toVector(from.lowerLeft);
        e->lowerRight = toVector(from.lowerRight);
        e->upperLeft = toVector(from.upperLeft);
        e->tiles = glm::ivec2{from.tiles[0], from.tiles[1]};
        e->bezel = math::dvec2{from.bezel[0], from.bezel[1]};
        e->overlap = glm::ivec2{from.overlap[0], from.overlap[1]};
        made_.screens.emplace_back(screen);
    }
    made_.lens = aspect_.create<scene::PerspectiveCamera>();
    addBackground();
    return addForeground();
}

void WallBuilder::addBackground() {
    const math::vec3 top = linearFromSrgb(config_.render.background[0]);
    const math::vec3 bottom = linearFromSrgb(config_.render.background[1]);
    if (top == bottom) {
        const auto& solid = aspect_.create<scene::SolidBackground>();
        edit(solid)->color = top;
        background_ = solid;
        return;
    }
    const auto& gradient = aspect_.create<scene::GradientBackground>();
    edit(gradient)->stops.assign(
        {math::vec4{bottom.x, bottom.y, bottom.z, 0.0F}, math::vec4{top.x, top.y, top.z, 1.0F}});
    background_ = gradient;
}

Result<void> WallBuilder::addForeground() {
    if (!config_.render.foreground) return {};
    const auto picture = image::readPng(config::imagePath(*config_.render.foreground));
    if (!picture) return tl::unexpected{picture.error()};
    const auto rgba = toRgba(*picture);
    const auto& texture = aspect_.create<scene::Texture>();
    auto e = edit(texture);
    e->pixels = field::Payload::of(std::span<const std::uint8_t>{rgba});
    e->size = glm::ivec2{picture->width, picture->height};
    e->srgb = true;
    e->wrapS = scene::Texture::Wrap::clamp;
    e->wrapT = scene::Texture::Wrap::clamp;
    foreground_ = texture;
    return {};
}

Ref<scene::Camera> WallBuilder::eyeCamera(std::size_t screen, config::Eye eye) {
    Ref<scene::Camera>& known = eyeCameras_[screen][static_cast<std::size_t>(eye)];
    if (!known) {
        const auto& camera = aspect_.create<scene::ScreenDecorator>();
        auto e = edit(camera);
        e->decoratee = made_.lens;
        e->screen = made_.screens[screen];
        e->user = made_.user;
        e->navigation = made_.navigation;
        e->eye = toEye(eye);
        known = camera;
    }
    return known;
}

Ref<scene::Viewport> WallBuilder::addViewport(std::size_t screen, config::Eye eye,
                                              const config::Canvas& canvas,
                                              const config::TileRect& part,
                                              const math::Rect& rect) {
    Ref<scene::Camera> camera = eyeCamera(screen, eye);
    if (part.width != canvas.width || part.height != canvas.height) {
        const auto& tile = aspect_.create<scene::TileDecorator>();
        auto e = edit(tile);
        e->decoratee = camera;
        e->part = math::Rect{
            .left = static_cast<double>(part.x) / canvas.width,
            .bottom = static_cast<double>(canvas.height - part.y - part.height) / canvas.height,
            .width = static_cast<double>(part.width) / canvas.width,
            .height = static_cast<double>(part.height) / canvas.height};
        camera = tile;
    }
    const auto& viewport = aspect_.create<scene::ShadowViewport>();
    auto e = edit(viewport);
    e->rect = rect;
    e->camera = camera;
    e->root = root_;
    e->background = background_;
    applyShadow(config_.shadow, *e);
    placeForeground(*e, canvas, part);
    made_.viewports.emplace_back(viewport);
    return viewport;
}

void WallBuilder::placeForeground(scene::ShadowViewport& viewport, const config::Canvas& canvas,
                                  const config::TileRect& part) {
    const auto* texture = aspect_.get(foreground_);
    if (texture == nullptr) return;
    // In pixels of the viewport, because a tile may hold only a piece of the image: the others lie
    // beyond its edges.
    const auto& place = *config_.render.foreground;
    const double height = std::max(2.0, std::round(place.height * canvas.height));
    const double width =
        std::max(2.0, std::round(height * texture->size->x / std::max(texture->size->y, 1)));
    const double left = std::round(place.position[0] * canvas.width) - part.x;
    const double bottom =
        std::round(place.position[1] * canvas.height) - (canvas.height - part.y - part.height);
    if (left >= part.width || bottom >= part.height || left + width <= 0 || bottom + height <= 0)
        return;
    const auto& foreground = aspect_.create<scene::ImageForeground>();
    auto e = edit(foreground);
    e->image = foreground_;
    e->rect = math::Rect{.left = left, .bottom = bottom, .width = width, .height = height};
    viewport.foregrounds.pushBack(foreground);
}

void WallBuilder::addWindow(const std::string& server, const config::Window& window, int gpu,
                            std::vector<Ref<scene::Viewport>> viewports) {
    const auto& made = aspect_.create<scene::Window>();
    auto e = edit(made);
    e->server = server;
    e->title = config_.name + ": " + server;
    e->size = glm::ivec2{window.size[0], window.size[1]};
    e->position = glm::ivec2{window.position[0], window.position[1]};
    e->fullscreen = window.fullscreen;
    e->monitor = window.monitor;
    e->gpu = gpu;
    e->samples = config_.render.samples;
    // One that hangs holds up all of its group: a wall that goes on without late servers cannot
    // have that unless it says so.
    e->swapGroup =
        config_.sync.swapGroup.value_or(config_.sync.onTimeout == config::OnTimeout::wait);
    e->viewports.assign(std::move(viewports));
    made_.windows.emplace_back(made);
}

}  // namespace gnomon::client

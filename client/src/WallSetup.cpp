#include <gnomon/client/WallSetup.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "Color.h"
#include "WallBuilder.h"

namespace gnomon::client {

using field::edit;
using field::Ref;

Result<WallContainers> buildWall(field::Aspect& aspect, const config::Config& config,
                                 Ref<scene::Node> root) {
    WallBuilder builder{aspect, config, root};
    if (auto room = builder.addRoom(); !room) return tl::unexpected{room.error()};
    for (const auto& server : config.servers) {
        for (const auto& window : server.windows) {
            std::vector<Ref<scene::Viewport>> viewports;
            for (const auto& from : window.viewports) {
                const auto screen = config::screenIndex(config, from.screen);
                if (!screen)
                    return fail(Errc::config, "server \"" + server.name + "\" shows screen \"" +
                                                  from.screen + "\", which does not exist");
                const auto canvas = config::canvas(config, *screen);
                if (!canvas) return tl::unexpected{canvas.error()};
                viewports.push_back(builder.addViewport(*screen, from.eye, *canvas,
                                                        canvas->tile(from.tile[0], from.tile[1]),
                                                        {.left = from.rect[0],
                                                         .bottom = from.rect[1],
                                                         .width = from.rect[2],
                                                         .height = from.rect[3]}));
            }
            builder.addWindow(server.name, window, config::gpuOf(server, window),
                              std::move(viewports));
        }
    }
    return builder.take();
}

void applyShadow(const config::Shadow& from, scene::ShadowViewport& viewport) {
    viewport.shadowOn = from.on;
    // What auto means is measured before; whoever does not gets what is good in most scenes.
    viewport.technique = from.technique == "auto" ? "lispsm" : from.technique;
    viewport.mapSize = from.mapSize.value_or(0);
    viewport.shadowColor =
        math::vec4{linearFromSrgb(from.color[0]), linearFromSrgb(from.color[1]),
                   linearFromSrgb(from.color[2]), static_cast<float>(from.color[3])};
    viewport.range = static_cast<float>(from.range);
    viewport.cascades = from.cascades;
    viewport.softness = static_cast<float>(from.softness);
    viewport.kernelWidth = from.kernelWidth;
    viewport.kernelSamples = from.kernelSamples;
    viewport.qualityMode = from.qualityMode;
    viewport.depthRange =
        from.qualityMode || from.depthRange == config::DepthRange::exact ? scene::DepthUse::exact
        : from.depthRange == config::DepthRange::previous                ? scene::DepthUse::previous
                                                                         : scene::DepthUse::off;
    viewport.overrideBias = from.offsetBias || from.offsetFactor;
    if (from.offsetBias) viewport.offBias = static_cast<float>(*from.offsetBias);
    if (from.offsetFactor) viewport.offFactor = static_cast<float>(*from.offsetFactor);
}

Result<WallContainers> buildWholeScreen(field::Aspect& aspect, const config::Config& config,
                                        std::size_t screen, const std::vector<config::Eye>& eyes,
                                        Ref<scene::Node> root, std::string server) {
    GNOMON_EXPECTS(screen < config.screens.size() && !eyes.empty(), "nothing to show");
    WallBuilder builder{aspect, config, root};
    if (auto room = builder.addRoom(); !room) return tl::unexpected{room.error()};
    const auto canvas = config::canvas(config, screen);
    if (!canvas) return tl::unexpected{canvas.error()};
    const auto count = static_cast<int>(eyes.size());
    std::vector<Ref<scene::Viewport>> viewports;
    for (int i = 0; i < count; ++i) {
        const config::TileRect whole{.width = canvas->width, .height = canvas->height};
        viewports.push_back(
            builder.addViewport(screen, eyes[static_cast<std::size_t>(i)], *canvas, whole,
                                {.left = static_cast<double>(i) / count, .width = 1.0 / count}));
    }
    config::Window window;
    window.size = {canvas->width * count, canvas->height};
    builder.addWindow(server, window, -1, std::move(viewports));
    return builder.take();
}

math::Affine worldFromRoom(const config::Config& config, const Look& look) noexcept {
    const auto& head = config.user.head;
    math::dmat4 toHead{1.0};
    toHead[3] = math::dvec4{-head[0], -head[1], -head[2], 1.0};
    math::dmat4 grow{look.scale};
    grow[3][3] = 1.0;
    return math::toAffine(worldFromEye(look) * grow * toHead);
}

void setView(field::Aspect& aspect, const WallContainers& wall, const config::Config& config,
             const Look& look) {
    if (const auto* navigation = aspect.get(wall.navigation))
        edit(*navigation)->worldFromRoom = worldFromRoom(config, look);
}

void setDepthRange(field::Aspect& aspect, const WallContainers& wall, const config::Config& config,
                   const DepthRange& range) {
    const auto* lens = aspect.get(wall.lens);
    if (lens == nullptr) return;
    const double far =
        config.render.far.value_or(std::max(range.far, config.render.near.value_or(0.0) * 2.0));
    auto e = edit(*lens);
    e->far = far;
    e->near = config.render.near.value_or(std::min(range.near, far * 0.5));
}

namespace {

/// A screen from the head, in room axes: tangents of its corners and the distance to its plane.
struct Seen {
    Opening opening = {};
    double distance = 0.0;  ///< metres along the screen's normal
    double ahead = -1.0;    ///< cosine between -z and the way to the screen's middle
    bool inFront = false;   ///< all of it, and not too oblique
};

Seen see(const config::Config& config, const config::Screen& screen) noexcept {
    constexpr double widest = 4.0;  // tangent of 76 degrees
    const math::dvec3 head = toVector(config.user.head);
    const math::dvec3 origin = toVector(screen.lowerLeft) - head;
    const math::dvec3 across = toVector(screen.lowerRight) - toVector(screen.lowerLeft);
    const math::dvec3 upward = toVector(screen.upperLeft) - toVector(screen.lowerLeft);
    constexpr double huge = std::numeric_limits<double>::infinity();
    Seen seen;
    seen.opening = {.left = huge, .right = -huge, .bottom = huge, .top = -huge};
    seen.inFront = true;
    for (int i = 0; i < 4; ++i) {
        const math::dvec3 corner =
            origin + across * static_cast<double>(i & 1) + upward * static_cast<double>(i >> 1);
        // Corners beside or behind the head count as far out.
        const double depth = std::max(-corner.z, 1e-9);
        const double x = std::clamp(corner.x / depth, -widest, widest);
        const double y = std::clamp(corner.y / depth, -widest, widest);
        if (std::abs(x) >= widest || std::abs(y) >= widest) seen.inFront = false;
        seen.opening.left = std::min(seen.opening.left, x);
        seen.opening.right = std::max(seen.opening.right, x);
        seen.opening.bottom = std::min(seen.opening.bottom, y);
        seen.opening.top = std::max(seen.opening.top, y);
    }
    const math::dvec3 middle = origin + across * 0.5 + upward * 0.5;
    const math::dvec3 normal = glm::cross(across, upward);
    const double area = glm::length(normal);
    seen.distance = area > 0.0 ? std::abs(glm::dot(origin, normal)) / area : 0.0;
    const double length = glm::length(middle);
    seen.ahead = length > 0.0 ? -middle.z / length : -1.0;
    return seen;
}

Seen straightAhead(const config::Config& config) noexcept {
    Seen best;
    for (const auto& screen : config.screens) {
        const Seen seen = see(config, screen);
        if (best.distance == 0.0 || seen.ahead > best.ahead) best = seen;
    }
    return best;
}

}  // namespace

Opening wallOpening(const config::Config& config) noexcept {
    Opening all = straightAhead(config).opening;
    for (const auto& screen : config.screens) {
        const Seen seen = see(config, screen);
        if (!seen.inFront) continue;
        all.left = std::min(all.left, seen.opening.left);
        all.right = std::max(all.right, seen.opening.right);
        all.bottom = std::min(all.bottom, seen.opening.bottom);
        all.top = std::max(all.top, seen.opening.top);
    }
    // Screens seen edge-on only: there is no picture to fill.
    if (!(all.right - all.left > 1e-6 && all.top - all.bottom > 1e-6)) return {};
    return all;
}

double wallDistance(const config::Config& config) noexcept {
    const double distance = straightAhead(config).distance;
    return distance > 0.0 ? distance : 1.0;
}

std::vector<config::Eye> eyesOf(const config::Config& config, std::size_t screen) {
    std::vector<config::Eye> eyes;
    for (const auto eye : {config::Eye::mono, config::Eye::left, config::Eye::right}) {
        const auto shows = [&](const config::Viewport& viewport) {
            return viewport.eye == eye && viewport.screen == config.screens[screen].name;
        };
        for (const auto& server : config.servers)
            for (const auto& window : server.windows)
                if (std::any_of(window.viewports.begin(), window.viewports.end(), shows) &&
                    std::find(eyes.begin(), eyes.end(), eye) == eyes.end())
                    eyes.push_back(eye);
    }
    return eyes;
}

}  // namespace gnomon::client

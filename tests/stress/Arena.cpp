#include "Arena.h"

#include <gnomon/image/Png.h>
#include <gnomon/scene/CameraView.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>

namespace gnomon::stress {
namespace {

int largestRegion(const image::Image& truth, const image::Image& factor, int depth, bool lit) {
    const int w = truth.width;
    const int h = truth.height;
    const auto at = [&](const image::Image& image, int x, int y) {
        return image.pixels[static_cast<std::size_t>(y * w + x)];
    };
    const auto deep = [&](int x, int y) {
        for (int dy = -depth; dy <= depth; ++dy)
            for (int dx = -depth; dx <= depth; ++dx) {
                if (x + dx < 0 || y + dy < 0 || x + dx >= w || y + dy >= h) return false;
                const std::uint8_t t = at(truth, x + dx, y + dy);
                if (t == truth::noSurface || (t > 127) != lit) return false;
            }
        return true;
    };
    std::vector<bool> wrong(truth.pixels.size(), false);
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x)
            wrong[static_cast<std::size_t>(y * w + x)] = deep(x, y) &&
                                                         (at(factor, x, y) > 127) != lit &&
                                                         at(factor, x, y) != truth::noSurface;
    int largest = 0;
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < wrong.size(); ++i) {
        if (!wrong[i]) continue;
        int size = 0;
        open.push_back(i);
        wrong[i] = false;
        while (!open.empty()) {
            const std::size_t p = open.back();
            open.pop_back();
            ++size;
            const auto visit = [&](std::size_t n, bool inside) {
                if (!inside || !wrong[n]) return;
                wrong[n] = false;
                open.push_back(n);
            };
            const auto x = static_cast<int>(p % static_cast<std::size_t>(w));
            const auto y = static_cast<int>(p / static_cast<std::size_t>(w));
            visit(p - 1, x > 0);
            visit(p + 1, x + 1 < w);
            visit(p - static_cast<std::size_t>(w), y > 0);
            visit(p + static_cast<std::size_t>(w), y + 1 < h);
        }
        largest = std::max(largest, size);
    }
    return largest;
}

}  // namespace

int lostShadow(const image::Image& truth, const image::Image& factor, int depth) {
    return largestRegion(truth, factor, depth, false);
}
int falseShadow(const image::Image& truth, const image::Image& factor, int depth) {
    return largestRegion(truth, factor, depth, true);
}

Arena::View Arena::seen(const scene::Camera& camera, int width, int height, int mapSize) {
    const View made = view(camera, width, height);
    auto e = edit(made.viewport);
    e->technique = technique();
    e->mapSize = mapSize;
    return made;
}

void Arena::place(const scene::Node& beacon, const math::dvec3& from, const math::dvec3& to) {
    edit(*app.get(scene::Ref<scene::Transform>{beacon.core->id}))->matrix = lookFrom(from, to);
}

/// What shadows are judged by.
struct Arena::Rays {
    truth::RayScene scene;
    truth::LightSampler light;
    std::vector<math::dmat4> maps = {};
    double texels = 0.0;  ///< of a map's clip space, whose sides are 2 long
    double reach = 0.0;   ///< of lookups, as ShadowState has it
    math::dvec4 source{0.0};

    /// Distance from the light along its axis, metres; 1 where it is parallel.
    double axial(const math::dvec3& position) const {
        if (source.w == 0.0) return 1.0;
        return glm::length(math::dvec3{source} - scene.origin() - position);
    }
};

const scene::ShadowState* Arena::stateOf(const View& view, const scene::Node& light) const {
    const glm::ivec2 size = view.window.size;
    const auto camera = orThrow(scene::cameraView(server, copyOf(view.viewport).camera,
                                                  static_cast<double>(size.x) / size.y));
    const scene::ShadowState* found = nullptr;
    server.forEach([&](const field::FieldContainer& container) {
        const auto* state = dynamic_cast<const scene::ShadowState*>(&container);
        if (state != nullptr && state->light->id == light.id() &&
            state->group->id == camera.group.id)
            found = state;
    });
    return found;
}

std::vector<math::dmat4> Arena::mapsOf(const View& view, const scene::Node& light) const {
    const auto* state = stateOf(view, light);
    if (state == nullptr) return {};
    return {state->clipFromWorld.begin(), state->clipFromWorld.end()};
}

/// Whether the filter, looking around a place on a plane, sees both light and shadow.
bool Arena::mixed(const Rays& rays, const math::dvec3& position, const math::dvec3& normal) const {
    constexpr int directions = 8;
    const auto [u, v] = shadow_fit::perpendicular(normal);
    const auto shadowed = [&](const math::dvec3& at) {
        const auto ray = rays.light.centre(at);
        return rays.scene.shadowed({.position = at, .normal = normal}, ray.direction, ray.reach);
    };
    const bool here = shadowed(position);
    for (const math::dmat4& map : rays.maps) {
        const math::dvec4 clip = map * math::dvec4{position + rays.scene.origin(), 1.0};
        const math::dvec2 place = math::dvec2{clip} / clip.w;
        if (!(std::max(std::abs(place.x), std::abs(place.y)) <= 1.0)) continue;
        // Metres on the plane to texels of the map, and back.
        const auto texelsOf = [&](const math::dvec3& step) {
            const math::dvec4 moved = map * math::dvec4{step, 0.0};
            return (math::dvec2{moved} - place * moved.w) / clip.w * (0.5 * rays.texels);
        };
        const glm::dmat2 texels{texelsOf(u), texelsOf(v)};
        if (!(std::abs(glm::determinant(texels)) > 0.0)) return true;
        const glm::dmat2 metres = glm::inverse(texels);
        // A texel more, where the map's own samples are.
        const auto& filter = GetParam().filter;
        const auto across = rays.light.centre(position).direction;
        const auto [x, y] = shadow_fit::perpendicular(across);
        const double unit =
            rays.axial(position) * std::max(glm::length(texelsOf(x)), glm::length(texelsOf(y)));
        const double reach =
            std::max(static_cast<double>(filter.leastTexels), rays.reach * unit) + 1.0;
        for (const double share : {0.35, 0.7, 1.0}) {
            for (int i = 0; i < directions; ++i) {
                const double angle = 2.0 * std::numbers::pi * i / directions;
                const math::dvec2 way =
                    metres * (math::dvec2{std::cos(angle), std::sin(angle)} * reach * share);
                if (shadowed(position + u * way.x + v * way.y) != here) return true;
            }
        }
    }
    return false;
}

image::Image Arena::truth(const View& view, const scene::Node& light, bool beyondTexels) {
    const scene::ShadowViewport& viewport = copyOf(view.viewport);
    const glm::ivec2 size = view.window.size;
    const auto camera =
        orThrow(scene::cameraView(server, viewport.camera, static_cast<double>(size.x) / size.y));
    scene::FlatScene flat{server};
    flat.update(viewport.root, {}, {});
    const auto uses = flat.lights();
    const auto use = std::find_if(uses.begin(), uses.end(), [&](const auto& candidate) {
        return candidate.node->id() == light.id();
    });
    EXPECT_NE(use, uses.end());
    const auto shape = shadow_fit::lightShape(*use);
    // Rays are floats, too: near what they meet.
    const math::Box bounds = flat.bounds();
    const math::dvec3 origin =
        glm::round(bounds.empty() ? camera.view.eyeWorld()
                                  : glm::clamp(camera.view.eyeWorld(), bounds.min, bounds.max));
    Rays rays{.scene = truth::RayScene{server}, .light = truth::LightSampler{shape, origin}};
    rays.scene.update(flat, origin);
    auto factor =
        truth::shadowTruth(rays.scene, camera.view, shape, {.width = size.x, .height = size.y})
            .factor;
    const auto* state = stateOf(view, light);
    if ((GetParam().hard() && !beyondTexels) || state == nullptr) return factor;
    rays.maps = mapsOf(view, light);
    rays.texels = state->mapSize;
    rays.reach = state->reach;
    rays.source = state->source;
    const math::dmat4 worldFromClip = glm::inverse(camera.view.clipFromWorld());
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            std::uint8_t& value = factor.pixels[static_cast<std::size_t>(y * size.x + x)];
            if (value == truth::noSurface) continue;
            const auto at = [&](double depth) {
                const math::dvec4 p =
                    worldFromClip * math::dvec4{(x + 0.5) / size.x * 2.0 - 1.0,
                                                1.0 - (y + 0.5) / size.y * 2.0, depth, 1.0};
                return math::dvec3{p} / p.w - origin;
            };
            const math::dvec3 way = at(0.0) - at(1.0);
            const double length = glm::length(way);
            const auto hit = rays.scene.firstHit(at(1.0), way / length, length);
            // What bleeds is judged by what must be lit alone.
            if (!hit || (value < 128 && GetParam().filter.bleeds) ||
                mixed(rays, hit->position, hit->normal))
                value = truth::noSurface;
        }
    }
    return factor;
}

Arena::Both Arena::both(const View& view, const scene::Node& light, bool beyondTexels) {
    Both made{.factor = factor(view, light)};
    made.truth = truth(view, light, beyondTexels);
    made.error = orThrow(truth::compareFactors(made.truth, made.factor));
    last_ = made;
    return made;
}

void Arena::remove(const scene::Node& node, const View& view) {
    edit(root)->removeChild(node);
    EXPECT_TRUE(app.destroyTree(node).has_value());
    EXPECT_TRUE(app.destroyTree(view.window).has_value());
}

void Arena::TearDown() {
    RenderTest::TearDown();
    const bool wanted = HasFailure() || std::getenv("GNOMON_STRESS_PICTURES") != nullptr;
    if (!wanted || last_.truth.pixels.empty()) return;
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string{test->test_suite_name()} + "." + test->name();
    std::replace(name.begin(), name.end(), '/', '-');
    const auto folder = std::filesystem::path{GNOMON_BIN_DIR}.parent_path() / "stress";
    std::filesystem::create_directories(folder);
    for (const auto& [what, picture] :
         {std::pair{"error", truth::errorPicture(last_.truth, last_.factor)},
          std::pair{"factor", last_.factor}})
        EXPECT_TRUE(image::writePng(folder / (name + "." + what + ".png"), picture).has_value());
}

Arena::Mesh Arena::sphere(const math::vec3& centre, float radius, int segments) {
    Mesh mesh;
    const int rings = segments / 2;
    for (int r = 0; r <= rings; ++r) {
        for (int s = 0; s < segments; ++s) {
            const float a =
                std::numbers::pi_v<float> * static_cast<float>(r) / static_cast<float>(rings);
            const float b = 2.0F * std::numbers::pi_v<float> * static_cast<float>(s) /
                            static_cast<float>(segments);
            mesh.positions.push_back(centre + radius * math::vec3{std::sin(a) * std::sin(b),
                                                                  std::cos(a),
                                                                  std::sin(a) * std::cos(b)});
        }
    }
    const auto at = [&](int r, int s) {
        return static_cast<std::uint32_t>(r * segments + s % segments);
    };
    for (int r = 0; r < rings; ++r) {
        for (int s = 0; s < segments; ++s) {
            if (r > 0)
                mesh.indices.insert(mesh.indices.end(), {at(r, s), at(r + 1, s), at(r, s + 1)});
            if (r + 1 < rings)
                mesh.indices.insert(mesh.indices.end(),
                                    {at(r, s + 1), at(r + 1, s), at(r + 1, s + 1)});
        }
    }
    return mesh;
}

}  // namespace gnomon::stress

#include "Arena.h"

#include <gnomon/scene/CameraView.h>

#include <algorithm>
#include <cmath>
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

image::Image Arena::truth(const View& view, const scene::Node& light) {
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
    truth::RayScene rays{server};
    rays.update(flat, glm::round(camera.view.eyeWorld()));
    return truth::shadowTruth(rays, camera.view, shadow_fit::lightShape(*use),
                              {.width = size.x, .height = size.y})
        .factor;
}

Arena::Both Arena::both(const View& view, const scene::Node& light) {
    Both made{.factor = factor(view, light)};
    made.truth = truth(view, light);
    made.error = orThrow(truth::compareFactors(made.truth, made.factor));
    return made;
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

#include "Lights.h"

#include <gnomon/shadow_fit/ShadowFitter.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::render {
namespace {

/// Light of Glsl.cpp, std140.
struct LightBlock {
    math::vec4 position{0.0F};
    math::vec4 direction{0.0F};
    math::vec4 color{0.0F};
    math::vec4 attenuation{1.0F, 0.0F, 0.0F, 0.0F};
    math::vec4 cone{0.0F};
    math::vec4 ambient{0.0F};
    glm::uvec4 index{0U};
};

struct ViewBlock {
    math::vec4 eye{0.0F};
    math::vec4 ambientMiddle{0.0F};
    math::vec4 ambientHalf{0.0F};
    math::vec4 shade{0.0F};
    glm::ivec4 factorImages{0};
};

/// False only where nothing that is seen can be reached.
bool reaches(const shadow_fit::LightShape& shape, const std::array<math::Plane, 6>& planes) {
    if (shape.kind == shadow_fit::LightKind::directional || !(shape.range > 0.0)) return true;
    return std::all_of(planes.begin(), planes.end(), [&](const math::Plane& plane) {
        return plane.distance(shape.position) >= -shape.range;
    });
}

LightBlock blockFor(const scene::FlatScene::LightUse& use, const shadow_fit::LightShape& shape,
                    const math::dvec3& origin) {
    LightBlock block;
    const math::dvec3 position = shape.position - origin;
    block.position = math::vec4{math::dvec4{position, shape.range}};
    block.direction = math::vec4{math::dvec4{
        shape.direction, static_cast<double>(shape.kind == shadow_fit::LightKind::directional ? 0
                                             : shape.kind == shadow_fit::LightKind::point     ? 1
                                                                                          : 2)}};
    block.color = math::vec4{use.light->color.get() * use.light->intensity.get(), 1.0F};
    block.ambient = math::vec4{use.light->ambient.get(), 0.0F};
    if (const auto* point = dynamic_cast<const scene::PointLight*>(use.light)) {
        block.attenuation = math::vec4{point->attenuation.get(), 0.0F};
    } else if (const auto* spot = dynamic_cast<const scene::SpotLight*>(use.light)) {
        block.attenuation = math::vec4{spot->attenuation.get(), 0.0F};
        // As KHR_lights_punctual: from 0 at the outer cosine to 1 at the inner one.
        const float outer = std::cos(std::clamp(spot->outerAngle.get(), 0.0F, 1.5707963F));
        const float inner = std::cos(std::clamp(spot->innerAngle.get(), 0.0F, 1.5707963F));
        const float scale = 1.0F / std::max(inner - outer, 1e-3F);
        block.cone = {scale, -outer * scale, 0.0F, 0.0F};
    }
    return block;
}

}  // namespace

Lights::Lights(const gl::Api& gl) : gl_{gl}, lights_{gl}, view_{gl} {
    lights_.label("lights");
    view_.label("view");
    gl.NamedBufferStorage(lights_.id(), sizeof(LightBlock) * scene::FlatScene::maxLights, nullptr,
                          GL_DYNAMIC_STORAGE_BIT);
    gl.NamedBufferStorage(view_.id(), sizeof(ViewBlock), nullptr, GL_DYNAMIC_STORAGE_BIT);
}

Lights::Uploaded Lights::upload(const scene::FlatScene& flat, const math::View& view,
                                const math::dvec3& origin, const scene::Viewport& viewport,
                                shadow::ShadowMaps* maps, const glm::ivec2& imagesAt, int only) {
    Uploaded done;
    const auto* shadowed = dynamic_cast<const scene::ShadowViewport*>(&viewport);
    const bool tracing =
        shadowed != nullptr && shadowed->shadowOn && shadowed->technique.get() == "ray";
    std::array<LightBlock, scene::FlatScene::maxLights> blocks;
    std::array<field::Id, scene::FlatScene::maxLights> order;
    std::uint64_t used = 0;
    const auto planes = math::frustumPlanes(view.clipFromWorld());
    const auto uses = flat.lights();
    const auto put = [&](std::size_t i, bool directional) {
        const auto& use = uses[i];
        if (only >= 0 ? i != static_cast<std::size_t>(only)
                      : !use.light->on || !(use.light->intensity > 0.0F))
            return;
        const auto shape = shadow_fit::lightShape(use);
        if (directional != (shape.kind == shadow_fit::LightKind::directional)) return;
        if (only < 0 && !reaches(shape, planes)) {
            ++done.unseen;
            return;
        }
        LightBlock block = blockFor(use, shape, origin);
        const bool rays = tracing && shadow_fit::wantsShadows(*shadowed, use);
        if (rays) done.traced.push_back({.layer = done.count, .shape = shape});
        block.ambient.w =
            rays || (maps != nullptr && maps->count(use.node->id()) > 0) ? 1.0F : 0.0F;
        block.index = {static_cast<std::uint32_t>(i), 0U, 0U, 0U};
        order[static_cast<std::size_t>(done.count)] = use.node->id();
        used |= std::uint64_t{1} << i;
        blocks[static_cast<std::size_t>(done.count++)] = block;
    };
    for (std::size_t i = 0; i < uses.size(); ++i) put(i, true);
    done.directional = done.count;
    for (std::size_t i = 0; i < uses.size(); ++i) put(i, false);
    if (!done.traced.empty())
        done.maps = {.mapsPerLight = 1, .lights = done.count, .images = true};
    else if (maps != nullptr)
        done.maps = maps->arrange(std::span{order}.first(static_cast<std::size_t>(done.count)));
    done.scoped = std::any_of(flat.instances().begin(), flat.instances().end(),
                              [&](const scene::FlatScene::Instance& instance) {
                                  return (instance.lights & used) != used;
                              });

    ViewBlock block;
    block.eye = math::vec4{math::dvec4{view.eyeWorld() - origin, static_cast<double>(done.count)}};
    const math::vec3& sky = viewport.ambientSky;
    const math::vec3& ground = viewport.ambientGround;
    block.ambientMiddle = math::vec4{(sky + ground) * 0.5F, 0.0F};
    block.ambientHalf = math::vec4{(sky - ground) * 0.5F, 0.0F};
    if (shadowed != nullptr) {
        const math::vec4 color = shadowed->shadowColor;
        block.shade = (math::vec4{1.0F} - color) * color.w;
    }
    block.factorImages = {imagesAt, 0, 0};
    if (done.count > 0)
        gl_.NamedBufferSubData(lights_.id(), 0,
                               static_cast<GLsizeiptr>(sizeof(LightBlock)) * done.count,
                               blocks.data());
    gl_.NamedBufferSubData(view_.id(), 0, sizeof block, &block);
    gl_.BindBufferBase(GL_UNIFORM_BUFFER, lightBinding, lights_.id());
    gl_.BindBufferBase(GL_UNIFORM_BUFFER, viewBinding, view_.id());
    return done;
}

}  // namespace gnomon::render

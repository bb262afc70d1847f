#include "SceneDrawer.h"

#include <algorithm>

namespace gnomon::render {
namespace {

/// @param lights  that the program is written out for
void useMaps(Variant& variant, const shadow::ShadowMaps::Arranged& maps, int lights) {
    if (maps.mapsPerLight == 0) return;
    variant.mapsPerLight = maps.mapsPerLight;
    variant.shadowLights = maps.lights;
    variant.features |= Variant::shadows;
    if (maps.images) {
        variant.features |= Variant::factorImages;
        return;
    }
    variant.places = std::min({maps.lights, lights, Variant::maxPlaces});
    if (maps.paged) variant.features |= Variant::pagedMaps;
    if (maps.perspective) variant.features |= Variant::perspectiveMaps;
}

}  // namespace

SceneDrawer::SceneDrawer(const gl::Api& gl, const field::Aspect& aspect, MeshStore& meshes,
                         TextureStore& textures, Programs& programs)
    : gl_{gl},
      aspect_{aspect},
      meshes_{meshes},
      programs_{programs},
      flat_{aspect},
      batches_{gl, meshes, textures, programs},
      commandBuffer_{gl} {
    commandBuffer_.label("draw commands");
}

void SceneDrawer::update(scene::Ref<scene::Node> root,
                         std::span<const scene::Ref<scene::Node>> excluded,
                         const field::Applied& applied,
                         const std::function<void(std::string)>& report) {
    flat_.update(root, excluded, applied);
    chunks_.update(flat_);
    rebuilt_ = flat_.rebuilt();
    // Parameters of materials and textures are rare to change: grouping anew is simple and right.
    for (const auto& change : applied.changed) {
        if (rebuilt_) break;
        const auto* container = aspect_.find(change.id);
        rebuilt_ = dynamic_cast<const scene::Material*>(container) != nullptr ||
                   dynamic_cast<const scene::Texture*>(container) != nullptr;
    }
    if (rebuilt_ || !flat_.moved().empty()) seenFrom_.reset();
    if (rebuilt_) {
        batches_.rebuild(flat_, chunks_, aspect_, report);
        instances_.resize(flat_.instances().size());
        haveOrigin_ = false;
    } else if (!flat_.moved().empty()) {
        if (!haveOrigin_) return;
        const auto moved = flat_.moved();
        for (const std::uint32_t i : moved) writeInstance(i);
        // Many small writes cost more than one large one.
        if (moved.size() > instances_.size() / 8 + 8) {
            uploadInstances();
        } else {
            for (const std::uint32_t i : moved)
                gl_.NamedBufferSubData(instanceBuffer_.id(),
                                       static_cast<GLintptr>(i * sizeof(InstanceGpu)),
                                       sizeof(InstanceGpu), &instances_[i]);
        }
    }
}

void SceneDrawer::writeInstance(std::size_t index) {
    const auto& instance = flat_.instances()[index];
    const math::dmat4& world = flat_.worldFromLocal(instance);
    InstanceGpu& gpu = instances_[index];
    for (int row = 0; row < 3; ++row) {
        const double shift = world[3][row] - origin_[row];
        gpu.rows[row] = math::vec4{math::dvec4{world[0][row], world[1][row], world[2][row], shift}};
    }
    gpu.info = {static_cast<std::uint32_t>(instance.lights),
                static_cast<std::uint32_t>(instance.lights >> 32U), 0U, 0U};
}

void SceneDrawer::uploadInstances() {
    if (instances_.empty()) return;
    if (instances_.size() > instanceCapacity_) {
        instanceCapacity_ = instances_.size() + instances_.size() / 2;
        instanceBuffer_ = gl::Buffer{gl_};
        instanceBuffer_.label("instances");
        gl_.NamedBufferStorage(instanceBuffer_.id(),
                               static_cast<GLsizeiptr>(instanceCapacity_ * sizeof(InstanceGpu)),
                               nullptr, GL_DYNAMIC_STORAGE_BIT);
    }
    gl_.NamedBufferSubData(instanceBuffer_.id(), 0,
                           static_cast<GLsizeiptr>(instances_.size() * sizeof(InstanceGpu)),
                           instances_.data());
}

void SceneDrawer::useOrigin(const math::dvec3& origin) {
    if (!haveOrigin_ || origin_ != origin) {
        origin_ = origin;
        haveOrigin_ = true;
        for (std::size_t i = 0; i < instances_.size(); ++i) writeInstance(i);
        uploadInstances();
    }
    if (instanceBuffer_) meshes_.useInstances(instanceBuffer_.id(), sizeof(InstanceGpu));
}

PassStatistics SceneDrawer::gather(const ColorPass& pass, bool blended) {
    PassStatistics done;
    const auto planes = math::frustumPlanes(pass.clipFromWorld);
    const auto states = batches_.batches();
    items_.resize(std::max({items_.size(), states.size(), batches_.depthBatches().size()}));
    for (auto& items : items_) items.clear();
    const auto drawables = batches_.drawables();
    std::uint64_t looked = 0;
    chunks_.tree().visit(planes, [&](std::uint32_t use, bool) {
        const Drawable& drawable = drawables[use];
        if (drawable.batch == Drawable::none) return;
        const BatchState& state = states[drawable.batch];
        ++looked;
        if (state.blend != blended) return;
        const math::Box& box = chunks_.bounds(use);
        const math::dvec3 nearest = glm::clamp(pass.eyeWorld, box.min, box.max);
        const math::dvec3 way = (blended ? box.centre() : nearest) - pass.eyeWorld;
        items_[drawable.batch].push_back(
            {.distance = static_cast<float>(glm::dot(way, way)), .command = drawable.command});
        ++done.chunks;
        if (state.primitive == GL_TRIANGLES) done.triangles += drawable.command.count / 3;
    });
    if (!blended) done.chunksCulled = drawables.size() - looked;
    return done;
}

void SceneDrawer::setFaces(const BatchState& state) {
    if (state.cull == Cull::none) {
        gl_.Disable(GL_CULL_FACE);
        return;
    }
    gl_.Enable(GL_CULL_FACE);
    gl_.CullFace(state.cull == Cull::back ? GL_BACK : GL_FRONT);
    gl_.FrontFace(state.mirrored ? GL_CW : GL_CCW);
}

void SceneDrawer::flush(std::span<const BatchState> states,
                        const std::function<void(const BatchState&)>& use, const Flush& how) {
    const auto drawn = [&](const BatchState& state) {
        return how.foreign || state.foreign == nullptr;
    };
    commands_.clear();
    for (std::size_t i = 0; i < states.size(); ++i)
        if (drawn(states[i]))
            for (const Item& item : items_[i]) commands_.push_back(item.command);
    if (commands_.empty()) return;
    gl_.NamedBufferData(commandBuffer_.id(),
                        static_cast<GLsizeiptr>(commands_.size() * sizeof(DrawCommand)),
                        commands_.data(), GL_STREAM_DRAW);
    gl_.BindBuffer(GL_DRAW_INDIRECT_BUFFER, commandBuffer_.id());
    std::size_t first = 0;
    for (std::size_t i = 0; i < states.size(); ++i) {
        const BatchState& state = states[i];
        if (items_[i].empty() || !drawn(state)) continue;
        use(state);
        setFaces(state);
        gl_.BindVertexArray(meshes_.vertexArray(state.format, how.positionsOnly));
        gl_.MultiDrawElementsIndirect(state.primitive, GL_UNSIGNED_INT,
                                      reinterpret_cast<const void*>(first * sizeof(DrawCommand)),
                                      static_cast<GLsizei>(items_[i].size()), 0);
        first += items_[i].size();
    }
}

void SceneDrawer::useSurface(const BatchState& state, const ColorPass& pass) {
    Variant variant{.format = state.format, .features = state.features};
    if (pass.scopedLights) variant.features |= Variant::scopedLights;
    variant.directionalLights = std::min(pass.directionalLights, Variant::maxDirectional);
    variant.otherLights = pass.lights - variant.directionalLights;
    if (variant.otherLights > Variant::maxOther) {
        variant.otherLights = 0;
        variant.features |= Variant::manyLights;
    }
    useMaps(variant, state.blend ? pass.blendedMaps : pass.maps,
            variant.directionalLights + variant.otherLights);
    if ((state.features & Variant::unlit) != 0) {
        variant = {.format = state.format, .features = state.features};
    }
    const GLuint program = programs_.mesh(variant);
    gl_.UseProgram(program);
    gl_.ProgramUniformMatrix4fv(program, 0, 1, GL_FALSE, &pass.clipFromOrigin[0][0]);
    batches_.bindMaterial(state.material);
    gl_.BindTextures(0, 3, state.textures.data());
}

PassStatistics SceneDrawer::gatherNearestFirst(const ColorPass& pass) {
    const PassStatistics done = gather(pass, false);
    for (auto& items : items_)
        std::sort(items.begin(), items.end(),
                  [](const Item& a, const Item& b) { return a.distance < b.distance; });
    return done;
}

PassStatistics SceneDrawer::drawOpaque(const ColorPass& pass) {
    const PassStatistics done = gatherNearestFirst(pass);
    const auto states = batches_.batches();
    flush(states, [&](const BatchState& state) { useSurface(state, pass); }, {});
    for (std::size_t i = 0; i < states.size(); ++i)
        if (states[i].foreign != nullptr && !items_[i].empty())
            drawForeign(states[i], items_[i], pass);
    return done;
}

PassStatistics SceneDrawer::drawBlended(const ColorPass& pass) {
    const PassStatistics done = gather(pass, true);
    if (done.chunks == 0) return done;
    struct Sorted {
        Item item = {};
        std::uint32_t batch = 0;
    };
    std::vector<Sorted> sorted;
    const auto states = batches_.batches();
    for (std::uint32_t i = 0; i < states.size(); ++i)
        for (const Item& item : items_[i]) sorted.push_back({.item = item, .batch = i});
    std::stable_sort(sorted.begin(), sorted.end(), [](const Sorted& a, const Sorted& b) {
        return a.item.distance > b.item.distance;
    });
    gl_.Enable(GL_BLEND);
    gl_.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl_.DepthMask(GL_FALSE);
    for (const Sorted& draw : sorted) {
        const BatchState& state = states[draw.batch];
        useSurface(state, pass);
        setFaces(state);
        gl_.BindVertexArray(meshes_.vertexArray(state.format, false));
        const DrawCommand& command = draw.item.command;
        gl_.DrawElementsInstancedBaseVertexBaseInstance(
            state.primitive, static_cast<GLsizei>(command.count), GL_UNSIGNED_INT,
            reinterpret_cast<const void*>(std::uintptr_t{command.firstIndex} * 4U), 1,
            command.baseVertex, command.baseInstance);
    }
    gl_.DepthMask(GL_TRUE);
    gl_.Disable(GL_BLEND);
    return done;
}

void SceneDrawer::drawForeign(const BatchState& state, const std::vector<Item>& items,
                              const ColorPass& pass) {
    const auto& foreign = programs_.foreign(*state.foreign);
    const GLuint program = foreign.program.id();
    gl_.UseProgram(program);
    gl_.BindTextures(0, 3, state.textures.data());
    if (foreign.texture >= 0) gl_.ProgramUniform1i(program, foreign.texture, 0);
    if (foreign.time >= 0)
        gl_.ProgramUniform1f(program, foreign.time, static_cast<float>(pass.time));
    setFaces(state);
    gl_.BindVertexArray(meshes_.vertexArray(state.format, false));
    gl_.Enable(GL_STENCIL_TEST);
    gl_.StencilFunc(GL_ALWAYS, 1, 0xff);
    gl_.StencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    for (const Item& item : items) {
        const auto& instance = flat_.instances()[item.command.baseInstance];
        const math::dmat4& world = flat_.worldFromLocal(instance);
        const math::mat4 clip{pass.clipFromWorld * world};
        const math::mat4 eye{pass.eyeFromWorld * world};
        if (foreign.clipFromLocal >= 0)
            gl_.ProgramUniformMatrix4fv(program, foreign.clipFromLocal, 1, GL_FALSE, &clip[0][0]);
        if (foreign.eyeFromLocal >= 0)
            gl_.ProgramUniformMatrix4fv(program, foreign.eyeFromLocal, 1, GL_FALSE, &eye[0][0]);
        if (foreign.eyeFromLocalNormal >= 0) {
            const math::vec3 a{eye[0]};
            const math::vec3 b{eye[1]};
            const math::vec3 c{eye[2]};
            const math::mat3 cofactors{glm::cross(b, c), glm::cross(c, a), glm::cross(a, b)};
            gl_.ProgramUniformMatrix3fv(program, foreign.eyeFromLocalNormal, 1, GL_FALSE,
                                        &cofactors[0][0]);
        }
        gl_.DrawElementsInstancedBaseVertexBaseInstance(
            state.primitive, static_cast<GLsizei>(item.command.count), GL_UNSIGNED_INT,
            reinterpret_cast<const void*>(std::uintptr_t{item.command.firstIndex} * 4U), 1,
            item.command.baseVertex, item.command.baseInstance);
    }
    gl_.Disable(GL_STENCIL_TEST);
}

void SceneDrawer::drawFactor(const ColorPass& pass) {
    gather(pass, false);
    flush(batches_.batches(),
          [&](const BatchState& state) {
              Variant variant{
                  .pass = Variant::Pass::factor,
                  .format = state.format,
                  .features = state.features & (Variant::alphaMask | Variant::diffuseMap)};
              useMaps(variant, pass.maps, 1);
              const GLuint program = programs_.mesh(variant);
              gl_.UseProgram(program);
              gl_.ProgramUniformMatrix4fv(program, 0, 1, GL_FALSE, &pass.clipFromOrigin[0][0]);
              batches_.bindMaterial(state.material);
              gl_.BindTextures(0, 3, state.textures.data());
          },
          {.foreign = true});
}

PassStatistics SceneDrawer::drawUnblurred(const ColorPass& pass, int firstLight, int lightCount) {
    const PassStatistics done = gatherNearestFirst(pass);
    flush(batches_.batches(),
          [&](const BatchState& state) {
              const bool masked = (state.features & Variant::alphaMask) != 0;
              Variant variant{
                  .pass = Variant::Pass::unblurred,
                  .format = masked ? state.format & (hasTexCoords | hasColors) : 0U,
                  .features =
                      masked ? state.features & (Variant::alphaMask | Variant::diffuseMap) : 0U,
                  .firstLight = firstLight,
                  .lightCount = lightCount};
              useMaps(variant, pass.maps, firstLight + lightCount);
              const GLuint program = programs_.mesh(variant);
              const math::mat3 eyeFromOrigin{math::dmat3{pass.eyeFromWorld}};
              gl_.UseProgram(program);
              gl_.ProgramUniformMatrix4fv(program, 0, 1, GL_FALSE, &pass.clipFromOrigin[0][0]);
              gl_.ProgramUniformMatrix3fv(program, 4, 1, GL_FALSE, &eyeFromOrigin[0][0]);
              if (!masked) return;
              batches_.bindMaterial(state.material);
              gl_.BindTextures(0, 3, state.textures.data());
          },
          {.positionsOnly = true, .foreign = true});
    return done;
}

void SceneDrawer::drawDepth(const ColorPass& pass) {
    gather(pass, false);
    flush(batches_.batches(),
          [&](const BatchState& state) { useDepth(state, pass.clipFromOrigin); },
          {.positionsOnly = true, .foreign = true});
}

std::optional<shadow_fit::DepthSpan> SceneDrawer::blendedDepth(const ColorPass& pass) {
    std::optional<shadow_fit::DepthSpan> span;
    const auto planes = math::frustumPlanes(pass.clipFromWorld);
    const auto states = batches_.batches();
    const auto drawables = batches_.drawables();
    chunks_.tree().visit(planes, [&](std::uint32_t use, bool) {
        const Drawable& drawable = drawables[use];
        if (drawable.batch == Drawable::none || !states[drawable.batch].blend) return;
        const math::Box& box = chunks_.bounds(use);
        for (int i = 0; i < 8; ++i) {
            const double depth = -(pass.eyeFromWorld * math::dvec4{box.corner(i), 1.0}).z;
            span = together(span, shadow_fit::DepthSpan{.near = depth, .far = depth});
        }
    });
    return span;
}

std::span<const math::dvec3> SceneDrawer::seenBy(const math::View& view) {
    const math::dmat4 clipFromWorld = view.clipFromWorld();
    if (seenFrom_ != clipFromWorld) {
        seen_.clear();
        seen_.add(view, nullptr, chunks_.tree());
        seenFrom_ = clipFromWorld;
    }
    return seen_.points();
}

shadow::CasterSource::Drawn SceneDrawer::drawCasters(const Pass& pass) {
    Drawn done;
    const auto states = batches_.depthBatches();
    items_.resize(std::max({items_.size(), states.size(), batches_.batches().size()}));
    for (auto& items : items_) items.clear();
    const auto drawables = batches_.drawables();
    chunks_.tree().visit(pass.volume, [&](std::uint32_t use, bool) {
        const Drawable& drawable = drawables[use];
        if (drawable.depthBatch == Drawable::none) return;
        items_[drawable.depthBatch].push_back({.command = drawable.command});
        ++done.chunks;
        done.triangles += drawable.command.count / 3;
    });
    flush(states, [&](const BatchState& state) { useDepth(state, pass.clipFromOrigin); },
          {.positionsOnly = true});
    return done;
}

void SceneDrawer::useDepth(const BatchState& state, const math::mat4& clipFromOrigin) {
    const bool masked = (state.features & Variant::alphaMask) != 0;
    // What is opaque reads positions alone, whatever else its mesh has.
    const GLuint program =
        programs_.mesh({.pass = Variant::Pass::depth,
                        .format = masked ? state.format & (hasTexCoords | hasColors) : 0U,
                        .features = state.features & (Variant::alphaMask | Variant::diffuseMap)});
    gl_.UseProgram(program);
    gl_.ProgramUniformMatrix4fv(program, 0, 1, GL_FALSE, &clipFromOrigin[0][0]);
    if (masked) {
        batches_.bindMaterial(state.material);
        gl_.BindTextures(0, 3, state.textures.data());
    }
}

}  // namespace gnomon::render

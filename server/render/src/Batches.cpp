#include "Batches.h"

#include <algorithm>
#include <cstring>

namespace gnomon::render {
namespace {

/// MaterialBlock of Glsl.cpp, std140.
struct MaterialBlock {
    math::vec4 diffuse{0.8F, 0.8F, 0.8F, 1.0F};
    math::vec4 specular{0.04F, 0.04F, 0.04F, 32.0F};
    math::vec4 emissive{0.0F, 0.0F, 0.0F, -1.0F};
    math::vec4 texRowS{1.0F, 0.0F, 0.0F, 1.0F};
    math::vec4 texRowT{0.0F, 1.0F, 0.0F, 0.0F};
};

MaterialBlock blockFor(const scene::Material* material) {
    MaterialBlock block;
    const auto* phong = dynamic_cast<const scene::PhongMaterial*>(material);
    if (phong == nullptr) return block;
    block.diffuse = phong->diffuse;
    block.specular =
        math::vec4{phong->specular.get(), std::clamp(phong->shininess.get(), 1.0F, 8192.0F)};
    const bool masked = phong->alpha == scene::PhongMaterial::Alpha::mask;
    block.emissive = math::vec4{phong->emissive.get(), masked ? phong->alphaCutoff.get() : -1.0F};
    block.texRowS = math::vec4{phong->texRowS.get(), phong->normalScale};
    block.texRowT = math::vec4{phong->texRowT.get(), 0.0F};
    return block;
}

math::Box chunkBounds(const scene::Chunk& chunk, const math::dmat4& world) {
    const bool ordered =
        chunk.min.x <= chunk.max.x && chunk.min.y <= chunk.max.y && chunk.min.z <= chunk.max.z;
    if (!ordered) return {};
    return math::transformed({.min = math::dvec3{chunk.min}, .max = math::dvec3{chunk.max}}, world);
}

GLenum glPrimitive(scene::Primitive primitive) {
    switch (primitive) {
        case scene::Primitive::lines:
            return GL_LINES;
        case scene::Primitive::points:
            return GL_POINTS;
        default:
            return GL_TRIANGLES;
    }
}

}  // namespace

Batches::Batches(const gl::Api& gl, MeshStore& meshes, TextureStore& textures, Programs& programs)
    : gl_{gl}, meshes_{meshes}, textures_{textures}, programs_{programs} {}

std::uint32_t Batches::batchFor(const BatchState& state, bool depth) {
    auto& index = depth ? depthIndex_ : index_;
    auto& list = depth ? depthBatches_ : batches_;
    const auto [at, isNew] = index.try_emplace(state, static_cast<std::uint32_t>(list.size()));
    if (isNew) list.push_back(state);
    return at->second;
}

std::uint32_t Batches::materialSlot(const scene::Material* material) {
    const auto [at, isNew] =
        slots_.try_emplace(material, static_cast<std::uint32_t>(materials_.size()));
    if (isNew) materials_.push_back(material);
    return at->second;
}

BatchState Batches::describe(const scene::FlatScene::Instance& instance,
                             const field::Aspect& aspect, const MeshStore::Mesh& mesh,
                             const std::function<void(std::string)>& report) {
    BatchState state{.format = mesh.format,
                     .primitive = glPrimitive(instance.geometry->primitive),
                     .mirrored = instance.mirrored,
                     .material = materialSlot(instance.material)};
    if (const auto* own = dynamic_cast<const scene::ShaderMaterial*>(instance.material)) {
        const auto& program = programs_.foreign(*own);
        if (program.error.empty()) {
            state.foreign = own;
            state.textures[0] = textures_.get(aspect.get(own->texture.get()));
            state.cull = own->doubleSided ? Cull::none : Cull::back;
            hasForeign_ = true;
        } else {
            report(program.error);
        }
        return state;
    }
    const auto* phong = dynamic_cast<const scene::PhongMaterial*>(instance.material);
    if (phong == nullptr) return state;  // no material: both sides, plain grey
    const bool mapped = (mesh.format & hasTexCoords) != 0;
    if (mapped) {
        state.textures = {textures_.get(aspect.get(phong->diffuseMap.get())),
                          textures_.get(aspect.get(phong->normalMap.get())),
                          textures_.get(aspect.get(phong->emissiveMap.get()))};
    }
    if (state.textures[0] != 0) state.features |= Variant::diffuseMap;
    if (state.textures[1] != 0 && !phong->unlit) state.features |= Variant::normalMap;
    if (state.textures[2] != 0 && !phong->unlit) state.features |= Variant::emissiveMap;
    if (phong->unlit) state.features |= Variant::unlit;
    if (phong->alpha == scene::PhongMaterial::Alpha::mask) {
        state.features |= Variant::alphaMask;
        hasMasked_ = true;
    }
    state.blend = phong->alpha == scene::PhongMaterial::Alpha::blend;
    state.cull = phong->doubleSided ? Cull::none : Cull::back;
    return state;
}

void Batches::rebuild(const scene::FlatScene& flat, const field::Aspect& aspect,
                      const std::function<void(std::string)>& report) {
    batches_.clear();
    depthBatches_.clear();
    index_.clear();
    depthIndex_.clear();
    drawables_.clear();
    firstDrawable_.clear();
    materials_.clear();
    slots_.clear();
    hasForeign_ = hasMasked_ = false;

    const auto instances = flat.instances();
    for (std::uint32_t i = 0; i < instances.size(); ++i) {
        const auto& instance = instances[i];
        firstDrawable_.push_back(static_cast<std::uint32_t>(drawables_.size()));
        const MeshStore::Mesh& mesh = meshes_.get(*instance.geometry);
        if (!mesh.valid || instance.bounds.empty()) continue;
        const BatchState state = describe(instance, aspect, mesh, report);
        const std::uint32_t batch = batchFor(state, false);
        const bool casts = instance.castsShadow && !state.blend && state.primitive == GL_TRIANGLES;
        const bool masked = (state.features & Variant::alphaMask) != 0;
        const math::dmat4& world = flat.worldFromLocal(instance);
        const auto& chunks = instance.geometry->chunks;
        for (std::uint32_t c = 0; c < chunks.size(); ++c) {
            const scene::Chunk& chunk = chunks[c];
            if (chunk.indexCount == 0) continue;
            Drawable drawable{.bounds = chunkBounds(chunk, world),
                              .command = {.count = chunk.indexCount,
                                          .firstIndex = mesh.firstIndex + chunk.firstIndex,
                                          .baseVertex = static_cast<GLint>(mesh.baseVertex),
                                          .baseInstance = i},
                              .batch = batch,
                              .chunk = c};
            if (drawable.bounds.empty()) continue;
            if (casts) {
                BatchState depth{.format = mesh.format};
                if (masked) {
                    depth.features = state.features & (Variant::alphaMask | Variant::diffuseMap);
                    depth.material = state.material;
                    depth.textures[0] = state.textures[0];
                } else {
                    if (chunk.closed) {
                        // The far side casts the same shadow, and where it lies is dark anyway.
                        depth.cull = Cull::front;
                        depth.mirrored = state.mirrored;
                    }
                }
                drawable.depthBatch = batchFor(depth, true);
            }
            drawables_.push_back(drawable);
        }
    }
    firstDrawable_.push_back(static_cast<std::uint32_t>(drawables_.size()));
    uploadMaterials();
}

void Batches::move(const scene::FlatScene& flat) {
    for (const std::uint32_t i : flat.moved()) {
        const auto& instance = flat.instances()[i];
        const math::dmat4& world = flat.worldFromLocal(instance);
        for (std::uint32_t d = firstDrawable_[i]; d < firstDrawable_[i + 1]; ++d)
            drawables_[d].bounds =
                chunkBounds(instance.geometry->chunks[drawables_[d].chunk], world);
    }
}

void Batches::uploadMaterials() {
    if (materials_.empty()) return;
    std::vector<std::byte> bytes(materials_.size() * static_cast<std::size_t>(materialStride));
    for (std::size_t i = 0; i < materials_.size(); ++i) {
        const MaterialBlock block = blockFor(materials_[i]);
        std::memcpy(bytes.data() + i * static_cast<std::size_t>(materialStride), &block,
                    sizeof block);
    }
    materialBuffer_ = gl::Buffer{gl_};
    materialBuffer_.label("materials");
    gl_.NamedBufferStorage(materialBuffer_.id(), static_cast<GLsizeiptr>(bytes.size()),
                           bytes.data(), 0);
}

void Batches::bindMaterial(std::uint32_t slot) const {
    gl_.BindBufferRange(GL_UNIFORM_BUFFER, 3, materialBuffer_.id(), slot * materialStride,
                        static_cast<GLsizeiptr>(sizeof(MaterialBlock)));
}

}  // namespace gnomon::render

#include "Batches.h"

#include <algorithm>
#include <cstring>

namespace gnomon::render {
namespace {

/// Blinn-Phong's colour with what makes it conserve energy, and half its shininess.
math::vec4 normalized(const math::vec3& specular, float shininess) {
    return math::vec4{specular * ((shininess + 8.0F) / 8.0F), shininess * 0.5F};
}

/// MaterialBlock of Glsl.cpp, std140.
struct MaterialBlock {
    math::vec4 diffuse{0.8F, 0.8F, 0.8F, 1.0F};
    math::vec4 specular = normalized(math::vec3{0.04F}, 32.0F);
    math::vec4 emissive{0.0F, 0.0F, 0.0F, -1.0F};
    math::vec4 texRowS{1.0F, 0.0F, 0.0F, 1.0F};
    math::vec4 texRowT{0.0F, 1.0F, 0.0F, 0.0F};
};

MaterialBlock blockFor(const scene::Material* material) {
    MaterialBlock block;
    const auto* phong = dynamic_cast<const scene::PhongMaterial*>(material);
    if (phong == nullptr) return block;
    block.diffuse = phong->diffuse;
    block.specular = normalized(phong->specular, std::clamp(phong->shininess.get(), 1.0F, 8192.0F));
    const bool masked = phong->alpha == scene::PhongMaterial::Alpha::mask;
    block.emissive = math::vec4{phong->emissive.get(), masked ? phong->alphaCutoff.get() : -1.0F};
    block.texRowS = math::vec4{phong->texRowS.get(), phong->normalScale};
    block.texRowT = math::vec4{phong->texRowT.get(), 0.0F};
    return block;
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

void Batches::rebuild(const scene::FlatScene& flat, const scene::ChunkTree& chunks,
                      const field::Aspect& aspect, const std::function<void(std::string)>& report) {
    batches_.clear();
    depthBatches_.clear();
    index_.clear();
    depthIndex_.clear();
    drawables_.assign(chunks.uses().size(), {});
    materials_.clear();
    slots_.clear();
    hasForeign_ = hasMasked_ = false;

    const auto instances = flat.instances();
    const auto uses = chunks.uses();
    const MeshStore::Mesh* mesh = nullptr;
    BatchState state;
    for (std::uint32_t u = 0; u < uses.size(); ++u) {
        const std::uint32_t i = uses[u].instance;
        const auto& instance = instances[i];
        if (uses[u].chunk == 0) {  // the first of an instance
            mesh = &meshes_.get(*instance.geometry);
            if (mesh->valid) state = describe(instance, aspect, *mesh, report);
        }
        if (!mesh->valid || chunks.bounds(u).empty()) continue;
        const scene::Chunk& chunk = instance.geometry->chunks[uses[u].chunk];
        drawables_[u] = {.command = {.count = chunk.indexCount,
                                     .firstIndex = mesh->firstIndex + chunk.firstIndex,
                                     .baseVertex = static_cast<GLint>(mesh->baseVertex),
                                     .baseInstance = i},
                         .batch = batchFor(state, false)};
        if (!instance.castsShadow || state.blend || state.primitive != GL_TRIANGLES) continue;
        BatchState depth{.format = mesh->format};
        if ((state.features & Variant::alphaMask) != 0) {
            depth.features = state.features & (Variant::alphaMask | Variant::diffuseMap);
            depth.material = state.material;
            depth.textures[0] = state.textures[0];
        } else if (chunk.closed) {
            // The far side casts the same shadow, and where it lies is dark anyway.
            depth.cull = Cull::front;
            depth.mirrored = state.mirrored;
        }
        drawables_[u].depthBatch = batchFor(depth, true);
    }
    uploadMaterials();
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

#pragma once

#include <gnomon/scene/ChunkTree.h>

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "MeshStore.h"
#include "Programs.h"
#include "TextureStore.h"

namespace gnomon::render {

/// As glMultiDrawElementsIndirect wants it.
struct DrawCommand {
    GLuint count = 0;
    GLuint instanceCount = 1;
    GLuint firstIndex = 0;
    GLint baseVertex = 0;
    GLuint baseInstance = 0;
};

enum class Cull : std::uint8_t { none, back, front };

/// What a run of draws shares.
struct BatchState {
    std::uint32_t format = 0;
    std::uint32_t features = 0;  ///< Variant::Feature, without scopedLights and shadows
    GLenum primitive = GL_TRIANGLES;
    Cull cull = Cull::none;
    bool mirrored = false;
    bool blend = false;
    std::uint32_t material = 0;  ///< slot in the material buffer
    std::array<GLuint, 3> textures{};
    const scene::ShaderMaterial* foreign = nullptr;
    friend auto operator<=>(const BatchState&, const BatchState&) = default;
};

/// How a use of a chunk is drawn.
struct Drawable {
    static constexpr std::uint32_t none = 0xffffffffU;
    DrawCommand command = {};
    std::uint32_t batch = none;       ///< colour
    std::uint32_t depthBatch = none;  ///< shadow maps
};

/// A flat scene made ready to draw: what to draw in which order of states, grouped once and culled
/// every frame.
class Batches {
public:
    Batches(const gl::Api& gl, MeshStore& meshes, TextureStore& textures, Programs& programs);

    /// Groups anew. @param report  told of materials whose shaders do not compile.
    void rebuild(const scene::FlatScene& flat, const scene::ChunkTree& chunks,
                 const field::Aspect& aspect, const std::function<void(std::string)>& report);
    std::span<const BatchState> batches() const noexcept { return batches_; }
    std::span<const BatchState> depthBatches() const noexcept { return depthBatches_; }
    /// By use in the chunk tree.
    std::span<const Drawable> drawables() const noexcept { return drawables_; }
    bool hasForeign() const noexcept { return hasForeign_; }
    bool hasMasked() const noexcept { return hasMasked_; }
    void bindMaterial(std::uint32_t slot) const;

private:
    static constexpr GLsizeiptr materialStride = 256;  // the largest alignment GL allows to demand
    std::uint32_t batchFor(const BatchState& state, bool depth);
    std::uint32_t materialSlot(const scene::Material* material);
    BatchState describe(const scene::FlatScene::Instance& instance, const field::Aspect& aspect,
                        const MeshStore::Mesh& mesh,
                        const std::function<void(std::string)>& report);
    void uploadMaterials();

    const gl::Api& gl_;
    MeshStore& meshes_;
    TextureStore& textures_;
    Programs& programs_;
    std::vector<BatchState> batches_;
    std::vector<BatchState> depthBatches_;
    std::map<BatchState, std::uint32_t> index_;
    std::map<BatchState, std::uint32_t> depthIndex_;
    std::vector<Drawable> drawables_;
    std::vector<const scene::Material*> materials_;
    std::map<const scene::Material*, std::uint32_t> slots_;
    gl::Buffer materialBuffer_;
    bool hasForeign_ = false;
    bool hasMasked_ = false;
};

}  // namespace gnomon::render

#pragma once

#include <gnomon/shadow/ShadowMaps.h>
#include <gnomon/shadow_fit/Receivers.h>

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "Batches.h"

namespace gnomon::render {

/// What one pass over the scene draws.
struct PassStatistics {
    std::uint64_t triangles = 0;
    std::uint64_t chunks = 0;
    std::uint64_t chunksCulled = 0;
};

/// One root's scene on the GPU: instances, batches, and the passes over them.
class SceneDrawer final : public shadow::CasterSource {
public:
    SceneDrawer(const gl::Api& gl, const field::Aspect& aspect, MeshStore& meshes,
                TextureStore& textures, Programs& programs);

    /// Follows the containers. @param report  told of what cannot be drawn.
    void update(scene::Ref<scene::Node> root, std::span<const scene::Ref<scene::Node>> excluded,
                const field::Applied& applied, const std::function<void(std::string)>& report);
    const scene::FlatScene& flat() const noexcept { return flat_; }
    const Batches& batches() const noexcept { return batches_; }
    /// Corners of what a view sees: the boxes of chunks, cut to it. The same span as long as
    /// neither view nor scene changes; good until the next call.
    std::span<const math::dvec3> seenBy(const math::View& view);
    /// True when what may cast changed beyond moved instances since the last update.
    bool castersRebuilt() const noexcept { return rebuilt_; }

    /// Everything drawn from now on is relative to @p origin (world).
    void useOrigin(const math::dvec3& origin);

    struct ColorPass {
        math::mat4 clipFromOrigin{1.0F};
        math::dmat4 clipFromWorld{1.0};
        math::dmat4 eyeFromWorld{1.0};
        math::dvec3 eyeWorld{0.0};
        bool scopedLights = false;
        shadow::ShadowMaps::Arranged maps = {};
        shadow::ShadowMaps::Arranged blendedMaps = {};  ///< of what is not the surface behind
        int lights = 0;
        int directionalLights = 0;  ///< the first of them
        double time = 0.0;
    };
    /// Opaque and masked surfaces, nearest first. Foreign materials mark stencil 1.
    PassStatistics drawOpaque(const ColorPass& pass);
    /// Blended surfaces, furthest first.
    PassStatistics drawBlended(const ColorPass& pass);
    /// The first light's factor on everything opaque.
    void drawFactor(const ColorPass& pass);
    /// Surfaces of everything opaque, and of some lights factors and kernels, for ScreenBlur.
    PassStatistics drawUnblurred(const ColorPass& pass, int firstLight, int lightCount);
    /// Depth alone of everything opaque or masked.
    void drawDepth(const ColorPass& pass);
    /// Depths in eye space between which blended chunks may be seen, by their boxes; nothing
    /// where there are none.
    std::optional<shadow_fit::DepthSpan> blendedDepth(const ColorPass& pass);

    Drawn drawCasters(const Pass& pass) override;

private:
    struct Item {
        float distance = 0.0F;
        DrawCommand command = {};
    };
    void uploadInstances();
    void writeInstance(std::size_t index);
    PassStatistics gather(const ColorPass& pass, bool blended);
    PassStatistics gatherNearestFirst(const ColorPass& pass);
    /// What of a mesh a pass reads, and whose meshes it draws.
    struct Flush {
        bool positionsOnly = false;
        /// Materials with shaders of their own as their geometry stands; else they are left out.
        bool foreign = false;
    };
    void flush(std::span<const BatchState> states,
               const std::function<void(const BatchState&)>& use, const Flush& how);
    void setFaces(const BatchState& state);
    void useDepth(const BatchState& state, const math::mat4& clipFromOrigin);
    void useSurface(const BatchState& state, const ColorPass& pass);
    void drawForeign(const BatchState& state, const std::vector<Item>& items,
                     const ColorPass& pass);

    struct InstanceGpu {
        math::vec4 rows[3];
        glm::uvec4 info;
    };

    const gl::Api& gl_;
    const field::Aspect& aspect_;
    MeshStore& meshes_;
    Programs& programs_;
    scene::FlatScene flat_;
    scene::ChunkTree chunks_;
    Batches batches_;
    shadow_fit::Receivers seen_;
    std::optional<math::dmat4> seenFrom_ = {};  // clipFromWorld of the view
    math::dvec3 origin_{0.0};
    bool haveOrigin_ = false;
    bool rebuilt_ = true;
    std::vector<InstanceGpu> instances_;
    gl::Buffer instanceBuffer_;
    std::size_t instanceCapacity_ = 0;
    gl::Buffer commandBuffer_;
    std::vector<std::vector<Item>> items_;  // by batch; kept for their memory
    std::vector<DrawCommand> commands_;
};

}  // namespace gnomon::render

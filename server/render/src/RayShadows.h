#pragma once

#include <gnomon/gl/Handle.h>
#include <gnomon/scene/CameraView.h>

#include <cstdint>
#include <span>
#include <vector>

#include "ShadowTracer.h"

namespace gnomon::render {

/// Exact shadows, by rays from every visible pixel to the lights: what technique `ray` is. Surfaces
/// are found by a depth pass, with a margin as wide as ShadowTracer reaches around the view, so
/// that neighbouring tiles find the same; rays are traced on the processor, on as many threads as
/// software GL may use.
class RayShadows {
public:
    static constexpr int margin = ShadowTracer::reach;  ///< pixels

    explicit RayShadows(const gl::Api& gl);

    struct Light {
        int layer = 0;
        shadow_fit::LightShape shape = {};
    };
    struct Pass {
        math::dmat4 clipFromWorld{1.0};  ///< of the view with its margin
        scene::PixelRect pixels = {};    ///< of the target, without
        glm::ivec2 size{0, 0};           ///< of the target: factors lie as its pixels do
        std::uint64_t version = 0;       ///< of the scene; the same: nothing changed
        friend bool operator==(const Pass&, const Pass&) = default;
    };
    /// True where the factors of a pass are what begin() to end() would make again.
    bool has(const Pass& pass, std::span<const Light> lights) const;
    /// Binds a framebuffer for the depths of everything opaque, cleared, as large as the view with
    /// its margin.
    void begin(const Pass& pass, int layers);
    /// Traces from the depths that were drawn.
    void end(const Pass& pass, std::span<const Light> lights, const truth::RayScene& scene);
    /// For the lookup.
    void bind() const;
    void forget() noexcept { lights_.clear(); }

private:
    const gl::Api& gl_;
    gl::Texture factors_;
    gl::Texture depth_;
    gl::Framebuffer framebuffer_;
    glm::ivec2 size_{0, 0};
    glm::ivec2 drawn_{0, 0};  // with the margin
    int layers_ = 0;
    Pass last_ = {};
    std::vector<Light> lights_;
    std::vector<shadow_fit::LightShape> shapes_;
    std::vector<float> depths_;
    ShadowTracer tracer_;
};

}  // namespace gnomon::render

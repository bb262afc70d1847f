#pragma once

#include <gnomon/gl/Handle.h>
#include <gnomon/math/View.h>
#include <gnomon/scene/CameraView.h>
#include <gnomon/shadow_fit/Fit.h>
#include <gnomon/truth/RayScene.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace gnomon::render {

/// Exact shadows, by rays from every visible pixel to the lights: what technique `ray` is. Surfaces
/// are found by a depth pass; rays are traced on the processor, on as many threads as software GL
/// may use. Of a light with an extent 16 rays a pixel go to the same points of it everywhere.
class RayShadows {
public:
    explicit RayShadows(const gl::Api& gl);

    struct Light {
        int layer = 0;
        shadow_fit::LightShape shape = {};
    };
    struct Pass {
        math::dmat4 clipFromWorld{1.0};
        scene::PixelRect pixels = {};
        glm::ivec2 size{0, 0};      ///< of the target: factors lie as its pixels do
        std::uint64_t version = 0;  ///< of the scene; the same: nothing changed
        friend bool operator==(const Pass&, const Pass&) = default;
    };
    /// True where the factors of a pass are what begin() to end() would make again.
    bool has(const Pass& pass, std::span<const Light> lights) const;
    /// Binds a framebuffer for the depths of everything opaque, cleared.
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
    int layers_ = 0;
    Pass last_ = {};
    std::vector<Light> lights_;
    std::vector<float> depths_;
    std::vector<std::uint8_t> traced_;
    unsigned threads_;
};

}  // namespace gnomon::render

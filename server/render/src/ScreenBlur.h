#pragma once

#include <gnomon/gl/Handle.h>
#include <gnomon/math/View.h>
#include <gnomon/shadow/ShadowMaps.h>

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>

#include "Programs.h"

namespace gnomon::render {

/// Images of the shadow factors of all lights that a view sees, blurred on the screen on each
/// surface by itself: what filters with `onScreen` are. They are drawn with a margin as wide as the
/// widest kernel around the view, so that neighbouring tiles blur alike; kernels that would be
/// wider are cut off there. Only blocks of pixels within reach of an edge are blurred.
class ScreenBlur {
public:
    static constexpr int margin = 64;  ///< pixels
    static constexpr int reach = 60;   ///< of the widest kernel, pixels: as in BlurGlsl.cpp
    static constexpr int atOnce = 2;   ///< lights in one pass over the scene

    ScreenBlur(const gl::Api& gl, Programs& programs);

    struct Pass {
        math::dmat4 clipFromEye{1.0};  ///< widened
        math::dmat4 eyeFromWorld{1.0};
        glm::ivec2 pixels{0, 0};
        shadow::ShadowMaps::Arranged maps = {};
        std::uint64_t version = 0;  ///< of the scene; the same: nothing changed
        friend bool operator==(const Pass&, const Pass&) = default;
    };
    /// True where the images of a pass are what begin() and blur() would make again.
    bool has(const Pass& pass) const noexcept { return made_ && pass == pass_; }
    /// Makes room. Then, of every atOnce lights: begin(), SceneDrawer::drawUnblurred(), blur().
    void start(const Pass& pass);
    /// Binds a framebuffer for what drawUnblurred() draws, cleared.
    void begin(int firstLight, int lightCount);
    void blur(int firstLight, int lightCount);
    /// For the lookup.
    void bind() const;
    void forget() noexcept { made_ = false; }
    std::uint64_t bytes() const noexcept;
    /// Pixels of one image, with its margin.
    glm::ivec2 size() const noexcept { return pass_.pixels + 2 * margin; }

private:
    gl::Texture texture(GLenum target, GLenum format, const glm::ivec2& size, int layers,
                        const char* label) const;
    void findBlocks(int layer);
    void drawPass(GLuint program, int layer, const gl::Texture& from, const gl::Texture& to,
                  int toLayer, const math::vec3& pass);

    const gl::Api& gl_;
    Programs& programs_;
    std::array<gl::Texture, 2> surfaces_;  ///< the passes go to and fro
    gl::Texture kernels_;
    gl::Texture factors_;
    gl::Texture depth_;
    gl::Texture ranges_;  ///< of blocks
    gl::Texture blocks_;
    gl::Framebuffer scene_;
    gl::Framebuffer one_;
    gl::VertexArray empty_;
    glm::ivec2 blockCount_{0, 0};
    int layers_ = 0;
    Pass pass_ = {};
    bool made_ = false;
};

}  // namespace gnomon::render

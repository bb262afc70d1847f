#pragma once

#include <gnomon/gl/Handle.h>
#include <gnomon/shadow/Filter.h>

#include <cstdint>
#include <vector>

namespace gnomon::shadow {

/// A sampler of single texels, beyond whose texture there is nothing, as far away as can be.
gl::Sampler texelSampler(const gl::Api& gl);
/// One that compares four texels with a depth, interpolated: 1 where none is nearer to the light.
gl::Sampler comparingSampler(const gl::Api& gl);

/// Summaries of the pages of a pool, coarser from level to level: for filters that need more of a
/// map than its texels. Made once after a page was drawn.
class Pyramid {
public:
    Pyramid(const gl::Api& gl, const PyramidInfo& info, int pageSize);

    GLuint texture() const noexcept { return texture_.id(); }
    std::uint64_t bytes() const noexcept;
    /// Room for so many layers, more than there are.
    void reserve(std::uint64_t layers);
    /// Makes a layer from the same one of the pages. Leaves its own framebuffer, viewport, program
    /// and textures bound, and the depth test off.
    /// @param pages  depth texture, a texel of border around each page
    void make(GLuint pages, int layer);

private:
    GLenum format() const noexcept;
    gl::Program build(std::string_view label, std::string_view function) const;

    const gl::Api& gl_;
    const PyramidInfo& info_;
    int pageSize_;  ///< texels
    int side_;      ///< cells, of the first level: a power of two
    int levels_;
    std::uint64_t layers_ = 0;
    gl::Texture texture_;
    gl::Texture cells_;                  ///< all levels of the page that is made
    std::vector<gl::Framebuffer> cell_;  ///< by level
    gl::Sampler sampler_;
    gl::Framebuffer kept_;
    gl::Program firstLevel_;
    gl::Program nextLevel_;
    gl::Program keep_;
    gl::VertexArray empty_;
};

}  // namespace gnomon::shadow

#pragma once

#include <gnomon/shadow/ShadowMaps.h>

#include <optional>
#include <vector>

#include "Pyramid.h"

namespace gnomon::shadow {

/// Pages of one size: layers of one depth texture, which grows when it is full.
class ShadowMaps::Pool {
public:
    /// @param pyramid  nullptr: none
    Pool(const gl::Api& gl, int pageSize, const PyramidInfo* pyramid)
        : gl_{gl}, pageSize_{pageSize} {
        if (pyramid != nullptr) pyramid_.emplace(gl, *pyramid, pageSize);
    }

    int side() const noexcept { return pageSize_ + 2; }  ///< texels, with the border
    int pageSize() const noexcept { return pageSize_; }
    GLuint texture() const noexcept { return texture_.id(); }
    std::uint64_t bytes() const noexcept {
        return static_cast<std::uint64_t>(side()) * static_cast<std::uint64_t>(side()) * 4U *
                   layers_ +
               (pyramid_ ? pyramid_->bytes() : 0U);
    }
    bool hasPyramid() const noexcept { return pyramid_.has_value(); }
    GLuint pyramidTexture() const noexcept { return pyramid_ ? pyramid_->texture() : 0U; }
    /// Makes the pyramid's layer of a page that was drawn.
    void summarise(int layer) { pyramid_->make(texture_.id(), layer); }
    bool unused() const noexcept { return free_.size() == layers_; }
    int take();
    void give(int layer) { free_.push_back(layer); }

private:
    void grow();

    const gl::Api& gl_;
    int pageSize_;
    gl::Texture texture_;
    std::uint64_t layers_ = 0;
    std::vector<int> free_;
    std::optional<Pyramid> pyramid_;
};

}  // namespace gnomon::shadow

#pragma once

#include <gnomon/shadow/ShadowMaps.h>

#include <vector>

namespace gnomon::shadow {

/// Pages of one size: layers of one depth texture, which grows when it is full.
class ShadowMaps::Pool {
public:
    Pool(const gl::Api& gl, int pageSize) : gl_{gl}, pageSize_{pageSize} {}

    int side() const noexcept { return pageSize_ + 2; }  ///< texels, with the border
    int pageSize() const noexcept { return pageSize_; }
    GLuint texture() const noexcept { return texture_.id(); }
    std::uint64_t bytes() const noexcept {
        return static_cast<std::uint64_t>(side()) * static_cast<std::uint64_t>(side()) * 4U *
               layers_;
    }
    int take();
    void give(int layer) { free_.push_back(layer); }

private:
    void grow();

    const gl::Api& gl_;
    int pageSize_;
    gl::Texture texture_;
    std::uint64_t layers_ = 0;
    std::vector<int> free_;
};

}  // namespace gnomon::shadow

#include "Pool.h"

#include <algorithm>

namespace gnomon::shadow {

int ShadowMaps::Pool::take() {
    if (free_.empty()) grow();
    const int layer = free_.back();
    free_.pop_back();
    return layer;
}

void ShadowMaps::Pool::grow() {
    const std::uint64_t layers =
        std::max<std::uint64_t>(1, layers_ < 4 ? layers_ * 2 : layers_ + 4);
    gl::Texture larger{gl_, GLenum{GL_TEXTURE_2D_ARRAY}};
    larger.label("shadow pages");
    gl_.TextureStorage3D(larger.id(), 1, GL_DEPTH_COMPONENT32F, side(), side(),
                         static_cast<GLsizei>(layers));
    if (texture_)
        gl_.CopyImageSubData(texture_.id(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, larger.id(),
                             GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, side(), side(),
                             static_cast<GLsizei>(layers_));
    texture_ = std::move(larger);
    for (std::uint64_t i = layers; i-- > layers_;) free_.push_back(static_cast<int>(i));
    if (pyramid_) pyramid_->reserve(layers);
    layers_ = layers;
}

}  // namespace gnomon::shadow

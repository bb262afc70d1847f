#pragma once

#include <gnomon/gl/Handle.h>
#include <gnomon/scene/Material.h>

#include <unordered_map>

namespace gnomon::render {

/// Textures on the GPU, mipmapped and with anisotropic filtering.
class TextureStore {
public:
    explicit TextureStore(const gl::Api& gl);

    /// 0 where there is none or its size and pixels do not agree.
    GLuint get(const scene::Texture* texture);
    void forget(field::Id texture) { textures_.erase(texture); }

private:
    gl::Texture upload(const scene::Texture& texture) const;

    const gl::Api& gl_;
    float maxAnisotropy_ = 1.0F;
    GLint maxSize_ = 0;
    std::unordered_map<field::Id, gl::Texture> textures_;
};

}  // namespace gnomon::render

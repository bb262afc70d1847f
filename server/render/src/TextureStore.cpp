#include "TextureStore.h"

#include <algorithm>
#include <bit>
#include <string_view>

namespace gnomon::render {
namespace {

// EXT_texture_filter_anisotropic; in the core from 4.6 on with the same values.
constexpr GLenum textureMaxAnisotropy = 0x84FE;
constexpr GLenum maxTextureMaxAnisotropy = 0x84FF;

GLint glWrap(scene::Texture::Wrap wrap) {
    switch (wrap) {
        case scene::Texture::Wrap::mirror:
            return GL_MIRRORED_REPEAT;
        case scene::Texture::Wrap::clamp:
            return GL_CLAMP_TO_EDGE;
        default:
            return GL_REPEAT;
    }
}

}  // namespace

TextureStore::TextureStore(const gl::Api& gl) : gl_{gl} {
    if (gl::hasExtension(gl, "GL_EXT_texture_filter_anisotropic") ||
        gl::hasExtension(gl, "GL_ARB_texture_filter_anisotropic"))
        gl.GetFloatv(maxTextureMaxAnisotropy, &maxAnisotropy_);
    // A software rasterizer pays for each sample of the footprint: with
    // eight, or two, the demo scene's textured frames take three times as long (llvmpipe 22.3.6).
    const auto* renderer = reinterpret_cast<const char*>(gl.GetString(GL_RENDERER));
    const std::string_view name = renderer == nullptr ? "" : renderer;
    if (name.find("llvmpipe") != name.npos || name.find("softpipe") != name.npos)
        maxAnisotropy_ = 1.0F;
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &maxSize_);
}

GLuint TextureStore::get(const scene::Texture* texture) {
    if (texture == nullptr) return 0;
    const auto [at, isNew] = textures_.try_emplace(texture->id());
    if (isNew) at->second = upload(*texture);
    return at->second.id();
}

gl::Texture TextureStore::upload(const scene::Texture& texture) const {
    const glm::ivec2 size = texture.size;
    if (size.x <= 0 || size.y <= 0 || size.x > maxSize_ || size.y > maxSize_ ||
        texture.pixels->size() !=
            static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * 4U)
        return {};
    gl::Texture made{gl_, GLenum{GL_TEXTURE_2D}};
    made.label("texture");
    const GLsizei levels =
        texture.mipmaps
            ? static_cast<GLsizei>(std::bit_width(static_cast<unsigned>(std::max(size.x, size.y))))
            : 1;
    const GLuint id = made.id();
    gl_.TextureStorage2D(id, levels, texture.srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, size.x, size.y);
    gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl_.TextureSubImage2D(id, 0, 0, 0, size.x, size.y, GL_RGBA, GL_UNSIGNED_BYTE,
                          texture.pixels->bytes().data());
    const bool nearest = texture.nearest;
    gl_.TextureParameteri(id, GL_TEXTURE_WRAP_S, glWrap(texture.wrapS));
    gl_.TextureParameteri(id, GL_TEXTURE_WRAP_T, glWrap(texture.wrapT));
    gl_.TextureParameteri(id, GL_TEXTURE_MAG_FILTER, nearest ? GL_NEAREST : GL_LINEAR);
    GLint minFilter = nearest ? GL_NEAREST : GL_LINEAR;
    if (levels > 1) {
        gl_.GenerateTextureMipmap(id);
        minFilter = nearest ? GL_NEAREST_MIPMAP_LINEAR : GL_LINEAR_MIPMAP_LINEAR;
    }
    gl_.TextureParameteri(id, GL_TEXTURE_MIN_FILTER, minFilter);
    if (!nearest && maxAnisotropy_ > 1.0F)
        gl_.TextureParameterf(id, textureMaxAnisotropy,
                              std::clamp(texture.anisotropy.get(), 1.0F, maxAnisotropy_));
    return made;
}

}  // namespace gnomon::render

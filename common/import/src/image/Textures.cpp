#include "image/Textures.h"

#include <fmt/format.h>

namespace gnomon::importer {

std::optional<Image> Textures::image(const std::string& name, const ImageSource& source) {
    const auto untextured = [&](const Error& error) {
        report_.warn(fmt::format("{}: {}; left untextured", name, error.text()));
        return std::nullopt;
    };
    const auto file = source();
    if (!file) return untextured(file.error());
    const auto header = imageHeader(file->bytes);
    if (!header) return untextured(header.error());
    if (header->decodedBytes() > maxTotalBytes - total_)
        return untextured({.code = Errc::limit,
                           .what = fmt::format("the images before it take {} MiB, the limit is {}",
                                               total_ >> 20U, maxTotalBytes >> 20U)});
    auto image = decodedImage(file->bytes);
    if (!image) return untextured(image.error());
    return *std::move(image);
}

const Textures::Pixels& Textures::pixels(const std::string& name, const Maker& make) {
    const auto [at, added] = pixels_.try_emplace(name);
    if (!added) return at->second;
    if (auto decoded = make()) {
        total_ += decoded->pixels.size();
        at->second = {.payload = field::Payload{std::move(decoded->pixels)},
                      .width = decoded->width,
                      .height = decoded->height};
    }
    return at->second;
}

const scene::Texture* Textures::texture(const std::string& name, const ImageSource& source,
                                        const Sampler& sampler, bool srgb) {
    return madeTexture(
        name, [&] { return image(name, source); }, sampler, srgb);
}

const scene::Texture* Textures::madeTexture(const std::string& name, const Maker& make,
                                            const Sampler& sampler, bool srgb) {
    const auto [at, added] = textures_.try_emplace({name, sampler, srgb}, nullptr);
    if (!added) return at->second;
    const Pixels& found = pixels(name, make);
    if (!found.payload) return nullptr;
    const auto& texture = aspect_.create<scene::Texture>();
    auto e = scene::edit(texture);
    e->pixels = found.payload;
    e->size = glm::ivec2{found.width, found.height};
    e->srgb = srgb;
    e->wrapS = sampler.wrapS;
    e->wrapT = sampler.wrapT;
    e->mipmaps = sampler.mipmaps;
    e->nearest = sampler.nearest;
    at->second = &texture;
    return &texture;
}

}  // namespace gnomon::importer

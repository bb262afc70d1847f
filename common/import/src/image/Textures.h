#pragma once

#include <gnomon/scene/Material.h>

#include <compare>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <unordered_map>

#include "image/Image.h"
#include "input/Report.h"

namespace gnomon::importer {

/// How a texture is looked up.
struct Sampler {
    scene::Texture::Wrap wrapS = scene::Texture::Wrap::repeat;
    scene::Texture::Wrap wrapT = scene::Texture::Wrap::repeat;
    bool mipmaps = true;
    bool nearest = false;
    friend auto operator<=>(const Sampler&, const Sampler&) = default;
};

/// The bytes of an image file, and who keeps them alive (nobody, where they are part of the model).
struct ImageFile {
    std::span<const std::byte> bytes = {};
    std::shared_ptr<const Bytes> owner = {};
};
using ImageSource = std::function<Result<ImageFile>()>;

/// Decodes images and makes Texture containers: one per image, sampler and use. What cannot be
/// decoded is reported once and gives nothing: the surface stays untextured.
class Textures {
public:
    /// The most that all decoded images of a file may hold.
    static constexpr std::uint64_t maxTotalBytes = std::uint64_t{1} << 30U;

    Textures(field::Aspect& aspect, Report& report) : aspect_{aspect}, report_{report} {}

    /// @param name  names the image, uniquely within the model; also in warnings
    const scene::Texture* texture(const std::string& name, const ImageSource& source,
                                  const Sampler& sampler, bool srgb);
    /// The same from pixels that @p make puts together, called where they are not there yet.
    using Maker = std::function<std::optional<Image>()>;
    const scene::Texture* madeTexture(const std::string& name, const Maker& make,
                                      const Sampler& sampler, bool srgb);
    /// The decoded image; nothing as above. It is not kept.
    std::optional<Image> image(const std::string& name, const ImageSource& source);

private:
    struct Pixels {
        field::Payload payload = {};
        int width = 0;
        int height = 0;
    };
    const Pixels& pixels(const std::string& name, const Maker& make);

    field::Aspect& aspect_;
    Report& report_;
    std::map<std::tuple<std::string, Sampler, bool>, const scene::Texture*> textures_;
    std::unordered_map<std::string, Pixels> pixels_;  // without payload: failed
    std::uint64_t total_ = 0;
};

}  // namespace gnomon::importer

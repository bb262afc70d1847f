#include <gnomon/base/Error.h>
#include <gnomon/demo/Image.h>
#include <png.h>

namespace gnomon::demo {
namespace {

bool isOpaque(const Image& image) {
    for (std::size_t i = 3; i < image.pixels.size(); i += 4) {
        if (image.pixels[i] != 255) return false;
    }
    return true;
}

}  // namespace

std::vector<std::uint8_t> encodePng(const Image& image) {
    const bool opaque = isOpaque(image);
    const std::size_t channels = opaque ? 3 : 4;
    std::vector<std::uint8_t> pixels;
    pixels.reserve(image.pixels.size());
    for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
        const auto pixel = image.pixels.begin() + static_cast<std::ptrdiff_t>(i);
        pixels.insert(pixels.end(), pixel, pixel + static_cast<std::ptrdiff_t>(channels));
    }
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    header.width = image.width;
    header.height = image.height;
    header.format = opaque ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
    header.flags =
        PNG_IMAGE_FLAG_FAST;  // noise hardly compresses: half the time, a third more bytes
    png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(header);
    std::vector<std::uint8_t> out(bytes);
    if (png_image_write_to_memory(&header, out.data(), &bytes, 0, pixels.data(), 0, nullptr) == 0) {
        throw Failure{Errc::file, "encoding " + image.name + " as PNG: " + header.message};
    }
    out.resize(bytes);
    return out;
}

}  // namespace gnomon::demo

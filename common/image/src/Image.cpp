#include <gnomon/base/Error.h>
#include <gnomon/image/Image.h>

namespace gnomon::image {
namespace {

std::size_t bytesOf(int width, int height, int channels) noexcept {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
           static_cast<std::size_t>(channels);
}

}  // namespace

bool isSound(const Image& image) noexcept {
    if (image.width < 1 || image.height < 1 || image.width > maxSide || image.height > maxSide)
        return false;
    if (image.channels != 1 && image.channels != 3 && image.channels != 4) return false;
    const auto bytes = bytesOf(image.width, image.height, image.channels);
    return bytes <= maxBytes && image.pixels.size() == bytes;
}

Image blank(int width, int height, int channels) {
    GNOMON_EXPECTS(width >= 1 && height >= 1 && width <= maxSide && height <= maxSide,
                   "an image has sides of 1 to 65535 pixels");
    Image image{.width = width, .height = height, .channels = channels};
    image.pixels.resize(bytesOf(width, height, channels));
    GNOMON_EXPECTS(isSound(image), "an image has 1, 3 or 4 channels and a limited size");
    return image;
}

}  // namespace gnomon::image

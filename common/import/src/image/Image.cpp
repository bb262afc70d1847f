#include "image/Image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>

#include "image/Jpeg.h"
#include "image/Png.h"
#include "image/Stb.h"

namespace gnomon::importer {
namespace {

/// Twice the largest image (stb keeps a 16-bit copy of some), and room for filter bytes.
constexpr std::size_t maxAllocation = (std::size_t{2} * maxImageBytes) + (std::size_t{1} << 20U);

struct StbPixels {
    void operator()(stbi_uc* pixels) const noexcept { stbi_image_free(pixels); }
};

const stbi_uc* data(std::span<const std::byte> file) noexcept {
    return reinterpret_cast<const stbi_uc*>(file.data());
}

std::uint8_t at(const Image& image, int x, int y, int channel) noexcept {
    const auto offset = (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                         static_cast<std::size_t>(x)) *
                            4 +
                        static_cast<std::size_t>(channel);
    return std::to_integer<std::uint8_t>(image.pixels[offset]);
}

}  // namespace

void* stbAllocate(std::size_t bytes) noexcept {
    return bytes > maxAllocation ? nullptr : std::malloc(bytes);
}
void* stbResize(void* old, std::size_t bytes) noexcept {
    return bytes > maxAllocation ? nullptr : std::realloc(old, bytes);
}
void stbFree(void* memory) noexcept { std::free(memory); }

namespace {

/// BMP and TGA.
Result<ImageHeader> otherHeader(std::span<const std::byte> file) {
    ImageHeader header;
    int channels = 0;
    if (stbi_info_from_memory(data(file), static_cast<int>(file.size()), &header.width,
                              &header.height, &channels) == 0)
        return fail(Errc::file, fmt::format("no PNG, JPEG, BMP or TGA image that can be read ({})",
                                            stbi_failure_reason()));
    return header;
}

Result<Image> decodedOther(std::span<const std::byte> file) {
    Image image;
    int channels = 0;
    const std::unique_ptr<stbi_uc, StbPixels> pixels{
        stbi_load_from_memory(data(file), static_cast<int>(file.size()), &image.width,
                              &image.height, &channels, STBI_rgb_alpha)};
    if (!pixels)
        return fail(Errc::file, fmt::format("the image is broken ({})", stbi_failure_reason()));
    image.hasAlpha = channels == 2 || channels == 4;
    const auto bytes =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 4;
    image.pixels.resize(bytes);
    std::memcpy(image.pixels.data(), pixels.get(), bytes);
    return image;
}

}  // namespace

Result<ImageHeader> imageHeader(std::span<const std::byte> file) {
    if (file.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        return fail(Errc::limit, "the image file has more than 2 GiB");
    auto header = isPng(file)    ? pngHeader(file)
                  : isJpeg(file) ? jpegHeader(file)
                                 : otherHeader(file);
    if (!header) return header;
    if (header->width <= 0 || header->height <= 0)
        return fail(Errc::file,
                    fmt::format("the image is {} x {} pixels", header->width, header->height));
    if (header->width > maxImageSide || header->height > maxImageSide ||
        header->decodedBytes() > maxImageBytes)
        return fail(Errc::limit,
                    fmt::format("the image is {} x {} pixels; the limits are {} a side and {} MiB",
                                header->width, header->height, maxImageSide, maxImageBytes >> 20U));
    return header;
}

Result<Image> decodedImage(std::span<const std::byte> file) {
    const auto header = imageHeader(file);
    if (!header) return tl::unexpected{header.error()};
    if (isPng(file)) return decodedPng(file);
    return isJpeg(file) ? decodedJpeg(file) : decodedOther(file);
}

ImageMean meanOf(const Image& image) {
    std::uint64_t sums[3] = {};
    for (std::size_t i = 0; i + 3 < image.pixels.size(); i += 4)
        for (std::size_t c = 0; c < 3; ++c)
            sums[c] += std::to_integer<std::uint64_t>(image.pixels[i + c]);
    const double scale =
        255.0 * static_cast<double>(std::max<std::size_t>(image.pixels.size(), 4)) / 4.0;
    return {.red = static_cast<double>(sums[0]) / scale,
            .green = static_cast<double>(sums[1]) / scale,
            .blue = static_cast<double>(sums[2]) / scale};
}

bool isGrey(const Image& image) {
    for (std::size_t i = 0; i + 3 < image.pixels.size(); i += 4)
        if (image.pixels[i] != image.pixels[i + 1] || image.pixels[i] != image.pixels[i + 2])
            return false;
    return true;
}

Image normalsFromHeights(const Image& heights, float scale) {
    Image normals{.width = heights.width, .height = heights.height};
    normals.pixels.reserve(heights.pixels.size());
    const int w = heights.width;
    const int h = heights.height;
    const auto height = [&](int x, int y) {
        return static_cast<float>(at(heights, (x + w) % w, (y + h) % h, 0)) / 255.0F;
    };
    const auto packed = [](float v) {
        return static_cast<std::byte>(std::lround((v * 0.5F + 0.5F) * 255.0F));
    };
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            // Central differences; rows go down, the map's y goes up.
            const float dx = (height(x + 1, y) - height(x - 1, y)) * 0.5F * scale;
            const float dy = (height(x, y - 1) - height(x, y + 1)) * 0.5F * scale;
            const float length = std::sqrt(dx * dx + dy * dy + 1.0F);
            normals.pixels.insert(normals.pixels.end(), {packed(-dx / length), packed(-dy / length),
                                                         packed(1.0F / length), std::byte{255}});
        }
    }
    return normals;
}

void putAlpha(Image& image, const Image& mask) {
    const int channel = mask.hasAlpha ? 3 : 0;
    for (int y = 0; y < image.height; ++y) {
        const int maskY = static_cast<int>(std::int64_t{y} * mask.height / image.height);
        for (int x = 0; x < image.width; ++x) {
            const int maskX = static_cast<int>(std::int64_t{x} * mask.width / image.width);
            const auto offset =
                (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                 static_cast<std::size_t>(x)) *
                    4 +
                3;
            image.pixels[offset] = std::byte{at(mask, maskX, maskY, channel)};
        }
    }
    image.hasAlpha = true;
}

}  // namespace gnomon::importer

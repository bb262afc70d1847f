#include "image/Jpeg.h"

#include <fmt/format.h>
#include <turbojpeg.h>

#include <algorithm>
#include <memory>

namespace gnomon::importer {
namespace {

struct Destroy {
    void operator()(void* decoder) const noexcept { tjDestroy(decoder); }
};
using Decoder = std::unique_ptr<void, Destroy>;

const unsigned char* jpegBytes(std::span<const std::byte> file) noexcept {
    return reinterpret_cast<const unsigned char*>(file.data());
}

struct Opened {
    Decoder decoder = {};
    ImageHeader header = {};
    int space = 0;
};

Result<Opened> opened(std::span<const std::byte> file) {
    Opened made{.decoder = Decoder{tjInitDecompress()}};
    if (!made.decoder) return fail(Errc::limit, "there is no memory for a JPEG decoder");
    int subsampling = 0;
    if (tjDecompressHeader3(made.decoder.get(), jpegBytes(file), file.size(), &made.header.width,
                            &made.header.height, &subsampling, &made.space) != 0)
        return fail(Errc::file, fmt::format("no JPEG image that can be read ({})",
                                            tjGetErrorStr2(made.decoder.get())));
    return made;
}

/// From inks as Adobe writes them, 255 for none.
void fromInks(Bytes& pixels) {
    for (std::size_t i = 0; i + 3 < pixels.size(); i += 4) {
        const auto black = std::to_integer<unsigned>(pixels[i + 3]);
        for (std::size_t c = 0; c < 3; ++c)
            pixels[i + c] =
                static_cast<std::byte>(std::to_integer<unsigned>(pixels[i + c]) * black / 255U);
        pixels[i + 3] = std::byte{255};
    }
}

}  // namespace

bool isJpeg(std::span<const std::byte> file) noexcept {
    return file.size() >= 3 && file[0] == std::byte{0xff} && file[1] == std::byte{0xd8} &&
           file[2] == std::byte{0xff};
}

Result<ImageHeader> jpegHeader(std::span<const std::byte> file) {
    const auto found = opened(file);
    if (!found) return tl::unexpected{found.error()};
    return found->header;
}

Result<Image> decodedJpeg(std::span<const std::byte> file) {
    const auto found = opened(file);
    if (!found) return tl::unexpected{found.error()};
    const ImageHeader& header = found->header;
    Image image{.width = header.width, .height = header.height};
    image.pixels.resize(static_cast<std::size_t>(header.decodedBytes()));
    const bool inks = found->space == TJCS_CMYK || found->space == TJCS_YCCK;
    // A small file of thousands of passes would take minutes.
    const int outcome =
        tjDecompress2(found->decoder.get(), jpegBytes(file), file.size(),
                      reinterpret_cast<unsigned char*>(image.pixels.data()), header.width, 0,
                      header.height, inks ? TJPF_CMYK : TJPF_RGBA, TJFLAG_LIMITSCANS);
    // Damage that leaves a picture is a warning, as it is to everybody who shows pictures.
    if (outcome != 0 && tjGetErrorCode(found->decoder.get()) != TJERR_WARNING)
        return fail(Errc::file, fmt::format("the JPEG image is broken ({})",
                                            tjGetErrorStr2(found->decoder.get())));
    if (inks) fromInks(image.pixels);
    return image;
}

}  // namespace gnomon::importer

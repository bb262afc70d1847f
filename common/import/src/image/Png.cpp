#include "image/Png.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <limits>

namespace gnomon::importer {
namespace {

constexpr std::array<unsigned char, 16> signature{0x89, 'P', 'N', 'G',  '\r', '\n', 0x1a, '\n',
                                                  0,    0,   0,   0x0d, 'I',  'H',  'D',  'R'};
/// Most that a text or a profile may take.
constexpr png_alloc_size_t maxChunk = png_alloc_size_t{1} << 20U;

/// libpng's full interface: the simplified one applies gamma, which would bend normal maps.
class PngReader {
public:
    explicit PngReader(std::span<const std::byte> file)
        : rest_{file},
          png_{png_create_read_struct(PNG_LIBPNG_VER_STRING, this, &onError, &onWarning)},
          info_{png_ != nullptr ? png_create_info_struct(png_) : nullptr} {}
    ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;

    /// @p to has room for what pngHeader() announces.
    bool read(Image& to) {
        if (png_ == nullptr || info_ == nullptr) return false;
        // Nothing with a destructor may live between here and the end: errors jump back here.
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        png_set_read_fn(png_, this, &onRead);
        png_set_crc_action(png_, PNG_CRC_QUIET_USE, PNG_CRC_QUIET_USE);
        png_set_option(png_, PNG_IGNORE_ADLER32, PNG_OPTION_ON);
        png_set_user_limits(png_, maxImageSide, maxImageSide);
        png_set_chunk_malloc_max(png_, maxChunk);
        png_read_info(png_, info_);
        to.hasAlpha = (png_get_color_type(png_, info_) & PNG_COLOR_MASK_ALPHA) != 0 ||
                      png_get_valid(png_, info_, PNG_INFO_tRNS) != 0;
        png_set_expand(png_);
        png_set_strip_16(png_);
        png_set_gray_to_rgb(png_);
        png_set_add_alpha(png_, 255, PNG_FILLER_AFTER);
        const int passes = png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        const std::size_t rowBytes = png_get_rowbytes(png_, info_);
        if (rowBytes * png_get_image_height(png_, info_) != to.pixels.size())
            png_error(png_, "another size than at its beginning");
        for (int pass = 0; pass < passes; ++pass)
            for (std::size_t at = 0; at < to.pixels.size(); at += rowBytes)
                png_read_row(png_, reinterpret_cast<png_bytep>(to.pixels.data() + at), nullptr);
        png_read_end(png_, nullptr);
        return true;
    }
    const char* problem() const noexcept { return problem_.data(); }

private:
    static void onRead(png_structp png, png_bytep to, std::size_t size) {
        auto& self = *static_cast<PngReader*>(png_get_io_ptr(png));
        if (self.rest_.size() < size) png_error(png, "cut short");
        std::memcpy(to, self.rest_.data(), size);
        self.rest_ = self.rest_.subspan(size);
    }
    [[noreturn]] static void onError(png_structp png, png_const_charp message) {
        auto& self = *static_cast<PngReader*>(png_get_error_ptr(png));
        std::snprintf(self.problem_.data(), self.problem_.size(), "%s", message);
        png_longjmp(png, 1);
    }
    static void onWarning(png_structp, png_const_charp) {}

    std::span<const std::byte> rest_;
    std::array<char, 128> problem_{"out of memory"};  // before the rest: creating may complain
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

}  // namespace

bool isPng(std::span<const std::byte> file) noexcept {
    return file.size() >= signature.size() &&
           std::memcmp(file.data(), signature.data(), signature.size()) == 0;
}

Result<ImageHeader> pngHeader(std::span<const std::byte> file) {
    if (file.size() < signature.size() + 8) return fail(Errc::file, "the PNG image is cut short");
    const auto number = [&](std::size_t at) {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < 4; ++i)
            value = value << 8U | std::to_integer<std::uint32_t>(file[at + i]);
        // What is beyond an int is beyond every limit.
        return static_cast<int>(std::min<std::uint32_t>(value, std::numeric_limits<int>::max()));
    };
    return ImageHeader{.width = number(signature.size()), .height = number(signature.size() + 4)};
}

Result<Image> decodedPng(std::span<const std::byte> file) {
    const auto header = pngHeader(file);
    if (!header) return tl::unexpected{header.error()};
    Image image{.width = header->width, .height = header->height};
    image.pixels.resize(static_cast<std::size_t>(header->decodedBytes()));
    PngReader reader{file};
    if (!reader.read(image))
        return fail(Errc::file, fmt::format("the PNG image is broken ({})", reader.problem()));
    return image;
}

}  // namespace gnomon::importer

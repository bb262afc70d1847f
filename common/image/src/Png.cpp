#include <fmt/core.h>
#include <gnomon/image/Png.h>
#include <png.h>

#include <array>
#include <cerrno>
#include <csetjmp>
#include <cstdio>

#include "AtomicFile.h"
#include "ReadFile.h"

namespace gnomon::image {
namespace {

/// For reading, libpng's simplified interface: it keeps its longjmp inside. Frees what libpng holds
/// when a function is left early.
struct PngImage {
    png_image value = {};
    PngImage() { value.version = PNG_IMAGE_VERSION; }
    ~PngImage() { png_image_free(&value); }
    PngImage(const PngImage&) = delete;
    PngImage& operator=(const PngImage&) = delete;
};

/// The layouts an Image has. Grey with alpha becomes RGBA.
png_uint_32 formatFor(png_uint_32 fileFormat) {
    if ((fileFormat & PNG_FORMAT_FLAG_ALPHA) != 0) return PNG_FORMAT_RGBA;
    return (fileFormat & PNG_FORMAT_FLAG_COLOR) != 0 ? PNG_FORMAT_RGB : PNG_FORMAT_GRAY;
}

/// For writing, the full interface: the simplified one's fastest setting takes three times as long.
class PngWriter {
public:
    PngWriter()
        : png_{png_create_write_struct(PNG_LIBPNG_VER_STRING, this, &onError, &onWarning)},
          info_{png_ != nullptr ? png_create_info_struct(png_) : nullptr} {}
    ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;

    bool write(std::FILE* file, const Image& image) {
        if (png_ == nullptr || info_ == nullptr) return false;
        // Nothing with a destructor may live between here and the end: errors jump back here.
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        const int colour = image.channels == 4   ? PNG_COLOR_TYPE_RGB_ALPHA
                           : image.channels == 3 ? PNG_COLOR_TYPE_RGB
                                                 : PNG_COLOR_TYPE_GRAY;
        png_init_io(png_, file);
        png_set_IHDR(png_, info_, static_cast<png_uint_32>(image.width),
                     static_cast<png_uint_32>(image.height), 8, colour, PNG_INTERLACE_NONE,
                     PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        png_set_sRGB(png_, info_, PNG_sRGB_INTENT_PERCEPTUAL);
        // The quickest pair on rendered pictures, and within a fifth of the size of level 3.
        png_set_compression_level(png_, 1);
        png_set_filter(png_, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
        png_write_info(png_, info_);
        const auto rowBytes = image.pixels.size() / static_cast<std::size_t>(image.height);
        for (std::size_t at = 0; at < image.pixels.size(); at += rowBytes)
            png_write_row(png_, image.pixels.data() + at);
        png_write_end(png_, info_);
        return true;
    }
    const char* problem() const noexcept { return problem_.data(); }

private:
    [[noreturn]] static void onError(png_structp png, png_const_charp message) {
        auto& self = *static_cast<PngWriter*>(png_get_error_ptr(png));
        std::snprintf(self.problem_.data(), self.problem_.size(), "%s", message);
        png_longjmp(png, 1);
    }
    static void onWarning(png_structp, png_const_charp) {}

    std::array<char, 128> problem_{"out of memory"};  // before the rest: creating may complain
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

}  // namespace

Result<void> writePng(const std::filesystem::path& path, const Image& image) {
    GNOMON_EXPECTS(isSound(image), "writePng needs an image whose size and pixels agree");
    auto file = AtomicFile::create(path);
    if (!file) return tl::unexpected{std::move(file).error()};
    errno = 0;
    PngWriter writer;
    if (!writer.write(file->stream(), image)) {
        const std::error_code cause{errno, std::generic_category()};
        return fail(Errc::file,
                    cause ? "cannot write " + path.string()
                          : fmt::format("cannot write {}: {}", path.string(), writer.problem()),
                    cause);
    }
    return file->commit();
}

Result<Image> readPng(const std::filesystem::path& path) {
    auto bytes = readFile(path, maxBytes);
    if (!bytes) return tl::unexpected{std::move(bytes).error()};
    const auto failed = [&](std::string_view why) {
        return fail(Errc::file, fmt::format("cannot read {} as PNG: {}", path.string(), why));
    };
    PngImage png;
    if (png_image_begin_read_from_memory(&png.value, bytes->data(), bytes->size()) == 0)
        return failed(png.value.message);
    png.value.format = formatFor(png.value.format);
    const std::size_t channels = PNG_IMAGE_SAMPLE_CHANNELS(png.value.format);
    constexpr auto side = static_cast<png_uint_32>(maxSide);
    if (png.value.width > side || png.value.height > side ||
        std::size_t{png.value.width} * png.value.height * channels > maxBytes)
        return failed(
            fmt::format("it is {}x{} pixels of {} bytes, at most {} a side and {} bytes "
                        "in all are read",
                        png.value.width, png.value.height, channels, maxSide, maxBytes));
    Image image = blank(static_cast<int>(png.value.width), static_cast<int>(png.value.height),
                        static_cast<int>(channels));
    if (png_image_finish_read(&png.value, nullptr, image.pixels.data(), 0, nullptr) == 0)
        return failed(png.value.message);
    return image;
}

}  // namespace gnomon::image

#include <fmt/core.h>
#include <gnomon/image/Pgm.h>

#include <optional>
#include <span>
#include <string_view>

#include "AtomicFile.h"
#include "ReadFile.h"

namespace gnomon::image {
namespace {

constexpr bool isSpace(std::uint8_t c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Reads the header's numbers one after the other; each must fit and be followed by white space.
class Header {
public:
    explicit Header(std::span<const std::uint8_t> bytes) : bytes_{bytes} {}

    bool magic() {
        if (bytes_.size() < 3 || bytes_[0] != 'P' || bytes_[1] != '5') return false;
        at_ = 2;
        return isSpace(bytes_[at_]) || bytes_[at_] == '#';
    }

    /// The next number; nothing if there is none or it has more than six digits.
    std::optional<int> number() {
        skip();
        int value = 0;
        int digits = 0;
        for (; at_ < bytes_.size() && bytes_[at_] >= '0' && bytes_[at_] <= '9'; ++at_) {
            if (++digits > 6) return {};
            value = value * 10 + (bytes_[at_] - '0');
        }
        const bool ended = at_ < bytes_.size() && (isSpace(bytes_[at_]) || bytes_[at_] == '#');
        return digits > 0 && ended ? std::optional{value} : std::nullopt;
    }

    /// What follows the single white space after the last number.
    std::span<const std::uint8_t> rest() const { return bytes_.subspan(at_ + 1); }

private:
    void skip() {
        while (at_ < bytes_.size() && (isSpace(bytes_[at_]) || bytes_[at_] == '#')) {
            if (bytes_[at_] == '#')
                while (at_ < bytes_.size() && bytes_[at_] != '\n' && bytes_[at_] != '\r') ++at_;
            else
                ++at_;
        }
    }

    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
};

}  // namespace

Result<void> writePgm(const std::filesystem::path& path, const Image& image) {
    GNOMON_EXPECTS(isSound(image) && image.channels == 1, "a PGM holds one channel");
    auto file = AtomicFile::create(path);
    if (!file) return tl::unexpected{std::move(file).error()};
    const auto header = fmt::format("P5\n{} {}\n255\n", image.width, image.height);
    // commit() reports what either of these could not write.
    std::fwrite(header.data(), 1, header.size(), file->stream());
    std::fwrite(image.pixels.data(), 1, image.pixels.size(), file->stream());
    return file->commit();
}

Result<Image> readPgm(const std::filesystem::path& path) {
    const auto bytes = readFile(path, maxBytes);
    if (!bytes) return tl::unexpected{bytes.error()};
    const auto failed = [&](std::string_view why) {
        return fail(Errc::file, fmt::format("cannot read {} as PGM: {}", path.string(), why));
    };
    Header header{*bytes};
    if (!header.magic()) return failed("it does not begin with P5 (a binary PGM)");
    const auto width = header.number();
    const auto height = header.number();
    const auto depth = header.number();
    if (!width || !height || !depth)
        return failed("the header must hold width, height and 255, each at most six digits");
    if (*width < 1 || *height < 1 || *width > maxSide || *height > maxSide)
        return failed(
            fmt::format("it is {}x{} pixels, each must be 1 to {}", *width, *height, maxSide));
    if (*depth != 255) return failed(fmt::format("its largest value is {}, must be 255", *depth));
    const auto pixels = header.rest();
    const auto expected = static_cast<std::size_t>(*width) * static_cast<std::size_t>(*height);
    if (pixels.size() != expected)
        return failed(fmt::format("{}x{} pixels need {} bytes, {} follow the header", *width,
                                  *height, expected, pixels.size()));
    return Image{.width = *width,
                 .height = *height,
                 .channels = 1,
                 .pixels = {pixels.begin(), pixels.end()}};
}

}  // namespace gnomon::image

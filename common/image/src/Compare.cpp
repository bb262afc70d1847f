#include <fmt/core.h>
#include <gnomon/image/Compare.h>

#include <algorithm>
#include <cstdlib>

namespace gnomon::image {
namespace {

bool sameShape(const Image& a, const Image& b) {
    return a.width == b.width && a.height == b.height && a.channels == b.channels;
}

}  // namespace

Result<Difference> compare(const Image& a, const Image& b, int threshold) {
    GNOMON_EXPECTS(isSound(a) && isSound(b), "compare needs images whose size and pixels agree");
    if (!sameShape(a, b))
        return fail(Errc::limit,
                    fmt::format("images to compare must be alike: one is {}x{} with {} channels, "
                                "the other {}x{} with {}",
                                a.width, a.height, a.channels, b.width, b.height, b.channels));
    const auto channels = static_cast<std::size_t>(a.channels);
    Difference difference;
    std::uint64_t sum = 0;
    std::uint64_t over = 0;
    for (std::size_t pixel = 0; pixel < a.pixels.size(); pixel += channels) {
        int largest = 0;
        for (std::size_t i = pixel; i < pixel + channels; ++i) {
            const int apart = std::abs(int{a.pixels[i]} - int{b.pixels[i]});
            largest = std::max(largest, apart);
            sum += static_cast<std::uint64_t>(apart);
        }
        difference.largest = std::max(difference.largest, largest);
        if (largest > threshold) ++over;
    }
    // A sound image has at least one pixel, so neither divisor is zero.
    const auto values = static_cast<double>(a.pixels.size());
    difference.mean = static_cast<double>(sum) / values;
    difference.share = static_cast<double>(over) * static_cast<double>(channels) / values;
    return difference;
}

Image differenceImage(const Image& a, const Image& b, int gain) {
    GNOMON_EXPECTS(isSound(a) && isSound(b) && sameShape(a, b) && gain >= 1,
                   "differenceImage needs two sound images of one shape");
    const auto from = static_cast<std::size_t>(a.channels);
    const auto to = std::min(from, std::size_t{3});
    Image result = blank(a.width, a.height, static_cast<int>(to));
    const auto apart = [&](std::size_t i) { return std::abs(int{a.pixels[i]} - int{b.pixels[i]}); };
    const std::size_t count = a.pixels.size() / from;
    for (std::size_t pixel = 0; pixel < count; ++pixel) {
        const int alpha = from == 4 ? apart(pixel * from + 3) : 0;
        for (std::size_t channel = 0; channel < to; ++channel) {
            const int value = std::min((apart(pixel * from + channel) + alpha), 255);
            result.pixels[pixel * to + channel] =
                static_cast<std::uint8_t>(std::min(std::int64_t{value} * gain, std::int64_t{255}));
        }
    }
    return result;
}

}  // namespace gnomon::image

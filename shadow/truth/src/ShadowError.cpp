#include <fmt/core.h>
#include <gnomon/truth/ShadowError.h>
#include <gnomon/truth/Truth.h>

#include <algorithm>
#include <cmath>

#include "Distance.h"
#include "Flip.h"
#include "Ssim.h"

namespace gnomon::truth {
namespace {

constexpr float farthest = 16.0F;  // pixels: an edge further off is another edge

bool lit(std::uint8_t value) { return value > 127; }

/// Pixels that have a neighbour on the other side, both counted by the truth.
std::vector<bool> edges(const image::Image& factor, const image::Image& truth) {
    std::vector<bool> marked(factor.pixels.size(), false);
    const auto w = static_cast<std::size_t>(factor.width);
    const auto mark = [&](std::size_t a, std::size_t b) {
        if (truth.pixels[a] == noSurface || truth.pixels[b] == noSurface) return;
        if (lit(factor.pixels[a]) == lit(factor.pixels[b])) return;
        marked[a] = marked[b] = true;
    };
    for (std::size_t y = 0; y < static_cast<std::size_t>(factor.height); ++y) {
        for (std::size_t x = 0; x < w; ++x) {
            const std::size_t i = y * w + x;
            if (x + 1 < w) mark(i, i + 1);
            if (i + w < factor.pixels.size()) mark(i, i + w);
        }
    }
    return marked;
}

}  // namespace

Result<ShadowError> compareFactors(const image::Image& truth, const image::Image& factor) {
    if (truth.width != factor.width || truth.height != factor.height || truth.channels != 1 ||
        factor.channels != 1)
        return fail(Errc::limit,
                    fmt::format("the truth is {}x{} with {} channel(s), the image {}x{} with {}: "
                                "both must have one channel and the same size",
                                truth.width, truth.height, truth.channels, factor.width,
                                factor.height, factor.channels));
    ShadowError error;
    const auto trueEdges = edges(truth, truth);
    const auto toTrueEdge = distanceTo(trueEdges, truth.width, truth.height);
    double squares = 0.0;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
        const std::uint8_t t = truth.pixels[i];
        const std::uint8_t f = factor.pixels[i];
        if (t == noSurface) continue;
        ++error.counted;
        error.holes += f == noSurface ? 1U : 0U;
        const double apart = (static_cast<double>(t) - static_cast<double>(f)) / 255.0;
        squares += apart * apart;
        if (lit(t) == lit(f)) continue;
        ++error.wrong;
        ++(lit(t) ? error.falseShadow : error.falseLight);
        ++(toTrueEdge[i] <= 2.0F ? error.nearEdge : error.interior);
    }
    if (error.counted == 0) return error;
    error.rmse = std::sqrt(squares / static_cast<double>(error.counted));

    const auto toEdge = distanceTo(edges(factor, truth), truth.width, truth.height);
    std::vector<float> displaced;
    for (std::size_t i = 0; i < trueEdges.size(); ++i)
        if (trueEdges[i]) displaced.push_back(std::min(toEdge[i], farthest));
    if (!displaced.empty()) {
        double sum = 0.0;
        for (const float d : displaced) sum += d;
        error.edgeMean = sum / static_cast<double>(displaced.size());
        const auto at =
            displaced.begin() + static_cast<std::ptrdiff_t>(displaced.size() * 95 / 100);
        std::nth_element(displaced.begin(), at, displaced.end());
        error.edge95 = *at;
    }

    // What the truth does not count is the same in both.
    Plane a{.width = truth.width, .height = truth.height, .values = {}};
    Plane b = a;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
        const bool counted = truth.pixels[i] != noSurface;
        a.values.push_back(static_cast<float>(truth.pixels[i]) / 255.0F);
        b.values.push_back(counted ? static_cast<float>(factor.pixels[i]) / 255.0F
                                   : a.values.back());
    }
    const Plane similar = ssim(a, b);
    const Plane seen = flip(a, b);
    double ssimSum = 0.0;
    double flipSum = 0.0;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
        if (truth.pixels[i] == noSurface) continue;
        ssimSum += similar.values[i];
        flipSum += seen.values[i];
    }
    error.ssim = ssimSum / static_cast<double>(error.counted);
    error.flip = flipSum / static_cast<double>(error.counted);
    return error;
}

image::Image errorPicture(const image::Image& truth, const image::Image& factor) {
    image::Image picture = image::blank(truth.width, truth.height, 3);
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
        const std::uint8_t t = truth.pixels[i];
        const auto dim = static_cast<std::uint8_t>(t == noSurface ? 255 : 96 + t / 2);
        std::uint8_t* rgb = picture.pixels.data() + i * 3;
        std::fill_n(rgb, 3, dim);
        if (t == noSurface || lit(t) == lit(factor.pixels[i])) continue;
        rgb[0] = lit(t) ? 220 : 0;
        rgb[1] = 0;
        rgb[2] = lit(t) ? 0 : 220;
    }
    return picture;
}

}  // namespace gnomon::truth

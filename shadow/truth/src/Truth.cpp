#include <gnomon/truth/Truth.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <thread>
#include <vector>

namespace gnomon::truth {
namespace {

using math::dvec3;
using math::dvec4;

/// What the rows of one thread add up to.
struct Sums {
    std::uint64_t counted = 0;
    std::uint64_t penumbra = 0;
    double squares = 0.0;
    double largest = 0.0;
};

std::uint8_t toByte(double factor) {
    const double byte = std::floor(factor * 255.0 + 0.5);
    return static_cast<std::uint8_t>(byte == noSurface ? 127 : byte);
}

/// Rays through pixel centres.
class PixelRays {
public:
    PixelRays(const math::View& view, const dvec3& origin, int width, int height)
        : worldFromClip_{glm::inverse(view.clipFromWorld())},
          origin_{origin},
          width_{width},
          height_{height} {}
    struct Ray {
        dvec3 from{0.0}, direction{0.0};
    };
    /// From the near plane; direction as long as it is to the far plane.
    Ray at(int x, int y) const {
        const double cx = (x + 0.5) / width_ * 2.0 - 1.0;
        const double cy = 1.0 - (y + 0.5) / height_ * 2.0;
        const dvec3 near = unproject({cx, cy, 1.0, 1.0});
        const dvec3 far = unproject({cx, cy, 0.0, 1.0});
        return {.from = near - origin_, .direction = far - near};
    }

private:
    dvec3 unproject(const dvec4& clip) const {
        const dvec4 p = worldFromClip_ * clip;
        return dvec3{p} / p.w;
    }
    math::dmat4 worldFromClip_;
    dvec3 origin_;
    int width_, height_;
};

/// 95 % interval's half width of a share found by n draws. Source: Edwin Wilson. Probable
/// Inference. 1927: it stays honest where all draws agree.
double halfWidth(double share, int n) {
    constexpr double z = 1.96;
    const double z2 = z * z / n;
    return z / (1.0 + z2) * std::sqrt(share * (1.0 - share) / n + z2 / (4.0 * n));
}

}  // namespace

Truth shadowTruth(const RayScene& scene, const math::View& view,
                  const shadow_fit::LightShape& light, const TruthOptions& options) {
    Truth truth{.factor = image::blank(options.width, options.height, 1)};
    const PixelRays rays{view, scene.origin(), options.width, options.height};
    const LightSampler sampler{light, scene.origin()};
    const int samples = sampler.hasExtent() ? std::max(1, options.samples) : 1;
    std::atomic<int> nextRow{0};
    std::mutex mutex;
    int rowsDone = 0;
    Sums total;

    const auto factorAt = [&](int x, int y, Sums& sums) -> std::uint8_t {
        const auto ray = rays.at(x, y);
        const double length = glm::length(ray.direction);
        const auto hit = scene.firstHit(ray.from, ray.direction / length, length);
        if (!hit) return noSurface;
        const auto middle = sampler.centre(hit->position);
        if (!(glm::dot(hit->normal, middle.direction) > leastCosine)) return noSurface;
        ++sums.counted;
        if (!sampler.shinesAt(hit->position)) return 0;
        if (samples == 1) return scene.shadowed(*hit, middle.direction, middle.reach) ? 0 : 255;
        const auto pixel = static_cast<std::uint32_t>(y * options.width + x);
        int lit = 0;
        for (int i = 0; i < samples; ++i) {
            const auto to =
                sampler.sample(hit->position, stratified(static_cast<std::uint32_t>(i), pixel));
            // A part of the light below the surface does not reach it.
            if (glm::dot(hit->normal, to.direction) > 0.0 &&
                !scene.shadowed(*hit, to.direction, to.reach))
                ++lit;
        }
        const double share = static_cast<double>(lit) / samples;
        const double width = halfWidth(share, samples);
        sums.penumbra += lit > 0 && lit < samples ? 1U : 0U;
        sums.squares += width * width;
        sums.largest = std::max(sums.largest, width);
        return toByte(share);
    };
    const auto work = [&] {
        Sums sums;
        for (int y = nextRow++; y < options.height; y = nextRow++) {
            auto* row = truth.factor.pixels.data() +
                        static_cast<std::size_t>(y) * static_cast<std::size_t>(options.width);
            for (int x = 0; x < options.width; ++x) row[x] = factorAt(x, y, sums);
            const std::lock_guard lock{mutex};
            ++rowsDone;
            if (options.progress) options.progress(static_cast<double>(rowsDone) / options.height);
        }
        const std::lock_guard lock{mutex};
        total.counted += sums.counted;
        total.penumbra += sums.penumbra;
        total.squares += sums.squares;
        total.largest = std::max(total.largest, sums.largest);
    };
    {
        std::vector<std::jthread> helpers;
        const unsigned threads = std::max(1U, std::thread::hardware_concurrency());
        for (unsigned i = 1; i < threads; ++i) helpers.emplace_back(work);
        work();
    }
    truth.counted = total.counted;
    truth.penumbra = total.penumbra;
    truth.largestWidth = total.largest;
    if (total.counted > 0)
        truth.rootMeanWidth = std::sqrt(total.squares / static_cast<double>(total.counted));
    return truth;
}

}  // namespace gnomon::truth

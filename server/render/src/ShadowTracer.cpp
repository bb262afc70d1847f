#include "ShadowTracer.h"

#include <gnomon/truth/LightSampler.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <thread>

namespace gnomon::render {
namespace {

using math::dvec2;
using math::dvec3;
using math::dvec4;
using truth::LightSampler;
using truth::RayPacket;

constexpr int probes = 5;    ///< rays of every pixel: to the middle of the light and its rim
constexpr int some = 16;     ///< in all of one that may lie in a penumbra
constexpr int samples = 64;  ///< in all of one that lies in it
constexpr int bandRows = 8;
constexpr int reach = ShadowTracer::reach;

unsigned threadCount() {
    const unsigned cores = std::max(1U, std::thread::hardware_concurrency());
    const char* asked = std::getenv("LP_NUM_THREADS");
    const int wanted = asked == nullptr ? 0 : std::atoi(asked);
    return wanted > 0 ? std::min(static_cast<unsigned>(wanted), cores) : cores;
}

/// Places of a light in the order they are asked: from the middle on, each as far from those before
/// as can be, so that the first reach its rim on all sides.
std::vector<dvec2> places() {
    std::vector<dvec2> left;
    for (int i = 0; i < samples; ++i)
        left.push_back(truth::sunflower(static_cast<std::uint32_t>(i), samples));
    std::vector<dvec2> made{left.front()};
    left.erase(left.begin());
    const auto away = [&](const dvec2& p) {
        double nearest = 4.0;
        for (const dvec2& q : made) nearest = std::min(nearest, glm::dot(p - q, p - q));
        return nearest;
    };
    while (!left.empty()) {
        const auto next =
            std::max_element(left.begin(), left.end(),
                             [&](const dvec2& a, const dvec2& b) { return away(a) < away(b); });
        made.push_back(*next);
        left.erase(next);
    }
    return made;
}

/// Where the surfaces of a depth image are.
class Points {
public:
    Points(const ShadowTracer::Surfaces& surfaces, const dvec3& origin)
        : worldFromClip_{glm::inverse(surfaces.clipFromWorld)},
          origin_{origin},
          size_{surfaces.size},
          depths_{surfaces.depths} {}

    struct Point {
        bool there = false;
        dvec3 position{0.0};  ///< relative to the origin, off the surface on the side that is seen
    };
    Point at(int x, int y) const {
        const float depth =
            depths_[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.x) +
                    static_cast<std::size_t>(x)];
        if (!(depth > 0.0F)) return {};
        const double cx = (x + 0.5) / size_.x * 2.0 - 1.0;
        const double cy = (y + 0.5) / size_.y * 2.0 - 1.0;
        const dvec4 base = worldFromClip_[0] * cx + worldFromClip_[1] * cy + worldFromClip_[3];
        const dvec3 surface = project(base + worldFromClip_[2] * static_cast<double>(depth));
        const dvec3 toEye = project(base + worldFromClip_[2]) - surface;
        const double away = glm::length(toEye);
        // Vertices and transforms are exact to what floats of this size can tell; a depth, to what
        // is left of the largest in its triangle, along this very line.
        const dvec3 size = glm::abs(surface);
        const dvec3 nearer = project(base + worldFromClip_[2] * (depth + 0x1p-24));
        const double slack =
            0x1p-20 * (1.0 + std::max({size.x, size.y, size.z})) + glm::length(nearer - surface);
        return {.there = true,
                .position = away > slack ? surface + toEye * (slack / away) : surface};
    }

private:
    dvec3 project(const dvec4& p) const { return dvec3{p} / p.w - origin_; }
    math::dmat4 worldFromClip_;
    dvec3 origin_;
    glm::ivec2 size_;
    std::span<const float> depths_;
};

constexpr std::uint8_t arrives = 1;
constexpr std::uint8_t blocked = 2;
constexpr std::uint8_t both = arrives | blocked;
constexpr auto packetSize = static_cast<int>(RayPacket::size);

/// One light's factors. Which pixels may lie in its penumbra is known after every probe().
class Tracer {
public:
    struct Images {
        std::uint8_t* seen = nullptr;
        std::uint8_t* factors = nullptr;
    };
    Tracer(const truth::RayScene& scene, const shadow_fit::LightShape& light, const Points& points,
           glm::ivec2 size, std::span<const dvec2> places, const Images& images)
        : scene_{scene},
          sampler_{light, scene.origin()},
          points_{points},
          size_{size},
          places_{places},
          images_{images} {
        if (!soft() || light.kind != shadow_fit::LightKind::directional) return;
        for (const dvec2& place : places) parallel_.push_back(sampler_.toward(dvec3{0.0}, place));
    }

    bool soft() const noexcept { return sampler_.hasExtent(); }

    /// Of the pixels of a row, what the first rays say.
    void probe(int y) const {
        for (int x = 0; x < size_.x; x += packetSize) {
            const int end = std::min(x + packetSize, size_.x);
            Block block;
            for (int i = x; i < end; ++i) {
                const auto point = points_.at(i, y);
                if (point.there && sampler_.shinesAt(point.position))
                    block.add(rowStart(y) + static_cast<std::size_t>(i), point.position);
                else
                    set(rowStart(y) + static_cast<std::size_t>(i), 0, 0);
            }
            if (block.used == 0) continue;
            if (!soft()) {
                const unsigned dark = scene_.blocked(
                    packet(block, [&](const dvec3& from) { return sampler_.centre(from); }));
                for (std::size_t i = 0; i < block.used; ++i)
                    set(block.pixels[i], 0, (dark >> i & 1U) != 0 ? 0 : 255);
                continue;
            }
            const auto lit = cast(block, 0, probes);
            for (std::size_t i = 0; i < block.used; ++i)
                set(block.pixels[i],
                    static_cast<std::uint8_t>((lit[i] > 0 ? arrives : 0) |
                                              (lit[i] < probes ? blocked : 0)),
                    lit[i]);
        }
    }

    /// Of the pixels of a band of rows, the rest. They are gathered square by square, to fill
    /// packets with rays that keep together.
    /// @param near  memory to use
    void refine(int low, std::vector<std::uint8_t>& near) const {
        const int high = std::min(low + bandRows, size_.y);
        near.resize(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(bandRows));
        for (int y = low; y < high; ++y) look(y, near.data() + rowStart(y - low));
        Block block;
        Block mixed;
        for (int x = 0; x < size_.x; x += packetSize)
            for (int y = low; y < high; ++y)
                for (int i = x; i < std::min(x + packetSize, size_.x); ++i) {
                    const std::size_t pixel = rowStart(y) + static_cast<std::size_t>(i);
                    if (images_.seen[pixel] == 0) continue;
                    if (near[rowStart(y - low) + static_cast<std::size_t>(i)] != both) {
                        images_.factors[pixel] = images_.seen[pixel] == arrives ? 255 : 0;
                        continue;
                    }
                    block.add(pixel, points_.at(i, y).position);
                    if (block.used == RayPacket::size) askSome(block, mixed);
                }
        askSome(block, mixed);
        askAll(mixed);
    }

private:
    struct Block {
        std::array<dvec3, RayPacket::size> from{};
        std::array<std::size_t, RayPacket::size> pixels{};
        std::size_t used = 0;
        void add(std::size_t pixel, const dvec3& position) {
            from[used] = position;
            pixels[used++] = pixel;
        }
    };
    std::size_t rowStart(int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.x);
    }
    void set(std::size_t pixel, std::uint8_t seen, int factor) const {
        images_.seen[pixel] = seen;
        images_.factors[pixel] = static_cast<std::uint8_t>(factor);
    }
    /// What the probes of each pixel of a row and of those within reach found together.
    void look(int y, std::uint8_t* near) const {
        std::fill_n(near, size_.x, std::uint8_t{0});
        for (int row = std::max(0, y - reach); row <= std::min(size_.y - 1, y + reach); ++row)
            for (int shift = -reach; shift <= reach; ++shift) {
                const std::uint8_t* seen = images_.seen + rowStart(row);
                for (int x = std::max(0, -shift); x < size_.x - std::max(0, shift); ++x)
                    near[x] |= seen[x + shift];
            }
    }
    template <class Way>
    static RayPacket packet(const Block& block, Way way) {
        RayPacket made;
        for (std::size_t i = 0; i < block.used; ++i) {
            const auto ray = way(block.from[i]);
            made.set(i, block.from[i], ray.direction, ray.reach);
        }
        return made;
    }
    /// How many rays of each pixel arrive.
    std::array<int, RayPacket::size> cast(const Block& block, int first, int end) const {
        std::array<int, RayPacket::size> lit{};
        for (auto place = static_cast<std::size_t>(first); place < static_cast<std::size_t>(end);
             ++place) {
            const unsigned dark = scene_.blocked(packet(block, [&](const dvec3& from) {
                return parallel_.empty() ? sampler_.toward(from, places_[place]) : parallel_[place];
            }));
            for (std::size_t i = 0; i < block.used; ++i) lit[i] += (dark >> i & 1U) == 0 ? 1 : 0;
        }
        return lit;
    }
    /// Ends with what all agree on; the others wait for the rest.
    void askSome(Block& block, Block& mixed) const {
        const auto lit = cast(block, probes, some);
        for (std::size_t i = 0; i < block.used; ++i) {
            std::uint8_t& factor = images_.factors[block.pixels[i]];
            factor = static_cast<std::uint8_t>(factor + lit[i]);
            if (factor == 0) continue;
            if (factor == some) {
                factor = 255;
                continue;
            }
            mixed.add(block.pixels[i], block.from[i]);
            if (mixed.used == RayPacket::size) askAll(mixed);
        }
        block.used = 0;
    }
    void askAll(Block& block) const {
        const auto lit = cast(block, some, samples);
        for (std::size_t i = 0; i < block.used; ++i) {
            std::uint8_t& factor = images_.factors[block.pixels[i]];
            factor = static_cast<std::uint8_t>(((factor + lit[i]) * 255 + samples / 2) / samples);
        }
        block.used = 0;
    }

    const truth::RayScene& scene_;
    LightSampler sampler_;
    const Points& points_;
    glm::ivec2 size_;
    std::span<const dvec2> places_;
    std::vector<LightSampler::Ray> parallel_ = {};  ///< the same from everywhere
    Images images_;
};

}  // namespace

ShadowTracer::ShadowTracer() : places_{places()}, threads_{threadCount()} {}

std::span<const std::uint8_t> ShadowTracer::trace(const truth::RayScene& scene,
                                                  const Surfaces& surfaces,
                                                  std::span<const shadow_fit::LightShape> lights) {
    const auto area =
        static_cast<std::size_t>(surfaces.size.x) * static_cast<std::size_t>(surfaces.size.y);
    seen_.resize(area * lights.size());
    factors_.resize(area * lights.size());
    const Points points{surfaces, scene.origin()};
    std::vector<Tracer> tracers;
    for (std::size_t i = 0; i < lights.size(); ++i)
        tracers.emplace_back(
            scene, lights[i], points, surfaces.size, places_,
            Tracer::Images{.seen = seen_.data() + i * area, .factors = factors_.data() + i * area});
    const auto onThreads = [&](const auto& work) {
        std::atomic<int> next{0};
        std::vector<std::jthread> helpers;
        for (unsigned i = 1; i < threads_; ++i) helpers.emplace_back([&] { work(next); });
        work(next);
    };
    const auto each = [&](std::atomic<int>& next, int step, const auto& work) {
        const int count = (surfaces.size.y + step - 1) / step;
        const int all = count * static_cast<int>(lights.size());
        for (int i = next++; i < all; i = next++)
            work(tracers[static_cast<std::size_t>(i / count)], i % count * step);
    };
    onThreads([&](std::atomic<int>& next) {
        each(next, 1, [](const Tracer& tracer, int y) { tracer.probe(y); });
    });
    if (std::none_of(tracers.begin(), tracers.end(), [](const Tracer& t) { return t.soft(); }))
        return factors_;
    onThreads([&](std::atomic<int>& next) {
        std::vector<std::uint8_t> near;
        each(next, bandRows, [&](const Tracer& tracer, int y) {
            if (tracer.soft()) tracer.refine(y, near);
        });
    });
    return factors_;
}

}  // namespace gnomon::render

// Distances, similarity and perceived difference, against slow or known answers.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "Distance.h"
#include "Flip.h"
#include "Ssim.h"

namespace gnomon::truth {
namespace {

TEST(Distance, IsThatOfTheNearestMark) {
    std::mt19937 random{3};
    constexpr int w = 37;
    constexpr int h = 23;
    for (int round = 0; round < 10; ++round) {
        std::vector<bool> marked(w * h, false);
        for (int i = 0; i < round * 3; ++i) marked[random() % marked.size()] = true;
        const auto found = distanceTo(marked, w, h);
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) {
                float nearest = HUGE_VALF;
                for (int v = 0; v < h; ++v)
                    for (int u = 0; u < w; ++u)
                        if (marked[static_cast<std::size_t>(v * w + u)])
                            nearest = std::min(nearest, std::hypot(static_cast<float>(u - x),
                                                                   static_cast<float>(v - y)));
                const float d = found[static_cast<std::size_t>(y * w + x)];
                if (std::isinf(nearest))
                    ASSERT_TRUE(std::isinf(d));
                else
                    ASSERT_NEAR(d, nearest, 1e-4F);
            }
    }
}

Plane constant(float value, int size = 64) {
    return {.width = size,
            .height = size,
            .values = std::vector<float>(static_cast<std::size_t>(size * size), value)};
}

TEST(Flip, OfBlackAndWhiteIsNearlyAll) {
    // The largest possible difference is green against blue; of grey images black against white.
    const Plane all = flip(constant(0.0F), constant(1.0F));
    EXPECT_GT(all.values[2000], 0.9F);
    EXPECT_LE(all.values[2000], 1.0F);
    EXPECT_NEAR(flip(constant(0.5F), constant(0.5F)).values[2000], 0.0F, 1e-6F);
}

TEST(Flip, GrowsWithTheDifferenceAndIsSymmetric) {
    float before = 0.0F;
    for (const float other : {0.55F, 0.6F, 0.7F, 0.9F}) {
        const float found = flip(constant(0.5F), constant(other)).values[2000];
        EXPECT_GT(found, before);
        EXPECT_NEAR(found, flip(constant(other), constant(0.5F)).values[2000], 1e-5F);
        before = found;
    }
}

TEST(Flip, AnEdgeThatIsMissingIsSeen) {
    Plane edge = constant(0.2F);
    for (int y = 0; y < 64; ++y)
        for (int x = 32; x < 64; ++x) edge.at(x, y) = 0.8F;
    const Plane found = flip(edge, constant(0.2F));
    EXPECT_GT(found.at(33, 32), 0.3F);
    EXPECT_NEAR(found.at(2, 32), 0.0F, 0.02F);
}

TEST(Ssim, IsOneForEqualsAndLowForNoise) {
    std::mt19937 random{9};
    Plane a = constant(0.0F);
    Plane b = constant(0.0F);
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        a.values[i] = static_cast<float>(random() % 256) / 255.0F;
        b.values[i] = static_cast<float>(random() % 256) / 255.0F;
    }
    EXPECT_NEAR(ssim(a, a).values[2000], 1.0F, 1e-5F);
    EXPECT_LT(std::abs(ssim(a, b).values[2000]), 0.4F);
}

}  // namespace
}  // namespace gnomon::truth

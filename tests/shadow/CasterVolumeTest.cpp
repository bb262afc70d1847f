// What is drawn into a page: all that can cast onto what is seen, and little else.
#include <gnomon/shadow_fit/Fit.h>
#include <gtest/gtest.h>

#include <random>

#include "CasterVolume.h"

namespace gnomon::shadow {
namespace {

using math::dmat4;
using math::dvec3;

class CasterVolumeTest : public testing::Test {
protected:
    double between(double low, double high) {
        return std::uniform_real_distribution<double>{low, high}(random);
    }
    static math::Box tiny(const dvec3& at) {
        return {.min = at - dvec3{1e-6}, .max = at + dvec3{1e-6}};
    }
    std::mt19937 random{11};
    // Light from straight above onto [-10, 10]^2, 20 m deep.
    const dmat4 clipFromWorld = math::orthographic({-10.0, -10.0, -20.0}, {10.0, 10.0, 0.0}) *
                                math::lookAt({0.0, 10.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0});
    std::vector<math::Plane> sides() const {
        const auto planes = math::frustumPlanes(clipFromWorld);
        return {planes.begin(), planes.begin() + 4};
    }
};

TEST_F(CasterVolumeTest, HoldsWhateverIsBetweenTheLightAndWhatIsSeen) {
    const std::vector<dvec3> seen{{-2.0, 0.0, -2.0}, {3.0, 0.0, -1.0}, {0.0, 1.0, 4.0}};
    SeenInMap image;
    image.project(clipFromWorld, seen, {});
    CasterVolume volume;
    volume.enclose(clipFromWorld, sides(), image, 0.01);
    for (int i = 0; i < 2000; ++i) {
        double a = between(0.0, 1.0);
        double b = between(0.0, 1.0);
        if (a + b > 1.0) {
            a = 1.0 - a;
            b = 1.0 - b;
        }
        const dvec3 receiver = seen[0] + (seen[1] - seen[0]) * a + (seen[2] - seen[0]) * b;
        const dvec3 caster = receiver + dvec3{0.0, between(0.0, 40.0), 0.0};
        EXPECT_TRUE(mayIntersect(volume.planes(), tiny(caster)));
    }
    EXPECT_FALSE(mayIntersect(volume.planes(), tiny({-8.0, 3.0, 6.0}))) << "beside it";
    EXPECT_FALSE(mayIntersect(volume.planes(), tiny({0.0, -5.0, 0.0}))) << "behind all of it";
}

TEST_F(CasterVolumeTest, ServesAViewThatMovesALittleAndNoOther) {
    std::vector<dvec3> seen{{-2.0, 0.0, -2.0}, {2.0, 0.0, -2.0}, {2.0, 0.0, 2.0}, {-2.0, 0.0, 2.0}};
    SeenInMap image;
    image.project(clipFromWorld, seen, {});
    CasterVolume volume;
    volume.enclose(clipFromWorld, sides(), image, 0.01);
    EXPECT_TRUE(volume.serves(image));
    for (dvec3& p : seen) p.x += 0.2;
    image.project(clipFromWorld, seen, {});
    EXPECT_TRUE(volume.serves(image));
    for (dvec3& p : seen) p.x += 2.0;
    image.project(clipFromWorld, seen, {});
    EXPECT_FALSE(volume.serves(image));
}

TEST_F(CasterVolumeTest, WhereSomethingIsAtTheLightOnlyThePagesSidesBound) {
    SeenInMap image;
    const dmat4 spot = math::perspective(1.0, 1.0, 0.1, 20.0) *
                       math::lookAt({0.0, 10.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0});
    const std::vector<dvec3> seen{{0.0, 0.0, 0.0}, {0.0, 12.0, 0.0}};
    image.project(spot, seen, {});
    EXPECT_TRUE(image.anywhere);
    CasterVolume volume;
    const auto planes = math::frustumPlanes(spot);
    volume.enclose(spot, std::span{planes}.first(4), image, 0.01);
    EXPECT_EQ(volume.planes().size(), 4U);
    EXPECT_TRUE(volume.serves(image));
}

}  // namespace
}  // namespace gnomon::shadow

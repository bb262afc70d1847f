// Affine maps and boxes.
#include <gnomon/math/Types.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace gnomon::math {
namespace {

Affine randomAffine(std::mt19937& random) {
    std::uniform_real_distribution<double> u{-2.0, 2.0};
    Affine a;
    for (int c = 0; c < 3; ++c) {
        a.translation[c] = 1000.0 * u(random);
        for (int r = 0; r < 3; ++r) a.linear[c][r] = static_cast<float>(u(random));
    }
    return a;
}

TEST(Affine, RoundTripsThroughAMatrix) {
    std::mt19937 random{1};
    for (int i = 0; i < 100; ++i) {
        const Affine a = randomAffine(random);
        EXPECT_EQ(toAffine(toMatrix(a)), a);
    }
    EXPECT_EQ(toMatrix(Affine{}), dmat4{1.0});
}

TEST(Affine, ComposesAsMatricesDo) {
    std::mt19937 random{2};
    for (int i = 0; i < 100; ++i) {
        const Affine a = randomAffine(random);
        const Affine b = randomAffine(random);
        const dmat4 expected = toMatrix(a) * toMatrix(b);
        const dmat4 found = toMatrix(a * b);
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r)
                EXPECT_NEAR(found[c][r], expected[c][r], c < 3 ? 1e-5 : 1e-9);
    }
}

TEST(Affine, AFarTranslationStaysExact) {
    const Affine far{.translation = {6378137.000001, 0.0, -149597870700.25}};
    EXPECT_EQ((far * Affine{}).translation, far.translation);
}

TEST(Matrix, FiniteMeansEveryNumber) {
    EXPECT_TRUE(isFinite(dmat4{1.0}));
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) {
            for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
                dmat4 m{1.0};
                m[c][r] = bad;
                EXPECT_FALSE(isFinite(m));
            }
        }
    }
}

TEST(Box, IsEmptyUntilSomethingIsAdded) {
    Box box;
    EXPECT_TRUE(box.empty());
    box.add(Box{});
    EXPECT_TRUE(box.empty());
    box.add(dvec3{1.0, 2.0, 3.0});
    EXPECT_FALSE(box.empty());
    EXPECT_EQ(box.size(), dvec3{0.0});
    box.add(dvec3{-1.0, 4.0, 3.0});
    EXPECT_EQ(box.centre(), dvec3(0.0, 3.0, 3.0));
    EXPECT_EQ(box.corner(0), dvec3(-1.0, 2.0, 3.0));
    EXPECT_EQ(box.corner(7), dvec3(1.0, 4.0, 3.0));
    const Box nan{.min = dvec3{std::nan("")}, .max = dvec3{1.0}};
    EXPECT_TRUE(nan.empty());
}

TEST(Box, ItsImageIsTheBoundsOfItsCornersImages) {
    std::mt19937 random{3};
    std::uniform_real_distribution<double> u{-3.0, 3.0};
    for (int i = 0; i < 200; ++i) {
        Box box;
        box.add(dvec3{u(random), u(random), u(random)});
        box.add(dvec3{u(random), u(random), u(random)});
        const dmat4 m = toMatrix(randomAffine(random));
        Box expected;
        for (int c = 0; c < 8; ++c) expected.add(dvec3{m * dvec4{box.corner(c), 1.0}});
        const Box found = transformed(box, m);
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(found.min[k], expected.min[k], 1e-9);
            EXPECT_NEAR(found.max[k], expected.max[k], 1e-9);
        }
    }
    EXPECT_TRUE(transformed(Box{}, dmat4{1.0}).empty());
}

}  // namespace
}  // namespace gnomon::math

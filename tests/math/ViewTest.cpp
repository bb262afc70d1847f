// Projections, tiles and off-axis views, against numbers worked out by hand.
#include <gnomon/math/View.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace gnomon::math {
namespace {

dvec3 ndc(const dmat4& clipFromSource, const dvec3& point) {
    const dvec4 clip = clipFromSource * dvec4{point, 1.0};
    return dvec3{clip} / clip.w;
}

void expectNear(const dvec3& a, const dvec3& b, double tolerance = 1e-12) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

TEST(View, DepthIsReversed) {
    const dmat4 clip = perspective(1.0, 1.5, 0.5, 200.0);
    EXPECT_NEAR(ndc(clip, {0.0, 0.0, -0.5}).z, 1.0, 1e-12);
    EXPECT_NEAR(ndc(clip, {0.0, 0.0, -200.0}).z, 0.0, 1e-12);
    double before = 2.0;
    for (double d = 0.5; d < 200.0; d *= 1.3) {
        const double z = ndc(clip, {0.0, 0.0, -d}).z;
        EXPECT_LT(z, before);
        before = z;
    }
    // w is the distance, so that what is behind the eye has w < 0.
    EXPECT_EQ((clip * dvec4{1.0, 2.0, -7.0, 1.0}).w, 7.0);
}

TEST(View, PerspectiveShowsItsAngle) {
    const double half = 0.4;
    const dmat4 clip = perspective(2.0 * half, 2.0, 0.1, 10.0);
    const double d = 3.0;
    expectNear(ndc(clip, {0.0, d * std::tan(half), -d}) * dvec3{1.0, 1.0, 0.0}, {0.0, 1.0, 0.0});
    expectNear(ndc(clip, {2.0 * d * std::tan(half), 0.0, -d}) * dvec3{1.0, 1.0, 0.0},
               {1.0, 0.0, 0.0});
}

TEST(View, OrthographicMapsItsBox) {
    const dmat4 clip = orthographic({-1.0, 2.0, -50.0}, {3.0, 8.0, -10.0});
    expectNear(ndc(clip, {-1.0, 2.0, -10.0}), {-1.0, -1.0, 1.0});
    expectNear(ndc(clip, {3.0, 8.0, -50.0}), {1.0, 1.0, 0.0});
    EXPECT_TRUE(isFinite(orthographic({1.0, 1.0, -1.0}, {1.0, 1.0, -1.0}))) << "no extent";
}

TEST(View, OffAxisAgreesWithAFrustumWorkedOutByHand) {
    // A screen 4 m wide and 2 m high, its lower left corner at (-1, 0, -2), facing +z; the eye 2 m
    // in front of it, above (0.5, 1.5). Seen from there its sides lie at x -1.5 and 2.5, and y -1.5
    // and 0.5, at distance 2.
    const ScreenCorners screen{.lowerLeft = {-1.0, 0.0, -2.0},
                               .lowerRight = {3.0, 0.0, -2.0},
                               .upperLeft = {-1.0, 2.0, -2.0}};
    const dvec3 eye{0.5, 1.5, 0.0};
    const View view = offAxis(eye, screen, 0.25, 100.0);
    const dmat4 byHand = frustum(-0.75, 1.25, -0.75, 0.25, 0.25, 100.0);
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            EXPECT_NEAR(view.clipFromEye[c][r], byHand[c][r], 1e-12) << c << ", " << r;
    expectNear(view.eyeWorld(), eye);
    const dmat4 clip = view.clipFromWorld();
    const dvec3 flat{1.0, 1.0, 0.0};
    expectNear(ndc(clip, screen.lowerLeft) * flat, {-1.0, -1.0, 0.0});
    expectNear(ndc(clip, screen.lowerRight) * flat, {1.0, -1.0, 0.0});
    expectNear(ndc(clip, screen.upperLeft) * flat, {-1.0, 1.0, 0.0});
    expectNear(ndc(clip, {1.0, 1.0, -2.0}) * flat, {0.0, 0.0, 0.0});
}

TEST(View, OffAxisShowsThePlaneOfAnyScreenWhereItIs) {
    std::mt19937 random{1};
    std::uniform_real_distribution<double> u{-1.0, 1.0};
    for (int i = 0; i < 200; ++i) {
        const dvec3 right = glm::normalize(dvec3{u(random), u(random), u(random)});
        const dvec3 up = glm::normalize(glm::cross(dvec3{u(random), u(random), u(random)}, right));
        const dvec3 normal = glm::cross(right, up);
        const dvec3 corner{u(random) * 5.0, u(random) * 5.0, u(random) * 5.0};
        const double width = 1.5 + u(random);
        const double height = 1.5 + u(random);
        const ScreenCorners screen{.lowerLeft = corner,
                                   .lowerRight = corner + right * width,
                                   .upperLeft = corner + up * height};
        const dvec3 eye = corner + right * u(random) + up * u(random) + normal * (1.1 + u(random));
        const View view = offAxis(eye, screen, 0.01, 50.0);
        expectNear(view.eyeWorld(), eye, 1e-9);
        const double s = 0.5 + 0.5 * u(random);
        const double t = 0.5 + 0.5 * u(random);
        const dvec3 seen =
            ndc(view.clipFromWorld(), corner + right * (s * width) + up * (t * height));
        EXPECT_NEAR(seen.x, 2.0 * s - 1.0, 1e-9);
        EXPECT_NEAR(seen.y, 2.0 * t - 1.0, 1e-9);
    }
}

TEST(View, AnEyeInOrBehindTheScreenStillGivesAView) {
    for (const double z : {0.0, -1e-9, -5.0})
        EXPECT_TRUE(isFinite(offAxis({0.3, 0.1, z}, {}, 0.1, 10.0).clipFromWorld())) << z;
}

TEST(View, ATileIsExactlyThePartOfTheWhole) {
    // Exact in the projection matrix: where the whole has p, the tile has (p - offset) * scale, to
    // the bit where scale and offset are powers of two.
    const dmat4 whole = frustum(-0.75, 1.25, -0.75, 0.25, 0.25, 100.0);
    for (int columns : {1, 2, 4}) {
        for (int rows : {1, 2, 4}) {
            for (int x = 0; x < columns; ++x) {
                for (int y = 0; y < rows; ++y) {
                    const Rect part{.left = static_cast<double>(x) / columns,
                                    .bottom = static_cast<double>(y) / rows,
                                    .width = 1.0 / columns,
                                    .height = 1.0 / rows};
                    const dmat4 tile = tileFromWhole(part) * whole;
                    const dvec4 p = whole * dvec4{0.3, -0.2, -4.0, 1.0};
                    const dvec4 q = tile * dvec4{0.3, -0.2, -4.0, 1.0};
                    const double shareX = (p.x / p.w + 1.0) * 0.5;
                    const double shareY = (p.y / p.w + 1.0) * 0.5;
                    EXPECT_NEAR((q.x / q.w + 1.0) * 0.5, (shareX - part.left) / part.width, 1e-14);
                    EXPECT_NEAR((q.y / q.w + 1.0) * 0.5, (shareY - part.bottom) / part.height,
                                1e-14);
                    EXPECT_EQ(q.z, p.z);
                    EXPECT_EQ(q.w, p.w);
                }
            }
        }
    }
    EXPECT_EQ(tileFromWhole({}), dmat4{1.0});
}

TEST(View, TilesOfTilesArePartsOfTheWhole) {
    const Rect outer{.left = 0.5, .bottom = 0.25, .width = 0.25, .height = 0.5};
    const Rect inner{.left = 0.5, .bottom = 0.0, .width = 0.5, .height = 0.5};
    const Rect both{.left = 0.625, .bottom = 0.25, .width = 0.125, .height = 0.25};
    EXPECT_EQ(tileFromWhole(inner) * tileFromWhole(outer), tileFromWhole(both));
}

TEST(View, AWidenedViewSeesTheSameInItsMiddle) {
    const View view{.clipFromEye = frustum(-0.75, 1.25, -0.75, 0.25, 0.25, 100.0)};
    const View wide = widened(view, {0.25, 0.5});
    const dvec4 p = view.clipFromWorld() * dvec4{0.3, -0.2, -4.0, 1.0};
    const dvec4 q = wide.clipFromWorld() * dvec4{0.3, -0.2, -4.0, 1.0};
    EXPECT_NEAR(q.x / q.w * 1.5, p.x / p.w, 1e-14);
    EXPECT_NEAR(q.y / q.w * 2.0, p.y / p.w, 1e-14);
    EXPECT_EQ(q.z, p.z);
}

TEST(View, LookAtIsRigidAndLooksThere) {
    const dmat4 view = lookAt({1.0, 2.0, 3.0}, {4.0, 2.0, -1.0}, {0.0, 1.0, 0.0});
    expectNear(dvec3{view * dvec4{4.0, 2.0, -1.0, 1.0}}, {0.0, 0.0, -5.0});
    expectNear(dvec3{view * dvec4{1.0, 5.0, 3.0, 1.0}}, {0.0, 3.0, 0.0});
    EXPECT_NEAR(glm::determinant(dmat3{view}), 1.0, 1e-12);
    for (const dvec3& up : {dvec3{3.0, 0.0, -4.0}, dvec3{0.0}, dvec3{1e-200, 0.0, 0.0}}) {
        const dmat4 odd = lookAt({1.0, 2.0, 3.0}, {4.0, 2.0, -1.0}, up);
        EXPECT_TRUE(isFinite(odd));
        EXPECT_NEAR(glm::determinant(dmat3{odd}), 1.0, 1e-9);
    }
    EXPECT_TRUE(isFinite(lookAt({1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}, {0.0, 1.0, 0.0})));
}

TEST(View, CornersLieOnThePlanesTheyBelongTo) {
    std::mt19937 random{2};
    std::uniform_real_distribution<double> u{-1.0, 1.0};
    for (int i = 0; i < 100; ++i) {
        const dmat4 clip = frustum(-1.5 + u(random), 1.5 + u(random), -1.2 + u(random),
                                   1.2 + u(random), 0.3, 40.0) *
                           lookAt({u(random) * 9.0, u(random) * 9.0, u(random) * 9.0},
                                  {u(random), 0.0, 0.0}, {0.0, 1.0, 0.0});
        const auto corners = frustumCorners(clip);
        const auto planes = frustumPlanes(clip);
        // near: lower left, lower right, upper right, upper left; then far.
        const auto on = [&](std::size_t plane, std::initializer_list<std::size_t> indices) {
            for (std::size_t c = 0; c < 8; ++c) {
                const double d = planes[plane].distance(corners[c]);
                if (std::find(indices.begin(), indices.end(), c) != indices.end())
                    EXPECT_NEAR(d, 0.0, 1e-8) << "plane " << plane << ", corner " << c;
                else
                    EXPECT_GT(d, 0.01) << "plane " << plane << ", corner " << c;
            }
        };
        on(0, {0, 3, 4, 7});
        on(1, {1, 2, 5, 6});
        on(2, {0, 1, 4, 5});
        on(3, {2, 3, 6, 7});
        on(4, {0, 1, 2, 3});
        on(5, {4, 5, 6, 7});
    }
}

TEST(View, CullingNeverLosesWhatIsInside) {
    std::mt19937 random{3};
    std::uniform_real_distribution<double> u{-1.0, 1.0};
    const dmat4 clip = perspective(1.0, 1.3, 0.5, 30.0);
    const auto planes = frustumPlanes(clip);
    int culled = 0;
    for (int i = 0; i < 2000; ++i) {
        Box box;
        const dvec3 centre{u(random) * 30.0, u(random) * 30.0, u(random) * 40.0};
        const dvec3 half{1.1 + u(random), 1.1 + u(random), 1.1 + u(random)};
        box.add(centre - half);
        box.add(centre + half);
        const bool kept = mayIntersect(planes, box);
        culled += kept ? 0 : 1;
        if (kept) continue;
        for (int k = 0; k < 30; ++k) {
            const dvec3 p = centre + half * dvec3{u(random), u(random), u(random)};
            const dvec4 c = clip * dvec4{p, 1.0};
            EXPECT_FALSE(std::abs(c.x) <= c.w && std::abs(c.y) <= c.w && c.z >= 0.0 && c.z <= c.w);
        }
    }
    EXPECT_GT(culled, 1000);
    EXPECT_FALSE(mayIntersect(planes, Box{}));
}

}  // namespace
}  // namespace gnomon::math

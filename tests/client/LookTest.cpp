#include <gnomon/client/Look.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::client {
namespace {

struct BoxCase {
    const char* name;
    math::Box box;
    Opening through;
};

class LookAtBox : public testing::TestWithParam<BoxCase> {};

TEST_P(LookAtBox, ShowsAllOfItAndNotMuchMore) {
    const auto& [name, box, through] = GetParam();
    const Look look = lookAtBox(box, through);
    const auto eyeFromWorld = math::lookAt(look.eye, look.center, look.up);
    double fill = 0.0;  // 1: a corner touches an edge of the picture
    for (int i = 0; i < 8; ++i) {
        const math::dvec3 corner{eyeFromWorld * math::dvec4{box.corner(i), 1.0}};
        ASSERT_LT(corner.z, 0.0);
        const double x = corner.x / -corner.z;
        const double y = corner.y / -corner.z;
        EXPECT_GT(x, through.left);
        EXPECT_LT(x, through.right);
        EXPECT_GT(y, through.bottom);
        EXPECT_LT(y, through.top);
        const double midX = (through.left + through.right) / 2;
        const double midY = (through.bottom + through.top) / 2;
        fill = std::max({fill, std::abs(x - midX) / (through.right - midX),
                         std::abs(y - midY) / (through.top - midY)});
    }
    EXPECT_GT(fill, 0.85);
    EXPECT_GT(look.eye.y, box.centre().y);
}

INSTANTIATE_TEST_SUITE_P(
    Table, LookAtBox,
    testing::Values(
        BoxCase{"Cube", {.min = math::dvec3{-1.0}, .max = math::dvec3{1.0}}, opening(1.0, 1.5)},
        BoxCase{
            "FarAway",
            {.min = math::dvec3{1e6, 1e6, 1e6}, .max = math::dvec3{1e6 + 10, 1e6 + 1, 1e6 + 30}},
            opening(0.3, 1.0)},
        BoxCase{"Tiny",
                {.min = math::dvec3{0.0}, .max = math::dvec3{1e-4, 1e-3, 1e-4}},
                opening(1.0, 3.0)},
        BoxCase{"LopsidedWall",
                {.min = math::dvec3{-5, 0, -5}, .max = math::dvec3{5, 3, 5}},
                Opening{.left = -1.5, .right = 0.2, .bottom = -0.9, .top = 0.1}}),
    [](const auto& row) { return row.param.name; });

TEST(Look, OfAnEmptyBoxIsFinite) {
    const Look look = lookAtBox({}, opening(1.0, 1.0));
    EXPECT_TRUE(std::isfinite(look.eye.x + look.eye.y + look.eye.z));
    EXPECT_NE(look.eye, look.center);
}

TEST(DepthRange, EnclosesTheBox) {
    const math::Box box{.min = math::dvec3{-1.0}, .max = math::dvec3{1.0}};
    for (const double distance : {0.0, 1.5, 100.0, 1e5}) {
        const math::dvec3 eye{0.0, 0.0, distance};
        const auto range = depthRange(box, eye);
        EXPECT_GT(range.near, 0.0);
        EXPECT_LT(range.near, range.far);
        EXPECT_LE(range.near, std::max(distance - 1.0, range.far / 2000.0));
        for (int i = 0; i < 8; ++i) EXPECT_GT(range.far, glm::length(box.corner(i) - eye));
    }
    EXPECT_EQ(depthRange({}, {}), DepthRange{});
}

}  // namespace
}  // namespace gnomon::client

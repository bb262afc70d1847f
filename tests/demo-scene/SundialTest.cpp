#include <gnomon/demo/Scenes.h>
#include <gnomon/demo/Sun.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace gnomon::demo {
namespace {

TEST(Sun, StandsInTheSouthAtNoonAtTheRightHeight) {
    const glm::dvec3 sun =
        towardSun({.latitude = glm::radians(42.0), .declination = glm::radians(10.0)});
    EXPECT_NEAR(sun.x, 0.0, 1e-12);
    EXPECT_GT(sun.z, 0.0);
    EXPECT_NEAR(std::asin(sun.y), glm::radians(90.0 - 42.0 + 10.0), 1e-12);
}

TEST(Sun, SetsDueWestSixHoursAfterNoonAtTheEquinox) {
    const glm::dvec3 sun = towardSun(
        {.latitude = glm::radians(42.0), .declination = 0.0, .hourAngle = glm::radians(90.0)});
    EXPECT_NEAR(sun.x, -1.0, 1e-12);
    EXPECT_NEAR(sun.y, 0.0, 1e-12);
}

TEST(Sundial, TheStylesShadowLiesOnTheHourLineAtAnyTimeOfYear) {
    const double latitude = plazaTime().latitude;
    const glm::dvec3 style{0.0, std::sin(latitude), -std::cos(latitude)};  // from the foot up
    for (const double declination : {-23.4, 0.0, 20.0}) {
        for (double hour = -4.0; hour <= 4.0; hour += 0.5) {
            const double hourAngle = glm::radians(15.0 * hour);
            const glm::dvec3 sun = towardSun({.latitude = latitude,
                                              .declination = glm::radians(declination),
                                              .hourAngle = hourAngle});
            ASSERT_GT(sun.y, 0.0);
            const glm::dvec3 shadow = style - sun * (style.y / sun.y);  // on the dial's plane
            const double angle = std::atan2(shadow.x, -shadow.z);
            EXPECT_NEAR(angle, hourLine(latitude, hourAngle), 1e-9)
                << "hour " << hour << ", declination " << declination;
        }
    }
}

/// The bronze blade as it stands in the scene: its shadow ends on the plaza's own time.
TEST(Sundial, TheBladeShowsThePlazasTime) {
    const Scene scene = plaza(1, 16);
    const auto node = std::find_if(scene.nodes.begin(), scene.nodes.end(),
                                   [](const Node& n) { return n.name == "sundial"; });
    ASSERT_NE(node, scene.nodes.end());
    const Mesh& blade = scene.meshes[*node->mesh].primitives.back().mesh;
    const glm::mat4 worldFromDial = node->parentFromNode();
    const auto sunNode = std::find_if(scene.nodes.begin(), scene.nodes.end(),
                                      [](const Node& n) { return n.name == "sun"; });
    ASSERT_NE(sunNode, scene.nodes.end());
    const glm::vec3 rays = sunNode->rotation * glm::vec3{0.0F, 0.0F, -1.0F};
    const glm::vec3 sunDial = glm::transpose(glm::mat3{worldFromDial}) * -rays;

    float dialHeight = 1e9F;
    for (const Vertex& v : blade.vertices) dialHeight = std::min(dialHeight, v.position.y);
    // The foot of the style on the shadow's side: the blade's southernmost, easternmost corner.
    glm::vec3 foot{0.0F, 0.0F, -1e9F};
    for (const Vertex& v : blade.vertices) {
        if (v.position.z > foot.z || (v.position.z == foot.z && v.position.x > foot.x))
            foot = v.position;
    }
    EXPECT_FLOAT_EQ(foot.y, dialHeight);
    // The shadow's edge is the largest angle any part of the blade reaches, seen from that foot.
    double edge = 0.0;
    for (const Vertex& v : blade.vertices) {
        const glm::vec3 p = v.position - sunDial * ((v.position.y - dialHeight) / sunDial.y) - foot;
        if (glm::length(p) > 0.5F) edge = std::max(edge, double{std::atan2(p.x, -p.z)});
    }
    const double expected = hourLine(plazaTime().latitude, plazaTime().hourAngle);
    EXPECT_NEAR(edge, expected, glm::radians(0.05));  // 12 seconds of time
}

}  // namespace
}  // namespace gnomon::demo

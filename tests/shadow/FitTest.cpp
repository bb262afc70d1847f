// What every fit owes, over random lights, views and scenes.
#include <gnomon/shadow_fit/Fit.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "Chance.h"

namespace gnomon::shadow_fit {
namespace {

using math::dmat4;
using math::dvec2;
using math::dvec3;
using math::dvec4;

struct Situation {
    LightShape light = {};
    std::vector<math::View> views = {};
    math::Box scene = {};
    FitSettings settings = {};

    /// What a fit made of it; the scene is one box.
    Fitted fitted(const FitInfo& info, int mapSize = 1024) const {
        math::BoxTree tree;
        tree.build({scene});
        const auto seen = receivers(tree);
        const auto samples = samplePicture(views, {.tree = tree}, 12);
        return shadow_fit::fitted(info, {.light = light,
                                         .views = views,
                                         .receivers = seen,
                                         .samples = samples,
                                         .scene = scene,
                                         .mapSize = mapSize,
                                         .settings = settings});
    }
    Receivers receivers(const math::BoxTree& tree) const {
        Receivers seen;
        for (const math::View& view : views) seen.add(view, &light, tree);
        return seen;
    }
    std::vector<dvec3> receiverPoints() const {
        math::BoxTree tree;
        tree.build({scene});
        const auto seen = receivers(tree);
        return {seen.points().begin(), seen.points().end()};
    }
};

Situation randomSituation(Chance& chance, LightKind kind) {
    Situation s;
    const double size = std::pow(10.0, chance.between(-1.0, 3.0));
    const dvec3 centre = chance.point(dvec3{-100.0}, dvec3{100.0});
    for (int i = 0; i < 2; ++i) s.scene.add(centre + chance.point(dvec3{-size}, dvec3{size}));
    const int views = chance.coin() ? 1 : 2;
    const dvec3 eye = centre + chance.direction() * size * chance.between(0.1, 3.0);
    for (int i = 0; i < views; ++i)
        s.views.push_back(
            {.clipFromEye = math::perspective(chance.between(0.3, 1.8), chance.between(0.5, 2.5),
                                              size * 1e-3, size * chance.between(1.0, 20.0)),
             .eyeFromWorld =
                 math::lookAt(eye + dvec3{0.065 * i, 0.0, 0.0},
                              chance.point(s.scene.min, s.scene.max), {0.0, 1.0, 0.0})});
    s.light.kind = kind;
    s.light.direction = chance.direction();
    s.light.position = centre - s.light.direction * size * chance.between(0.0, 3.0);
    s.light.halfAngle = chance.between(0.05, 1.4);
    if (chance.coin()) s.light.range = size * chance.between(0.5, 5.0);
    return s;
}

/// Where the map has a point: x, y in [-1, 1] inside, z reversed depth.
dvec3 inMap(const FittedMap& map, const dvec3& p) {
    const dvec4 clip = map.clipFromWorld * dvec4{p, 1.0};
    EXPECT_GT(clip.w, 0.0) << "what can be looked up has w > 0";
    return dvec3{clip} / clip.w;
}

bool inside(const dvec3& q) { return std::abs(q.x) <= 1.0 && std::abs(q.y) <= 1.0; }

bool visible(const Situation& s, const dvec3& p) {
    return std::any_of(s.views.begin(), s.views.end(), [&](const math::View& view) {
        const dvec4 c = view.clipFromWorld() * dvec4{p, 1.0};
        return std::abs(c.x) <= c.w && std::abs(c.y) <= c.w && c.z >= 0.0 && c.z <= c.w;
    });
}

/// Right at a spot nothing is judged: its map begins at a near plane.
bool lit(const LightShape& light, const dvec3& p, double nearest) {
    if (light.kind == LightKind::directional) return true;
    const dvec3 way = p - light.position;
    const double distance = glm::length(way);
    if (light.range > 0.0 && distance > light.range) return false;
    return distance > nearest &&
           glm::dot(way, light.direction) > distance * std::cos(light.halfAngle * 0.999);
}

using Case = std::tuple<std::size_t, LightKind, unsigned>;

class EveryFit : public testing::TestWithParam<Case> {
protected:
    const FitInfo& info() const { return fits()[std::get<0>(GetParam())]; }
    LightKind kind() const { return std::get<1>(GetParam()); }
    Chance chance{std::get<2>(GetParam())};
};

TEST_P(EveryFit, HoldsEveryReceiverAndWhatLiesBetweenItAndTheLight) {
    int receivers = 0;
    for (int round = 0; round < 60; ++round) {
        const Situation s = randomSituation(chance, kind());
        const Fitted fitted = s.fitted(info());
        for (const FittedMap& map : fitted.maps) ASSERT_TRUE(math::isFinite(map.clipFromWorld));
        for (int i = 0; i < 400; ++i) {
            const dvec3 p = chance.point(s.scene.min, s.scene.max);
            if (!visible(s, p) || !lit(s.light, p, 0.01 * s.scene.radius())) continue;
            ++receivers;
            ASSERT_FALSE(fitted.maps.empty()) << "a visible, lit place has no map";
            const auto map = std::find_if(fitted.maps.begin(), fitted.maps.end(),
                                          [&](const FittedMap& m) { return inside(inMap(m, p)); });
            ASSERT_NE(map, fitted.maps.end()) << "round " << round;
            const dvec3 q = inMap(*map, p);
            EXPECT_GE(q.z, 0.0);
            EXPECT_LE(q.z, 1.0);
            // A caster on the way to the light: the same place in the map, nearer to the light.
            const dvec3 way = kind() == LightKind::directional
                                  ? -s.light.direction * s.scene.radius()
                                  : (s.light.position - p) * 0.99;
            const dvec3 caster = p + way * chance.between(0.01, 1.0);
            const dvec3 c = inMap(*map, caster);
            EXPECT_NEAR(c.x, q.x, 1e-6);
            EXPECT_NEAR(c.y, q.y, 1e-6);
            EXPECT_GT(c.z, q.z);
        }
    }
    EXPECT_GT(receivers, 300) << "the test tested little";
}

TEST_P(EveryFit, SaysTheSameAgain) {
    for (int round = 0; round < 20; ++round) {
        const Situation s = randomSituation(chance, kind());
        const Fitted a = s.fitted(info());
        const Fitted b = s.fitted(info());
        ASSERT_EQ(a.maps.size(), b.maps.size());
        for (std::size_t i = 0; i < a.maps.size(); ++i)
            EXPECT_EQ(a.maps[i].clipFromWorld, b.maps[i].clipFromWorld);
    }
}

TEST_P(EveryFit, DegenerateScenesGiveFiniteMapsOrNone) {
    for (int round = 0; round < 40; ++round) {
        Situation s = randomSituation(chance, kind());
        switch (round % 8) {
            case 0:
                s.scene = {};
                break;
            case 1:
                s.scene.max = s.scene.min;
                break;
            case 2:
                s.scene.max.y = s.scene.min.y;
                break;
            case 3:
                s.scene.max = {s.scene.min.x, s.scene.min.y, s.scene.max.z};
                break;
            case 4:  // the light along the view, and against it
                s.light.direction =
                    (round % 16 < 8 ? -1.0 : 1.0) * dvec3{glm::inverse(s.views[0].eyeFromWorld)[2]};
                break;
            case 5:
                s.light.position = s.scene.centre();
                break;
            case 6:
                s.light.position = s.views[0].eyeWorld();
                break;
            default:
                s.light.direction = {0.0, round % 16 < 8 ? -1.0 : 1.0, 0.0};
                break;
        }
        const Fitted fitted = s.fitted(info());
        for (const FittedMap& map : fitted.maps) EXPECT_TRUE(math::isFinite(map.clipFromWorld));
        if (s.scene.empty()) {
            EXPECT_TRUE(fitted.maps.empty());
        }
    }
}

TEST_P(EveryFit, WhatNobodySeesHasNoMap) {
    Situation s = randomSituation(chance, kind());
    s.views.clear();
    EXPECT_TRUE(s.fitted(info()).maps.empty());
    // Looking away from the scene.
    const dvec3 eye = s.scene.max + dvec3{10.0};
    s.views.push_back({.clipFromEye = math::perspective(0.5, 1.0, 0.1, 1e4),
                       .eyeFromWorld = math::lookAt(eye, eye + dvec3{1.0}, {0.0, 1.0, 0.0})});
    EXPECT_TRUE(s.fitted(info()).maps.empty());
}

TEST_P(EveryFit, AViewThatIsNotFiniteIsSkipped) {
    Situation s = randomSituation(chance, kind());
    const Fitted expected = s.fitted(info());
    math::View broken = s.views[0];
    broken.clipFromEye[0][0] = std::numeric_limits<double>::quiet_NaN();
    s.views.insert(s.views.begin(), broken);
    const Fitted found = s.fitted(info());
    ASSERT_EQ(found.maps.size(), expected.maps.size());
    for (std::size_t i = 0; i < found.maps.size(); ++i)
        EXPECT_EQ(found.maps[i].clipFromWorld, expected.maps[i].clipFromWorld);
    s.views = {broken};
    EXPECT_TRUE(s.fitted(info()).maps.empty());
}

std::string caseName(const testing::TestParamInfo<Case>& info) {
    const auto& [fit, kind, seed] = info.param;
    return std::string{fits()[fit].name} +
           (kind == LightKind::directional ? "_directional_" : "_spot_") + std::to_string(seed);
}

INSTANTIATE_TEST_SUITE_P(All, EveryFit,
                         testing::Combine(testing::Range(std::size_t{0}, fits().size()),
                                          testing::Values(LightKind::directional, LightKind::spot),
                                          testing::Range(0U, 4U)),
                         caseName);

TEST(StandardFit, AParallelLightsRectangleIsTheSmallest) {
    Chance chance{9};
    const auto& info = *std::find_if(fits().begin(), fits().end(),
                                     [](const FitInfo& i) { return i.name == "std"; });
    int tried = 0;
    for (int round = 0; round < 60; ++round) {
        const Situation s = randomSituation(chance, LightKind::directional);
        const auto points = s.receiverPoints();
        const Fitted fitted = s.fitted(info, 65536);
        if (points.empty() || fitted.maps.empty()) continue;
        // Extents of the map in metres, from the rows of its matrix.
        const dmat4 rows = glm::transpose(fitted.maps[0].clipFromWorld);
        const double width = 2.0 / glm::length(dvec3{rows[0]});
        const double height = 2.0 / glm::length(dvec3{rows[1]});
        const dvec3 u = glm::normalize(dvec3{rows[0]});
        const dvec3 v = glm::normalize(dvec3{rows[1]});
        EXPECT_NEAR(glm::dot(u, v), 0.0, 1e-9);
        EXPECT_NEAR(glm::dot(u, s.light.direction), 0.0, 1e-9);
        double smallest = std::numeric_limits<double>::infinity();
        for (int step = 0; step < 900; ++step) {
            const double angle = step * std::numbers::pi / 1800.0;
            const dvec3 a = u * std::cos(angle) + v * std::sin(angle);
            const dvec3 b = v * std::cos(angle) - u * std::sin(angle);
            dvec2 low{std::numeric_limits<double>::infinity()};
            dvec2 high = -low;
            for (const dvec3& p : points) {
                const dvec2 q{glm::dot(p, a), glm::dot(p, b)};
                low = glm::min(low, q);
                high = glm::max(high, q);
            }
            smallest = std::min(smallest, (high.x - low.x) * (high.y - low.y));
        }
        ++tried;
        EXPECT_LE(width * height, smallest * 1.001 + 1e-12);
    }
    EXPECT_GT(tried, 20);
}

TEST(StandardFit, ASpotsMapIsCutToWhatIsSeen) {
    const auto& info = *std::find_if(fits().begin(), fits().end(),
                                     [](const FitInfo& i) { return i.name == "std"; });
    Situation s;
    s.scene = {.min = {-10.0, 0.0, -10.0}, .max = {10.0, 0.1, 10.0}};
    s.light = {.kind = LightKind::spot, .position = {0.0, 10.0, 0.0}, .halfAngle = 0.7};
    const auto texels = [&](double fovy) {
        s.views = {{.clipFromEye = math::perspective(fovy, 1.0, 0.1, 100.0),
                    .eyeFromWorld = math::lookAt({0.0, 12.0, 0.0}, {3.0, 0.0, 0.0}, {0, 0, -1})}};
        const Fitted fitted = s.fitted(info);
        EXPECT_EQ(fitted.maps.size(), 1U);
        const auto a = inMap(fitted.maps[0], {3.0, 0.0, 0.0});
        const auto b = inMap(fitted.maps[0], {3.01, 0.0, 0.0});
        return glm::length(dvec2{b} - dvec2{a});
    };
    EXPECT_GT(texels(0.1), 4.0 * texels(1.0)) << "a narrow view gets finer texels";
}

TEST(CascadedFit, SharesTheTexelsOfOneMapAmongAsManyAsAskedFor) {
    const auto& info = *std::find_if(fits().begin(), fits().end(),
                                     [](const FitInfo& i) { return i.name == "csm"; });
    Situation s;
    s.scene = {.min = {-100.0, 0.0, -100.0}, .max = {100.0, 0.0, 100.0}};
    s.light = {.direction = glm::normalize(dvec3{0.4, -1.0, 0.3})};
    s.views = {{.clipFromEye = math::perspective(1.0, 1.5, 0.1, 300.0),
                .eyeFromWorld = math::lookAt({0.0, 2.0, 90.0}, {0.0, 0.0, 0.0}, {0, 1, 0})}};
    double nearest = 0.0;
    for (int cascades = 2; cascades <= 8; ++cascades) {
        s.settings.cascades = cascades;
        const Fitted fitted = s.fitted(info, 1024);
        EXPECT_FALSE(fitted.degenerate) << cascades;
        EXPECT_GE(fitted.maps.size(), 2U) << cascades;
        EXPECT_LE(fitted.maps.size(), static_cast<std::size_t>(cascades));
        EXPECT_LE(fitted.mapSize * fitted.mapSize * cascades, 1024 * 1024) << cascades;
        // The ground in front of the eye is in the first map, at a texel of centimetres.
        const dvec3 place{0.0, 0.0, 86.0};
        const auto a = inMap(fitted.maps[0], place);
        ASSERT_TRUE(inside(a)) << cascades;
        const auto b = inMap(fitted.maps[0], place + dvec3{0.01, 0.0, 0.0});
        const double density = glm::length(dvec2{b} - dvec2{a}) * fitted.mapSize;
        if (cascades > 2) {
            EXPECT_GT(density, nearest * 0.6) << "more maps, no coarser near the eye";
        }
        nearest = density;
    }
}

}  // namespace
}  // namespace gnomon::shadow_fit

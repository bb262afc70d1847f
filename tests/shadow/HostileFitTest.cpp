// Fits of inputs that nobody should make: not a number, infinite, denormal, coincident, flat, tiny
// and huge. A failure names its seed; each seed is a situation of its own.
#include <gnomon/shadow_fit/Fit.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "Chance.h"

namespace gnomon::shadow_fit {
namespace {

using math::dmat4;
using math::dvec3;
using math::dvec4;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr std::array hostileValues{std::numeric_limits<double>::quiet_NaN(),
                                   infinite,
                                   -infinite,
                                   0.0,
                                   -0.0,
                                   std::numeric_limits<double>::denorm_min(),
                                   -1e-310,
                                   1e-200,
                                   1e-30,
                                   1e30,
                                   -1e200,
                                   std::numeric_limits<double>::max(),
                                   std::numeric_limits<double>::lowest(),
                                   -1.0,
                                   1.0};

struct Spoiled {
    LightShape light = {};
    std::vector<math::View> views = {};
    std::vector<math::Box> boxes = {};
    std::vector<Sample> moreSamples = {};
    FitSettings settings = {};
    int mapSize = 1024;
    double size = 0.0;  ///< metres, about
};

class Maker {
public:
    explicit Maker(unsigned seed) : chance_{seed} {}

    Spoiled make(LightKind kind) {
        // Metres, or what an application in another unit makes of them.
        scale_ = chance_.one(4) == 0 ? std::pow(10.0, chance_.between(-12.0, 12.0)) : 1.0;
        Spoiled s;
        s.size = 20.0 * scale_;
        for (int i = 1 + chance_.one(6); i > 0; --i) {
            math::Box box;
            for (int corner = 0; corner < 2; ++corner) box.add(place());
            s.boxes.push_back(box);
        }
        const dvec3 eye = place() * 2.0;
        s.views.push_back(
            {.clipFromEye =
                 math::perspective(chance_.between(0.3, 1.8), 1.3, 1e-3 * scale_, 50.0 * scale_),
             .eyeFromWorld = math::lookAt(eye, s.boxes[0].centre(), {0.0, 1.0, 0.0})});
        s.light.kind = kind;
        s.light.direction = chance_.direction();
        s.light.position = place() * 2.0;
        s.light.halfAngle = chance_.between(0.05, 1.4);
        for (int i = 1 + chance_.one(3); i > 0; --i) spoil(s);
        return s;
    }

private:
    dvec3 place() { return chance_.point(dvec3{-10.0}, dvec3{10.0}) * scale_; }
    double hostile() {
        return hostileValues[static_cast<std::size_t>(
            chance_.one(static_cast<int>(hostileValues.size())))];
    }
    math::Box& oneBox(Spoiled& s) {
        if (s.boxes.empty()) s.boxes.push_back({.min = place() - dvec3{scale_}, .max = place()});
        return s.boxes[static_cast<std::size_t>(chance_.one(static_cast<int>(s.boxes.size())))];
    }
    void spoil(Spoiled& s) {
        switch (chance_.one(20)) {
            case 0:
                s.views[0].clipFromEye[chance_.one(4)][chance_.one(4)] = hostile();
                break;
            case 1:
                s.views[0].eyeFromWorld[chance_.one(4)][chance_.one(4)] = hostile();
                break;
            case 2:
                s.light.direction[chance_.one(3)] = hostile();
                break;
            case 3:
                s.light.direction = dvec3{hostile(), hostile(), hostile()};
                break;
            case 4:
                s.light.position[chance_.one(3)] = hostile();
                break;
            case 5:
                (chance_.coin() ? s.light.halfAngle : s.light.range) = hostile();
                break;
            case 6:
                (chance_.coin() ? oneBox(s).min : oneBox(s).max)[chance_.one(3)] = hostile();
                break;
            case 7:
                oneBox(s).max = oneBox(s).min;
                break;
            case 8:  // flat, and a line where it was flat
                for (math::Box& box : s.boxes) {
                    const int axis = chance_.one(3);
                    box.max[axis] = box.min[axis];
                }
                break;
            case 9:
                s.light.direction = (chance_.coin() ? -1.0 : 1.0) *
                                    dvec3{glm::transpose(s.views[0].eyeFromWorld)[2]};
                break;
            case 10:
                s.light.position = s.views[0].eyeWorld();
                break;
            case 11:
                s.light.position = oneBox(s).centre();
                break;
            case 12:
                s.boxes.assign(8, oneBox(s));
                break;
            case 13:
                s.boxes.clear();
                break;
            case 14:
                s.moreSamples.push_back(
                    {.world = {hostile(), hostile(), hostile()}, .weight = hostile()});
                break;
            case 15:
                s.mapSize =
                    std::array{-1, 0, 1, 16, 17, 65536}[static_cast<std::size_t>(chance_.one(6))];
                s.settings = {.range = hostile(), .cascades = chance_.one(200) - 100};
                break;
            case 16:
                std::swap(oneBox(s).min, oneBox(s).max);
                break;
            case 17: {  // a ground without an end
                const double level = place().y;
                s.boxes.push_back(
                    {.min = {-infinite, level, -infinite}, .max = {infinite, level, infinite}});
                break;
            }
            case 18: {  // all of it far away
                const dvec3 by = chance_.direction() * std::pow(10.0, chance_.between(3.0, 9.0));
                for (math::Box& box : s.boxes) box = {.min = box.min + by, .max = box.max + by};
                for (math::View& view : s.views) {
                    dmat4 back{1.0};
                    back[3] = dvec4{-by, 1.0};
                    view.eyeFromWorld = view.eyeFromWorld * back;
                }
                s.light.position += by;
                break;
            }
            default:
                s.views.push_back(
                    {.clipFromEye = dmat4{hostile()}, .eyeFromWorld = s.views[0].eyeFromWorld});
                break;
        }
    }

    Chance chance_;
    double scale_ = 1.0;
};

/// What the test itself knows of lights.
bool directed(const LightShape& light) {
    return math::isFinite(light.direction) && light.direction != dvec3{0.0};
}
bool placed(const LightShape& light) {
    return light.kind == LightKind::directional ||
           glm::all(glm::lessThanEqual(glm::abs(light.position), dvec3{farthestPlace}));
}

bool looksAt(const math::View& view, const dvec3& p) {
    const dvec4 c = view.clipFromWorld() * dvec4{p, 1.0};
    const double most = 0.9999 * c.w;
    return std::abs(c.x) <= most && std::abs(c.y) <= most && c.z >= 1e-7 * c.w && c.z <= most;
}

bool reached(const LightShape& light, const dvec3& p) {
    if (light.kind == LightKind::directional) return true;
    const dvec3 way = p - light.position;
    const double distance = glm::length(way);
    if (light.range > 0.0 && distance > 0.999 * light.range) return false;
    const double angle = std::min(light.halfAngle, 1.48) * 0.999;
    return distance > 0.0 && glm::dot(way, light.direction) >
                                 distance * glm::length(light.direction) * std::cos(angle);
}

/// A point that a view sees of a box, if it finds one.
std::optional<dvec3> seenOf(const math::Box& box, const math::View& view, Chance& chance) {
    const dmat4 worldFromClip = math::inverted(view.clipFromWorld());
    const auto inView = [&] {
        const dvec4 p = worldFromClip * dvec4{chance.between(-1.0, 1.0), chance.between(-1.0, 1.0),
                                              std::pow(10.0, chance.between(-6.0, 0.0)), 1.0};
        return p.w != 0.0 ? dvec3{p} / p.w : dvec3{infinite};
    };
    dvec3 p = inView();
    for (int axis = 0; axis < 3; ++axis) {
        if (box.min[axis] != box.max[axis]) continue;
        const dvec3 q = inView();
        const double share = (box.min[axis] - p[axis]) / (q[axis] - p[axis]);
        if (!(share > 0.0 && share < 1.0)) return {};
        p += (q - p) * share;
        p[axis] = box.min[axis];
    }
    const bool in =
        glm::all(glm::greaterThanEqual(p, box.min)) && glm::all(glm::lessThanEqual(p, box.max));
    if (in && looksAt(view, p)) return p;
    if (!isPlace(box.min) || !isPlace(box.max)) return {};
    p = box.min + (box.max - box.min) * chance.point(dvec3{0.0}, dvec3{1.0});
    p = glm::clamp(p, box.min, box.max);
    if (!looksAt(view, p)) return {};
    return p;
}

/// Whether a map has a point; rounding of what the point's numbers are like is let through.
bool holds(const FittedMap& map, const dvec3& p) {
    const dmat4& m = map.clipFromWorld;
    const dvec4 clip = m * dvec4{p, 1.0};
    if (!(clip.w > 0.0)) return false;
    const dvec4 size =
        glm::abs(m[0] * p.x) + glm::abs(m[1] * p.y) + glm::abs(m[2] * p.z) + glm::abs(m[3]);
    const dvec4 slack = size * 1e-12;
    return std::abs(clip.x) <= clip.w + slack.x && std::abs(clip.y) <= clip.w + slack.y &&
           clip.z >= -slack.z;
}

std::string described(const Spoiled& s) {
    std::ostringstream text;
    const auto put = [&](const dvec3& p) {
        text << " (" << p.x << ' ' << p.y << ' ' << p.z << ')';
    };
    text << "\nlight direction, position:";
    put(s.light.direction);
    put(s.light.position);
    text << " half angle " << s.light.halfAngle << " range " << s.light.range << "\nboxes:";
    for (const math::Box& box : s.boxes) {
        put(box.min);
        put(box.max);
    }
    for (const math::View& view : s.views)
        for (const dmat4* m : {&view.clipFromEye, &view.eyeFromWorld}) {
            text << "\nmatrix, columns:";
            for (int column = 0; column < 4; ++column) {
                put(dvec3{(*m)[column]});
                text << ' ' << (*m)[column].w;
            }
        }
    return text.str();
}

class HostileFit : public testing::TestWithParam<std::size_t> {};

TEST_P(HostileFit, MapsAreFiniteAndHoldWhatIsSeen) {
    constexpr unsigned situations = 6000;
    int judged = 0;
    int maps = 0;
    for (unsigned seed = 0; seed < situations; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Spoiled s =
            Maker{seed}.make(seed % 2 == 0 ? LightKind::directional : LightKind::spot);
        math::BoxTree tree;
        tree.build(s.boxes);
        const auto usable = usableLight(s.light);
        EXPECT_EQ(usable.has_value(), directed(s.light) && placed(s.light));
        Receivers seen;
        for (const math::View& view : s.views) seen.add(view, usable ? &*usable : nullptr, tree);
        auto samples = samplePicture(s.views, {.tree = tree}, 8);
        samples.insert(samples.end(), s.moreSamples.begin(), s.moreSamples.end());
        if (usable) weigh(samples, *usable, {.tree = tree});
        const Fitted made = fitted(fits()[GetParam()], {.light = s.light,
                                                        .views = s.views,
                                                        .receivers = seen,
                                                        .samples = samples,
                                                        .scene = tree.bounds(),
                                                        .mapSize = s.mapSize,
                                                        .settings = s.settings});
        for (const dvec3& p : seen.points()) ASSERT_TRUE(math::isFinite(p));
        for (const FittedMap& map : made.maps) {
            ++maps;
            for (int column = 0; column < 4; ++column)
                for (int row = 0; row < 4; ++row)
                    ASSERT_LE(std::abs(map.clipFromWorld[column][row]),
                              std::numeric_limits<float>::max())
                        << column << " " << row;
        }
        if (seen.empty()) {
            ASSERT_TRUE(made.maps.empty());
            ASSERT_FALSE(made.degenerate);
        } else if (made.maps.empty()) {
            ASSERT_TRUE(made.degenerate)
                << "what is seen has no map, and nothing says so" << described(s);
            ASSERT_FALSE(usable.has_value()) << "a light like any other has no map" << described(s);
        }
        // So far off, rounding has more of a say in where a spot is than the scene's size.
        if (!usable || !(glm::length(usable->position) < 1e12 * s.size)) continue;
        Chance chance{seed};
        for (const math::View& view : s.views) {
            if (!view.usable()) continue;
            for (int i = 0; i < 60; ++i) {
                if (s.boxes.empty()) break;
                const auto& box =
                    s.boxes[static_cast<std::size_t>(chance.one(static_cast<int>(s.boxes.size())))];
                if (box.empty()) continue;
                const auto p = seenOf(box, view, chance);
                if (!p || !(glm::length(*p) < 1e25) || !reached(*usable, *p)) continue;
                ++judged;
                ASSERT_TRUE(std::any_of(made.maps.begin(), made.maps.end(),
                                        [&](const FittedMap& map) { return holds(map, *p); }))
                    << "no map has " << p->x << ", " << p->y << ", " << p->z << described(s);
            }
        }
        // What the fitter does before it fits.
        if (seen.empty()) continue;
        seen.mayBeShadowed(*usable, tree);
        seen.dropUnshadowed(*usable, tree);
        const LightShape spot = spotThatSees(*usable, seen.points());
        ASSERT_TRUE(math::isFinite(spot.direction) && std::isfinite(spot.halfAngle));
    }
    EXPECT_GT(judged, 20000) << "the test tested little";
    EXPECT_GT(maps, 1000);
}

INSTANTIATE_TEST_SUITE_P(All, HostileFit, testing::Range(std::size_t{0}, fits().size()),
                         [](const auto& info) { return std::string{fits()[info.param].name}; });

}  // namespace
}  // namespace gnomon::shadow_fit

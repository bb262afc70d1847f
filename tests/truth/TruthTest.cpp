// The reference against closed formulas: a sphere and a box over a plane.
#include <gnomon/scene/Types.h>
#include <gnomon/shadow_fit/ShadowFitter.h>
#include <gnomon/truth/Truth.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace gnomon::truth {
namespace {

using math::dvec2;
using math::dvec3;
using math::vec3;
using namespace scene;

template <class T>
field::Payload payloadOf(const std::vector<T>& items) {
    return field::Payload::of(std::span<const T>{items});
}

class TruthTest : public testing::Test {
protected:
    static field::TypeRegistry sceneTypes() {
        field::TypeRegistry types;
        addTypes(types);
        return types;
    }
    void add(const std::vector<std::array<float, 3>>& positions,
             const std::vector<std::uint32_t>& indices, const Node* below = nullptr) {
        const auto made = makeNode<Geometry>(aspect, "mesh");
        edit(below == nullptr ? root : *below)->addChild(made.node);
        vec3 low{1e9F};
        vec3 high{-1e9F};
        for (const auto& p : positions) {
            low = glm::min(low, vec3{p[0], p[1], p[2]});
            high = glm::max(high, vec3{p[0], p[1], p[2]});
        }
        auto e = edit(made.core);
        e->positions = payloadOf(positions);
        e->indices = payloadOf(indices);
        e->chunks.assign({Chunk{
            .indexCount = static_cast<std::uint32_t>(indices.size()), .min = low, .max = high}});
        e->boundsMin = low;
        e->boundsMax = high;
    }
    void ground() {
        add({{-20, 0, 20}, {20, 0, 20}, {20, 0, -20}, {-20, 0, -20}}, {0, 1, 2, 0, 2, 3});
    }
    void box(const vec3& a, const vec3& b) {
        add({{a.x, a.y, a.z},
             {b.x, a.y, a.z},
             {b.x, b.y, a.z},
             {a.x, b.y, a.z},
             {a.x, a.y, b.z},
             {b.x, a.y, b.z},
             {b.x, b.y, b.z},
             {a.x, b.y, b.z}},
            {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
             3, 7, 6, 3, 6, 2, 0, 4, 7, 0, 7, 3, 1, 2, 6, 1, 6, 5});
    }
    void sphere(const vec3& centre, float radius, int segments) {
        std::vector<std::array<float, 3>> positions;
        std::vector<std::uint32_t> indices;
        const int rings = segments / 2;
        for (int r = 0; r <= rings; ++r)
            for (int s = 0; s < segments; ++s) {
                const float a =
                    std::numbers::pi_v<float> * static_cast<float>(r) / static_cast<float>(rings);
                const float b = 2 * std::numbers::pi_v<float> * static_cast<float>(s) /
                                static_cast<float>(segments);
                positions.push_back({centre.x + radius * std::sin(a) * std::cos(b),
                                     centre.y + radius * std::cos(a),
                                     centre.z + radius * std::sin(a) * std::sin(b)});
            }
        const auto at = [&](int r, int s) {
            return static_cast<std::uint32_t>(r * segments + s % segments);
        };
        for (int r = 0; r < rings; ++r)
            for (int s = 0; s < segments; ++s)
                indices.insert(indices.end(), {at(r, s), at(r + 1, s), at(r, s + 1), at(r, s + 1),
                                               at(r + 1, s), at(r + 1, s + 1)});
        add(positions, indices);
    }
    /// Straight down on [-4, 4]^2.
    static constexpr int size = 400;
    math::View topView() const {
        return {.clipFromEye = math::orthographic({-4.0, -4.0, -40.0}, {4.0, 4.0, 0.0}),
                .eyeFromWorld = math::lookAt({0.0, 20.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0})};
    }
    static dvec3 placeOf(int x, int y) {
        return {(x + 0.5) / size * 8.0 - 4.0, 0.0, (y + 0.5) / size * 8.0 - 4.0};
    }
    Truth trace(const shadow_fit::LightShape& light, int samples = 1) {
        FlatScene flat{aspect};
        flat.update(Ref<Node>{root}, {}, {});
        RayScene rays{aspect};
        rays.update(flat, dvec3{0.0});
        return shadowTruth(rays, topView(), light,
                           {.width = size, .height = size, .samples = samples});
    }
    /// Pixels of the ground whose factor is off by more than a tolerance.
    template <class Expected>
    int different(const Truth& truth, double tolerance, Expected&& expected) {
        int count = 0;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const auto found = truth.factor.pixels[static_cast<std::size_t>(y * size + x)];
                const auto right = expected(placeOf(x, y));
                if (!right || found == noSurface) continue;
                count += std::abs(found / 255.0 - *right) > tolerance ? 1 : 0;
            }
        return count;
    }

    field::TypeRegistry types = sceneTypes();
    field::Aspect aspect{types, 1};
    const Node& root = aspect.create<Node>();
};

TEST_F(TruthTest, ABoxsShadowFromASun) {
    ground();
    box({-1.0F, 1.0F, -1.0F}, {1.0F, 2.0F, 1.0F});
    const dvec3 direction = glm::normalize(dvec3{0.5, -1.0, 0.25});
    const auto truth = trace({.direction = direction});
    const int wrong = different(truth, 0.5, [&](const dvec3& p) -> std::optional<double> {
        if (std::abs(p.x) < 1.0 && std::abs(p.z) < 1.0) return {};  // the box is seen there
        // Slabs along the ray to the sun.
        double enter = 0.0;
        double leave = 1e9;
        const math::Box b{.min = {-1.0, 1.0, -1.0}, .max = {1.0, 2.0, 1.0}};
        for (int i = 0; i < 3; ++i) {
            const double s = (b.min[i] - p[i]) / -direction[i];
            const double t = (b.max[i] - p[i]) / -direction[i];
            enter = std::max(enter, std::min(s, t));
            leave = std::min(leave, std::max(s, t));
        }
        return enter < leave ? 0.0 : 1.0;
    });
    EXPECT_LE(wrong, 2);
    EXPECT_GT(truth.counted, 100000U);
}

TEST_F(TruthTest, ASpheresShadowFromASpot) {
    ground();
    sphere({0.5F, 2.0F, 0.0F}, 0.8F, 400);
    const shadow_fit::LightShape spot{.kind = shadow_fit::LightKind::spot,
                                      .position = {-1.0, 6.0, 0.5},
                                      .direction = glm::normalize(dvec3{0.2, -1.0, 0.0}),
                                      .halfAngle = 0.5};
    const auto truth = trace(spot);
    const dvec3 centre{0.5, 2.0, 0.0};
    const int wrong = different(truth, 0.5, [&](const dvec3& p) -> std::optional<double> {
        if (glm::length(dvec2{p.x - 0.5, p.z}) < 0.81) return {};
        const dvec3 way = spot.position - p;
        if (glm::dot(-way, spot.direction) < std::cos(0.5) * glm::length(way)) return 0.0;
        const double t = glm::dot(centre - p, way) / glm::dot(way, way);
        return glm::length(p + way * t - centre) < 0.8 ? 0.0 : 1.0;
    });
    // The mesh's chords lie up to 5e-5 m inside the ball.
    EXPECT_LE(wrong, 12);
}

TEST_F(TruthTest, TheHalfShadowOfAnEdgeUnderASunWithADisk) {
    ground();
    // A wide roof whose edge lies along z at x = 0, two metres up.
    box({-19.0F, 2.0F, -19.0F}, {0.0F, 2.1F, 19.0F});
    const double angle = 0.15;
    const auto truth = trace({.direction = {0.0, -1.0, 0.0}, .extent = angle}, 256);
    int counted = 0;
    const int wrong = different(truth, 0.03, [&](const dvec3& p) -> std::optional<double> {
        if (p.x < 0.0) return {};  // under the roof, from above not seen
        ++counted;
        // Of the sun's disk the part beyond a chord is hidden; of a small disk by area, exactly so
        // for directions by solid angle only in the limit.
        const double chord = std::atan2(p.x, 2.1) / angle;  // its upper edge
        if (chord >= 1.0) return 1.0;
        return 1.0 - (std::acos(chord) - chord * std::sqrt(1.0 - chord * chord)) / std::numbers::pi;
    });
    EXPECT_GT(counted, 1000);
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(truth.penumbra, 1000U);
    EXPECT_LT(truth.largestWidth, 0.07);
    EXPECT_GT(truth.rootMeanWidth, 0.0);
}

TEST_F(TruthTest, AFactorThatWouldRoundTo128IsWritten127) {
    ground();
    box({-19.0F, 2.0F, -19.0F}, {0.0F, 2.1F, 19.0F});
    const auto truth = trace({.direction = {0.0, -1.0, 0.0}, .extent = 0.3}, 256);
    std::uint64_t surfaces = 0;
    for (const auto value : truth.factor.pixels) surfaces += value != noSurface ? 1U : 0U;
    EXPECT_EQ(surfaces, truth.counted);
    EXPECT_EQ(surfaces, static_cast<std::uint64_t>(size) * size) << "all of it faces the sun";
}

TEST_F(TruthTest, WhatFacesAwayOrIsNotThereIs128) {
    box({-1.0F, 1.0F, -1.0F}, {1.0F, 2.0F, 1.0F});
    const auto below = trace({.direction = {0.0, 1.0, 0.0}});
    EXPECT_EQ(below.counted, 0U);
    const auto above = trace({.direction = {0.0, -1.0, 0.0}});
    EXPECT_EQ(above.counted, static_cast<std::uint64_t>(size / 4) * (size / 4));
}

TEST_F(TruthTest, InstancesFollowTheirTransforms) {
    ground();
    const auto place = makeNode<Transform>(aspect, "place");
    edit(root)->addChild(place.node);
    add({{-0.5F, 2, -0.5F}, {0.5F, 2, -0.5F}, {0.5F, 2, 0.5F}, {-0.5F, 2, 0.5F}},
        {0, 1, 2, 0, 2, 3}, &place.node);
    FlatScene flat{aspect};
    RayScene rays{aspect};
    flat.update(Ref<Node>{root}, {}, {});
    rays.update(flat, dvec3{0.0});
    const dvec3 up{0.0, 1.0, 0.0};
    EXPECT_TRUE(rays.blocked({0.0, 0.5, 0.0}, up, 10.0));
    EXPECT_FALSE(rays.blocked({3.0, 0.5, 0.0}, up, 10.0));
    edit(place.core)->matrix = math::Affine{.translation = {3.0, 0.0, 0.0}};
    aspect.commit();
    field::Applied applied;
    applied.changed.push_back({.id = place.core.id(), .mask = ~field::Mask{0}});
    flat.update(Ref<Node>{root}, {}, applied);
    ASSERT_FALSE(flat.rebuilt());
    rays.update(flat, dvec3{0.0});
    EXPECT_FALSE(rays.blocked({0.0, 0.5, 0.0}, up, 10.0));
    EXPECT_TRUE(rays.blocked({3.0, 0.5, 0.0}, up, 10.0));
    // Another origin: the same scene.
    rays.update(flat, dvec3{3.0, 0.0, 0.0});
    EXPECT_TRUE(rays.blocked({0.0, 0.5, 0.0}, up, 10.0));
}

TEST_F(TruthTest, AMaskedCasterLetsLightThroughItsHoles) {
    ground();
    const auto& texture = aspect.create<Texture>();
    {
        // Left half opaque, right half clear.
        std::vector<std::array<std::uint8_t, 4>> pixels;
        for (int i = 0; i < 16 * 16; ++i)
            pixels.push_back({255, 255, 255, static_cast<std::uint8_t>(i % 16 < 8 ? 255 : 0)});
        auto e = edit(texture);
        e->pixels = payloadOf(pixels);
        e->size = glm::ivec2{16, 16};
        e->wrapS = Texture::Wrap::clamp;
    }
    const auto& material = aspect.create<PhongMaterial>();
    {
        auto e = edit(material);
        e->diffuseMap = texture;
        e->alpha = PhongMaterial::Alpha::mask;
        e->doubleSided = true;
    }
    const auto painted = makeNode<MaterialGroup>(aspect, "painted");
    edit(root)->addChild(painted.node);
    edit(painted.core)->material = Ref<Material>{material};
    add({{-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}}, {0, 1, 2, 0, 2, 3}, &painted.node);
    const auto& mesh = *aspect.get(Ref<Geometry>{aspect.get(painted.node.children()[0])->core->id});
    const std::vector<std::array<float, 2>> coords{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    edit(mesh)->texCoords = payloadOf(coords);
    // From the side, so that the shadow is not under the plate: moved by 2 m.
    const auto truth = trace({.direction = glm::normalize(dvec3{1.0, -1.0, 0.0})});
    const auto at = [&](double x, double z) {
        const auto column = static_cast<int>((x + 4.0) / 8.0 * size);
        const auto row = static_cast<int>((z + 4.0) / 8.0 * size);
        return truth.factor.pixels[static_cast<std::size_t>(row * size + column)];
    };
    EXPECT_EQ(at(1.5, 0.0), 0) << "under its opaque half";
    EXPECT_EQ(at(2.5, 0.0), 255) << "under its clear half";
}

}  // namespace
}  // namespace gnomon::truth

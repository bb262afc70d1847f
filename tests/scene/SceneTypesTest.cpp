// The types of a scene, as containers.
#include <gnomon/scene/Window.h>

#include <random>

#include "SceneFixture.h"

namespace gnomon::scene {
namespace {

class SceneTypes : public SceneTest {};

TEST_F(SceneTypes, EveryTypeTravelsWithItsDefaults) {
    const auto schema = types.schema();
    ASSERT_FALSE(schema.empty());
    field::Reader from{schema};
    const auto count = from.scalar<std::uint32_t>();
    EXPECT_GT(count, 20U);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::string name = from.string();
        const field::TypeInfo* type = types.find(field::typeIdOf(name));
        ASSERT_NE(type, nullptr) << name;
        const auto& made = source.create(*type);
        exchange();
        const auto* copy = replica.find(made.id());
        ASSERT_NE(copy, nullptr) << name;
        EXPECT_TRUE(field::sameFields(made, *copy)) << name;
        EXPECT_NE(field::print(made).find(name), std::string::npos);
        const auto fields = from.scalar<std::uint32_t>();
        for (std::uint32_t k = 0; k < fields; ++k) {
            from.string();
            from.string();
            from.scalar<std::uint8_t>();
        }
    }
    EXPECT_EQ(source.digest(), replica.digest());
}

TEST_F(SceneTypes, AChangeOfOneTransformCostsAtMost96Bytes) {
    const auto made = makeNode<Transform>(source, "moved");
    exchange();
    edit(made.core)->matrix = math::Affine{.translation = {1.0, 2.0, 3.0}};
    const auto list = source.commit();
    EXPECT_LE(list.bytes.size(), 96U);
    EXPECT_EQ(list.bytes.size(), 13U + 12U + 60U);
}

TEST_F(SceneTypes, ALargeTranslationTravelsExactly) {
    const auto made = makeNode<Transform>(source, "far");
    edit(made.core)->matrix = math::Affine{.translation = {6378137.0000001, -1e-7, 1e12 + 0.125}};
    exchange();
    EXPECT_EQ(copyOf(made.core)->matrix.get(), made.core.matrix.get());
}

TEST_F(SceneTypes, CorruptScenesAreRefusedOrSound) {
    const Node& top = node("top");
    for (int i = 0; i < 12; ++i) {
        const auto made = makeNode<Transform>(source, "t");
        edit(made.core)->matrix = math::Affine{.translation = math::dvec3{i * 1.0}};
        edit(i % 3 == 0 ? top : *source.get(top.children()[0]))->addChild(made.node);
        const Node& leaf = node("leaf");
        edit(leaf)->core = unitBox();
        edit(made.node)->addChild(leaf);
    }
    const auto light = makeNode<SpotLight>(source, "lamp");
    edit(top)->addChild(light.node);
    const auto whole = source.commit();
    for (unsigned seed = 0; seed < 3000; ++seed) {
        std::mt19937 random{seed};
        auto broken = whole;
        for (int i = 0; i < 2; ++i)
            broken.bytes[random() % broken.bytes.size()] = static_cast<std::byte>(random());
        field::Aspect aspect{types, 0};
        if (!aspect.apply(broken)) continue;
        // Whatever was taken in can be flattened.
        FlatScene flat{aspect};
        flat.update(Ref<Node>{top.id()}, {}, {});
        EXPECT_LE(flat.instances().size(), 24U);
    }
}

TEST(PixelRect, SharesMeetAndPixelsArePixels) {
    EXPECT_EQ(pixelRect({}, {640, 480}), (PixelRect{0, 0, 640, 480}));
    EXPECT_EQ(pixelRect({.left = 10.0, .bottom = 20.0, .width = 100.0, .height = 50.0}, {640, 480}),
              (PixelRect{10, 20, 100, 50}));
    for (const int width : {641, 1023, 7, 100}) {
        int edge = 0;
        for (int i = 0; i < 3; ++i) {
            const auto rect = pixelRect({.left = i / 3.0, .width = 1.0 / 3.0}, {width, 10});
            EXPECT_EQ(rect.x, edge) << "a gap or an overlap";
            edge = rect.x + rect.width;
        }
        EXPECT_EQ(edge, width);
    }
}

}  // namespace
}  // namespace gnomon::scene

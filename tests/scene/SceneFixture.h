#pragma once

#include <gnomon/field/Aspect.h>
#include <gnomon/scene/Camera.h>
#include <gnomon/scene/CameraView.h>
#include <gnomon/scene/FlatScene.h>
#include <gnomon/scene/Types.h>
#include <gtest/gtest.h>

#include <span>
#include <string>
#include <vector>

namespace gnomon::scene {

inline field::TypeRegistry sceneTypes() {
    field::TypeRegistry types;
    addTypes(types);
    return types;
}

/// Two aspects with the types of a scene: one that is edited, one that follows.
class SceneTest : public testing::Test {
protected:
    field::Applied exchange() {
        field::Applied applied;
        const auto result = replica.apply(source.commit(), &applied);
        EXPECT_TRUE(result.has_value()) << (result ? "" : result.error().text());
        return applied;
    }
    template <class T>
    const T* copyOf(const T& original) const {
        return replica.get(Ref<T>{original});
    }
    const Node& node(std::string name) {
        const Node& made = source.create<Node>();
        edit(made)->name = std::move(name);
        return made;
    }
    /// A box of one metre, as a geometry of one chunk.
    const Geometry& unitBox() {
        static constexpr float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1};
        static constexpr std::uint32_t indices[] = {0, 1, 2, 1, 2, 3};
        const Geometry& geometry = source.create<Geometry>();
        auto e = edit(geometry);
        e->positions = Payload::of<float>(positions);
        e->indices = Payload::of<std::uint32_t>(indices);
        e->chunks.assign({Chunk{.indexCount = 6, .max = math::vec3{1.0F}}});
        e->boundsMax = math::vec3{1.0F};
        return geometry;
    }

    field::TypeRegistry types = sceneTypes();
    field::Aspect source{types, 1};
    field::Aspect replica{types, 0};
};

}  // namespace gnomon::scene

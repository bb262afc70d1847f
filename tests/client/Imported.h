#pragma once

#include <gnomon/client/Model.h>
#include <gnomon/scene/Light.h>
#include <gnomon/scene/Types.h>

#include <initializer_list>

namespace gnomon::client::test {

inline field::TypeRegistry sceneTypes() {
    field::TypeRegistry types;
    scene::addTypes(types);
    return types;
}

/// What an importer would hand over, made by hand.
class Importer {
public:
    explicit Importer(const field::TypeRegistry& types)
        : aspect{types, 0, true},
          root{scene::makeNode<scene::Group>(aspect, "file").node},
          result{aspect.create<scene::ImportedScene>()} {
        auto e = edit(result);
        e->source = "made.glb";
        e->root = root;
        e->boundsMin = math::dvec3{-1.0};
        e->boundsMax = math::dvec3{1.0, 3.0, 1.0};
    }

    const scene::DirectionalLight& addLight() {
        const auto light = scene::makeNode<scene::DirectionalLight>(aspect, "file's light");
        edit(root)->addChild(light.node);
        edit(result)->lights.pushBack(light.node);
        return light.core;
    }

    const scene::Transform& addMover() {
        const auto mover = scene::makeNode<scene::Transform>(aspect, "mover");
        edit(root)->addChild(mover.node);
        return mover.core;
    }

    const scene::Animation& addAnimation(float duration) {
        const auto& animation = aspect.create<scene::Animation>();
        edit(animation)->duration = duration;
        edit(result)->animations.pushBack(animation);
        return animation;
    }

    void addChannel(const scene::Animation& animation, const scene::Transform& target,
                    scene::AnimationChannel::Path path, std::initializer_list<float> times,
                    std::initializer_list<float> values) {
        const auto& channel = aspect.create<scene::AnimationChannel>();
        {
            auto e = edit(channel);
            e->target = target;
            e->path = path;
            e->times = field::Payload::of(std::span<const float>{times.begin(), times.size()});
            e->values = field::Payload::of(std::span<const float>{values.begin(), values.size()});
        }
        edit(animation)->channels.pushBack(channel);
    }

    field::ChangeList take() { return aspect.commit(); }

    field::Aspect aspect;
    const scene::Node& root;
    const scene::ImportedScene& result;
};

}  // namespace gnomon::client::test

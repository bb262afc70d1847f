#pragma once

#include <gnomon/scene/Camera.h>

namespace gnomon::scene {

/// One animated property of one node. Stays in the client, which plays it into transforms.
class AnimationChannel final : public Container<AnimationChannel> {
public:
    static constexpr std::string_view typeName = "AnimationChannel";
    static constexpr bool replicated = false;
    enum class Path { translation, rotation, scale, last = scale };
    enum class Interpolation { linear, step, cubicSpline, last = cubicSpline };

    Field<Ref<Transform>> target;
    Field<Path> path;
    Field<Interpolation> interpolation;
    Field<Payload> times;  ///< float seconds, strictly ascending, finite
    /// float: 3 a key (translation, scale) or 4 (rotation, quaternion x y z w); three times that
    /// for cubicSpline (in-tangent, value, out-tangent), as glTF's.
    Field<Payload> values;
    static constexpr auto fields() {
        return std::tuple{
            entry("target", &AnimationChannel::target), entry("path", &AnimationChannel::path),
            entry("interpolation", &AnimationChannel::interpolation),
            entry("times", &AnimationChannel::times), entry("values", &AnimationChannel::values)};
    }
};

/// The resting pose of an animated transform, for the properties no channel writes.
class AnimationPose final : public Container<AnimationPose> {
public:
    static constexpr std::string_view typeName = "AnimationPose";
    static constexpr bool replicated = false;
    Field<Ref<Transform>> target;
    Field<math::dvec3> translation;
    Field<math::vec4> rotation{math::vec4{0.0F, 0.0F, 0.0F, 1.0F}};  ///< quaternion x y z w
    Field<math::vec3> scale{math::vec3{1.0F}};
    static constexpr auto fields() {
        return std::tuple{entry("target", &AnimationPose::target),
                          entry("translation", &AnimationPose::translation),
                          entry("rotation", &AnimationPose::rotation),
                          entry("scale", &AnimationPose::scale)};
    }
};

class Animation final : public Container<Animation> {
public:
    static constexpr std::string_view typeName = "Animation";
    static constexpr bool replicated = false;
    Field<std::string> name;
    Field<float> duration;  ///< seconds, the largest key
    MultiField<Ref<AnimationChannel>> channels;
    static constexpr auto fields() {
        return std::tuple{entry("name", &Animation::name), entry("duration", &Animation::duration),
                          entry("channels", &Animation::channels)};
    }
};

/// What an importer hands over: exactly one in its change list.
class ImportedScene final : public Container<ImportedScene> {
public:
    static constexpr std::string_view typeName = "ImportedScene";
    static constexpr bool replicated = false;
    Field<std::string> source;  ///< the file's name
    Field<Ref<Node>> root;
    MultiField<Ref<Animation>> animations;
    MultiField<Ref<AnimationPose>> poses;
    MultiField<Ref<PerspectiveCamera>> cameras;  ///< with their beacons
    MultiField<Ref<Node>> lights;                ///< nodes whose core is a light
    MultiField<std::string> warnings;            ///< what was left out, and why
    Field<math::dvec3> boundsMin;  ///< of everything drawn, world space; min > max: nothing
    Field<math::dvec3> boundsMax;
    Field<std::uint64_t> trianglesDrawn;
    static constexpr auto fields() {
        return std::tuple{entry("source", &ImportedScene::source),
                          entry("root", &ImportedScene::root),
                          entry("animations", &ImportedScene::animations),
                          entry("poses", &ImportedScene::poses),
                          entry("cameras", &ImportedScene::cameras),
                          entry("lights", &ImportedScene::lights),
                          entry("warnings", &ImportedScene::warnings),
                          entry("boundsMin", &ImportedScene::boundsMin),
                          entry("boundsMax", &ImportedScene::boundsMax),
                          entry("trianglesDrawn", &ImportedScene::trianglesDrawn)};
    }
};

}  // namespace gnomon::scene

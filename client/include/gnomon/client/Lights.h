#pragma once

#include <gnomon/client/SceneTree.h>

#include <variant>

namespace gnomon::client {

/// `--sun`: parallel light.
struct Sun {
    math::dvec3 toward{0.0, 1.0, 0.0};  ///< direction toward the light, any length above 0
    double angle = 0.0;                 ///< angular radius of its disk, radians
    friend bool operator==(const Sun&, const Sun&) = default;
};

/// `--spot`
struct Spot {
    math::dvec3 position{0.0};
    math::dvec3 direction{0.0, -1.0, 0.0};  ///< where it shines, any length above 0
    double angle = 0.7853981633974483;      ///< full cone angle, radians, below pi
    double radius = 0.0;                    ///< of its disk, metres
    friend bool operator==(const Spot&, const Spot&) = default;
};

/// `--point`
struct Point {
    math::dvec3 position{0.0};
    double radius = 0.0;  ///< of its sphere, metres
    friend bool operator==(const Point&, const Point&) = default;
};

using LightOption = std::variant<Sun, Spot, Point>;

/// How bright a light is. The default is one white light that alone lights a scene well; spot and
/// point lights do not get darker with distance.
struct Brightness {
    math::vec3 color{1.0F};
    float intensity = 0.85F;
    math::vec3 ambient{0.12F};
};

/// Adds a light above the tree's content. Returns the node whose core is the light.
field::Ref<scene::Node> addLight(field::Aspect& aspect, SceneTree& tree, const LightOption& option,
                                 const Brightness& brightness = {});
/// Lights from the command line, which together are about as bright as one.
void addLights(field::Aspect& aspect, SceneTree& tree, const std::vector<LightOption>& options);
/// What lights a scene that brings no light: from above, front and right, slightly warm.
field::Ref<scene::Node> addDefaultSun(field::Aspect& aspect, SceneTree& tree);

}  // namespace gnomon::client

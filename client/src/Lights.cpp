#include <gnomon/client/Lights.h>
#include <gnomon/math/View.h>
#include <gnomon/scene/Light.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace gnomon::client {

using field::edit;

namespace {

/// A beacon at @p position whose -z axis is @p direction.
math::dmat4 pointing(const math::dvec3& position, const math::dvec3& direction) {
    return glm::inverse(
        math::lookAt(position, position + glm::normalize(direction), math::dvec3{0.0, 1.0, 0.0}));
}

template <class L>
const L& makeLight(field::Aspect& aspect, const scene::Node& beacon, const Brightness& brightness) {
    const L& light = aspect.create<L>();
    auto e = edit(light);
    e->beacon = beacon;
    e->color = brightness.color;
    e->intensity = brightness.intensity;
    e->ambient = brightness.ambient;
    return light;
}

class Adder {
public:
    Adder(field::Aspect& aspect, SceneTree& tree, const Brightness& brightness)
        : aspect_{aspect}, tree_{tree}, brightness_{brightness} {}

    const scene::Node& operator()(const Sun& sun) const {
        const auto& light =
            make<scene::DirectionalLight>("sun", pointing(math::dvec3{0.0}, -sun.toward));
        edit(light)->angle = static_cast<float>(sun.angle);
        return insertAboveContent(aspect_, tree_, "sun", light);
    }

    const scene::Node& operator()(const Spot& spot) const {
        const auto& light = make<scene::SpotLight>("spot", pointing(spot.position, spot.direction));
        {
            auto e = edit(light);
            e->radius = static_cast<float>(spot.radius);
            e->outerAngle = static_cast<float>(spot.angle * 0.5);
            e->innerAngle = static_cast<float>(spot.angle * 0.5 * 0.85);
        }
        return insertAboveContent(aspect_, tree_, "spot", light);
    }

    const scene::Node& operator()(const Point& point) const {
        const auto& light =
            make<scene::PointLight>("point", glm::translate(math::dmat4{1.0}, point.position));
        edit(light)->radius = static_cast<float>(point.radius);
        return insertAboveContent(aspect_, tree_, "point", light);
    }

private:
    template <class L>
    const L& make(std::string name, const math::dmat4& worldFromBeacon) const {
        const auto& beacon = addBeacon(aspect_, tree_, name + " beacon", worldFromBeacon);
        return makeLight<L>(aspect_, beacon, brightness_);
    }

    field::Aspect& aspect_;
    SceneTree& tree_;
    const Brightness& brightness_;
};

}  // namespace

field::Ref<scene::Node> addLight(field::Aspect& aspect, SceneTree& tree, const LightOption& option,
                                 const Brightness& brightness) {
    return field::Ref<scene::Node>{std::visit(Adder{aspect, tree, brightness}, option)};
}

void addLights(field::Aspect& aspect, SceneTree& tree, const std::vector<LightOption>& options) {
    if (options.empty()) return;
    const Brightness one;
    const auto count = static_cast<float>(options.size());
    // Lights from different sides overlap only in part: by the root of their number, not by it.
    const Brightness each{.color = one.color,
                          .intensity = one.intensity / std::sqrt(count),
                          .ambient = one.ambient / count};
    for (const auto& option : options) addLight(aspect, tree, option, each);
}

field::Ref<scene::Node> addDefaultSun(field::Aspect& aspect, SceneTree& tree) {
    const Brightness warm{.color = math::vec3{1.0F, 0.96F, 0.90F},
                          .intensity = 0.82F,
                          .ambient = math::vec3{0.14F, 0.15F, 0.18F}};
    return addLight(aspect, tree, Sun{.toward = math::dvec3{0.45, 0.80, 0.35}}, warm);
}

}  // namespace gnomon::client

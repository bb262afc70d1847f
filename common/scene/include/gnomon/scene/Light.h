#pragma once

#include <gnomon/scene/Node.h>

namespace gnomon::scene {

/// Lights the subtree of the node whose core it is. Where it stands and where it shines is the
/// beacon's business: position its origin, direction its -z axis. Without a beacon, its own node.
class Light : public NodeCore {
public:
    Field<bool> on{true};
    Field<Ref<Node>> beacon;
    Field<math::vec3> color{math::vec3{1.0F}};  ///< linear RGB
    Field<float> intensity{
        1.0F};  ///< a surface of albedo 1 facing it at attenuation 1 gets this radiance
    Field<math::vec3> ambient;  ///< added everywhere it lights, not attenuated
    Field<bool> castsShadow{true};

protected:
    template <class Self>
    static constexpr auto lightFields() {
        return std::tuple{
            entry("on", static_cast<Field<bool> Self::*>(&Light::on)),
            entry("beacon", static_cast<Field<Ref<Node>> Self::*>(&Light::beacon)),
            entry("color", static_cast<Field<math::vec3> Self::*>(&Light::color)),
            entry("intensity", static_cast<Field<float> Self::*>(&Light::intensity)),
            entry("ambient", static_cast<Field<math::vec3> Self::*>(&Light::ambient)),
            entry("castsShadow", static_cast<Field<bool> Self::*>(&Light::castsShadow))};
    }
};

/// Parallel light along the beacon's -z.
class DirectionalLight final : public Container<DirectionalLight, Light> {
public:
    static constexpr std::string_view typeName = "DirectionalLight";
    Field<float> angle;  ///< angular radius of the disk it comes from, radians
    static constexpr auto fields() {
        return std::tuple_cat(lightFields<DirectionalLight>(),
                              std::tuple{entry("angle", &DirectionalLight::angle)});
    }
};

/// From the beacon's origin in all directions. Attenuation 1 / (c + l d + q d^2) with
/// attenuation = (c, l, q), times a window that reaches zero at range (0: unlimited).
class PointLight final : public Container<PointLight, Light> {
public:
    static constexpr std::string_view typeName = "PointLight";
    Field<math::vec3> attenuation{math::vec3{1.0F, 0.0F, 0.0F}};
    Field<float> range;   ///< metres
    Field<float> radius;  ///< of the sphere it comes from, metres
    static constexpr auto fields() {
        return std::tuple_cat(
            lightFields<PointLight>(),
            std::tuple{entry("attenuation", &PointLight::attenuation),
                       entry("range", &PointLight::range), entry("radius", &PointLight::radius)});
    }
};

/// As PointLight, within a cone around the beacon's -z: full inside innerAngle, nothing outside
/// outerAngle (both half angles, radians, 0 <= inner < outer <= pi/2).
class SpotLight final : public Container<SpotLight, Light> {
public:
    static constexpr std::string_view typeName = "SpotLight";
    Field<math::vec3> attenuation{math::vec3{1.0F, 0.0F, 0.0F}};
    Field<float> range;
    Field<float> radius;  ///< of the disk it comes from, metres
    Field<float> innerAngle{0.0F};
    Field<float> outerAngle{0.7853982F};
    static constexpr auto fields() {
        return std::tuple_cat(
            lightFields<SpotLight>(),
            std::tuple{entry("attenuation", &SpotLight::attenuation),
                       entry("range", &SpotLight::range), entry("radius", &SpotLight::radius),
                       entry("innerAngle", &SpotLight::innerAngle),
                       entry("outerAngle", &SpotLight::outerAngle)});
    }
};

}  // namespace gnomon::scene

#include "gltf/Lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "build/Phong.h"

namespace gnomon::importer {
namespace {

constexpr double halfPi = 1.5707963267948966;
/// Twice what the sun gives; larger numbers are mistakes, and their squares overflow.
constexpr double largestIntensity = 1.0e12;

}  // namespace

GltfDevices::GltfDevices(const GltfDocument& document, Report& report) : report_{report} {
    if (const auto extension = document.root().extension("KHR_lights_punctual"))
        lights_ = extension->objects("lights", "light");
    cameras_ = document.root().objects("cameras", "camera");
}

std::optional<LightDraft> GltfDevices::light(const JsonView& json) {
    LightDraft draft{.name = json.string("name", json.where())};
    const auto leftOut = [&](const std::string& why) {
        report_.warn(fmt::format("{}: {}; left out", json.where(), why));
        return std::nullopt;
    };
    const auto type = json.string("type", "");
    if (type == "directional")
        draft.kind = LightDraft::Kind::directional;
    else if (type == "point")
        draft.kind = LightDraft::Kind::point;
    else if (type == "spot")
        draft.kind = LightDraft::Kind::spot;
    else
        return leftOut(
            fmt::format("type is \"{}\", expected directional, point or spot", printable(type)));
    std::array<double, 3> color{1.0, 1.0, 1.0};
    json.numbers("color", color);
    draft.color = clamped({color[0], color[1], color[2]});
    draft.intensity = json.number("intensity", 1.0);
    if (!(draft.intensity > 0.0 && draft.intensity <= largestIntensity))
        return leftOut(fmt::format("intensity is {:g}", draft.intensity));
    const double range = json.number("range", 0.0);
    draft.range = range > 0.0 && range < 1.0e9 ? range : 0.0;
    if (draft.kind != LightDraft::Kind::spot) return draft;

    double inner = 0.0;
    double outer = halfPi / 2.0;
    if (const auto spot = json.object("spot")) {
        inner = spot->number("innerConeAngle", inner);
        outer = spot->number("outerConeAngle", outer);
    }
    if (!(inner >= 0.0 && inner < outer && outer <= halfPi))
        report_.warn(
            fmt::format("{}: cone from {:g} to {:g} rad, expected 0 <= inner < outer <= "
                        "pi/2; clamped",
                        json.where(), inner, outer));
    draft.outerAngle = std::clamp(outer, 0.01, halfPi);
    draft.innerAngle = std::clamp(inner, 0.0, draft.outerAngle * 0.999);
    return draft;
}

std::optional<CameraDraft> GltfDevices::camera(const JsonView& json) {
    const auto leftOut = [&](const std::string& why) {
        report_.warn(fmt::format("{}: {}; left out", json.where(), why));
        return std::nullopt;
    };
    const auto perspective = json.object("perspective");
    if (!perspective) return leftOut("only perspective cameras are read");
    CameraDraft draft{.fovy = perspective->number("yfov", 0.0),
                      .near = perspective->number("znear", 0.0),
                      .far = perspective->number("zfar", 0.0)};
    if (!(draft.fovy > 1.0e-4 && draft.fovy < 2.0 * halfPi - 1.0e-4))
        return leftOut(fmt::format("yfov is {:g} rad", draft.fovy));
    if (!(draft.near > 0.0 && draft.near < 1.0e9))
        return leftOut(fmt::format("znear is {:g}", draft.near));
    if (perspective->has("zfar") && !(draft.far > draft.near && draft.far < 1.0e12))
        return leftOut(fmt::format("zfar is {:g}, znear {:g}", draft.far, draft.near));
    return draft;
}

void GltfDevices::add(const JsonView& json, const scene::Node& node,
                      const math::dmat4& worldFromNode, SceneBuilder& to) {
    const math::dvec3 place{worldFromNode[3]};
    if (const auto extension = json.extension("KHR_lights_punctual")) {
        const auto number = extension->unsignedInteger("light").value_or(lights_.size());
        if (number >= lights_.size()) {
            report_.warn(fmt::format("{}: light is {}, but there are {} lights; left out",
                                     json.where(), number, lights_.size()));
        } else if (!math::isFinite(worldFromNode)) {
            report_.warn(json.where() + ": its light's place is not finite; left out");
        } else if (auto draft = light(lights_[number])) {
            draft->beacon = &to.addGroup(node, draft->name + " beacon");
            draft->positionWorld = place;
            to.addLight(*std::move(draft));
        }
    }
    const auto number = json.index("camera", cameras_.size(), "cameras");
    if (!number || !math::isFinite(worldFromNode)) return;
    if (auto draft = camera(cameras_[*number])) {
        draft->beacon = &to.addGroup(node, cameras_[*number].string("name", "camera") + " beacon");
        draft->eyeWorld = place;
        to.addCamera(*draft);
    }
}

}  // namespace gnomon::importer

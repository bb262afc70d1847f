#pragma once

#include <gnomon/client/CameraPath.h>
#include <gnomon/client/SceneSetup.h>
#include <gnomon/math/View.h>
#include <gnomon/scene/Window.h>
#include <gnomon/shadow_fit/Fit.h>

#include "Plan.h"
#include "Reference.h"

namespace gnomon::client {

/// One step of a path on which flicker is measured.
struct Step {
    Look look = {};
    double turn = 0.0;  ///< of the first light about the vertical through the centre, radians
};
/// The eye along a path, evenly over its time; without one, around the centre by a twentieth of a
/// degree a step.
std::vector<Step> cameraSteps(const Look& start, const CameraPath* path, int count);
/// The light turns by a quarter of a degree a step, as far as the sun does in a minute.
std::vector<Step> lightSteps(const Look& start, int count);

/// A scene in an aspect, seen in a window; eye and light can be moved.
class Stage {
public:
    /// @param view  as Reference::resolved() returns it. @throws Failure, also without any light
    Stage(field::Aspect& aspect, const Reference& reference, const BenchView& view,
          const config::Shadow& shadow);

    PreparedScene& scene() noexcept { return scene_; }
    field::Ref<scene::Window> window() const noexcept { return window_; }
    /// The light that is measured.
    field::Ref<scene::Node> light() const noexcept { return light_; }
    /// How many lights are on.
    std::size_t lights() const { return activeLights(aspect_, scene_).size(); }
    void take(const Step& step);
    math::View view() const;
    shadow_fit::LightShape lightShape() const;

private:
    void place(field::Ref<scene::Node> beacon, const math::dmat4& worldFromBeacon);
    field::Ref<scene::Node> cameraBeacon() const;
    field::Ref<scene::Node> lightBeacon() const;

    field::Aspect& aspect_;
    PreparedScene scene_ = {};
    field::Ref<scene::Window> window_ = {};
    field::Ref<scene::Node> light_ = {};
    math::dmat4 lightAtRest_{1.0};  // worldFromBeacon
};

}  // namespace gnomon::client

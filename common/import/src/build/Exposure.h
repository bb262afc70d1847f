#pragma once

#include <gnomon/math/Types.h>
#include <gnomon/scene/Node.h>

#include <span>
#include <string>
#include <vector>

namespace gnomon::importer {

/// A light as a file gives it.
struct LightDraft {
    enum class Kind { directional, point, spot };
    Kind kind = Kind::point;
    std::string name = {};
    math::vec3 color{1.0F};
    double intensity = 1.0;   ///< lux (directional), candela (point, spot); >= 0
    double range = 0.0;       ///< metres; 0: unlimited
    double innerAngle = 0.0;  ///< half angles, radians
    double outerAngle = 0.7853981633974483;
    const scene::Node* beacon = nullptr;
    math::dvec3 positionWorld{0.0};
};

/// The one factor for all lights of a file that turns its units into ours.
///
/// Files differ by a factor of a thousand and more, depending on the program they come from, and we
/// have no camera exposure. So light is scaled until it is neither black nor burnt: where there are
/// directional lights, the brightest gets intensity 1 (a white surface facing it gets radiance 1);
/// where there are none, the strongest point or spot light gets attenuated intensity 1 at the
/// distance of what it stands next to - the nearest drawn box, but at least a seventh of the
/// scene's radius and at most half its range. The ratios between the lights of a file stay.
/// @param drawn  boxes of what is drawn, world space
/// @return 1 where no light shines.
double exposure(std::span<const LightDraft> lights, std::span<const math::Box> drawn,
                const math::Box& bounds);

/// Where a light of this (exposed) intensity falls below 0.01: about what the darkest step that can
/// be told from black takes in an sRGB picture. Metres; 0 for intensity 0.
double derivedRange(double intensity);

}  // namespace gnomon::importer

#pragma once

#include <glm/vec3.hpp>

namespace gnomon::demo {

/// Where on Earth, when in the year, and when in the day; radians.
struct SunTime {
    double latitude = 0.0;
    double declination = 0.0;  ///< of the sun: 0 at the equinoxes, 0.41 at midsummer
    double hourAngle = 0.0;    ///< since solar noon, 2 pi a day
};

/// Unit vector to the sun with X to the east, Y up and -Z to the north.
///
/// Source: Jean Meeus. Astronomical Algorithms. 1991, chapter 12 (no refraction).
glm::dvec3 towardSun(const SunTime& time);

/// Angle of the hour line of a horizontal sundial, from north to east. The shadow of a style that
/// points to the celestial pole lies on it whatever the declination.
///
/// Source: Rene Rohr. Sundials: History, Theory, and Practice. 1970, chapter 3.
double hourLine(double latitude, double hourAngle);

}  // namespace gnomon::demo

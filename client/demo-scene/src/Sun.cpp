#include <gnomon/demo/Sun.h>

#include <cmath>

namespace gnomon::demo {

glm::dvec3 towardSun(const SunTime& time) {
    const double sinLatitude = std::sin(time.latitude);
    const double cosLatitude = std::cos(time.latitude);
    const double sinDeclination = std::sin(time.declination);
    const double cosDeclination = std::cos(time.declination);
    const double north =
        cosLatitude * sinDeclination - sinLatitude * cosDeclination * std::cos(time.hourAngle);
    const double west = cosDeclination * std::sin(time.hourAngle);
    const double up =
        sinLatitude * sinDeclination + cosLatitude * cosDeclination * std::cos(time.hourAngle);
    return {-west, up, -north};
}

double hourLine(double latitude, double hourAngle) {
    return std::atan2(std::sin(latitude) * std::sin(hourAngle), std::cos(hourAngle));
}

}  // namespace gnomon::demo

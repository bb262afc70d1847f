#include <fmt/format.h>
#include <gnomon/config/Layout.h>

#include <algorithm>

#include "Checks.h"
#include "PlacedCanvas.h"
#include "Room.h"
#include "Subject.h"

namespace gnomon::config {
namespace {

// Nearer than this the picture is a smear and its frustum's numbers are worthless.
constexpr double nearestEye = 1e-3;  // metres

// How far the nearest eye is in front of the screen, metres; negative: behind.
double eyeDistance(const User& user, const Screen& screen) {
    const Point normal = cross(minus(screen.lowerRight, screen.lowerLeft),
                               minus(screen.upperLeft, screen.lowerLeft));
    const double norm = length(normal);  // > 0: validate() refuses screens without area
    double distance = dot(minus(user.head, screen.lowerLeft), normal) / norm;
    for (const Eye eye : {Eye::left, Eye::right}) {
        const Point fromCorner = minus(eyePosition(user, eye), screen.lowerLeft);
        distance = std::min(distance, dot(fromCorner, normal) / norm);
    }
    return distance;
}

void checkCanvas(const Config& config, const Screen& screen, std::vector<Finding>& findings) {
    for (const Server& server : config.servers) {
        for (const Window& window : server.windows) {
            for (const Viewport& viewport : window.viewports) {
                if (viewport.screen != screen.name) continue;
                const PixelRect rect = pixelRect(window, viewport);
                const auto grid = placedCanvas(screen, {rect.width, rect.height});
                if (!grid) {
                    findings.push_back(grid.error());
                    return;
                }
                const double aspect = grid->pitch[0] / grid->pitch[1];
                if (aspect > 1.02 || aspect < 1 / 1.02) {
                    findings.push_back(
                        {.level = Level::warning,
                         .place = screen.origin.table,
                         .what = fmt::format("{}: its pixels are {:.2f} x {:.2f} mm, not square; "
                                             "do corners and window size match?",
                                             subject(screen), grid->pitch[0] * 1e3,
                                             grid->pitch[1] * 1e3)});
                }
                return;  // all tiles have this size, or checkCover() says so
            }
        }
    }
}

}  // namespace

void checkGeometry(const Config& config, std::vector<Finding>& findings) {
    for (const Screen& screen : config.screens) {
        checkCanvas(config, screen, findings);
        const double distance = eyeDistance(config.user, screen);
        if (distance >= nearestEye) continue;
        const std::string how =
            distance > -nearestEye ? std::string{"on"} : fmt::format("{:.3g} m behind", -distance);
        const Place& place = config.user.origin.of("head");
        findings.push_back(
            {.place = place.line == 0 ? screen.origin.table : place,
             .what = fmt::format("user: an eye is {} the plane of {}, must be in front of it "
                                 "(seen from there, lower_right is right of lower_left)",
                                 how, subject(screen))});
    }
}

}  // namespace gnomon::config

#include <fmt/format.h>
#include <gnomon/config/Config.h>
#include <gnomon/config/Layout.h>

#include <cmath>

#include "Room.h"
#include "Schema.h"
#include "Subject.h"

namespace gnomon::config {
namespace {

constexpr double smallest = 1e-6;  // metres; what is shorter has no direction worth trusting
constexpr double degree = 0.017453292519943295;
// How far the corners, which somebody measured, may be off a right angle.
constexpr double skewLimit = 0.1 * degree;

constexpr std::size_t maxWindows = 16;    // of a server
constexpr std::size_t maxViewports = 64;  // of a window

bool overlap(const PixelRect& a, const PixelRect& b) {
    return a.left < b.left + b.width && b.left < a.left + a.width &&
           a.bottom < b.bottom + b.height && b.bottom < a.bottom + a.height;
}

void validateRect(const Window& window, const Viewport& viewport, const std::string& subjectText,
                  std::vector<Finding>& findings) {
    const PixelRect rect = pixelRect(window, viewport);
    const auto complain = [&](const char* why) {
        findings.push_back(
            {.place = viewport.origin.of("rect"),
             .what = fmt::format("{}: rect is {}, {} x {} pixels at {}, {} of a window of {} x {}, "
                                 "must {}",
                                 subjectText, tomlText(viewport.rect), rect.width, rect.height,
                                 rect.left, rect.bottom, window.size[0], window.size[1], why)});
    };
    if (rect.width < 1 || rect.height < 1) {
        complain("have at least one pixel");
    } else if (rect.left + rect.width > window.size[0] ||
               rect.bottom + rect.height > window.size[1]) {
        complain("lie in it");
    }
}

void validateWindow(const Window& window, const std::string& subjectText,
                    std::vector<Finding>& findings) {
    checkFields(window, subjectText, findings);
    const std::size_t count = window.viewports.size();
    if (count < 1 || count > maxViewports) {
        findings.push_back({.place = window.origin.table,
                            .what = fmt::format("{}: has {} viewports, must have 1 to {} "
                                                "([[server.window.viewport]])",
                                                subjectText, count, maxViewports)});
        return;
    }
    for (std::size_t i = 0; i < count; ++i) {
        const Viewport& viewport = window.viewports[i];
        const std::string viewportText = subjectText + ", viewport";
        const std::size_t before = findings.size();
        checkFields(viewport, viewportText, findings);
        if (findings.size() != before) continue;
        validateRect(window, viewport, viewportText, findings);
        for (std::size_t j = 0; j < i; ++j) {
            if (!overlap(pixelRect(window, viewport), pixelRect(window, window.viewports[j]))) {
                continue;
            }
            findings.push_back({.level = Level::warning,
                                .place = viewport.origin.of("rect"),
                                .what = viewportText + " covers part of another in its window"});
            break;
        }
    }
}

}  // namespace

std::vector<Finding> validate(const User& user) {
    std::vector<Finding> findings;
    checkFields(user, "user", findings);
    const double size = length(user.forward);
    // Which way is right is unknown for one who looks straight up or down.
    if (!(size > 0) || !(length(cross(user.forward, Point{0, 1, 0})) > 1e-6 * size)) {
        findings.push_back({.place = user.origin.of("forward"),
                            .what = fmt::format("user: forward is {}, must not be vertical or zero",
                                                tomlText(user.forward))});
    }
    return findings;
}

std::vector<Finding> validate(const Sync& sync) {
    std::vector<Finding> findings;
    checkFields(sync, "sync", findings);
    return findings;
}

std::vector<Finding> validate(const Cluster& cluster) {
    std::vector<Finding> findings;
    checkFields(cluster, "cluster", findings);
    return findings;
}

std::vector<Finding> validate(const Shadow& shadow) {
    std::vector<Finding> findings;
    checkFields(shadow, "shadow", findings);
    return findings;
}

std::vector<Finding> validate(const Render& render) {
    std::vector<Finding> findings;
    checkFields(render, "render", findings);
    if (render.foreground) checkFields(*render.foreground, "render.foreground", findings);
    if (render.near && render.far && !(*render.far > *render.near)) {
        findings.push_back({.place = render.origin.of("far"),
                            .what = fmt::format("render: far is {} m, must be > near, {} m",
                                                tomlText(render.far), tomlText(render.near))});
    }
    return findings;
}

std::vector<Finding> validate(const Screen& screen) {
    std::vector<Finding> findings;
    checkFields(screen, subject(screen), findings);
    const auto complain = [&](std::string_view key, const std::string& what) {
        findings.push_back({.place = screen.origin.of(key), .what = subject(screen) + ": " + what});
    };
    const Point right = minus(screen.lowerRight, screen.lowerLeft);
    const Point up = minus(screen.upperLeft, screen.lowerLeft);
    const auto [width, height] = extent(screen);
    if (!(width > smallest)) {
        complain("lower_right", fmt::format("lower_right is {} m from lower_left, the screen must "
                                            "have a width",
                                            width));
    } else if (!(height > smallest)) {
        complain("upper_left", fmt::format("upper_left is {} m from lower_left, the screen must "
                                           "have a height",
                                           height));
    } else if (const double cosine = dot(right, up) / (width * height);
               !(std::abs(cosine) < std::sin(skewLimit))) {
        const double angle = std::acos(std::fmin(std::fmax(cosine, -1), 1)) / degree;
        complain("upper_left", fmt::format("its lower and left edge are at {:.2f} degrees, must be "
                                           "90 (a rectangle)",
                                           angle));
    }
    const bool hasBezel = screen.bezel[0] > 0 || screen.bezel[1] > 0;
    const bool hasOverlap = screen.overlap[0] > 0 || screen.overlap[1] > 0;
    if (hasBezel && hasOverlap) {
        complain("overlap", fmt::format("overlap is {}, bezel is {}, only one of them can be",
                                        tomlText(screen.overlap), tomlText(screen.bezel)));
    }
    return findings;
}

std::vector<Finding> validate(const Server& server) {
    std::vector<Finding> findings;
    checkFields(server, subject(server), findings);
    const auto complain = [&](std::string_view key, const std::string& what) {
        findings.push_back({.place = server.origin.of(key), .what = subject(server) + ": " + what});
    };
    if (isLookedUp(server)) {
        if (server.port != 0) {
            complain("port", fmt::format("port is {}, and a server without a host says where it "
                                         "listens when it is looked up: leave it out",
                                         server.port));
        }
    } else if (server.port == 0 && !isLocal(server.host)) {
        complain("port",
                 fmt::format("port is 0, must be 1 to 65535 on another machine ({})", server.host));
    }
    if (server.windows.empty() || server.windows.size() > maxWindows) {
        complain("windows", fmt::format("has {} windows, must have 1 to {} ([[server.window]])",
                                        server.windows.size(), maxWindows));
    }
    for (const Window& window : server.windows) {
        validateWindow(window, subject(server) + ", window", findings);
    }
    return findings;
}

std::vector<Finding> validate(const Config& config) {
    std::vector<Finding> all;
    const auto add = [&](std::vector<Finding>&& more) {
        all.insert(all.end(), more.begin(), more.end());
    };
    checkFields(config, "", all);
    add(validate(config.user));
    add(validate(config.sync));
    add(validate(config.cluster));
    add(validate(config.shadow));
    add(validate(config.render));
    for (const Screen& screen : config.screens) add(validate(screen));
    for (const Server& server : config.servers) {
        add(validate(server));
        if (!isLookedUp(server) || config.cluster.lookup) continue;
        all.push_back({.place = server.origin.of("host"),
                       .what = subject(server) + ": host is \"\", must be a host name or an IP "
                                                 "address, for [cluster] has no lookup"});
    }
    return all;
}

}  // namespace gnomon::config

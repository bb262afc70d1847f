#include <fmt/format.h>
#include <gnomon/config/Adjust.h>
#include <gnomon/config/Layout.h>
#include <gnomon/config/Report.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace gnomon::config {
namespace {

int scaled(int pixels, double factor) {
    // Rules of findings() refuse what is out of range; here it must only fit an int.
    return static_cast<int>(std::clamp(std::round(pixels * factor), -1e9, 1e9));
}

// A number of Viewport::rect; shares stay as they are.
double scaledRect(double number, double factor, int windowPixels) {
    if (number <= 1) return number;
    const double pixels = std::round(number * factor);
    // A single pixel would read as the whole window.
    return pixels <= 1 && windowPixels > 1 ? pixels / windowPixels : pixels;
}

void scale(Window& window, std::array<double, 2> factor) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
        window.size[axis] = scaled(window.size[axis], factor[axis]);
        window.position[axis] = scaled(window.position[axis], factor[axis]);
        for (Viewport& viewport : window.viewports) {
            for (const std::size_t i : {axis, axis + 2}) {
                viewport.rect[i] = scaledRect(viewport.rect[i], factor[axis], window.size[axis]);
            }
        }
    }
    window.fullscreen = false;
}

}  // namespace

Result<Config> withTileSize(const Config& config, int width, int height) {
    if (width < 1 || height < 1) {
        return fail(Errc::config,
                    fmt::format("tiles of {} x {} pixels, must be at least 1 x 1", width, height));
    }
    Config result = config;
    std::map<std::string, std::array<double, 2>> factorOfScreen;
    for (Server& server : result.servers) {
        for (Window& window : server.windows) {
            if (window.viewports.empty()) continue;
            const Viewport& first = window.viewports.front();
            const PixelRect rect = pixelRect(window, first);
            if (rect.width < 1 || rect.height < 1) continue;  // findings() says so
            const std::array<double, 2> factor = {static_cast<double>(width) / rect.width,
                                                  static_cast<double>(height) / rect.height};
            factorOfScreen.emplace(first.screen, factor);
            scale(window, factor);
        }
    }
    for (Screen& screen : result.screens) {
        const auto factor = factorOfScreen.find(screen.name);
        if (factor == factorOfScreen.end()) continue;
        for (std::size_t axis = 0; axis < 2; ++axis) {
            screen.overlap[axis] = scaled(screen.overlap[axis], factor->second[axis]);
        }
    }
    for (const Server& server : result.servers) {
        for (const Window& window : server.windows) {
            for (const Viewport& viewport : window.viewports) {
                const PixelRect rect = pixelRect(window, viewport);
                if (rect.width == width && rect.height == height) continue;
                return fail(Errc::config,
                            fmt::format("{}server \"{}\": a viewport becomes {} x {} pixels where "
                                        "tiles of {} x {} are asked for",
                                        viewport.origin.of("rect").prefix(), server.name,
                                        rect.width, rect.height, width, height));
            }
        }
    }
    const auto found = findings(result);
    if (hasError(found)) return tl::unexpected{toError(found)};
    return result;
}

Config localized(const Config& config) {
    Config result = arranged(config);
    result.cluster = {};
    for (Server& server : result.servers) {
        server.host = "localhost";
        server.port = 0;
        server.gpu = -1;
        for (Window& window : server.windows) {
            window.fullscreen = false;
            window.monitor = 0;
            window.gpu.reset();
        }
    }
    // Processes that share one machine's cores wait for each other; one that died is noticed by its
    // closed connection, without any timeout.
    const auto servers = static_cast<double>(result.servers.size());
    result.sync.timeout = std::max(result.sync.timeout, 0.25 * servers);  // seconds
    result.sync.startTimeout = std::max(result.sync.startTimeout, 10.0 * servers);
    return result;
}

Config arranged(const Config& config) {
    Config result = config;
    int left = 0;  // pixels of the desktop taken so far
    for (std::size_t i = 0; i < config.screens.size(); ++i) {
        const auto grid = canvas(config, i);
        if (!grid) continue;  // nobody shows it, or findings() says what is wrong
        const Screen& screen = config.screens[i];
        bool isStereo = false;
        for (Server& server : result.servers) {
            for (Window& window : server.windows) {
                if (window.viewports.empty()) continue;
                const Viewport& first = window.viewports.front();
                if (first.screen != screen.name) continue;
                const bool isInside = first.tile[0] >= 0 && first.tile[0] < screen.tiles[0] &&
                                      first.tile[1] >= 0 && first.tile[1] < screen.tiles[1];
                if (!isInside) continue;  // findings() says so
                isStereo = isStereo || first.eye == Eye::right;
                const TileRect tile = grid->tile(first.tile[0], first.tile[1]);
                const PixelRect rect = pixelRect(window, first);
                const int fromTop = window.size[1] - rect.bottom - rect.height;
                window.position = {
                    left + (first.eye == Eye::right ? grid->width : 0) + tile.x - rect.left,
                    tile.y - fromTop};
            }
        }
        left += isStereo ? 2 * grid->width : grid->width;
    }
    return result;
}

}  // namespace gnomon::config

#include <fmt/format.h>
#include <gnomon/config/Layout.h>
#include <gnomon/config/Report.h>

#include <algorithm>
#include <array>

#include "Subject.h"
#include "Text.h"

namespace gnomon::config {
namespace {

using Row = std::vector<std::string>;

// Columns as wide as their widest cell, two spaces apart, no space at the end of a line.
std::string table(const std::vector<Row>& rows) {
    std::vector<std::size_t> widths;
    for (const Row& row : rows) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t i = 0; i < row.size(); ++i) {
            widths[i] = std::max(widths[i], row[i].size());
        }
    }
    std::string text;
    for (const Row& row : rows) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i) {
            line += fmt::format("{:<{}}", row[i], widths[i] + 2);
        }
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    }
    return text;
}

std::string gpuText(int gpu) { return gpu < 0 ? "any" : std::to_string(gpu); }

std::string windowText(const Window& window) {
    const std::string size = fmt::format("{}x{}", window.size[0], window.size[1]);
    if (window.fullscreen) return fmt::format("{} full screen {}", size, window.monitor);
    return fmt::format("{} at {},{}", size, window.position[0], window.position[1]);
}

std::string rectText(const Window& window, const Viewport& viewport) {
    const PixelRect rect = pixelRect(window, viewport);
    const PixelRect whole{.width = window.size[0], .height = window.size[1]};
    if (rect == whole) return "whole";
    return fmt::format("{}x{} at {},{}", rect.width, rect.height, rect.left, rect.bottom);
}

std::vector<Row> serverRows(const Config& config) {
    std::vector<Row> rows = {
        {"server", "host", "port", "gpu", "window", "viewport", "screen", "tile", "eye"}};
    for (const Server& server : config.servers) {
        Row row = {server.name, hostText(server),
                   isLookedUp(server) ? "-"
                   : server.port == 0 ? "any"
                                      : std::to_string(server.port)};
        for (const Window& window : server.windows) {
            row.resize(3);
            row.push_back(gpuText(gpuOf(server, window)));
            row.push_back(windowText(window));
            for (const Viewport& viewport : window.viewports) {
                row.resize(5);
                row.push_back(rectText(window, viewport));
                row.push_back(viewport.screen);
                row.push_back(fmt::format("{},{}", viewport.tile[0], viewport.tile[1]));
                row.emplace_back(name(viewport.eye));
                rows.push_back(row);
                // What repeats is said once.
                std::fill(row.begin(), row.begin() + 5, std::string{});
            }
        }
    }
    return rows;
}

// "left right", in this order, each only if somebody shows it
std::string eyesText(const Config& config, const Screen& screen) {
    std::string text;
    for (const Eye eye : {Eye::mono, Eye::left, Eye::right}) {
        bool isShown = false;
        for (const Server& server : config.servers) {
            for (const Window& window : server.windows) {
                for (const Viewport& viewport : window.viewports) {
                    isShown = isShown || (viewport.screen == screen.name && viewport.eye == eye);
                }
            }
        }
        if (!isShown) continue;
        if (!text.empty()) text += ' ';
        text += name(eye);
    }
    return text.empty() ? std::string{"nobody"} : text;
}

std::string gapText(const Screen& screen, const Canvas& grid) {
    if (grid.gap == Cells{0, 0}) return "-";
    const char* kind = screen.overlap == Cells{0, 0} ? "bezel" : "overlap";
    return fmt::format("{} {},{} px", kind, std::abs(grid.gap[0]), std::abs(grid.gap[1]));
}

std::vector<Row> screenRows(const Config& config) {
    std::vector<Row> rows = {
        {"screen", "metres", "tiles", "tile px", "between", "whole px", "mm/px", "eyes"}};
    for (std::size_t i = 0; i < config.screens.size(); ++i) {
        const Screen& screen = config.screens[i];
        const auto [width, height] = extent(screen);
        Row row = {screen.name, fmt::format("{:.3f} x {:.3f}", width, height),
                   fmt::format("{} x {}", screen.tiles[0], screen.tiles[1])};
        const auto grid = canvas(config, i);
        if (grid) {
            row.push_back(fmt::format("{} x {}", grid->tileSize[0], grid->tileSize[1]));
            row.push_back(gapText(screen, *grid));
            row.push_back(fmt::format("{} x {}", grid->width, grid->height));
            row.push_back(
                fmt::format("{:.3f} x {:.3f}", grid->pitch[0] * 1e3, grid->pitch[1] * 1e3));
        } else {
            row.insert(row.end(), 4, "-");
        }
        row.push_back(eyesText(config, screen));
        rows.push_back(std::move(row));
    }
    return rows;
}

std::string count(std::size_t n, const char* what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

}  // namespace

std::string describe(const Config& config) {
    const Point& head = config.user.head;
    const Shadow& shadow = config.shadow;
    std::string text =
        fmt::format("{}: {} on {}\n", config.name, count(config.servers.size(), "server"),
                    count(config.screens.size(), "screen"));
    text += fmt::format(
        "head at {}, {}, {} m, eyes {:g} mm apart; shadows {}\n\n", head[0], head[1], head[2],
        config.user.eyeSeparation * 1e3,
        shadow.on ? fmt::format("{}, map {}", shadow.technique,
                                shadow.mapSize ? fmt::to_string(*shadow.mapSize) : "as the screen")
                  : std::string{"off"});
    text += table(serverRows(config));
    if (config.cluster.lookup)
        text += fmt::format("servers are looked up on {} (udp)\n", *config.cluster.lookup);
    text += "\nfit groups (all tiles and eyes of a screen share its shadow fits)\n";
    text += table(screenRows(config));
    return text;
}

}  // namespace gnomon::config

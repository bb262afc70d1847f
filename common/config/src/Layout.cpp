#include <fmt/format.h>
#include <gnomon/config/Layout.h>

#include <cmath>

#include "PlacedCanvas.h"
#include "Room.h"
#include "Subject.h"

namespace gnomon::config {
namespace {

constexpr double maxCanvas = 1 << 20;  // pixels a side; keeps every product below in an int

// A number of Viewport::rect along a window side of @p pixels.
double inPixels(double number, int pixels) { return number <= 1 ? number * pixels : number; }

// Start and length in whole pixels.
std::array<int, 2> span(double start, double extent, int pixels) {
    const double from = std::round(inPixels(start, pixels));
    // Two shares: round the far edge itself, so that it is the neighbour's near edge.
    const double to = start <= 1 && extent <= 1 ? std::round((start + extent) * pixels)
                                                : from + std::round(inPixels(extent, pixels));
    return {static_cast<int>(from), static_cast<int>(to - from)};
}

tl::unexpected<Finding> wrong(const Screen& screen, std::string_view key, const std::string& what) {
    return tl::unexpected{
        Finding{.place = screen.origin.of(key), .what = subject(screen) + ": " + what}};
}

// Pixels between neighbours along one side, see canvas().
tl::expected<int, Finding> gapAlong(const Screen& screen, std::size_t axis, double sideMetres,
                                    int tilePixels) {
    const int count = screen.tiles[axis];
    const char* side = axis == 0 ? "width" : "height";
    if (count == 1) return 0;
    if (screen.overlap[axis] >= tilePixels) {
        return wrong(screen, "overlap",
                     fmt::format("overlap is {} pixels of a tile's {} of {}, must be less",
                                 screen.overlap[axis], side, tilePixels));
    }
    if (screen.overlap[axis] > 0) return -screen.overlap[axis];
    const double lit = sideMetres - (count - 1) * screen.bezel[axis];
    if (!(lit > 0)) {
        return wrong(screen, "bezel",
                     fmt::format("bezels ({} of {} m) leave nothing of its {} of {} m", count - 1,
                                 screen.bezel[axis], side, sideMetres));
    }
    const double gap = std::round(screen.bezel[axis] * count * tilePixels / lit);
    if (gap > maxCanvas) return static_cast<int>(maxCanvas);  // refused with the canvas below
    return static_cast<int>(gap);
}

}  // namespace

TileRect Canvas::tile(int column, int row) const {
    GNOMON_EXPECTS(column >= 0 && column < tiles[0] && row >= 0 && row < tiles[1],
                   "tile outside the canvas");
    return {.x = column * (tileSize[0] + gap[0]),
            .y = row * (tileSize[1] + gap[1]),
            .width = tileSize[0],
            .height = tileSize[1]};
}

Share Canvas::share(int column, int row) const {
    const TileRect rect = tile(column, row);
    return {.left = static_cast<double>(rect.x) / width,
            .bottom = static_cast<double>(height - rect.y - rect.height) / height,
            .right = static_cast<double>(rect.x + rect.width) / width,
            .top = static_cast<double>(height - rect.y) / height};
}

tl::expected<Canvas, Finding> placedCanvas(const Screen& screen, Cells tileSize) {
    if (tileSize[0] < 1 || tileSize[1] < 1) {
        return wrong(screen, "tiles",
                     fmt::format("tiles of {} x {} pixels, must be at least 1 x 1", tileSize[0],
                                 tileSize[1]));
    }
    const std::array<double, 2> sides = extent(screen);
    Canvas result{.tiles = screen.tiles, .tileSize = tileSize};
    std::array<int, 2> pixels = {};
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const auto gap = gapAlong(screen, axis, sides[axis], tileSize[axis]);
        if (!gap) return tl::unexpected{gap.error()};
        const double total = static_cast<double>(screen.tiles[axis]) * tileSize[axis] +
                             static_cast<double>(screen.tiles[axis] - 1) * *gap;
        if (total > maxCanvas) {
            return wrong(screen, "bezel",
                         fmt::format("{} pixels along its {}, must be at most {}", total,
                                     axis == 0 ? "width" : "height", maxCanvas));
        }
        pixels[axis] = static_cast<int>(total);
        result.gap[axis] = *gap;
        result.pitch[axis] = sides[axis] / total;  // total >= 1
    }
    result.width = pixels[0];
    result.height = pixels[1];
    return result;
}

Result<Canvas> canvas(const Screen& screen, Cells tileSize) {
    auto result = placedCanvas(screen, tileSize);
    if (!result) return fail(Errc::config, result.error().text());
    return *result;
}

Result<Canvas> canvas(const Config& config, std::size_t screen, std::optional<Cells> tileSize) {
    GNOMON_EXPECTS(screen < config.screens.size(), "no such screen");
    const Screen& shown = config.screens[screen];
    if (tileSize) return canvas(shown, *tileSize);
    for (const Server& server : config.servers) {
        for (const Window& window : server.windows) {
            for (const Viewport& viewport : window.viewports) {
                if (viewport.screen != shown.name) continue;
                const PixelRect rect = pixelRect(window, viewport);
                const Cells size = {rect.width, rect.height};
                if (!tileSize) tileSize = size;
                if (*tileSize == size) continue;
                return fail(
                    Errc::config,
                    fmt::format("{}{}: shows {} x {} pixels of screen \"{}\", must be "
                                "{} x {} as its other tiles",
                                viewport.origin.of("rect").prefix(), subject(server), size[0],
                                size[1], shown.name, (*tileSize)[0], (*tileSize)[1]));
            }
        }
    }
    if (tileSize) return canvas(shown, *tileSize);
    return fail(Errc::config,
                fmt::format("{}{}: no server shows it, so its size in pixels is unknown",
                            shown.origin.table.prefix(), subject(shown)));
}

PixelRect pixelRect(const Window& window, const Viewport& viewport) {
    const auto [left, width] = span(viewport.rect[0], viewport.rect[2], window.size[0]);
    const auto [bottom, height] = span(viewport.rect[1], viewport.rect[3], window.size[1]);
    return {.left = left, .bottom = bottom, .width = width, .height = height};
}

std::array<double, 2> extent(const Screen& screen) {
    return {length(minus(screen.lowerRight, screen.lowerLeft)),
            length(minus(screen.upperLeft, screen.lowerLeft))};
}

Point eyePosition(const User& user, Eye eye) {
    if (eye == Eye::mono) return user.head;
    const Point right = cross(user.forward, Point{0, 1, 0});
    const double norm = length(right);
    if (!(norm > 0)) return user.head;  // looking straight up: validate() refuses it
    const double side = eye == Eye::left ? -0.5 : 0.5;
    return plusScaled(user.head, right, side * user.eyeSeparation / norm);
}

}  // namespace gnomon::config

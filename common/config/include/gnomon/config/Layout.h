#pragma once

#include <gnomon/base/Error.h>
#include <gnomon/config/Config.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

/// Where tiles lie on their screen, in whole pixels. Pure geometry: a picture of the whole screen
/// and the tiles of a wall are cut from the same grid, so they agree in every pixel.
namespace gnomon::config {

/// Pixels of a canvas, from its upper left corner.
struct TileRect {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    bool operator==(const TileRect&) const = default;
};

/// Part of a screen: 0,0 is its lower left corner, 1,1 its upper right.
struct Share {
    double left = 0;
    double bottom = 0;
    double right = 1;
    double top = 1;
    bool operator==(const Share&) const = default;
};

/// The pixels of one whole screen, including those behind bezels.
struct Canvas {
    int width = 0;
    int height = 0;
    Cells tiles = {1, 1};     ///< columns, rows
    Cells tileSize = {0, 0};  ///< pixels of each tile
    /// Pixels between neighbours, across and down: hidden by a bezel if > 0, shared if < 0.
    Cells gap = {0, 0};
    std::array<double, 2> pitch = {0, 0};  ///< metres per pixel, across and down

    /// @pre 0 <= column < tiles[0] and 0 <= row < tiles[1]; row 0 is the top row
    TileRect tile(int column, int row) const;
    /// The tile's part of the screen: its pixels over the canvas' pixels, nothing rounded.
    Share share(int column, int row) const;
    bool operator==(const Canvas&) const = default;
};

/// The screen's canvas when each tile has @p tileSize pixels.
///
/// Corners bound the lit area with bezels, so pitch = width of the screen / width of the canvas,
/// canvas width = columns * tile + (columns - 1) * gap, and gap = bezel / pitch rounded to whole
/// pixels. Hence gap = round(bezel * columns * tile / (screen width - (columns - 1) * bezel)).
///
/// Errc::config: zero-sized tiles, bezels as wide as the screen, an overlap as wide as a tile, a
/// canvas above 2^20 pixels a side.
Result<Canvas> canvas(const Screen& screen, Cells tileSize);

/// The same with the tile size its viewports have, or @p tileSize instead.
/// Errc::config also if no viewport shows the screen or its tiles differ in size.
/// @pre screen < config.screens.size()
Result<Canvas> canvas(const Config& config, std::size_t screen, std::optional<Cells> tileSize = {});

/// Pixels of a window, from its lower left corner as in OpenGL.
struct PixelRect {
    int left = 0;
    int bottom = 0;
    int width = 0;
    int height = 0;
    bool operator==(const PixelRect&) const = default;
};

/// The pixels a viewport covers. Shares are rounded edge by edge, so neighbours abut.
PixelRect pixelRect(const Window& window, const Viewport& viewport);

/// Lengths of the screen's lower and left edge, metres.
std::array<double, 2> extent(const Screen& screen);

/// The eye's position in the room when the head is where the file puts it.
Point eyePosition(const User& user, Eye eye);

}  // namespace gnomon::config

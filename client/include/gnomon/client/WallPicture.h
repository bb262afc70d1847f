#pragma once

#include <gnomon/client/WallSetup.h>
#include <gnomon/image/Image.h>
#include <gnomon/net/ServerEvent.h>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace gnomon::client {

/// What one eye sees of one screen, put together from the servers' pictures. Bezels and tiles of
/// servers that are gone are black.
struct WallPicture {
    std::string screen = {};
    config::Eye eye = config::Eye::mono;
    image::Image image = {};                ///< RGB, the pixels of the screen's canvas
    std::vector<std::string> missing = {};  ///< servers whose tile is not there
};

/// One picture a screen and eye that any viewport shows, in the order of the config.
/// @param wall  built from the same @p config
/// Errors: Errc::protocol where an image does not fit its window.
Result<std::vector<WallPicture>> assembleWall(const config::Config& config,
                                              const WallContainers& wall,
                                              std::span<const net::Image> images);

/// `wall.png`, with `-<screen>` where there are several screens and `-left`, `-right` for eyes.
std::filesystem::path pictureFile(const std::filesystem::path& file,
                                  std::span<const WallPicture> all, const WallPicture& one);

}  // namespace gnomon::client

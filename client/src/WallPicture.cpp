#include <fmt/format.h>
#include <gnomon/client/WallPicture.h>
#include <gnomon/config/Layout.h>

#include <algorithm>
#include <cstring>
#include <unordered_map>

namespace gnomon::client {
namespace {

/// What arrived of one window.
struct WindowPixels {
    image::Image image = {};  ///< RGB
    bool arrived = false;
};

Result<void> blit(const net::Image& from, image::Image& to) {
    const auto channels = static_cast<std::size_t>(from.channels);
    const std::size_t width = from.width;
    if ((channels != 3 && channels != 4) || from.pixels.size() != width * from.height * channels ||
        std::uint64_t{from.x} + from.width > static_cast<std::uint64_t>(to.width) ||
        std::uint64_t{from.y} + from.height > static_cast<std::uint64_t>(to.height))
        return fail(Errc::protocol,
                    fmt::format("a picture of {}x{} pixels at {},{} does not fit its window of "
                                "{}x{}",
                                from.width, from.height, from.x, from.y, to.width, to.height));
    for (std::size_t row = 0; row < from.height; ++row) {
        const std::uint8_t* source = from.pixels.data() + row * width * channels;
        std::uint8_t* target =
            to.pixels.data() + ((from.y + row) * static_cast<std::size_t>(to.width) + from.x) * 3;
        for (std::size_t x = 0; x < width; ++x)
            std::memcpy(target + x * 3, source + x * channels, 3);
    }
    return {};
}

/// Copies a viewport's pixels to its tile's place.
void place(const WindowPixels& window, const config::PixelRect& from, const config::TileRect& tile,
           image::Image& canvas) {
    const int width = std::min(from.width, tile.width);
    const int height = std::min(from.height, tile.height);
    const int top = window.image.height - from.bottom - from.height;  // rows from the top
    for (int row = 0; row < height; ++row) {
        const auto at = [](const image::Image& image, int x, int y) {
            return (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                    static_cast<std::size_t>(x)) *
                   3;
        };
        std::memcpy(canvas.pixels.data() + at(canvas, tile.x, tile.y + row),
                    window.image.pixels.data() + at(window.image, from.left, top + row),
                    static_cast<std::size_t>(width) * 3);
    }
}

}  // namespace

Result<std::vector<WallPicture>> assembleWall(const config::Config& config,
                                              const WallContainers& wall,
                                              std::span<const net::Image> images) {
    std::vector<WindowPixels> windows;
    for (const auto& server : config.servers)
        for (const auto& window : server.windows)
            windows.push_back({.image = image::blank(window.size[0], window.size[1], 3)});
    GNOMON_EXPECTS(windows.size() == wall.windows.size(), "the wall is of another config");
    std::unordered_map<std::uint64_t, std::size_t> indices;
    for (std::size_t i = 0; i < windows.size(); ++i) indices.emplace(wall.windows[i].id.value, i);
    for (const auto& image : images) {
        const auto found = indices.find(image.window);
        if (found == indices.end())
            return fail(Errc::protocol, "a picture of a window that does not exist");
        if (auto fits = blit(image, windows[found->second].image); !fits)
            return tl::unexpected{fits.error()};
        windows[found->second].arrived = true;
    }

    std::vector<WallPicture> pictures;
    for (std::size_t screen = 0; screen < config.screens.size(); ++screen) {
        for (const auto eye : eyesOf(config, screen)) {
            const auto canvas = config::canvas(config, screen);
            if (!canvas) return tl::unexpected{canvas.error()};
            WallPicture picture{.screen = config.screens[screen].name,
                                .eye = eye,
                                .image = image::blank(canvas->width, canvas->height, 3)};
            std::size_t index = 0;
            for (const auto& server : config.servers) {
                for (const auto& window : server.windows) {
                    const WindowPixels& pixels = windows[index++];
                    for (const auto& viewport : window.viewports) {
                        if (viewport.screen != picture.screen || viewport.eye != eye) continue;
                        if (!pixels.arrived) picture.missing.push_back(server.name);
                        place(pixels, config::pixelRect(window, viewport),
                              canvas->tile(viewport.tile[0], viewport.tile[1]), picture.image);
                    }
                }
            }
            pictures.push_back(std::move(picture));
        }
    }
    return pictures;
}

std::filesystem::path pictureFile(const std::filesystem::path& file,
                                  std::span<const WallPicture> all, const WallPicture& one) {
    const bool severalScreens = std::any_of(all.begin(), all.end(), [&](const WallPicture& other) {
        return other.screen != one.screen;
    });
    std::string name = file.stem().string();
    if (severalScreens) name += "-" + one.screen;
    if (one.eye != config::Eye::mono) name += "-" + std::string{config::name(one.eye)};
    return file.parent_path() / (name + file.extension().string());
}

}  // namespace gnomon::client

#pragma once

#include <gnomon/client/Look.h>
#include <gnomon/config/Config.h>
#include <gnomon/scene/Room.h>
#include <gnomon/scene/Window.h>

#include <cstddef>
#include <string>
#include <vector>

/// From a wall's description to the containers that show it.
namespace gnomon::client {

/// What stands for the room and its windows in an aspect.
struct WallContainers {
    field::Ref<scene::User> user = {};
    field::Ref<scene::Navigation> navigation = {};
    field::Ref<scene::PerspectiveCamera> lens = {};       ///< near and far of all viewports
    std::vector<field::Ref<scene::Screen>> screens = {};  ///< in the order of the config
    std::vector<field::Ref<scene::Window>> windows = {};  ///< in the order of the config
    std::vector<field::Ref<scene::ShadowViewport>> viewports = {};
};

/// All windows of all servers, each viewport with its tile of its screen.
/// @param root  what the viewports show
/// Errors: Errc::config (screens without area, unequal tiles), Errc::file (the foreground image).
/// On an error the aspect holds a part of the containers: drop it.
Result<WallContainers> buildWall(field::Aspect& aspect, const config::Config& config,
                                 field::Ref<scene::Node> root);

/// What a config says of shadows, put into a viewport.
void applyShadow(const config::Shadow& from, scene::ShadowViewport& viewport);

/// One window that shows a whole screen, bezels included, in one piece: one viewport an eye, side
/// by side, each with the pixels of the wall's canvas. The window bears the name @p server.
/// @pre screen < config.screens.size(), at least one eye
Result<WallContainers> buildWholeScreen(field::Aspect& aspect, const config::Config& config,
                                        std::size_t screen, const std::vector<config::Eye>& eyes,
                                        field::Ref<scene::Node> root, std::string server);

/// Places the room in the world: the config's head lands at the look's eye, the room's -z axis
/// points to its centre, a room metre is scale world metres.
math::Affine worldFromRoom(const config::Config& config, const Look& look) noexcept;
void setView(field::Aspect& aspect, const WallContainers& wall, const config::Config& config,
             const Look& look);
/// Near and far of all viewports, metres of the world; the config's own values come first.
void setDepthRange(field::Aspect& aspect, const WallContainers& wall, const config::Config& config,
                   const DepthRange& range);

/// What the head sees of the screens in front of it, together.
Opening wallOpening(const config::Config& config) noexcept;
/// Metres from the head to the plane of the screen that is most straight ahead.
double wallDistance(const config::Config& config) noexcept;

/// Eyes that any viewport shows the screen to, in the order mono, left, right.
std::vector<config::Eye> eyesOf(const config::Config& config, std::size_t screen);

}  // namespace gnomon::client

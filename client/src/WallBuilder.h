#pragma once

#include <gnomon/client/WallSetup.h>
#include <gnomon/config/Layout.h>

#include <optional>

namespace gnomon::client {

inline math::dvec3 toVector(const config::Point& point) { return {point[0], point[1], point[2]}; }

/// Makes the containers of a wall one by one.
class WallBuilder {
public:
    WallBuilder(field::Aspect& aspect, const config::Config& config, field::Ref<scene::Node> root);

    /// User, navigation, screens, lens, background, foreground image.
    Result<void> addRoom();
    /// A viewport that shows a part of a screen's canvas; @p part in pixels of the canvas from its
    /// upper left.
    field::Ref<scene::Viewport> addViewport(std::size_t screen, config::Eye eye,
                                            const config::Canvas& canvas,
                                            const config::TileRect& part, const math::Rect& rect);
    void addWindow(const std::string& server, const config::Window& window, int gpu,
                   std::vector<field::Ref<scene::Viewport>> viewports);

    WallContainers take() { return std::move(made_); }

private:
    Result<void> addForeground();
    void addBackground();
    /// The screen seen by an eye: shared by all viewports that look through it.
    field::Ref<scene::Camera> eyeCamera(std::size_t screen, config::Eye eye);
    void placeForeground(scene::ShadowViewport& viewport, const config::Canvas& canvas,
                         const config::TileRect& part);

    field::Aspect& aspect_;
    const config::Config& config_;
    field::Ref<scene::Node> root_;
    WallContainers made_ = {};
    field::Ref<scene::Background> background_ = {};
    field::Ref<scene::Texture> foreground_ = {};
    std::vector<std::array<field::Ref<scene::Camera>, 3>> eyeCameras_ = {};
};

}  // namespace gnomon::client

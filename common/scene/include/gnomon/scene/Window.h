#pragma once

#include <gnomon/scene/Camera.h>
#include <gnomon/scene/Material.h>

#include <algorithm>

namespace gnomon::scene {

/// What is seen where nothing is drawn. Colours are linear RGB.
class Background : public field::FieldContainer {};

class SolidBackground final : public Container<SolidBackground, Background> {
public:
    static constexpr std::string_view typeName = "SolidBackground";
    Field<math::vec3> color;
    static constexpr auto fields() { return std::tuple{entry("color", &SolidBackground::color)}; }
};

/// Colours from the bottom (0) to the top (1) of the whole picture, tiles together; positions
/// ascend.
class GradientBackground final : public Container<GradientBackground, Background> {
public:
    static constexpr std::string_view typeName = "GradientBackground";
    MultiField<math::vec4> stops;  ///< rgb, position
    static constexpr auto fields() {
        return std::tuple{entry("stops", &GradientBackground::stops)};
    }
};

/// What is drawn last, over everything, unshadowed.
class Foreground : public field::FieldContainer {};

/// An image (a logo); rgba, blended by its alpha.
class ImageForeground final : public Container<ImageForeground, Foreground> {
public:
    static constexpr std::string_view typeName = "ImageForeground";
    Field<Ref<Texture>> image;
    /// In the viewport: by shares where all four are <= 1, else in pixels.
    Field<math::Rect> rect;
    static constexpr auto fields() {
        return std::tuple{entry("image", &ImageForeground::image),
                          entry("rect", &ImageForeground::rect)};
    }
};

/// A part of a window that shows a scene through a camera.
class Viewport : public field::FieldContainer {
public:
    /// In the window: a number <= 1 is a share, a larger one pixels (as OpenSG's).
    Field<math::Rect> rect;
    Field<Ref<Camera>> camera;
    Field<Ref<Node>> root;
    Field<Ref<Background>> background;
    MultiField<Ref<Foreground>> foregrounds;
    /// Light from everywhere: radiance (linear RGB) of a white surface facing up and down.
    Field<math::vec3> ambientSky{math::vec3{0.20F, 0.22F, 0.26F}};
    Field<math::vec3> ambientGround{math::vec3{0.10F, 0.09F, 0.08F}};

protected:
    template <class Self>
    static constexpr auto viewportFields() {
        return std::tuple{
            entry("rect", static_cast<Field<math::Rect> Self::*>(&Viewport::rect)),
            entry("camera", static_cast<Field<Ref<Camera>> Self::*>(&Viewport::camera)),
            entry("root", static_cast<Field<Ref<Node>> Self::*>(&Viewport::root)),
            entry("background", static_cast<Field<Ref<Background>> Self::*>(&Viewport::background)),
            entry("foregrounds",
                  static_cast<MultiField<Ref<Foreground>> Self::*>(&Viewport::foregrounds)),
            entry("ambientSky", static_cast<Field<math::vec3> Self::*>(&Viewport::ambientSky)),
            entry("ambientGround",
                  static_cast<Field<math::vec3> Self::*>(&Viewport::ambientGround))};
    }
};

/// Without shadows.
class PlainViewport final : public Container<PlainViewport, Viewport> {
public:
    static constexpr std::string_view typeName = "PlainViewport";
    static constexpr auto fields() { return viewportFields<PlainViewport>(); }
};

/// How fits learn how deep the view really is: what is hidden needs no shadow map.
enum class DepthUse {
    off,       ///< from bounding boxes alone
    previous,  ///< as it was in the last frame, with a margin
    exact,     ///< a depth pass first, in every frame that changes, on all servers
    last = exact
};

/// With shadows: put in place of a plain one, everything has a default.
/// Source: Nico Hempe. Diploma thesis on the OpenSG ShadowViewport. 2005, chapter 9.3.
class ShadowViewport final : public Container<ShadowViewport, Viewport> {
public:
    static constexpr std::string_view typeName = "ShadowViewport";
    Field<bool> shadowOn{true};
    /// `FIT[+FILTER]`, see shadow/Registry.h; "none" is the plain picture.
    Field<std::string> technique{"std"};
    /// Texels a side; larger maps are drawn in pages. 0: see mapSizeFor().
    Field<std::int32_t> mapSize;
    Field<math::vec4> shadowColor{math::vec4{0.0F, 0.0F, 0.0F, 1.0F}};  ///< rgb, a = darkness
    Field<float> range{0.3F};         ///< focus region, 0 < range < 0.8
    Field<std::int32_t> cascades{4};  ///< of csm, 2 to 8
    /// Radius of the kernel that pcf, vsm and evsm blur with, metres. 0: see
    /// shadow_fit::softnessOf().
    Field<float> softness;
    Field<std::int32_t> kernelWidth{8};  ///< of square, texels
    /// Of square, a row; 0: all of its texels.
    Field<std::int32_t> kernelSamples;
    Field<bool> qualityMode;  ///< better for more time: exact depth, more samples
    Field<DepthUse> depthRange;
    Field<float> offBias{4.0F};  ///< with overrideBias: constant offset, units of depth resolution
    Field<float> offFactor{10.0F};       ///< with overrideBias: factor of the slope
    Field<bool> overrideBias;            ///< false: the offset is derived for each receiver
    MultiField<Ref<Node>> lightNodes;    ///< empty: found by traversal
    MultiField<Ref<Node>> excludeNodes;  ///< subtrees that cast no shadow

    static constexpr auto fields() {
        using V = ShadowViewport;
        return std::tuple_cat(
            viewportFields<V>(),
            std::tuple{entry("shadowOn", &V::shadowOn), entry("technique", &V::technique),
                       entry("mapSize", &V::mapSize), entry("shadowColor", &V::shadowColor),
                       entry("range", &V::range), entry("cascades", &V::cascades),
                       entry("softness", &V::softness), entry("kernelWidth", &V::kernelWidth),
                       entry("kernelSamples", &V::kernelSamples),
                       entry("qualityMode", &V::qualityMode), entry("depthRange", &V::depthRange),
                       entry("offBias", &V::offBias), entry("offFactor", &V::offFactor),
                       entry("overrideBias", &V::overrideBias), entry("lightNodes", &V::lightNodes),
                       entry("excludeNodes", &V::excludeNodes)});
    }
};

/// Texels a side of a shadow map where none are asked for: 512, doubled until they are not fewer
/// than the pixels of the shorter side of what the whole screen shows.
inline int mapSizeFor(glm::ivec2 whole) noexcept {
    int size = 512;
    while (size < std::min(whole.x, whole.y) && size < 16384) size *= 2;
    return size;
}

/// Where a server draws. A server draws the windows that bear its name.
class Window final : public Container<Window> {
public:
    static constexpr std::string_view typeName = "Window";
    Field<std::string> server;
    Field<std::string> title;
    Field<glm::ivec2> size{glm::ivec2{640, 480}};  ///< pixels
    Field<glm::ivec2> position;
    Field<bool> fullscreen;
    Field<std::int32_t> monitor;
    Field<std::int32_t> gpu{-1};     ///< -1: the server's
    Field<std::int32_t> samples{1};  ///< multisampling, 1 is off
    MultiField<Ref<Viewport>> viewports;
    Field<bool> swapGroup;  ///< swaps with all others that do, where the driver can
    static constexpr auto fields() {
        return std::tuple{entry("server", &Window::server),
                          entry("title", &Window::title),
                          entry("size", &Window::size),
                          entry("position", &Window::position),
                          entry("fullscreen", &Window::fullscreen),
                          entry("monitor", &Window::monitor),
                          entry("gpu", &Window::gpu),
                          entry("samples", &Window::samples),
                          entry("viewports", &Window::viewports),
                          entry("swapGroup", &Window::swapGroup)};
    }
};

}  // namespace gnomon::scene

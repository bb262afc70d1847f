#pragma once

#include <gnomon/math/View.h>
#include <gnomon/scene/Camera.h>

namespace gnomon::scene {

/// What a camera with all its decorators shows.
struct CameraView {
    math::View view = {};     ///< as decorated: what is drawn
    math::View whole = {};    ///< without tile decorators: what the whole screen or window shows
    math::Rect part = {};     ///< which part of the whole that is
    double worldScale = 1.0;  ///< metres of the world to a metre of the room
    /// The screen, else the innermost camera: whoever shares it belongs to one fit group.
    Ref<field::FieldContainer> group = {};
};

/// @param aspect  width / height of the viewport's pixels, for perspective cameras; what a tile
///                decorator decorates has the shape of the whole.
/// Errors (Errc::edit): a missing decoratee, or decorators that go round in a circle.
Result<CameraView> cameraView(const field::Aspect& scene, Ref<Camera> camera, double aspect);

/// worldFromNode, by walking up from the node; the identity for no node.
math::dmat4 worldFromNode(const field::Aspect& scene, Ref<Node> node);

/// The box in pixels, from the window's lower left, that a viewport's rect means: a number <= 1 is
/// a share, a larger one pixels.
struct PixelRect {
    int x = 0, y = 0, width = 0, height = 0;
    friend bool operator==(const PixelRect&, const PixelRect&) = default;
};
PixelRect pixelRect(const math::Rect& rect, glm::ivec2 window) noexcept;

}  // namespace gnomon::scene

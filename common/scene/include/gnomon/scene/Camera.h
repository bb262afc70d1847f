#pragma once

#include <gnomon/scene/Node.h>
#include <gnomon/scene/Room.h>

namespace gnomon::scene {

/// What a viewport looks through. See cameraView() in CameraView.h for what they mean together.
class Camera : public field::FieldContainer {};

/// Looks along its beacon's -z.
class PerspectiveCamera final : public Container<PerspectiveCamera, Camera> {
public:
    static constexpr std::string_view typeName = "PerspectiveCamera";
    Field<Ref<Node>> beacon;
    Field<double> fovy{1.0471975511965976};  ///< vertical, radians
    Field<double> near{0.1};                 ///< metres
    Field<double> far{1000.0};
    static constexpr auto fields() {
        return std::tuple{
            entry("beacon", &PerspectiveCamera::beacon), entry("fovy", &PerspectiveCamera::fovy),
            entry("near", &PerspectiveCamera::near), entry("far", &PerspectiveCamera::far)};
    }
};

/// A camera by its two matrices; clip space as math::View's.
class MatrixCamera final : public Container<MatrixCamera, Camera> {
public:
    static constexpr std::string_view typeName = "MatrixCamera";
    Field<math::dmat4> clipFromEye{math::dmat4{1.0}};
    Field<math::dmat4> eyeFromWorld{math::dmat4{1.0}};
    static constexpr auto fields() {
        return std::tuple{entry("clipFromEye", &MatrixCamera::clipFromEye),
                          entry("eyeFromWorld", &MatrixCamera::eyeFromWorld)};
    }
};

enum class Eye { mono, left, right, last = right };

/// One eye of a stereo pair in front of a perspective or matrix camera: the frustum is sheared so
/// that both eyes' agree at the zero parallax distance.
class StereoDecorator final : public Container<StereoDecorator, Camera> {
public:
    static constexpr std::string_view typeName = "StereoDecorator";
    Field<Ref<Camera>> decoratee;
    Field<Eye> eye;
    Field<double> eyeSeparation{0.065};       ///< metres
    Field<double> zeroParallaxDistance{2.0};  ///< metres
    static constexpr auto fields() {
        return std::tuple{entry("decoratee", &StereoDecorator::decoratee),
                          entry("eye", &StereoDecorator::eye),
                          entry("eyeSeparation", &StereoDecorator::eyeSeparation),
                          entry("zeroParallaxDistance", &StereoDecorator::zeroParallaxDistance)};
    }
};

/// Looks through a real screen with a user's eye, off-axis. Takes near and far from the decorated
/// camera, and everything else from the room. OpenSG's ProjectionCameraDecorator.
class ScreenDecorator final : public Container<ScreenDecorator, Camera> {
public:
    static constexpr std::string_view typeName = "ScreenDecorator";
    Field<Ref<Camera>> decoratee;
    Field<Ref<Screen>> screen;
    Field<Ref<User>> user;
    Field<Ref<Navigation>> navigation;
    Field<Eye> eye;
    static constexpr auto fields() {
        return std::tuple{
            entry("decoratee", &ScreenDecorator::decoratee),
            entry("screen", &ScreenDecorator::screen), entry("user", &ScreenDecorator::user),
            entry("navigation", &ScreenDecorator::navigation), entry("eye", &ScreenDecorator::eye)};
    }
};

/// Shows a part of what the decorated camera shows: exact in the projection matrix.
class TileDecorator final : public Container<TileDecorator, Camera> {
public:
    static constexpr std::string_view typeName = "TileDecorator";
    Field<Ref<Camera>> decoratee;
    Field<math::Rect> part;  ///< of the whole picture
    static constexpr auto fields() {
        return std::tuple{entry("decoratee", &TileDecorator::decoratee),
                          entry("part", &TileDecorator::part)};
    }
};

}  // namespace gnomon::scene

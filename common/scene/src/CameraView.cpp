#include <gnomon/scene/CameraView.h>

#include <cmath>
#include <utility>

namespace gnomon::scene {
namespace {

/// Decorators nest at most this deep; also ends a circle of them.
constexpr int maxDecorators = 16;

double eyeSign(Eye eye) noexcept { return eye == Eye::left ? -0.5 : eye == Eye::right ? 0.5 : 0.0; }

class Resolver {
public:
    Resolver(const field::Aspect& scene, double aspect) : scene_{scene}, aspect_{aspect} {}

    Result<CameraView> resolve(Ref<Camera> ref, int depth) {
        if (depth > maxDecorators)
            return fail(Errc::edit, "a camera's decorators are nested too deep or in a circle");
        const Camera* camera = scene_.get(ref);
        if (camera == nullptr) return fail(Errc::edit, "a viewport or decorator has no camera");
        if (const auto* c = dynamic_cast<const PerspectiveCamera*>(camera)) return perspective(*c);
        if (const auto* c = dynamic_cast<const MatrixCamera*>(camera)) {
            CameraView result;
            result.view = {.clipFromEye = c->clipFromEye, .eyeFromWorld = c->eyeFromWorld};
            result.whole = result.view;
            result.group = Ref<field::FieldContainer>{*c};
            return result;
        }
        if (const auto* c = dynamic_cast<const StereoDecorator*>(camera)) return stereo(*c, depth);
        if (const auto* c = dynamic_cast<const ScreenDecorator*>(camera)) return screen(*c, depth);
        if (const auto* c = dynamic_cast<const TileDecorator*>(camera)) return tile(*c, depth);
        return fail(Errc::edit, "a camera of a type that is not known here");
    }

private:
    CameraView perspective(const PerspectiveCamera& camera) const {
        CameraView result;
        result.view.clipFromEye = math::perspective(camera.fovy, aspect_, camera.near, camera.far);
        result.view.eyeFromWorld = math::inverted(worldFromNode(scene_, camera.beacon));
        result.whole = result.view;
        result.group = Ref<field::FieldContainer>{camera};
        return result;
    }

    Result<CameraView> stereo(const StereoDecorator& camera, int depth) {
        auto result = resolve(camera.decoratee, depth + 1);
        if (!result) return result;
        const double shift = eyeSign(camera.eye) * camera.eyeSeparation;
        for (math::View* view : {&result->view, &result->whole}) {
            // The eye moves by shift; the frustum is sheared back so that the plane at the zero
            // parallax distance stays where it was: x_clip += m00 * shift * (1 + z/zero).
            math::dmat4 move{1.0};
            move[3][0] = -shift;
            view->eyeFromWorld = move * view->eyeFromWorld;
            const double zero = std::max(camera.zeroParallaxDistance.get(), 1e-6);
            view->clipFromEye[2][0] -= view->clipFromEye[0][0] * shift / zero;
        }
        return result;
    }

    Result<CameraView> screen(const ScreenDecorator& camera, int depth) {
        auto inner = resolve(camera.decoratee, depth + 1);
        if (!inner) return inner;
        const Screen* screen = scene_.get(camera.screen.get());
        const User* user = scene_.get(camera.user.get());
        if (screen == nullptr || user == nullptr)
            return fail(Errc::edit, "a screen decorator without a screen or a user");
        const Navigation* navigation = scene_.get(camera.navigation.get());
        const math::dmat4 worldFromRoom =
            navigation == nullptr ? math::dmat4{1.0} : math::toMatrix(navigation->worldFromRoom);
        const double volume = std::abs(glm::determinant(math::dmat3{worldFromRoom}));
        // A room of no size shows nothing: its view cannot be looked back through.
        const double scale = volume > 0.0 && std::isfinite(volume) ? std::cbrt(volume) : 1.0;
        const auto* lens =
            dynamic_cast<const PerspectiveCamera*>(scene_.get(camera.decoratee.get()));
        const double near = lens == nullptr ? 0.1 : lens->near.get();
        const double far = lens == nullptr ? 1000.0 : lens->far.get();

        const math::dmat4 roomFromHead = math::toMatrix(user->roomFromHead);
        const math::dvec3 eye{
            roomFromHead * math::dvec4{eyeSign(camera.eye) * user->eyeSeparation, 0.0, 0.0, 1.0}};
        const math::ScreenCorners corners{.lowerLeft = screen->lowerLeft,
                                          .lowerRight = screen->lowerRight,
                                          .upperLeft = screen->upperLeft};
        CameraView result;
        // Near and far are metres of the world; offAxis works in the room.
        math::View room = math::offAxis(eye, corners, near / scale, far / scale);
        // Eye space in world metres: undo the room's scale, so that eyeFromWorld is rigid.
        math::dmat4 grow{scale};
        grow[3][3] = 1.0;
        math::dmat4 shrink{1.0 / scale};
        shrink[3][3] = 1.0;
        result.view.eyeFromWorld = grow * room.eyeFromWorld * math::inverted(worldFromRoom);
        result.view.clipFromEye = room.clipFromEye * shrink;
        // shrink scales clip coordinates with w; bring w back to the distance in world metres.
        result.view.clipFromEye *= scale;
        result.whole = result.view;
        result.worldScale = scale;
        result.group = Ref<field::FieldContainer>{*screen};
        return result;
    }

    Result<CameraView> tile(const TileDecorator& camera, int depth) {
        const math::Rect part = camera.part;
        if (!(part.width > 0.0 && part.height > 0.0))
            return fail(Errc::edit, "a tile decorator without area");
        // What is decorated shows the whole, which has another shape than the tile.
        const double tileAspect = std::exchange(aspect_, aspect_ * part.height / part.width);
        auto result = resolve(camera.decoratee, depth + 1);
        aspect_ = tileAspect;
        if (!result) return result;
        result->view.clipFromEye = math::tileFromWhole(part) * result->view.clipFromEye;
        result->part = {.left = result->part.left + part.left * result->part.width,
                        .bottom = result->part.bottom + part.bottom * result->part.height,
                        .width = result->part.width * part.width,
                        .height = result->part.height * part.height};
        return result;
    }

    const field::Aspect& scene_;
    double aspect_;
};

}  // namespace

Result<CameraView> cameraView(const field::Aspect& scene, Ref<Camera> camera, double aspect) {
    return Resolver{scene, aspect}.resolve(camera, 0);
}

math::dmat4 worldFromNode(const field::Aspect& scene, Ref<Node> node) {
    math::dmat4 world{1.0};
    for (const Node* at = scene.get(node); at != nullptr; at = scene.get(at->parent()))
        if (const auto* transform = scene.get(Ref<Transform>{at->core->id}))
            world = math::toMatrix(transform->matrix) * world;
    return world;
}

PixelRect pixelRect(const math::Rect& rect, glm::ivec2 window) noexcept {
    const auto pixels = [](double value, int whole) {
        return static_cast<int>(std::lround(value <= 1.0 ? value * whole : value));
    };
    const int x = pixels(rect.left, window.x);
    const int y = pixels(rect.bottom, window.y);
    // Where both are shares the far edge is rounded, not the width, so that neighbours meet.
    const auto far = [&](double low, double extent, int start, int whole) {
        return low <= 1.0 && extent <= 1.0 ? static_cast<int>(std::lround((low + extent) * whole))
                                           : start + pixels(extent, whole);
    };
    const int right = far(rect.left, rect.width, x, window.x);
    const int top = far(rect.bottom, rect.height, y, window.y);
    return {.x = x, .y = y, .width = right - x, .height = top - y};
}

}  // namespace gnomon::scene

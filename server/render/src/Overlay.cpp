#include "Overlay.h"

#include <algorithm>
#include <array>

namespace gnomon::render {

void Overlay::drawBackground(const field::Aspect& scene, const scene::Viewport& viewport,
                             const math::Rect& part) {
    std::array<math::vec4, 16> stops{};
    int count = 1;
    const scene::Background* background = scene.get(viewport.background.get());
    if (const auto* solid = dynamic_cast<const scene::SolidBackground*>(background)) {
        stops[0] = math::vec4{solid->color.get(), 0.0F};
    } else if (const auto* gradient = dynamic_cast<const scene::GradientBackground*>(background)) {
        count = static_cast<int>(std::min(gradient->stops.size(), stops.size()));
        std::copy_n(gradient->stops.begin(), count, stops.begin());
        count = std::max(count, 1);
    }
    const GLuint program = programs_.background();
    gl_.UseProgram(program);
    gl_.ProgramUniform2f(program, 0, static_cast<float>(part.bottom),
                         static_cast<float>(part.height));
    gl_.ProgramUniform1i(program, 1, count);
    gl_.ProgramUniform4fv(program, 2, count, &stops[0].x);
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(GL_EQUAL);
    gl_.DepthMask(GL_FALSE);
    gl_.Disable(GL_CULL_FACE);
    gl_.BindVertexArray(empty_.id());
    gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 2 * (count + 2));
    gl_.DepthFunc(GL_GREATER);
    gl_.DepthMask(GL_TRUE);
}

void Overlay::drawForegrounds(const field::Aspect& scene, const scene::Viewport& viewport,
                              const scene::PixelRect& pixels) {
    for (const auto& ref : viewport.foregrounds) {
        const auto* image = dynamic_cast<const scene::ImageForeground*>(scene.find(ref.id));
        if (image == nullptr) continue;
        const GLuint texture = textures_.get(scene.get(image->image.get()));
        if (texture == 0) continue;
        const math::Rect r = image->rect;
        const bool shares = r.left <= 1.0 && r.bottom <= 1.0 && r.width <= 1.0 && r.height <= 1.0;
        const double sx = 2.0 / (shares ? 1.0 : std::max(pixels.width, 1));
        const double sy = 2.0 / (shares ? 1.0 : std::max(pixels.height, 1));
        const GLuint program = programs_.foreground();
        gl_.UseProgram(program);
        gl_.ProgramUniform4f(program, 0, static_cast<float>(r.left * sx - 1.0),
                             static_cast<float>(r.bottom * sy - 1.0),
                             static_cast<float>(r.width * sx), static_cast<float>(r.height * sy));
        gl_.Disable(GL_DEPTH_TEST);
        gl_.Disable(GL_CULL_FACE);
        gl_.Enable(GL_BLEND);
        gl_.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
        gl_.BindTextureUnit(0, texture);
        gl_.BindVertexArray(empty_.id());
        gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
        gl_.Disable(GL_BLEND);
        gl_.Enable(GL_DEPTH_TEST);
    }
}

}  // namespace gnomon::render

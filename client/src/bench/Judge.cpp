#include "Judge.h"

#include <gnomon/image/Png.h>

namespace gnomon::client {
namespace {

constexpr int stillSamples = 64;
constexpr int pathSamples = 16;
constexpr int settlingFrames = 2;

/// Wrong shares of each band, counted as truth::compareFactors() counts.
std::array<double, 3> wrongIn(const image::Image& bands, const image::Image& truth,
                              const image::Image& factor) {
    std::array<double, 3> wrong{};
    std::array<double, 3> counted{};
    for (std::size_t i = 0; i < bands.pixels.size(); ++i) {
        const std::size_t band = bands.pixels[i];
        if (band >= wrong.size() || truth.pixels[i] == truth::noSurface) continue;
        counted[band] += 1.0;
        if ((truth.pixels[i] > 127) != (factor.pixels[i] > 127)) wrong[band] += 1.0;
    }
    for (std::size_t band = 0; band < wrong.size(); ++band)
        if (counted[band] > 0.0) wrong[band] /= counted[band];
    return wrong;
}

}  // namespace

Judge::Judge(Reference& reference, const BenchView& view, int flickerFrames, const CameraPath* path,
             Console& console)
    : aspect_{reference.types(), 2},
      reference_{reference},
      stage_{aspect_, reference, view, {}},
      size_{(*view.view.size)[0], (*view.view.size)[1]},
      rest_{.look = *view.view.look()} {
    truth_ =
        trace(stillSamples, [&](double share) { console.progress("truth", share, view.name); });
    bands_ = reference_.bands(stage_.view(), size_.x, size_.y);
    if (flickerFrames < 2) return;
    camera_ = along(cameraSteps(rest_.look, path, flickerFrames), console);
    light_ = along(lightSteps(rest_.look, flickerFrames), console);
}

image::Image Judge::trace(int count, const std::function<void(double)>& progress) const {
    return reference_
        .truth(stage_.view(), stage_.lightShape(),
               {.width = size_.x, .height = size_.y, .samples = count, .progress = progress})
        .factor;
}

std::vector<Judge::Moment> Judge::along(const std::vector<Step>& steps, Console& console) {
    std::vector<Moment> moments;
    for (const Step& step : steps) {
        stage_.take(step);
        moments.push_back({.step = step, .truth = trace(pathSamples, {})});
        console.progress("truth along a path",
                         static_cast<double>(moments.size()) / static_cast<double>(steps.size()),
                         "");
    }
    stage_.take(rest_);
    return moments;
}

std::optional<math::dvec3> Judge::onlySun() const {
    const auto light = stage_.lightShape();
    if (stage_.lights() != 1 || light.kind != shadow_fit::LightKind::directional) return {};
    return -light.direction;
}

FlickerError Judge::flicker(Contender& contender, const std::vector<Moment>& moments) const {
    Flicker found;
    for (const Moment& moment : moments) {
        contender.take(moment.step);
        found.add(moment.truth, contender.factor());
    }
    return found.found();
}

void Judge::judge(Contender& contender, BenchRow& row, const std::filesystem::path& picture) const {
    // What fits learn from earlier frames, they have learnt.
    for (int i = 0; i < settlingFrames; ++i) contender.frame(Motion::moving);
    const image::Image factor = contender.factor();
    row.error = orThrow(truth::compareFactors(truth_, factor));
    row.bands = wrongIn(bands_, truth_, factor);
    if (!picture.empty()) orThrow(image::writePng(picture, truth::errorPicture(truth_, factor)));
    if (camera_.empty()) return;
    row.cameraFlicker = flicker(contender, camera_);
    row.lightFlicker = flicker(contender, light_);
    contender.take(rest_);
}

}  // namespace gnomon::client

#include "Reference.h"

#include <gnomon/client/AnimationPlayer.h>
#include <gnomon/import/Import.h>

#include <algorithm>
#include <numbers>

namespace gnomon::client {
namespace {

field::TypeRegistry allTypes() {
    field::TypeRegistry types;
    scene::addTypes(types);
    return types;
}

field::ChangeList read(const std::filesystem::path& file, Console& console) {
    return orThrow(importer::importScene(
        file, {.progress = [&](double share, const std::string& what) {
            console.progress("loading", share, share < 1.0 ? what : file.filename().string());
        }}));
}

}  // namespace

Reference::Reference(const std::filesystem::path& file, Console& console)
    : file_{file},
      types_{allTypes()},
      imported_{read(file, console)},
      aspect_{types_, 2},
      flat_{aspect_},
      rays_{aspect_} {
    prepared_ = orThrow(prepareScene(aspect_, {.file = file, .imported = &imported_}));
    for (const auto& warning : prepared_.model->warnings) console.log(LogLevel::warning, warning);
    AnimationPlayer player;
    player.play(aspect_, *prepared_.model);
    player.animate(aspect_, 0.0);
    flat_.update(prepared_.tree.root, {}, {});
}

BenchView Reference::resolved(const BenchView& view, std::array<int, 2> size) const {
    BenchView whole = view;
    const double shape = static_cast<double>(size[0]) / size[1];
    const double fovy = std::numbers::pi / 3.0;
    const auto fallback =
        defaultView(aspect_, prepared_, opening(view.view.fovy.value_or(fovy), shape));
    const auto given = view.view.look();
    const Look look = given.value_or(fallback.look);
    const DepthRange range = depthRange(prepared_.bounds, look.eye);
    whole.view.size = size;
    whole.view.eye = look.eye;
    whole.view.center = look.center;
    whole.view.up = look.up;
    whole.view.fovy = view.view.fovy.value_or(given ? fovy : fallback.fovy.value_or(fovy));
    whole.view.near = view.view.near.value_or(range.near);
    whole.view.far = view.view.far.value_or(range.far);
    if (view.sun) whole.lights = {sunSeenFrom(look, *view.sun)};
    return whole;
}

void Reference::lookFrom(const math::View& view) {
    // Along a path the first eye stays the origin: it is close enough, and costs nothing.
    const math::dvec3 origin = truth::originFor(flat_.bounds(), view.eyeWorld());
    if (placed_ && glm::distance(rays_.origin(), origin) < 64.0) return;
    rays_.update(flat_, origin);
    placed_ = true;
}

truth::Truth Reference::truth(const math::View& view, const shadow_fit::LightShape& light,
                              const truth::TruthOptions& options) {
    lookFrom(view);
    return truth::shadowTruth(rays_, view, light, options);
}

image::Image Reference::bands(const math::View& view, int width, int height) {
    lookFrom(view);
    const math::dmat4 worldFromClip = glm::inverse(view.clipFromWorld());
    const auto unproject = [&](double x, double y, double z) {
        const math::dvec4 p = worldFromClip * math::dvec4{x, y, z, 1.0};
        return math::dvec3{p} / p.w - rays_.origin();
    };
    std::vector<float> depths(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                              -1.0F);
    std::vector<float> sorted;
    std::size_t i = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x, ++i) {
            const double cx = (x + 0.5) / width * 2.0 - 1.0;
            const double cy = 1.0 - (y + 0.5) / height * 2.0;
            const math::dvec3 from = unproject(cx, cy, 1.0);
            const math::dvec3 ray = unproject(cx, cy, 0.0) - from;
            const double length = glm::length(ray);
            const auto hit = rays_.firstHit(from, ray / length, length);
            if (!hit) continue;
            depths[i] = static_cast<float>(hit->distance);
            sorted.push_back(depths[i]);
        }
    }
    std::sort(sorted.begin(), sorted.end());
    image::Image found = image::blank(width, height, 1);
    for (i = 0; i < depths.size(); ++i) {
        const auto rank =
            std::lower_bound(sorted.begin(), sorted.end(), depths[i]) - sorted.begin();
        const auto third =
            static_cast<std::size_t>(rank) * 3 / std::max<std::size_t>(1, sorted.size());
        found.pixels[i] = depths[i] < 0.0F ? noBand : static_cast<std::uint8_t>(third);
    }
    return found;
}

}  // namespace gnomon::client

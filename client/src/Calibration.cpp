#include "Calibration.h"

#include <gnomon/scene/CameraView.h>
#include <gnomon/shadow_fit/ShadowFitter.h>
#include <gnomon/truth/ShadowError.h>
#include <gnomon/truth/Truth.h>

#include <algorithm>
#include <chrono>

namespace gnomon::client {
namespace {

constexpr int framesEach = 5;       // at the most
constexpr double enoughMs = 300.0;  // of them: what is that slow need not be known better
constexpr int samplesOfExtent = 64;

class Calibration {
public:
    Calibration(LocalSession& session, const std::vector<field::Ref<scene::Window>>& windows)
        : session_{session}, windows_{windows} {}

    bool look();
    bool hasExtent() const { return light_.extent > 0.0; }
    bool isQualityAsked() const { return quality_; }
    void trace();
    void measure(Measured& candidate);
    void use(const Measured& candidate);

private:
    template <class Do>
    void viewports(Do act) {
        for (const auto& ref : windows_)
            for (const auto& viewport : session_.aspect().get(ref)->viewports)
                if (const auto* shadowed = dynamic_cast<const scene::ShadowViewport*>(
                        session_.aspect().find(viewport.id)))
                    act(*shadowed);
    }

    LocalSession& session_;
    const std::vector<field::Ref<scene::Window>>& windows_;
    field::Ref<scene::Node> lightNode_ = {};
    shadow_fit::LightShape light_ = {};
    image::Image truth_ = {};
    bool quality_ = false;  ///< as asked for; and so is
    scene::DepthUse depthRange_ = scene::DepthUse::off;
};

/// False where there is no shadow to judge.
bool Calibration::look() {
    const field::Aspect& aspect = session_.aspect();
    const scene::ShadowViewport* first = nullptr;
    viewports([&](const scene::ShadowViewport& v) { first = first == nullptr ? &v : first; });
    if (first == nullptr) return false;
    quality_ = first->qualityMode;
    depthRange_ = first->depthRange;
    scene::FlatScene flat{aspect};
    flat.update(first->root, {}, {});
    for (const auto& use : flat.lights()) {
        if (!use.light->on || !use.light->castsShadow) continue;
        lightNode_ = *use.node;
        light_ = shadow_fit::lightShape(use);
        return true;
    }
    return false;
}

void Calibration::trace() {
    const field::Aspect& aspect = session_.aspect();
    const scene::Window& window = *aspect.get(windows_.front());
    const auto* viewport =
        dynamic_cast<const scene::Viewport*>(aspect.find(window.viewports[0].id));
    const auto pixels = scene::pixelRect(viewport->rect, window.size);
    const auto camera = orThrow(scene::cameraView(
        aspect, viewport->camera, static_cast<double>(pixels.width) / pixels.height));
    scene::FlatScene flat{aspect};
    flat.update(viewport->root, {}, {});
    truth::RayScene rays{aspect};
    rays.update(flat, truth::originFor(flat.bounds(), camera.view.eyeWorld()));
    truth_ = truth::shadowTruth(rays, camera.view, light_,
                                {.width = pixels.width,
                                 .height = pixels.height,
                                 .samples = hasExtent() ? samplesOfExtent : 1})
                 .factor;
}

void Calibration::use(const Measured& candidate) {
    viewports([&](const scene::ShadowViewport& viewport) {
        auto e = edit(viewport);
        e->technique = candidate.technique;
        e->mapSize = candidate.mapSize;
        e->qualityMode = candidate.quality || quality_;
        e->depthRange = candidate.quality ? scene::DepthUse::exact : depthRange_;
    });
    session_.commit();
}

void Calibration::measure(Measured& candidate) {
    using Clock = std::chrono::steady_clock;
    use(candidate);
    auto& renderer = session_.renderer();
    std::vector<double> times;
    double sum = 0.0;
    for (int i = 0; i <= framesEach && sum < enoughMs; ++i) {
        // What moves is drawn anew in every frame: so is a wall's picture, most of the time.
        renderer.forgetShadows();
        const auto begin = Clock::now();
        for (const auto& window : windows_) orThrow(renderer.draw(session_.rendered(window), 0.0));
        renderer.finish();
        // The first one compiles.
        if (i == 0) continue;
        times.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
        sum += times.back();
    }
    const auto middle = times.begin() + std::ssize(times) / 2;
    std::nth_element(times.begin(), middle, times.end());
    candidate.ms = *middle;
    const auto factor = renderer.shadowFactor(session_.rendered(windows_.front()), 0, lightNode_);
    const auto error =
        orThrow(truth::compareFactors(truth_, orThrow(Result<image::Image>{factor})));
    candidate.error = 100.0 * (hasExtent() ? error.rmse : error.share(error.wrong));
}

}  // namespace

Choice calibrate(LocalSession& session, const std::vector<field::Ref<scene::Window>>& windows,
                 const Budget& budget, Console& console) {
    Calibration calibration{session, windows};
    if (windows.empty() || !calibration.look()) {
        Choice none;
        none.chosen.technique = "std";
        none.why = "nothing here casts a shadow: std";
        calibration.use(none.chosen);
        return none;
    }
    calibration.trace();
    auto all = candidates(calibration.hasExtent(), calibration.isQualityAsked());
    for (std::size_t i = 0; i < all.size(); ++i) {
        calibration.measure(all[i]);
        console.progress("auto", static_cast<double>(i + 1) / static_cast<double>(all.size()),
                         all[i].technique);
    }
    Choice choice = choose(all, budget);
    calibration.use(choice.chosen);
    return choice;
}

}  // namespace gnomon::client

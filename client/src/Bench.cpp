#include "Bench.h"

#include <fmt/format.h>
#include <gnomon/image/Png.h>
#include <gnomon/scene/CameraView.h>
#include <gnomon/truth/ShadowError.h>
#include <gnomon/truth/Truth.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "BenchReport.h"
#include "FreeView.h"
#include "LocalSession.h"
#include "Nudge.h"
#include "TextFile.h"

namespace gnomon::client {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int warmUpRounds = 3;

/// One technique with one size of map, with everything of its own but the context.
struct Contender {
    std::string technique = {};
    int mapSize = 0;
    std::unique_ptr<LocalSession> session = {};
    PreparedScene scene = {};
    field::Ref<scene::Window> window = {};
    std::optional<Nudge> nudge = {};
    std::vector<double> frameMs = {};
    render::FrameStatistics last = {};
    truth::ShadowError error = {};
    std::string picture = {};  ///< of the error, in the report's folder
};

class Bench {
public:
    explicit Bench(const BenchOptions& options)
        : options_{options}, context_{makeContext(options.backend)} {}

    int run() {
        for (const int size : options_.mapSizes)
            for (const std::string& technique : options_.techniques)
                // Without maps their size does not matter.
                if (technique != "none" || size == options_.mapSizes.front())
                    enter(technique, size);
        measureErrors();
        measureTimes();
        print();
        write();
        return 0;
    }

private:
    void enter(const std::string& technique, int mapSize);
    void measureErrors();
    void measureTimes();
    void frame(Contender& contender, bool count);
    void print() const;
    BenchTable table() const;
    void write();
    Interval ratio(const Contender& contender) const;

    const BenchOptions& options_;
    Console console_;
    std::unique_ptr<gl::Context> context_;
    glm::ivec2 size_{0};
    std::vector<std::unique_ptr<Contender>> contenders_;
};

void Bench::enter(const std::string& technique, int mapSize) {
    auto made = std::make_unique<Contender>();
    made->technique = technique;
    made->mapSize = mapSize;
    made->session = std::make_unique<LocalSession>(
        *context_, [this](const std::string& t) { console_.log(LogLevel::warning, t); });
    field::Aspect& aspect = made->session->aspect();
    made->scene = orThrow(
        prepareScene(aspect, {.file = options_.scene, .lights = options_.lights, .progress = {}}));
    config::Shadow shadow{.technique = technique, .mapSize = mapSize};
    made->window = addFreeView(aspect, made->scene,
                               {.view = options_.view, .shadow = shadow, .server = "bench"});
    if (options_.dynamic)
        made->nudge.emplace(aspect, made->scene.tree, activeLights(aspect, made->scene));
    made->session->commit();
    contenders_.push_back(std::move(made));
    console_.progress(
        "loading",
        static_cast<double>(contenders_.size()) /
            static_cast<double>(options_.techniques.size() * options_.mapSizes.size()),
        technique);
}

void Bench::measureErrors() {
    if (!options_.report.empty()) makeFolder(options_.report);
    field::Aspect& aspect = contenders_.front()->session->aspect();
    const scene::Window& window = *aspect.get(contenders_.front()->window);
    const auto* viewport =
        dynamic_cast<const scene::Viewport*>(aspect.find(window.viewports[0].id));
    const glm::ivec2 size = window.size;
    size_ = size;
    const auto camera =
        orThrow(scene::cameraView(aspect, viewport->camera, static_cast<double>(size.x) / size.y));
    scene::FlatScene flat{aspect};
    flat.update(contenders_.front()->scene.tree.root, {}, {});
    if (flat.lights().empty()) throw Failure{Errc::config, "the scene has no light to measure"};
    truth::RayScene rays{aspect};
    rays.update(flat, glm::round(camera.view.eyeWorld()));
    const auto truth = truth::shadowTruth(
        rays, camera.view, shadow_fit::lightShape(flat.lights().front()),
        {.width = size.x, .height = size.y, .samples = 64, .progress = [&](double share) {
             console_.progress("truth", share, "");
         }});
    for (const auto& c : contenders_) {
        auto& renderer = c->session->renderer();
        const scene::Window& drawn = c->session->rendered(c->window);
        const auto lights = activeLights(c->session->aspect(), c->scene);
        orThrow(renderer.draw(drawn, 0.0));
        const auto factor = orThrow(renderer.shadowFactor(drawn, 0, lights.front()));
        c->error = orThrow(truth::compareFactors(truth.factor, factor));
        if (options_.report.empty()) continue;
        c->picture = fmt::format("{}-{}.png", c->technique, c->mapSize);
        orThrow(image::writePng(options_.report / c->picture,
                                truth::errorPicture(truth.factor, factor)));
    }
}

void Bench::frame(Contender& contender, bool count) {
    const auto begin = Clock::now();
    if (contender.nudge) {
        contender.nudge->step();
        contender.session->commit();
    }
    auto& renderer = contender.session->renderer();
    contender.last = orThrow(renderer.draw(contender.session->rendered(contender.window), 0.0));
    renderer.finish();
    const double ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    if (count) contender.frameMs.push_back(ms);
}

void Bench::measureTimes() {
    const auto rounds = static_cast<std::size_t>(options_.rounds);
    for (std::size_t round = 0; round < rounds + warmUpRounds; ++round) {
        // Nobody always goes first.
        for (std::size_t i = 0; i < contenders_.size(); ++i)
            frame(*contenders_[(i + round) % contenders_.size()], round >= warmUpRounds);
        console_.progress(
            "frames", static_cast<double>(round + 1) / static_cast<double>(rounds + warmUpRounds),
            "");
    }
}

Interval Bench::ratio(const Contender& contender) const {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < contender.frameMs.size(); ++i)
        ratios.push_back(contender.frameMs[i] / contenders_.front()->frameMs[i]);
    return medianOf(std::move(ratios));
}

void Bench::print() const {
    fmt::print("{:16} {:>5} {:>9} {:>22} {:>8} {:>8} {:>8} {:>9} {:>9}\n", "technique", "map", "ms",
               "ratio to the first", "wrong %", "inner %", "RMSE", "triangles", "texels");
    for (const auto& c : contenders_) {
        const Interval all = ratio(*c);
        fmt::print(
            "{:16} {:5} {:9.2f} {:8.3f} [{:.3f}, {:.3f}] {:8.3f} {:8.3f} {:8.4f} {:9} {:9}\n",
            c->technique, c->mapSize, medianOf(c->frameMs).median, all.median, all.low, all.high,
            100.0 * c->error.share(c->error.wrong), 100.0 * c->error.share(c->error.interior),
            c->error.rmse, c->last.triangles + c->last.shadowTriangles, c->last.mapTexels);
    }
}

BenchTable Bench::table() const {
    BenchTable table{.scene = options_.scene.filename().string(),
                     .renderer = context_->renderer(),
                     .width = size_.x,
                     .height = size_.y,
                     .dynamic = options_.dynamic,
                     .frames = options_.rounds};
    for (const auto& c : contenders_)
        table.rows.push_back({.technique = c->technique,
                              .mapSize = c->mapSize,
                              .frameMs = medianOf(c->frameMs),
                              .ratio = ratio(*c),
                              .error = c->error,
                              .triangles = c->last.triangles + c->last.shadowTriangles,
                              .mapTexels = c->last.mapTexels,
                              .mapBytes = c->last.mapBytes,
                              .degenerate = c->last.degenerate,
                              .picture = c->picture});
    return table;
}

void Bench::write() {
    const BenchTable found = table();
    if (!options_.report.empty()) {
        writeBenchReport(options_.report, found);
        console_.line("wrote " + (options_.report / "index.html").string());
    }
    if (!options_.json.empty()) writeText(options_.json, benchJson(found));
    if (!options_.csv.empty()) writeText(options_.csv, benchCsv(found));
}

}  // namespace

int bench(const BenchOptions& options) { return Bench{options}.run(); }

}  // namespace gnomon::client

#include "Shot.h"

#include <gnomon/config/Adjust.h>
#include <gnomon/config/Layout.h>
#include <gnomon/config/Load.h>
#include <gnomon/image/Pgm.h>
#include <gnomon/image/Png.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>

#include "Calibration.h"
#include "Console.h"
#include "FreeView.h"
#include "LocalSession.h"
#include "Nudge.h"
#include "TextFile.h"

namespace gnomon::client {
namespace {

using Clock = std::chrono::steady_clock;
using field::Ref;

constexpr int warmUpFrames = 3;

double milliseconds(Clock::duration d) {
    return std::chrono::duration<double, std::milli>(d).count();
}

/// One picture to write: a viewport of a window.
struct Part {
    std::filesystem::path file = {};
    int x = 0;
    int width = 0;
    std::size_t screen = 0;  ///< of the wall
};
struct Shown {
    Ref<scene::Window> window = {};
    std::vector<Part> parts = {};
};

std::filesystem::path withSuffix(const std::filesystem::path& file, const std::string& suffix) {
    auto named = file;
    named.replace_filename(file.stem().string() + suffix + file.extension().string());
    return named;
}

image::Image columns(const image::Image& whole, int x, int width) {
    if (x == 0 && width == whole.width) return whole;
    image::Image part = image::blank(width, whole.height, whole.channels);
    const auto from = static_cast<std::ptrdiff_t>(whole.width) * whole.channels;
    const auto to = static_cast<std::ptrdiff_t>(width) * whole.channels;
    for (int y = 0; y < whole.height; ++y)
        std::copy_n(
            whole.pixels.begin() + y * from + static_cast<std::ptrdiff_t>(x) * whole.channels, to,
            part.pixels.begin() + y * to);
    return part;
}

/// Black where no tile of the screen is: behind bezels.
void blackenBezels(const config::Config& wall, std::size_t screen, image::Image& picture) {
    const config::Canvas canvas = orThrow(config::canvas(wall, screen));
    if (canvas.gap[0] <= 0 && canvas.gap[1] <= 0) return;
    const auto shown = [&](int at, int axis) {
        const auto i = static_cast<std::size_t>(axis);
        return at % (canvas.tileSize[i] + std::max(canvas.gap[i], 0)) < canvas.tileSize[i];
    };
    auto pixel = picture.pixels.begin();
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x, pixel += picture.channels)
            if (!shown(x, 0) || !shown(y, 1)) std::fill_n(pixel, picture.channels, std::uint8_t{0});
}

class Shot {
public:
    explicit Shot(const ShotOptions& options)
        : options_{options},
          context_{makeContext(options.backend)},
          session_{*context_,
                   [this](const std::string& t) { console_.log(LogLevel::warning, t); }} {}

    void load();
    int take();
    /// What auto means; it is used from then on. After load().
    Choice choose();

private:
    void lookFreely();
    void lookAsWall();
    void time();
    void writePictures();
    void writeFactor();
    void writeJson() const;
    render::FrameStatistics draw();

    const ShotOptions& options_;
    Console console_;
    std::unique_ptr<gl::Context> context_;
    LocalSession session_;
    PreparedScene scene_ = {};
    std::vector<Shown> shown_ = {};
    std::optional<config::Config> wall_ = {};
    std::string technique_ = "std";
    Budget budget_ = {};
    std::string why_ = {};  ///< of auto
    int mapSize_ = 0;
    render::FrameStatistics last_ = {};
    render::FrameStatistics passes_ = {};
    std::vector<double> frameMs_ = {};
};

void Shot::lookFreely() {
    config::Shadow shadow;
    options_.shadow.apply(shadow);
    technique_ = shadow.technique;
    budget_ = budgetOf(shadow);
    const auto size = options_.view.size.value_or(defaultViewSize);
    mapSize_ = shadow.mapSize.value_or(scene::mapSizeFor({size[0], size[1]}));
    const auto window = addFreeView(
        session_.aspect(), scene_,
        {.view = options_.view, .shadow = shadow, .samples = options_.samples, .server = "shot"});
    const int width = session_.aspect().get(window)->size->x;
    shown_.push_back({.window = window, .parts = {{.file = options_.out, .width = width}}});
}

void Shot::lookAsWall() {
    config::Config wall = orThrow(config::loadConfig(options_.wall));
    if (options_.tile)
        wall = orThrow(config::withTileSize(wall, (*options_.tile)[0], (*options_.tile)[1]));
    if (options_.view.near) wall.render.near = options_.view.near;
    if (options_.view.far) wall.render.far = options_.view.far;
    options_.shadow.apply(wall.shadow);
    technique_ = wall.shadow.technique;
    budget_ = budgetOf(wall.shadow);
    field::Aspect& aspect = session_.aspect();
    const Look look = options_.view.look().value_or(
        defaultView(aspect, scene_, wallOpening(wall), wallDistance(wall)).look);
    for (std::size_t i = 0; i < wall.screens.size(); ++i) {
        // Both eyes always: the fit of a screen's shadows knows both.
        const auto eyes = eyesOf(wall, i);
        if (eyes.empty()) continue;
        const auto whole =
            orThrow(buildWholeScreen(aspect, wall, i, eyes, scene_.tree.root, "shot"));
        setView(aspect, whole, wall, look);
        setDepthRange(aspect, whole, wall, depthRange(scene_.bounds, look.eye));
        Shown shown{.window = whole.windows.front()};
        const glm::ivec2 size = aspect.get(shown.window)->size;
        const int width = size.x / static_cast<int>(eyes.size());
        mapSize_ =
            std::max(mapSize_, wall.shadow.mapSize.value_or(scene::mapSizeFor({width, size.y})));
        for (std::size_t k = 0; k < eyes.size(); ++k) {
            std::string suffix;
            if (wall.screens.size() > 1) suffix += "-" + wall.screens[i].name;
            const bool chosen = options_.eyeSide.has_value();
            if (chosen && eyes[k] != *options_.eyeSide && eyes[k] != config::Eye::mono) continue;
            if (!chosen && eyes[k] != config::Eye::mono)
                suffix += eyes[k] == config::Eye::left ? "-left" : "-right";
            shown.parts.push_back(
                {.file = options_.out.empty() ? options_.out : withSuffix(options_.out, suffix),
                 .x = static_cast<int>(k) * width,
                 .width = width,
                 .screen = i});
        }
        shown_.push_back(std::move(shown));
    }
    wall_ = std::move(wall);
}

render::FrameStatistics Shot::draw() {
    render::FrameStatistics sum;
    for (const Shown& shown : shown_) {
        const auto one = orThrow(session_.renderer().draw(session_.rendered(shown.window), 0.0));
        sum.triangles += one.triangles;
        sum.shadowTriangles += one.shadowTriangles;
        sum.chunks += one.chunks;
        sum.chunksCulled += one.chunksCulled;
        sum.lights += one.lights;
        sum.lightsUnseen += one.lightsUnseen;
        sum.pagesDrawn += one.pagesDrawn;
        sum.pagesKept += one.pagesKept;
        sum.pagesUnseen += one.pagesUnseen;
        sum.mapTexels += one.mapTexels;
        sum.mapBytes = one.mapBytes;
        sum.factorPixels += one.factorPixels;
        sum.factorBytes += one.factorBytes;
        sum.kernelPixels = std::max(sum.kernelPixels, one.kernelPixels);
        sum.degenerate += one.degenerate;
        sum.shadowMs += one.shadowMs;
        sum.colorMs += one.colorMs;
        sum.overlayMs += one.overlayMs;
    }
    session_.renderer().finish();
    return sum;
}

void Shot::time() {
    std::optional<Nudge> nudge;
    if (options_.dynamic)
        nudge.emplace(session_.aspect(), scene_.tree, activeLights(session_.aspect(), scene_));
    const auto step = [&] {
        if (!nudge) return;
        nudge->step();
        session_.commit();
    };
    for (int i = 0; i < warmUpFrames; ++i) {
        step();
        draw();
    }
    for (int i = 0; i < options_.frames; ++i) {
        const auto begin = Clock::now();
        step();
        last_ = draw();
        frameMs_.push_back(milliseconds(Clock::now() - begin));
        console_.progress("frames", (i + 1.0) / options_.frames, "");
    }
    // Pass times apart: a glFinish after each pass would slow the frames themselves.
    std::vector<render::FrameStatistics> passes;
    session_.renderer().measurePasses(true);
    for (int i = 0; i < std::clamp(options_.frames / 4, 1, 10); ++i) {
        step();
        passes.push_back(draw());
    }
    session_.renderer().measurePasses(false);
    const auto median = [&](double render::FrameStatistics::*member) {
        std::vector<double> values;
        for (const auto& pass : passes) values.push_back(pass.*member);
        std::nth_element(values.begin(),
                         values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                         values.end());
        return values[values.size() / 2];
    };
    passes_.shadowMs = median(&render::FrameStatistics::shadowMs);
    passes_.colorMs = median(&render::FrameStatistics::colorMs);
    passes_.overlayMs = median(&render::FrameStatistics::overlayMs);
}

void Shot::writePictures() {
    if (options_.out.empty()) return;
    for (const Shown& shown : shown_) {
        const image::Image whole = session_.renderer().read(session_.rendered(shown.window));
        for (const Part& part : shown.parts) {
            image::Image picture = columns(whole, part.x, part.width);
            if (wall_) blackenBezels(*wall_, part.screen, picture);
            orThrow(image::writePng(part.file, picture));
            console_.line("wrote " + part.file.string());
        }
    }
}

void Shot::writeFactor() {
    if (options_.shadowFactor.empty()) return;
    const auto lights = activeLights(session_.aspect(), scene_);
    const auto index = static_cast<std::size_t>(options_.light);
    if (index >= lights.size())
        throw Failure{Errc::config, "--light " + std::to_string(options_.light) +
                                        ": the scene has " + std::to_string(lights.size()) +
                                        " light(s) that are on"};
    const auto factor = session_.renderer().shadowFactor(session_.rendered(shown_.front().window),
                                                         0, lights[index]);
    orThrow(image::writePgm(options_.shadowFactor, orThrow(Result<image::Image>{factor})));
    console_.line("wrote " + options_.shadowFactor.string());
}

void Shot::writeJson() const {
    if (options_.json.empty() && frameMs_.empty()) return;
    auto sorted = frameMs_;
    std::sort(sorted.begin(), sorted.end());
    nlohmann::ordered_json json{
        {"technique", technique_}, {"map_size", mapSize_}, {"renderer", context_->renderer()}};
    if (!why_.empty()) json["auto"] = why_;
    if (!sorted.empty()) {
        json["frame_ms"] = {
            {"median", sorted[sorted.size() / 2]}, {"min", sorted.front()}, {"max", sorted.back()}};
        json["pass_ms"] = {{"shadow", passes_.shadowMs},
                           {"color", passes_.colorMs},
                           {"overlay", passes_.overlayMs}};
    }
    json["triangles"] = last_.triangles + last_.shadowTriangles;
    json["shadow_triangles"] = last_.shadowTriangles;
    json["chunks"] = last_.chunks;
    json["chunks_culled"] = last_.chunksCulled;
    json["lights"] = last_.lights;
    json["lights_unseen"] = last_.lightsUnseen;
    json["map_texels"] = last_.mapTexels;
    json["map_bytes"] = last_.mapBytes;
    if (last_.kernelPixels > 0) {
        json["factor_pixels"] = last_.factorPixels;
        json["factor_bytes"] = last_.factorBytes;
        json["kernel_pixels"] = last_.kernelPixels;
    }
    json["pages_drawn"] = last_.pagesDrawn;
    json["pages_kept"] = last_.pagesKept;
    json["pages_unseen"] = last_.pagesUnseen;
    json["degenerate"] = last_.degenerate;
    if (options_.json.empty()) {
        std::fputs((json.dump(2) + "\n").c_str(), stdout);
        return;
    }
    writeText(options_.json, json.dump(2) + "\n");
}

void Shot::load() {
    scene_ = loadScene(session_.aspect(), console_,
                       {.file = options_.scene,
                        .lights = options_.lights,
                        .animationTime = options_.animationTime});
    if (options_.wall.empty())
        lookFreely();
    else
        lookAsWall();
    session_.commit();
}

Choice Shot::choose() {
    std::vector<Ref<scene::Window>> windows;
    for (const Shown& shown : shown_) windows.push_back(shown.window);
    return calibrate(session_, windows, budget_, console_);
}

int Shot::take() {
    load();
    if (technique_ == "auto") {
        const Choice choice = choose();
        technique_ = choice.chosen.technique;
        mapSize_ = choice.chosen.mapSize;
        why_ = choice.why;
        console_.line("auto: " + why_);
    }
    last_ = draw();
    writePictures();
    writeFactor();
    if (options_.frames > 0) time();
    writeJson();
    return 0;
}

}  // namespace

int takeShot(const ShotOptions& options) { return Shot{options}.take(); }
Choice chooseTechnique(const ShotOptions& options) {
    Shot shot{options};
    shot.load();
    return shot.choose();
}

}  // namespace gnomon::client

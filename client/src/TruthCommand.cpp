#include <fmt/format.h>
#include <gnomon/image/Pgm.h>
#include <gnomon/image/Png.h>
#include <gnomon/scene/CameraView.h>
#include <gnomon/scene/Types.h>
#include <gnomon/shadow_fit/ShadowFitter.h>
#include <gnomon/truth/ShadowError.h>
#include <gnomon/truth/Truth.h>

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>

#include "Commands.h"
#include "FreeView.h"
#include "TextFile.h"

namespace gnomon::client {
namespace {

struct TruthArguments {
    std::filesystem::path scene = {};
    ViewArguments view = {};
    std::vector<LightOption> lights = {};
    int samples = 1;
    int light = 0;
    double animationTime = 0.0;
    std::filesystem::path out = {};
};

int traceTruth(const TruthArguments& arguments) {
    Console console;
    field::TypeRegistry types;
    scene::addTypes(types);
    field::Aspect aspect{types, 2};
    const auto prepared = loadScene(aspect, console,
                                    {.file = arguments.scene,
                                     .lights = arguments.lights,
                                     .animationTime = arguments.animationTime});
    const auto window = aspect.get(addFreeView(aspect, prepared, {.view = arguments.view}));
    const auto* viewport =
        dynamic_cast<const scene::Viewport*>(aspect.find(window->viewports[0].id));
    const glm::ivec2 size = window->size;
    const auto camera =
        orThrow(scene::cameraView(aspect, viewport->camera, static_cast<double>(size.x) / size.y));

    const auto begin = std::chrono::steady_clock::now();
    scene::FlatScene flat{aspect};
    flat.update(prepared.tree.root, {}, {});
    const auto lights = activeLights(aspect, prepared);
    const auto wanted = static_cast<std::size_t>(arguments.light);
    if (wanted >= lights.size())
        throw Failure{Errc::config, fmt::format("--light {}: the scene has {} light(s) that are on",
                                                arguments.light, lights.size())};
    const auto uses = flat.lights();
    const auto use = std::find_if(uses.begin(), uses.end(), [&](const auto& candidate) {
        return candidate.node->id() == lights[wanted].id;
    });
    GNOMON_EXPECTS(use != uses.end(), "a light that is on is in the flat scene");
    truth::RayScene rays{aspect};
    rays.update(flat, truth::originFor(flat.bounds(), camera.view.eyeWorld()));
    const auto truth =
        truth::shadowTruth(rays, camera.view, shadow_fit::lightShape(*use),
                           {.width = size.x,
                            .height = size.y,
                            .samples = arguments.samples,
                            .progress = [&](double s) { console.progress("tracing", s, ""); }});
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    orThrow(image::writePgm(arguments.out, truth.factor));
    console.line(fmt::format("{} pixels face the light, {} in penumbra; {:.2f} s", truth.counted,
                             truth.penumbra, seconds));
    if (arguments.samples > 1)
        console.line(
            fmt::format("95 % interval of a pixel's factor: +-{:.4f} (root mean square), at most "
                        "+-{:.4f}",
                        truth.rootMeanWidth, truth.largestWidth));
    console.line("wrote " + arguments.out.string());
    return 0;
}

struct CompareArguments {
    std::filesystem::path truth = {};
    std::filesystem::path factor = {};
    std::filesystem::path out = {};
    std::filesystem::path json = {};
};

int compareFactor(const CompareArguments& arguments) {
    const auto reference = orThrow(image::readPgm(arguments.truth));
    const auto factor = orThrow(image::readPgm(arguments.factor));
    const auto e = orThrow(truth::compareFactors(reference, factor));
    const auto percent = [&](std::uint64_t pixels) { return 100.0 * e.share(pixels); };
    fmt::print("counted            {} pixels\n", e.counted);
    fmt::print("wrong              {:.4f} %  ({} pixels)\n", percent(e.wrong), e.wrong);
    fmt::print("  false shadow     {:.4f} %\n", percent(e.falseShadow));
    fmt::print("  false light      {:.4f} %\n", percent(e.falseLight));
    fmt::print("  near an edge     {:.4f} %\n", percent(e.nearEdge));
    fmt::print("  interior         {:.4f} %\n", percent(e.interior));
    if (e.holes > 0) fmt::print("without surface    {} pixels\n", e.holes);
    fmt::print("RMSE of the factor {:.5f}\n", e.rmse);
    fmt::print("edges displaced    {:.3f} pixels in the mean, 95 % within {:.3f}\n", e.edgeMean,
               e.edge95);
    fmt::print("SSIM               {:.5f}\n", e.ssim);
    fmt::print("FLIP               {:.5f}\n", e.flip);
    if (!arguments.out.empty())
        orThrow(image::writePng(arguments.out, truth::errorPicture(reference, factor)));
    if (!arguments.json.empty()) {
        const nlohmann::ordered_json json{{"counted", e.counted},
                                          {"wrong", e.share(e.wrong)},
                                          {"false_shadow", e.share(e.falseShadow)},
                                          {"false_light", e.share(e.falseLight)},
                                          {"near_edge", e.share(e.nearEdge)},
                                          {"interior", e.share(e.interior)},
                                          {"holes", e.holes},
                                          {"rmse", e.rmse},
                                          {"edge_mean", e.edgeMean},
                                          {"edge_95", e.edge95},
                                          {"ssim", e.ssim},
                                          {"flip", e.flip}};
        writeText(arguments.json, json.dump(2) + "\n");
    }
    return 0;
}

}  // namespace

void addTruth(CLI::App& program, Action& action) {
    auto arguments = std::make_shared<TruthArguments>();
    auto& command = *program.add_subcommand("truth", "Trace a light's exact shadows");
    command.add_option("scene", arguments->scene, "scene file (glTF, OBJ, PLY ...)")->required();
    addViewOptions(command, arguments->view);
    addLightOptions(command, arguments->lights);
    command
        .add_option("--samples", arguments->samples,
                    "points of the light for each pixel; 1: its centre")
        ->check(CLI::Range(1, 65536));
    command.add_option("--light", arguments->light, "which light, counted from 0")
        ->check(CLI::Range(0, 63));
    command.add_option("--time", arguments->animationTime, "seconds into the scene's animations");
    command
        .add_option("--out", arguments->out,
                    "shadow factor to write (PGM): 255 lit, 0 shadowed, 128 no surface or facing "
                    "away")
        ->required();
    command.callback([arguments, &action] {
        arguments->view.validate();
        action = [arguments] { return traceTruth(*arguments); };
    });
}

void addCompare(CLI::App& program, Action& action) {
    auto arguments = std::make_shared<CompareArguments>();
    auto& command =
        *program.add_subcommand("compare", "Tell how far a shadow factor is from the truth");
    command.add_option("truth", arguments->truth, "PGM that `gnomon truth` wrote")->required();
    command.add_option("image", arguments->factor, "PGM that `gnomon shot --shadow-factor` wrote")
        ->required();
    command.add_option("--out", arguments->out,
                       "picture of the error to write (PNG): false shadow red, false light blue");
    command.add_option("--json", arguments->json, "figures to write");
    command.callback(
        [arguments, &action] { action = [arguments] { return compareFactor(*arguments); }; });
}

}  // namespace gnomon::client

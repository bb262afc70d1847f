#include <gnomon/shadow/Filter.h>
#include <gnomon/shadow_fit/Fit.h>

#include <memory>

#include "Commands.h"
#include "bench/Bench.h"
#include "bench/ViewFile.h"

namespace gnomon::client {
namespace {

struct BenchArguments {
    BenchOptions options = {};
    PlanOptions plan = {};
    ViewArguments view = {};
    std::vector<LightOption> lights = {};
    std::filesystem::path views = {};
    bool dynamic = false;
};

std::vector<std::string_view> filterNames() {
    std::vector<std::string_view> names;
    for (const auto& info : shadow::filters()) names.push_back(info.name);
    return names;
}

Registry builtIn() {
    Registry registry;
    for (const auto& info : shadow_fit::fits()) registry.fits.emplace_back(info.name);
    for (const auto& info : shadow::filters()) registry.filters.emplace_back(info.name);
    for (const char* word : {"volume", "planar", "blob", "lightmap", "ray"})
        if (shadow_fit::parseTechnique(word, filterNames())) registry.others.emplace_back(word);
    return registry;
}

void checkTechniques(const std::vector<std::string>& techniques) {
    for (const auto& technique : techniques)
        if (const auto known = shadow_fit::parseTechnique(technique, filterNames()); !known)
            throw CLI::ValidationError("--technique", known.error().what);
}

/// The views that were said, or none.
std::vector<BenchView> viewsOf(const BenchArguments& arguments) {
    arguments.view.validate();
    const bool one = arguments.view.eye || arguments.view.fovy || arguments.view.near ||
                     arguments.view.far || !arguments.lights.empty();
    if (arguments.views.empty()) {
        if (!one) return {};
        return {{.view = arguments.view, .lights = arguments.lights}};
    }
    if (one)
        throw CLI::ValidationError("--views",
                                   "takes the place of --eye, --fovy, lights and others");
    auto views = loadViews(arguments.views);
    if (!views) throw CLI::ValidationError("--views", views.error().text());
    return *std::move(views);
}

Motion parseMotion(const std::string& text) {
    for (const auto motion : {Motion::still, Motion::moving})
        if (text == name(motion)) return motion;
    throw CLI::ValidationError("--motion", "found \"" + text + "\", expected static or dynamic");
}

void check(BenchArguments& arguments) {
    PlanOptions& plan = arguments.plan;
    if (arguments.options.scenes.empty() && plan.sweep.empty())
        throw CLI::RequiredError("scene (or --sweep, which has one of its own)");
    if (arguments.dynamic && plan.motions.empty()) plan.motions = {Motion::moving};
    checkTechniques(plan.techniques);
    plan.views = viewsOf(arguments);
    auto chapters = chaptersOf(plan, builtIn());
    if (!chapters) throw CLI::ValidationError(chapters.error().what);
    arguments.options.chapters = *std::move(chapters);
}

void addWhatIsCompared(CLI::App& command, BenchArguments& arguments) {
    using Texts = std::vector<std::string>;
    PlanOptions& plan = arguments.plan;
    command.add_option("scene", arguments.options.scenes, "scene files (glTF, OBJ, PLY ...)");
    addViewOptions(command, arguments.view);
    command.remove_option(command.get_option("--size"));
    command
        .add_option_function<Texts>(
            "--size",
            [&plan](const Texts& texts) {
                for (const auto& text : texts) plan.sizes.push_back(parseSize("--size", text));
            },
            "pixels of the windows")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("WxH,...");
    addLightOptions(command, arguments.lights);
    command.add_option("--views", arguments.views, "named views, JSON lines: docs/measure.md");
    command.add_option("--technique", plan.techniques, "techniques; the first is compared with")
        ->delimiter(',')
        ->allow_extra_args(false);
    command.add_option("--map-size", plan.mapSizes, "texels a side of the maps")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(CLI::Range(16, 16384));
    command
        .add_option_function<Texts>(
            "--motion",
            [&plan](const Texts& texts) {
                for (const auto& text : texts) plan.motions.push_back(parseMotion(text));
            },
            "static, dynamic or both: whether what was drawn before can serve again")
        ->delimiter(',')
        ->allow_extra_args(false);
    command.add_flag("--dynamic", arguments.dynamic, "the same as --motion dynamic");
    command.add_option("--sweep", plan.sweep, "gates or thesis: comparisons that are built in");
    command
        .add_option("--flicker", plan.flickerFrames,
                    "frames of each path (eye, light) on which flicker is measured")
        ->check(CLI::Range(2, 10000));
    command.add_option("--path", arguments.options.path,
                       "the eye's path for --flicker (JSON lines); else around the centre");
}

void addPeers(CLI::App& command, PeerOptions& peers) {
    command.add_option("--peer", peers.program,
                       "another renderer to take turns with (gnomon-osg-peer beside this program)");
    command.add_option("--peer-technique", peers.techniques, "which of its techniques")
        ->delimiter(',')
        ->allow_extra_args(false);
    command.add_flag("--no-peer", peers.off, "without");
}

}  // namespace

void addBench(CLI::App& program, Action& action) {
    auto arguments = std::make_shared<BenchArguments>();
    BenchOptions& options = arguments->options;
    auto& command = *program.add_subcommand(
        "bench", "Compare techniques: run time in alternating frames, error against traced truth");
    addWhatIsCompared(command, *arguments);
    addBackendOption(command, options.backend);
    addPeers(command, options.peers);
    command.add_option("--frames", options.frames, "frames of each, in turn")
        ->check(CLI::Range(1, 100000));
    command.add_option("--json", options.json, "figures to write");
    command.add_option("--csv", options.csv, "the same as a table");
    command.add_option("--report", options.report,
                       "folder to write a page with plots, tables and pictures to");
    command.callback([arguments, &action] {
        check(*arguments);
        action = [arguments] { return bench(arguments->options); };
    });
}

}  // namespace gnomon::client

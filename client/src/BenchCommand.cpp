#include <memory>

#include "Bench.h"
#include "Commands.h"

namespace gnomon::client {

void addBench(CLI::App& program, Action& action) {
    auto options = std::make_shared<BenchOptions>();
    auto& command = *program.add_subcommand(
        "bench", "Compare techniques: run time in alternating frames, error against traced truth");
    command.add_option("scene", options->scene, "scene file (glTF, OBJ, PLY ...)")->required();
    addViewOptions(command, options->view);
    addLightOptions(command, options->lights);
    addBackendOption(command, options->backend);
    command
        .add_option("--technique", options->techniques, "techniques; the first is compared with")
        ->delimiter(',');
    command.add_option("--map-size", options->mapSizes, "texels a side of the maps")
        ->delimiter(',')
        ->check(CLI::Range(16, 16384));
    command.add_option("--frames", options->rounds, "frames of each, in turn")
        ->check(CLI::Range(1, 100000));
    command.add_flag("--dynamic", options->dynamic, "nothing drawn before can serve again");
    command.add_option("--json", options->json, "figures to write");
    command.add_option("--csv", options->csv, "the same as a table");
    command.add_option("--report", options->report,
                       "folder to write a page with plot, table and pictures to");
    command.callback([options, &action] {
        options->view.validate();
        if (options->techniques.empty()) options->techniques = {"none", "std"};
        if (options->mapSizes.empty()) options->mapSizes = {1024};
        for (const auto& technique : options->techniques) {
            const auto findings = config::validate(config::Shadow{.technique = technique});
            if (config::hasError(findings))
                throw CLI::ValidationError("--technique", config::toError(findings).what);
        }
        action = [options] { return bench(*options); };
    });
}

}  // namespace gnomon::client

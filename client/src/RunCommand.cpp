#include <memory>

#include "Commands.h"
#include "RunOptions.h"

namespace gnomon::client {

void addRun(CLI::App& program, Action& action, std::function<Choice(const ShotOptions&)> choose) {
    auto& command = *program.add_subcommand("run", "Start the servers of a wall and drive it");
    const auto options = std::make_shared<RunOptions>();
    options->choose = std::move(choose);
    command.add_option("CONFIG", options->config, "The wall, a TOML file")->required();
    command.add_option("--scene", options->scene, "glTF, GLB, OBJ, PLY ...")->type_name("FILE");
    command
        .add_option_function<std::string>(
            "--frames",
            [options](const std::string& text) {
                const auto most = 1e15;
                const auto n = parseNumbers("--frames", text, 1, 1, "how many frames");
                if (!(n[0] >= 1.0 && n[0] <= most) ||
                    n[0] != static_cast<double>(static_cast<std::uint64_t>(n[0])))
                    throw CLI::ValidationError{
                        "--frames", "found \"" + text + "\", expected a whole number above 0"};
                options->frames = static_cast<std::uint64_t>(n[0]);
            },
            "End after that many frames; time then runs at 60 frames a second, or along the whole "
            "path, however long they take")
        ->type_name("N");
    command.add_option("--path", options->path, "Camera path: JSON lines of time, eye, center, up")
        ->type_name("FILE");
    addViewOptions(command, options->view);
    addLightOptions(command, options->lights);
    addShadowOptions(command, options->shadow);
    addBackendOption(command, options->backend);
    command.add_flag("--local", options->local,
                     "All servers as processes of this machine, whatever the hosts say");
    command.add_option("--key", options->key, "Cluster key, instead of the config's")
        ->type_name("FILE");
    command
        .add_option_function<std::string>(
            "--tile",
            [options](const std::string& text) { options->tile = parseSize("--tile", text); },
            "Pixels of every tile")
        ->type_name("WxH");
    command.add_option("--out", options->out, "The wall's last picture, PNG")
        ->type_name("WALL.png");
    command.add_option("--json", options->json, "What was measured")->type_name("FILE");
    command
        .add_option("--trace", options->trace,
                    "Each frame: its time, how many servers showed it, who was dropped or came")
        ->type_name("FILE.csv");
    command.add_option("--log", options->log, "Keeps all that is said, added at the file's end")
        ->type_name("FILE");
    command.add_flag("--dry-run", options->dryRun, "Say what would be started, and end");
    command.callback([options, &action] {
        options->view.validate();
        if (!options->path.empty() && options->view.eye)
            throw CLI::ValidationError{"--path", "not together with --eye"};
        action = [options] { return run(*options); };
    });
}

}  // namespace gnomon::client

#include <memory>

#include "Commands.h"
#include "Shot.h"

namespace gnomon::client {

void addShot(CLI::App& program, Action& action) {
    auto options = std::make_shared<ShotOptions>();
    auto& command = *program.add_subcommand("shot", "Render one picture in this process");
    command.add_option("scene", options->scene, "scene file (glTF, OBJ, PLY ...)")->required();
    addViewOptions(command, options->view);
    addLightOptions(command, options->lights);
    addShadowOptions(command, options->shadow);
    addBackendOption(command, options->backend);
    command.add_option("--frames", options->frames, "frames to time, after warm-up")
        ->check(CLI::Range(1, 1000000));
    command.add_flag(
        "--dynamic", options->dynamic,
        "move light and casters imperceptibly every frame, so that nothing can be kept");
    command.add_option("--light", options->light, "light whose factor is written, counted from 0")
        ->check(CLI::Range(0, 63));
    command.add_option("--time", options->animationTime, "seconds into the scene's animations");
    command.add_option("--samples", options->samples, "multisampling")
        ->check(CLI::IsMember({1, 2, 4, 8}));
    command.add_option("--wall", options->wall, "what this wall shows, in one piece");
    command.add_option_function<std::string>(
        "--tile", [options](const std::string& text) { options->tile = parseSize("--tile", text); },
        "WxH pixels of each of the wall's tiles");
    const std::map<std::string, config::Eye> eyes{{"left", config::Eye::left},
                                                  {"right", config::Eye::right}};
    command.add_option("--eye-side", options->eyeSide, "left or right: only this eye of the wall")
        ->transform(CLI::CheckedTransformer(eyes));
    command.add_option("--out", options->out, "picture to write (PNG)");
    command.add_option("--shadow-factor", options->shadowFactor,
                       "shadow factor to write (PGM): 255 lit, 0 shadowed, 128 no surface");
    command.add_option("--json", options->json, "figures to write");
    command.callback([options, &action] {
        options->view.validate();
        if (!options->wall.empty() && options->view.size)
            throw CLI::ValidationError("--size", "the wall's config says how many pixels it has");
        if (options->eyeSide && options->wall.empty())
            throw CLI::ValidationError("--eye-side", "only with --wall");
        action = [options] { return takeShot(*options); };
    });
}

}  // namespace gnomon::client

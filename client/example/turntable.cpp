/// The smallest application: a model on a turntable, on a wall.
///     gnomon-example configs/local-2x2.toml model.glb
#include <gnomon/client/Application.h>

#include <cstdio>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>

int main(int argc, char** argv) try {
    if (argc < 3) throw gnomon::Failure{gnomon::Errc::config, "usage: WALL.toml MODEL [FRAMES]"};
    gnomon::client::Application app{argv[1], {.local = true}};
    const auto model = gnomon::orThrow(app.load(argv[2]));
    app.addDefaultSun();
    app.showAll();

    // Between the content and the model goes a transform, which is all that changes later.
    const auto table = gnomon::scene::makeNode<gnomon::scene::Transform>(app.aspect(), "turntable");
    edit(table.node)->addChild(*app.aspect().get(model.root));
    edit(app.content())->addChild(table.node);

    gnomon::orThrow(app.start());
    const int frames = argc > 3 ? std::atoi(argv[3]) : 600;
    for (int n = 0; n < frames; ++n) {
        const double seconds = n / 60.0;
        const auto turned = glm::rotate(glm::dmat4{1.0}, seconds, glm::dvec3{0.0, 1.0, 0.0});
        edit(table.core)->matrix = gnomon::math::toAffine(turned);
        app.frame(seconds);
    }
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "gnomon-example: %s\n", error.what());
    return 1;
}

#include <gnomon/demo/Scenes.h>
#include <gnomon/demo/Shapes.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "Parts.h"

namespace gnomon::demo {

SunTime plazaTime() {
    // Rome's latitude, the end of May, six minutes to five.
    return {.latitude = glm::radians(41.9),
            .declination = glm::radians(20.0),
            .hourAngle = glm::radians(15.0 * 4.9)};
}

double plazaNorth() { return glm::radians(-28.0); }

Scene plaza(std::uint64_t seed, std::uint32_t textureShrink) {
    Scene scene{.name = "plaza"};
    const Materials m = addMaterials(scene, seed, textureShrink);
    addGround(scene, m, seed);
    addHouses(scene, m, seed);
    addSundial(scene, m);
    addColonnade(scene, m);
    addPortico(scene, m);
    addGate(scene, m);
    addBanners(scene, m);
    addFountain(scene, m);
    addArmillary(scene, m);
    addFurniture(scene, m, seed);
    addTrees(scene, m, seed);
    addBirds(scene, m, seed);

    const glm::dvec3 toward = towardSun(plazaTime());
    const glm::mat3 worldFromDial{turned(static_cast<float>(plazaNorth()))};
    const Index sun =
        scene.add(Light{.name = "sun", .colour = {1.0F, 0.90F, 0.74F}, .intensity = 3.14F});
    scene.add(Node{.name = "sun",
                   .translation = worldFromDial * glm::vec3{toward} * 60.0F,
                   .rotation = lookingAlong(worldFromDial * -glm::vec3{toward}),
                   .light = sun});
    const glm::vec3 eye{0.3F, 3.95F, 20.6F};
    const Index camera = scene.add(Camera{.name = "view", .yFov = glm::radians(42.0F)});
    scene.add(Node{.name = "view",
                   .translation = eye,
                   .rotation = lookingAlong(glm::vec3{0.3F, 3.0F, 0.0F} - eye),
                   .camera = camera});
    return scene;
}

}  // namespace gnomon::demo

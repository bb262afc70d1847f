#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "Parts.h"

namespace gnomon::demo {

void addTurning(Scene& scene, Index node, const glm::vec3& axis, int turns) {
    // Keys a third of a turn apart: linear interpolation takes the shorter way round.
    const int keys = 3 * std::abs(turns);
    Spin spin{.node = node};
    const glm::quat rest = scene.nodes[node].rotation;
    for (int i = 0; i <= keys; ++i) {
        const float part = static_cast<float>(i) / static_cast<float>(keys);
        const float angle = part * static_cast<float>(turns) * 2.0F * std::numbers::pi_v<float>;
        spin.seconds.push_back(part * site::loopSeconds);
        spin.rotations.push_back(rest * glm::angleAxis(angle, axis));
    }
    scene.spins.push_back(std::move(spin));
}

void addSwinging(Scene& scene, Index node, const glm::vec3& axis, float angle, int swings,
                 float phase) {
    const int keys = 8 * swings;
    Spin spin{.node = node};
    const glm::quat rest = scene.nodes[node].rotation;
    for (int i = 0; i <= keys; ++i) {
        const float part = static_cast<float>(i) / static_cast<float>(keys);
        const float turn = part * static_cast<float>(swings) + phase;
        const float at = angle * std::sin(turn * 2.0F * std::numbers::pi_v<float>);
        spin.seconds.push_back(part * site::loopSeconds);
        spin.rotations.push_back(rest * glm::angleAxis(at, axis));
    }
    scene.spins.push_back(std::move(spin));
}

}  // namespace gnomon::demo

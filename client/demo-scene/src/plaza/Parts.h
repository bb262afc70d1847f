#pragma once

#include <gnomon/demo/Random.h>
#include <gnomon/demo/Scene.h>

#include <glm/mat4x4.hpp>
#include <glm/trigonometric.hpp>

#include "Materials.h"

/// The parts of the plaza. Each adds its meshes and nodes; angles on the plaza run from the view
/// axis (-Z) to the right, distances are from the middle of the sundial.
namespace gnomon::demo {

/// Measures that several parts share; metres, radians.
namespace site {
constexpr float colonnadeRadius = 24.0F;  ///< of the column axes
constexpr float wallRadius = 28.2F;       ///< inner face of the wall behind the right wing
constexpr float stylobate = 0.48F;        ///< height of the floor the columns stand on
constexpr float plazaRadius = 31.0F;      ///< of the paving
constexpr float gateHalfAngle = 0.27F;    ///< what the gate takes of the circle, each way
constexpr float leftWingEnd = -1.66F;
constexpr float rightWingEnd = 1.48F;
/// One round of every movement: all animations repeat together after it.
constexpr float loopSeconds = 24.0F;
}  // namespace site

/// Height of the hills outside the paving; 0 near it.
float terrainHeight(float x, float z, std::uint64_t seed);

void addGround(Scene& scene, const Materials& m, std::uint64_t seed);
void addHouses(Scene& scene, const Materials& m, std::uint64_t seed);
void addSundial(Scene& scene, const Materials& m);
void addColonnade(Scene& scene, const Materials& m);
void addPortico(Scene& scene, const Materials& m);
void addGate(Scene& scene, const Materials& m);
void addBanners(Scene& scene, const Materials& m);
void addFountain(Scene& scene, const Materials& m);
void addArmillary(Scene& scene, const Materials& m);
void addFurniture(Scene& scene, const Materials& m, std::uint64_t seed);
void addTrees(Scene& scene, const Materials& m, std::uint64_t seed);
void addBirds(Scene& scene, const Materials& m, std::uint64_t seed);

/// A terracotta jar of about @p height metres with two handles, standing on y = 0.
Mesh amphora(float height, float uvPerMetre);

/// Turns @p node about its own @p axis, @p turns whole times a loop (negative: the other way).
void addTurning(Scene& scene, Index node, const glm::vec3& axis, int turns);

/// Swings @p node about its own @p axis by @p angle radians each way, @p swings times a loop,
/// beginning at @p phase (0 to 1) of a swing.
void addSwinging(Scene& scene, Index node, const glm::vec3& axis, float angle, int swings,
                 float phase);

}  // namespace gnomon::demo

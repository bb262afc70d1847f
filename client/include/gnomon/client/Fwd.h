#pragma once

namespace gnomon::client {

class Application;
struct ApplicationOptions;
struct Look;
struct Model;
struct Opening;
struct PreparedScene;
struct SceneOptions;
struct SceneTree;
struct WallContainers;

}  // namespace gnomon::client

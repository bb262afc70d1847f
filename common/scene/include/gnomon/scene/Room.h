#pragma once

#include <gnomon/scene/Node.h>

namespace gnomon::scene {

/// Who looks: a head in the room and the distance between its eyes. Eyes lie on the head's x axis.
class User final : public Container<User> {
public:
    static constexpr std::string_view typeName = "User";
    Field<math::Affine> roomFromHead;
    Field<double> eyeSeparation{0.063};  ///< metres
    static constexpr auto fields() {
        return std::tuple{entry("roomFromHead", &User::roomFromHead),
                          entry("eyeSeparation", &User::eyeSeparation)};
    }
};

/// Where the room is in the world; its 3x3 part may scale (a room of 3 m over a city).
class Navigation final : public Container<Navigation> {
public:
    static constexpr std::string_view typeName = "Navigation";
    Field<math::Affine> worldFromRoom;
    static constexpr auto fields() {
        return std::tuple{entry("worldFromRoom", &Navigation::worldFromRoom)};
    }
};

/// A flat screen in the room: corners of its lit area (metres), how many tiles it has, and what
/// lies between them.
class Screen final : public Container<Screen> {
public:
    static constexpr std::string_view typeName = "Screen";
    Field<std::string> name;
    Field<math::dvec3> lowerLeft{math::dvec3{-1.0, -1.0, 0.0}};
    Field<math::dvec3> lowerRight{math::dvec3{1.0, -1.0, 0.0}};
    Field<math::dvec3> upperLeft{math::dvec3{-1.0, 1.0, 0.0}};
    Field<glm::ivec2> tiles{glm::ivec2{1, 1}};  ///< columns, rows
    Field<math::dvec2> bezel;                   ///< metres between the tiles' lit areas
    Field<glm::ivec2> overlap;                  ///< pixels that neighbours share
    static constexpr auto fields() {
        return std::tuple{entry("name", &Screen::name),
                          entry("lowerLeft", &Screen::lowerLeft),
                          entry("lowerRight", &Screen::lowerRight),
                          entry("upperLeft", &Screen::upperLeft),
                          entry("tiles", &Screen::tiles),
                          entry("bezel", &Screen::bezel),
                          entry("overlap", &Screen::overlap)};
    }
};

}  // namespace gnomon::scene

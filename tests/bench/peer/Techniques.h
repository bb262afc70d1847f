#pragma once

#include <osgShadow/ShadowedScene>
#include <string>
#include <vector>

namespace peer {

/// Scene masks that osgShadow asks for.
inline constexpr unsigned receives = 1;
inline constexpr unsigned casts = 2;

std::vector<std::string> techniqueNames();
/// A scene whose shadows are made so; "None": without. nullptr: no such technique.
osg::ref_ptr<osgShadow::ShadowedScene> shadowedScene(const std::string& technique, int mapSize);

}  // namespace peer

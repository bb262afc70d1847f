#pragma once

#include <gnomon/config/Load.h>
#include <gnomon/config/Report.h>

#include <fstream>
#include <sstream>
#include <string>

namespace gnomon::config {

/// A small right wall: what tests start from and spoil.
inline constexpr const char* smallWall = R"(name = "small"
[user]
head = [0.0, 1.7, 3.0]
eye_separation = 0.063
[sync]
pipeline = 1
[shadow]
technique = "std"
map_size = 1024
[[screen]]
name = "front"
lower_left = [-1.0, 1.0, 0.0]
lower_right = [1.0, 1.0, 0.0]
upper_left = [-1.0, 2.0, 0.0]
tiles = [2, 1]
[[server]]
name = "west"
host = "pc1"
[[server.window]]
size = [400, 400]
[[server.window.viewport]]
screen = "front"
tile = [0, 0]
[[server]]
name = "east"
host = "pc2"
[[server.window]]
size = [400, 400]
[[server.window.viewport]]
screen = "front"
tile = [1, 0]
)";

/// @p text with the first @p from replaced; unchanged text if there is none.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// All findings as lines.
inline std::string allText(const std::vector<Finding>& findings) {
    std::string text;
    for (const Finding& finding : findings) text += finding.text() + "\n";
    return text;
}

inline std::string fileText(const std::string& path) {
    std::ifstream file{path, std::ios::binary};
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

}  // namespace gnomon::config

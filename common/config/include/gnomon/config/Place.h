#pragma once

#include <map>
#include <string>
#include <string_view>

namespace gnomon::config {

/// A position in a configuration file. Line and column count from 1; 0: not from a file.
struct Place {
    std::string file = {};
    int line = 0;
    int column = 0;

    /// "wall.toml:12:18: ", or nothing when the position is unknown.
    std::string prefix() const;
};

/// Where a struct and each of its keys were written, so that checks made long after reading can
/// still point at the file. No part of the value: any two origins are equal.
struct Origin {
    Place table = {};
    std::map<std::string, Place, std::less<>> keys = {};

    /// The key's place; where the key was not written, the table's.
    const Place& of(std::string_view key) const;

    friend bool operator==(const Origin&, const Origin&) noexcept { return true; }
};

}  // namespace gnomon::config

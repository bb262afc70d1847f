#pragma once

#include <gnomon/config/Finding.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::config {

/// A value of a TOML text with its position: all the reader sees of the TOML library.
struct Node {
    enum class Kind : std::uint8_t { boolean, integer, number, text, list, table, date };

    Kind kind = Kind::table;
    Place place = {};
    std::string key = {};  ///< in a table
    Place keyPlace = {};
    bool boolean = false;
    std::int64_t integer = 0;
    double number = 0;  ///< of an integer too
    std::string text = {};
    std::vector<Node> items = {};  ///< of a list, or of a table in file order

    /// The table's entry of that name, or null.
    const Node* find(std::string_view name) const;
};

/// The value for a message: `"abc"`, `3`, `a list of 2 values`.
std::string found(const Node& node);

/// Parses TOML 1.0. Any bytes will do; where they are no TOML, returns nothing and adds the error.
std::optional<Node> parseToml(std::string_view text, std::string_view filename,
                              std::vector<Finding>& findings);

}  // namespace gnomon::config

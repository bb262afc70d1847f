#pragma once

#include <gnomon/config/Finding.h>

#include <optional>
#include <string_view>

namespace gnomon::config {

/// The first thing in a text that version 3.3 of the TOML library must not see:
/// - a dotted key (`a.b.c`) of more than 16 parts. It limits nested values but not these, makes a
///   table of each part and frees them by recursion: half a million overflow the stack.
/// - a character beyond ASCII outside of quotes and comments, where TOML has none. Its test for
///   white space runs into __builtin_unreachable() for most of them;
/// - a text of several lines, in which the same test is reached and which no key needs.
std::optional<Finding> precheck(std::string_view text, std::string_view filename);

}  // namespace gnomon::config

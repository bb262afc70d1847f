#pragma once

#include <gnomon/net/ServerEvent.h>

#include <functional>
#include <string>

namespace gnomon::client {

using net::LogLevel;

/// Where the library's lines go. Called on any of its threads, one line at a time, without a line
/// end.
using LogCallback = std::function<void(LogLevel level, const std::string& line)>;

}  // namespace gnomon::client

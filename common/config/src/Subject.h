#pragma once

#include <gnomon/config/Config.h>

#include <string>
#include <string_view>

/// How messages call the struct they are about: `server "left2", window, viewport`.
namespace gnomon::config {

std::string subject(std::string_view kind, std::string_view name);
inline std::string subject(const Screen& screen) { return subject("screen", screen.name); }
inline std::string subject(const Server& server) { return subject("server", server.name); }
/// Where it is.
inline std::string hostText(const Server& server) {
    return isLookedUp(server) ? std::string{"looked up"} : server.host;
}

}  // namespace gnomon::config

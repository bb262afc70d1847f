#pragma once

#include <string>
#include <vector>

#include "Asio.h"

namespace gnomon::net {

/// A network interface that is up and takes multicast, or this machine's loopback.
struct Interface {
    std::string name = {};
    asio::ip::address_v4 address = {};  ///< its first, where it was not asked for another
};

/// Each once: those that connections to @p listening come through. Unspecified: all.
std::vector<Interface> interfacesOf(const asio::ip::address_v4& listening);

}  // namespace gnomon::net

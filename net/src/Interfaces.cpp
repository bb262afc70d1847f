#include "Interfaces.h"

#include <ifaddrs.h>
#include <net/if.h>

#include <algorithm>
#include <memory>

namespace gnomon::net {

std::vector<Interface> interfacesOf(const asio::ip::address_v4& listening) {
    ifaddrs* first = nullptr;
    if (::getifaddrs(&first) != 0) return {};
    const std::unique_ptr<ifaddrs, decltype(&::freeifaddrs)> owner{first, &::freeifaddrs};
    std::vector<Interface> found;
    for (const ifaddrs* at = first; at != nullptr; at = at->ifa_next) {
        if (at->ifa_addr == nullptr || at->ifa_addr->sa_family != AF_INET) continue;
        const bool loopback = (at->ifa_flags & IFF_LOOPBACK) != 0;
        // The loopback device takes multicast although it does not say so.
        if ((at->ifa_flags & IFF_UP) == 0 || !(loopback || (at->ifa_flags & IFF_MULTICAST) != 0))
            continue;
        const auto* in = reinterpret_cast<const sockaddr_in*>(at->ifa_addr);
        const asio::ip::address_v4 address{ntohl(in->sin_addr.s_addr)};
        // All of 127.0.0.0/8 is there.
        const bool listens = listening.is_unspecified() || address == listening ||
                             (loopback && listening.is_loopback());
        const bool known = std::any_of(found.begin(), found.end(), [&](const Interface& other) {
            return other.name == at->ifa_name;
        });
        if (listens && !known) found.push_back({.name = at->ifa_name, .address = address});
    }
    return found;
}

}  // namespace gnomon::net

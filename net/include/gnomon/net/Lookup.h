#pragma once

#include <gnomon/base/Error.h>
#include <gnomon/net/HubTypes.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// Finding servers by name: the client asks a multicast group by UDP, who has the name answers.
namespace gnomon::net {

/// Administratively scoped (RFC 2365): no router passes it on. The port is the TCP one's number.
inline constexpr std::string_view defaultLookupGroup = "239.255.74.30:7430";

struct LookupGroup {
    std::string address = {};  ///< IPv4 multicast
    std::uint16_t port = 0;
};
/// "239.255.74.30:7430"; Errc::config says what is wrong with it.
Result<LookupGroup> parseLookupGroup(std::string_view text);

/// What became of asking for one name.
struct LookupAnswer {
    /// One for each server that has the name: there should be one.
    std::vector<ServerAddress> places = {};
    double ms = 0;             ///< from the question to the first of them
    std::string trouble = {};  ///< why an answer was of no use; for people
};

/// Asks for all names at once, until each was answered or @p limit is over. Where there is no key
/// (@p anywhere is false) only servers on this machine are asked.
/// @param group  see parseLookupGroup()
/// @throws Failure Errc::config: the group is none
/// @return for each name, in their order
std::vector<LookupAnswer> lookUp(const std::vector<std::string>& names, const std::string& group,
                                 bool anywhere, std::chrono::milliseconds limit);

}  // namespace gnomon::net

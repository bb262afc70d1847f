#pragma once

#include <gnomon/base/Error.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "Allowance.h"

namespace gnomon::net {

/// What a server says to those who look for its name; without the sockets.
class Responder {
public:
    /// More than many clients that start at once ask.
    static constexpr unsigned mostPerSecond = 32;

    /// @param instance  of this process: tells servers of one name apart
    Responder(std::string name, std::uint16_t port, std::uint64_t instance)
        : name_{std::move(name)}, port_{port}, instance_{instance} {}

    /// The datagram that is to be sent back, never longer than what came; empty: none is due,
    /// because another name was meant, or too many have been sent in this second.
    /// An error: that was no lookup.
    Result<std::vector<std::byte>> answer(std::span<const std::byte> datagram, TimePoint now);

private:
    const std::string name_;
    const std::uint16_t port_;
    const std::uint64_t instance_;
    Allowance allowance_{mostPerSecond};
};

}  // namespace gnomon::net

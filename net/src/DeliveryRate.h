#pragma once

#include <optional>

namespace gnomon::net {

/// Bytes a second that lately reached the other side of a TCP connection, as the system measured it
/// while there was always more to send; nothing where it has not.
std::optional<double> deliveryRateOf(int socket) noexcept;

}  // namespace gnomon::net

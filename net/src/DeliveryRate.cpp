// Apart from the rest: the system's header, which has all of tcp_info, is not to be had beside
// glibc's, which Asio uses.
#include "DeliveryRate.h"

#include <linux/tcp.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstddef>

namespace gnomon::net {

std::optional<double> deliveryRateOf(int socket) noexcept {
    tcp_info info{};
    socklen_t size = sizeof info;
    if (::getsockopt(socket, IPPROTO_TCP, TCP_INFO, &info, &size) != 0) return {};
    if (size < offsetof(tcp_info, tcpi_delivery_rate) + sizeof info.tcpi_delivery_rate) return {};
    if (info.tcpi_delivery_rate == 0 || info.tcpi_delivery_rate_app_limited != 0) return {};
    return static_cast<double>(info.tcpi_delivery_rate);
}

}  // namespace gnomon::net

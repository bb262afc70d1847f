#include "Responder.h"

#include <gnomon/net/ClientMessages.h>
#include <gnomon/net/ServerMessages.h>

#include "Datagrams.h"

namespace gnomon::net {

Result<std::vector<std::byte>> Responder::answer(std::span<const std::byte> datagram,
                                                 TimePoint now) {
    const auto lookup = decodeDatagram<wire::Lookup>(Route::toServerLookup, datagram);
    if (!lookup) return tl::unexpected{lookup.error()};
    if (lookup->server != name_ || !allowance_.take(now)) return std::vector<std::byte>{};
    // Whatever its version: it will say that they do not fit.
    auto answer = net::datagram(wire::Announcement{
        .token = lookup->token, .instance = instance_, .port = port_, .server = name_});
    GNOMON_EXPECTS(answer.size() <= datagram.size(), "an announcement is no longer than a lookup");
    return answer;
}

}  // namespace gnomon::net

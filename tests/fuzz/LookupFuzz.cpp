// Datagrams of a name that is looked up, to a server and to a client that may hear anything.
//
// A step's kind, bits 0-1: 0 a datagram to the server; 1 one to the client, from place bits 4-7;
// 2 the client looks anew; 3 it tries the next place, which fails (bit 4: which works). Bit 2: a
// second has gone by.
#include <gnomon/net/ClientMessages.h>
#include <gnomon/net/ServerMessages.h>

#include <algorithm>

#include "Candidates.h"
#include "Check.h"
#include "Datagrams.h"
#include "Responder.h"
#include "Script.h"

namespace gnomon::fuzz {
namespace {

using namespace std::chrono_literals;

class Rig {
public:
    void step(const Step& step) {
        if ((step.kind & 4U) != 0) {
            now_ += 1s;
            answered_ = 0;
        }
        switch (step.kind & 3U) {
            case 0:
                return toServer(step.bytes);
            case 1:
                return toClient(step.bytes, step.kind >> 4U);
            case 2:
                candidates_.begin();
                break;
            default:
                tryNext((step.kind & 16U) != 0);
        }
    }

private:
    void toServer(std::span<const std::byte> bytes) {
        const auto answer = server_.answer(bytes, now_);
        if (!answer || answer->empty()) return;
        require(answer->size() <= bytes.size(), "an answer is no longer than its question");
        require(++answered_ <= net::Responder::mostPerSecond, "answers are so many a second");
        const auto read =
            net::decodeDatagram<net::wire::Announcement>(net::Route::toClientLookup, *answer);
        require(read && read->port == 7430 && read->server == "left", "a client understands it");
    }
    void toClient(std::span<const std::byte> bytes, unsigned place) {
        const auto heard =
            net::decodeDatagram<net::wire::Announcement>(net::Route::toClientLookup, bytes);
        if (!heard) return;
        require(std::ranges::equal(net::datagram(*heard), bytes), "what is accepted comes back");
        candidates_.add({.host = std::to_string(place), .port = heard->port}, heard->instance);
        const auto all = candidates_.all();
        require(!all.empty() && all.size() <= net::Candidates::most, "so many are kept");
        if (const auto rivals = candidates_.rivals())
            require(rivals->first != rivals->second, "rivals are at different places");
    }
    void tryNext(bool works) {
        const auto failures = candidates_.failuresOfNext();
        const auto next = candidates_.next();
        require(next.has_value() == failures.has_value(), "what comes next is known");
        if (!next) return;
        require(next->port != 0, "nobody is at port 0");
        if (works)
            candidates_.worked(*next);
        else
            candidates_.failed(*next);
    }

    net::TimePoint now_{1000s};
    unsigned answered_ = 0;
    net::Responder server_{"left", 7430, 5};
    net::Candidates candidates_{1};
};

}  // namespace
}  // namespace gnomon::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gnomon::fuzz;
    Rig rig;
    for (const Step& step : parsedScript({data, size})) rig.step(step);
    return 0;
}

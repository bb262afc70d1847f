// Two ends of a TLS connection and somebody in between, who reads, changes, holds back and makes up
// what either hears. He cannot make either take for the other's what it did not say.
//
// A step's kind: bit 0 who is spoken to (0 the server, 1 the client); bits 1-2 how: 0 all that the
// other has said, as it is; 1 the same, with changes (u16 place, u8 to xor, ...); 2 bytes made up;
// 3 nothing, but the other says something (the bytes). Bit 7 of the first step: different keys.
#include <openssl/rand.h>

#include <array>

#include "Check.h"
#include "KnownKey.h"
#include "Script.h"
#include "Tls.h"

namespace gnomon::fuzz {
namespace {

using net::TlsContext;
using net::TlsSession;
using net::TlsSide;
using Bytes = std::vector<std::byte>;

// The same numbers for the same input, so that what is found can be found again.
std::uint64_t randomState = 0;

int predictable(unsigned char* to, int count) {
    for (int i = 0; i < count; ++i) {
        randomState = randomState * 6364136223846793005U + 1442695040888963407U;
        to[i] = static_cast<unsigned char>(randomState >> 56U);
    }
    return 1;
}
int isSeeded() { return 1; }

void makeRandomPredictable() {
    static const RAND_METHOD method{.seed = nullptr,
                                    .bytes = &predictable,
                                    .cleanup = nullptr,
                                    .add = nullptr,
                                    .pseudorand = &predictable,
                                    .status = &isSeeded};
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
    RAND_set_rand_method(&method);
#pragma GCC diagnostic pop
}

std::shared_ptr<const TlsContext> contextOf(TlsSide side, char digit) {
    return std::make_shared<const TlsContext>(side, knownKey(digit));
}

struct End {
    explicit End(std::shared_ptr<const TlsContext> context) : tls{std::move(context), 3} {}

    void handshake() {
        if (broken || tls.established()) return;
        broken = !tls.handshake();
    }
    /// What it hears; what it takes for the other's goes to heard.
    void hear(const Bytes& bytes) {
        if (broken) return;
        tls.feed(bytes);
        handshake();
        std::array<std::byte, 4096> room;
        while (!broken && tls.established()) {
            const auto count = tls.read(room);
            broken = !count;
            if (broken || *count == 0) break;
            heard.insert(heard.end(), room.begin(),
                         room.begin() + static_cast<std::ptrdiff_t>(*count));
        }
    }
    void say(const Bytes& bytes) {
        if (broken || !tls.established()) return;
        if (tls.write(bytes))
            said.insert(said.end(), bytes.begin(), bytes.end());
        else
            broken = true;
    }

    TlsSession tls;
    bool broken = false;
    Bytes said = {}, heard = {};
};

void change(Bytes& sealed, const Bytes& how) {
    for (std::size_t i = 0; i + 2 < how.size() && !sealed.empty(); i += 3) {
        const auto place =
            std::to_integer<std::size_t>(how[i]) + 256 * std::to_integer<std::size_t>(how[i + 1]);
        sealed[place % sealed.size()] ^= how[i + 2];
    }
}

void requireHonest(const End& speaker, const End& hearer) {
    require(hearer.heard.size() <= speaker.said.size() &&
                std::equal(hearer.heard.begin(), hearer.heard.end(), speaker.said.begin()),
            "only what was said is heard, in its order");
}

}  // namespace
}  // namespace gnomon::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gnomon::fuzz;
    makeRandomPredictable();
    randomState = 1;
    static const auto ours = contextOf(TlsSide::client, '1');
    static const auto same = contextOf(TlsSide::server, '1');
    static const auto other = contextOf(TlsSide::server, '2');
    const Script script = parsedScript({data, size});
    const bool different = !script.empty() && (script.front().kind & 0x80U) != 0;
    End client{ours}, server{different ? other : same};
    client.handshake();
    for (const Step& step : script) {
        End& to = (step.kind & 1U) != 0 ? client : server;
        End& from = (step.kind & 1U) != 0 ? server : client;
        switch (step.kind >> 1U & 3U) {
            case 0:
                to.hear(std::exchange(from.tls.output(), {}));
                break;
            case 1: {
                Bytes sealed = std::exchange(from.tls.output(), {});
                change(sealed, step.bytes);
                to.hear(sealed);
                break;
            }
            case 2:
                to.hear(step.bytes);
                break;
            default:
                from.say(step.bytes);
                break;
        }
    }
    requireHonest(client, server);
    requireHonest(server, client);
    if (different)
        require(!server.tls.established() && !client.tls.established(), "keys must be the same");
    return 0;
}

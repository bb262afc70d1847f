// A server with a cluster key, and bytes from somebody who does not have it: whatever he sends, the
// server must not take it for a client's. (The seeds are of one who has it. To send again what he
// sent must not help, for the server's part of the handshake is another one each time.)
//
// A step's kind: bits 0-1 the connection, bit 2 its end.
#include "Check.h"
#include "HostRig.h"
#include "KnownKey.h"
#include "Script.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gnomon;
    fuzz::HostRig rig{fuzz::knownKey()};
    for (const fuzz::Step& step : fuzz::parsedScript({data, size})) {
        if ((step.kind & 4U) != 0)
            rig.disconnect(step.kind & 3U);
        else
            rig.send(step.kind & 3U, step.bytes);
    }
    fuzz::require(!rig.heardOfClient(), "without the key nothing gets through");
    return 0;
}

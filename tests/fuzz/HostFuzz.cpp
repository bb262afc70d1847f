// A server in the clear, and whatever comes over up to four connections.
//
// A step's kind: bits 0-1 the connection, bits 2-3 what happens there: 0 a message, whose bytes are
// its type (u32) and body, with the length that is right; 1 bytes as they are; 2, 3 its end.
#include <gnomon/field/Wire.h>

#include "HostRig.h"
#include "Script.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gnomon;
    fuzz::HostRig rig{nullptr};
    for (const fuzz::Step& step : fuzz::parsedScript({data, size})) {
        const std::size_t connection = step.kind & 3U;
        switch (step.kind >> 2U & 3U) {
            case 0: {
                if (step.bytes.size() < 4) break;
                field::Writer to;
                to.scalar(static_cast<std::uint32_t>(step.bytes.size() - 4));
                to.bytes(step.bytes);
                rig.send(connection, to.written());
                break;
            }
            case 1:
                rig.send(connection, step.bytes);
                break;
            default:
                rig.disconnect(connection);
                break;
        }
    }
    return 0;
}

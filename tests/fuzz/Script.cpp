#include "Script.h"

namespace gnomon::fuzz {

Script parsedScript(std::span<const std::uint8_t> bytes) {
    Script script;
    while (bytes.size() >= 3) {
        const std::size_t announced = bytes[1] + std::size_t{256} * bytes[2];
        const auto length = std::min(announced, bytes.size() - 3);
        const auto body = std::as_bytes(bytes.subspan(3, length));
        script.push_back({.kind = bytes[0], .bytes = {body.begin(), body.end()}});
        bytes = bytes.subspan(3 + length);
    }
    return script;
}

std::vector<std::uint8_t> bytesOf(const Script& script) {
    std::vector<std::uint8_t> bytes;
    for (const Step& step : script) {
        bytes.push_back(step.kind);
        bytes.push_back(static_cast<std::uint8_t>(step.bytes.size()));
        bytes.push_back(static_cast<std::uint8_t>(step.bytes.size() >> 8U));
        for (const std::byte b : step.bytes) bytes.push_back(static_cast<std::uint8_t>(b));
    }
    return bytes;
}

}  // namespace gnomon::fuzz

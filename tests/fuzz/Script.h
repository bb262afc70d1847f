#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::fuzz {

/// One thing that happens: what kind of thing is up to the target.
struct Step {
    std::uint8_t kind = 0;
    std::vector<std::byte> bytes = {};
};

/// What a fuzzer's bytes stand for where order and place matter as much as content: several
/// connections, several change lists. A step is u8 kind, u16 length, bytes; any bytes are a script.
using Script = std::vector<Step>;

Script parsedScript(std::span<const std::uint8_t> bytes);
std::vector<std::uint8_t> bytesOf(const Script& script);

}  // namespace gnomon::fuzz

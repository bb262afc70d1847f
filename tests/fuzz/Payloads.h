#pragma once

#include <gnomon/field/Payload.h>

#include <cstdint>
#include <vector>

namespace gnomon::fuzz {

/// Payloads that every change list of a fuzzer may name: geometry of one triangle, say, for all of
/// them are too large to be guessed by their hash.
inline std::vector<field::Payload> knownPayloads() {
    std::vector<field::Payload> known;
    for (const std::size_t size : {4U, 12U, 36U, 48U, 64U, 200U}) {
        std::vector<std::byte> bytes(size);
        for (std::size_t i = 0; i < size; ++i)
            bytes[i] = static_cast<std::byte>(i % 4 == 0 ? i / 4 : 0);
        known.emplace_back(std::move(bytes));
    }
    return known;
}

}  // namespace gnomon::fuzz

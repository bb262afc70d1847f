#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "Script.h"

namespace gnomon::fuzz {

/// Where the targets' first inputs go: FOLDER/TARGET/NAME, and FOLDER/TARGET.dict.
class Seeds {
public:
    explicit Seeds(std::filesystem::path folder) : folder_{std::move(folder)} {}

    void add(const std::string& target, const std::string& name,
             std::span<const std::byte> bytes) const;
    void add(const std::string& target, const std::string& name, std::string_view text) const {
        add(target, name, std::as_bytes(std::span{text}));
    }
    void add(const std::string& target, const std::string& name, const Script& script) const {
        const auto bytes = bytesOf(script);
        add(target, name, std::as_bytes(std::span{bytes}));
    }
    /// With a first byte that picks the reader.
    void add(const std::string& target, const std::string& name, std::size_t reader,
             std::span<const std::byte> bytes) const;
    /// Words that libFuzzer inserts.
    void dictionary(const std::string& target, const std::vector<std::string>& words) const;

private:
    std::filesystem::path folder_;
};

void addWireSeeds(const Seeds& seeds);
void addChangeSeeds(const Seeds& seeds);
void addModelSeeds(const Seeds& seeds);
/// Of a client and a server that talk to each other, in the clear and by TLS.
void addTrafficSeeds(const Seeds& seeds);

}  // namespace gnomon::fuzz

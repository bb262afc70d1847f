#pragma once

#include <gnomon/base/Error.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace gnomon::net {

/// The secret that all machines of a cluster share: 256 random bits in a file that only its owner
/// may read. Who has it may draw on the wall and read what it shows.
///
/// The file is one line, `gnomon-key-1 ` and 64 hexadecimal digits.
class ClusterKey {
public:
    static constexpr std::size_t bytes = 32;

    /// A new one. @throws Failure Errc::process: the system gives no random numbers
    static ClusterKey random();
    /// What such a file says; a line end may be missing.
    static Result<ClusterKey> parse(std::string_view text);
    /// Errors name the file: missing, malformed, or open to others.
    static Result<ClusterKey> load(const std::filesystem::path& file);

    /// Writes a file of mode 0600, and the folders above it; never over one that is there.
    Result<void> save(const std::filesystem::path& file) const;

    /// 16 hexadecimal digits that tell keys apart and give nothing away.
    const std::string& fingerprint() const noexcept { return fingerprint_; }
    std::span<const std::byte, bytes> secret() const noexcept { return secret_; }

    ClusterKey(const ClusterKey&) = default;
    ClusterKey& operator=(const ClusterKey&) = default;
    /// Leaves nothing in memory.
    ~ClusterKey();

private:
    explicit ClusterKey(const std::array<std::byte, bytes>& secret);

    std::array<std::byte, bytes> secret_ = {};
    std::string fingerprint_ = {};
};

/// Null: no key; then only this machine is spoken to.
using SharedKey = std::shared_ptr<const ClusterKey>;

/// Whether that is a numeric address through which other computers can be reached.
bool needsKey(const std::string& address);

/// Where a key lies unless one is named: $XDG_CONFIG_HOME/gnomon/cluster.key, or that below
/// ~/.config. Empty where there is no home.
std::filesystem::path defaultKeyFile();

}  // namespace gnomon::net

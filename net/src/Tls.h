#pragma once

#include <gnomon/net/ClusterKey.h>
#include <openssl/ssl.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace gnomon::net {

namespace detail {
struct Free {
    void operator()(SSL_CTX* context) const noexcept { SSL_CTX_free(context); }
    void operator()(SSL* connection) const noexcept { SSL_free(connection); }
    void operator()(BIO_METHOD* method) const noexcept { BIO_meth_free(method); }
};
}  // namespace detail

enum class TlsSide : std::uint8_t { client, server };

/// What all connections of one side have in common: TLS 1.3 and nothing older, both sides proved
/// to have the cluster key (an external pre-shared key with a Diffie-Hellman exchange), no
/// certificates, no early data, no tickets.
class TlsContext {
public:
    /// @throws Failure Errc::process: OpenSSL does not do as it should
    TlsContext(TlsSide side, SharedKey key);

    TlsSide side() const noexcept { return side_; }
    const ClusterKey& key() const noexcept { return *key_; }
    SSL_CTX* get() const noexcept { return context_.get(); }
    BIO_METHOD* transport() const noexcept { return transport_.get(); }

private:
    const TlsSide side_;
    const SharedKey key_;
    std::unique_ptr<BIO_METHOD, detail::Free> transport_;
    std::unique_ptr<SSL_CTX, detail::Free> context_;
};

/// One connection's TLS, without a socket: bytes in, bytes out. Belongs to one thread at a time.
///
/// Nothing is let through before the handshake is complete and both sides have proved the key.
class TlsSession {
public:
    /// Most bytes a handshake may take; ours take about 500.
    static constexpr std::size_t maxHandshakeBytes = std::size_t{16} << 10U;
    /// Plain bytes of a full record.
    static constexpr std::size_t recordBytes = std::size_t{16} << 10U;
    /// Records after which the sending key is renewed; AES-GCM allows 2^24.5 (RFC 8446, 5.5).
    static constexpr std::uint64_t defaultRecordsPerKey = std::uint64_t{1} << 23U;

    explicit TlsSession(std::shared_ptr<const TlsContext> context,
                        std::uint64_t recordsPerKey = defaultRecordsPerKey);
    ~TlsSession() = default;
    TlsSession(const TlsSession&) = delete;
    TlsSession& operator=(const TlsSession&) = delete;

    /// Bytes that came. They stay where they are until handshake() or read() wants more.
    void feed(std::span<const std::byte> sealed);
    /// Goes on with the handshake. True when it is complete, false when it needs what comes next.
    Result<bool> handshake();
    /// Opened bytes, at least one; 0: feed more. @pre established()
    Result<std::size_t> read(std::span<std::byte> room);
    /// Seals @p plain into output(). @pre established()
    Result<void> write(std::span<const std::byte> plain);
    /// The last words, into output(). Nothing can be written after them.
    void end();

    bool established() const noexcept { return established_; }
    /// Bytes to be sent; whoever sends them takes them out.
    std::vector<std::byte>& output() noexcept { return output_; }

private:
    friend struct TlsCallbacks;
    Error handshakeError();
    Result<void> checkFirstByte();

    std::shared_ptr<const TlsContext> context_;
    std::unique_ptr<SSL, detail::Free> ssl_;
    std::span<const std::byte> input_;
    std::vector<std::byte> output_;
    std::size_t handshakeBytes_ = 0;
    const std::uint64_t recordsPerKey_;
    std::uint64_t records_ = 0;  // since the sending key is in use
    bool established_ = false;
    std::string strangeKey_ = {};  // fingerprint the client offered, where it is not ours
};

}  // namespace gnomon::net

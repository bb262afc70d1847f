#include <fmt/format.h>
#include <openssl/err.h>

#include "Tls.h"

namespace gnomon::net {
namespace {

/// Content types of a TLS record, its first byte.
constexpr std::byte alertRecord{21}, handshakeRecord{22};

/// OpenSSL's oldest complaint of this thread, and none is left.
std::string complaint() {
    const unsigned long code = ERR_get_error();
    ERR_clear_error();
    const char* reason = code == 0 ? nullptr : ERR_reason_error_string(code);
    return reason == nullptr ? "no reason given" : reason;
}

Error broken(std::string what) { return {.code = Errc::protocol, .what = std::move(what)}; }

}  // namespace

TlsSession::TlsSession(std::shared_ptr<const TlsContext> context, std::uint64_t recordsPerKey)
    : context_{std::move(context)}, ssl_{SSL_new(context_->get())}, recordsPerKey_{recordsPerKey} {
    BIO* bio = ssl_ == nullptr ? nullptr : BIO_new(context_->transport());
    if (bio == nullptr) throw Failure{Errc::limit, "OpenSSL cannot make another connection"};
    BIO_set_data(bio, this);
    BIO_set_init(bio, 1);
    SSL_set_bio(ssl_.get(), bio, bio);  // takes it over
    SSL_set_app_data(ssl_.get(), this);
    if (context_->side() == TlsSide::client)
        SSL_set_connect_state(ssl_.get());
    else
        SSL_set_accept_state(ssl_.get());
}

void TlsSession::feed(std::span<const std::byte> sealed) {
    GNOMON_EXPECTS(input_.empty(), "bytes were fed before the last ones were used");
    input_ = sealed;
}

/// A peer without a key speaks our messages in the clear; OpenSSL would only find a wrong version.
Result<void> TlsSession::checkFirstByte() {
    if (handshakeBytes_ > 0 || input_.empty()) return {};
    const std::byte first = input_.front();
    if (first == handshakeRecord) return {};
    if (context_->side() == TlsSide::client) {
        if (first == alertRecord) return {};
        return gnomon::fail(Errc::protocol, "it does not speak TLS: has it the cluster key?");
    }
    // So that it knows TLS is spoken here: fatal alert, handshake_failure.
    constexpr std::array<unsigned char, 7> alert{21, 3, 3, 0, 2, 2, 40};
    for (const unsigned char b : alert) output_.push_back(std::byte{b});
    return gnomon::fail(Errc::protocol, "it does not speak TLS: it has no cluster key");
}

Result<bool> TlsSession::handshake() {
    if (established_) return true;
    if (auto first = checkFirstByte(); !first) return tl::unexpected{std::move(first).error()};
    handshakeBytes_ += input_.size();
    if (handshakeBytes_ > maxHandshakeBytes)
        return gnomon::fail(
            Errc::limit, fmt::format("a TLS handshake of more than {} bytes", maxHandshakeBytes));
    ERR_clear_error();
    const int outcome = SSL_do_handshake(ssl_.get());
    if (outcome == 1) {
        // Only one who proved the key resumes a session made of it.
        if (SSL_session_reused(ssl_.get()) != 1 || SSL_version(ssl_.get()) != TLS1_3_VERSION)
            return tl::unexpected{broken("the TLS handshake did without the cluster key")};
        established_ = true;
        return true;
    }
    if (SSL_get_error(ssl_.get(), outcome) == SSL_ERROR_WANT_READ) return false;
    return tl::unexpected{handshakeError()};
}

Error TlsSession::handshakeError() {
    const auto reason = complaint();
    const auto& ours = context_->key().fingerprint();
    if (!strangeKey_.empty())
        return broken(
            fmt::format("it has another cluster key ({}, here it is {})", strangeKey_, ours));
    if (context_->side() == TlsSide::client)
        return broken(fmt::format("it does not accept the cluster key {}, has it another? ({})",
                                  ours, reason));
    return broken(fmt::format("no TLS with the cluster key {} ({})", ours, reason));
}

Result<std::size_t> TlsSession::read(std::span<std::byte> room) {
    GNOMON_EXPECTS(established_, "reading before the TLS handshake is complete");
    ERR_clear_error();
    std::size_t count = 0;
    const int outcome = SSL_read_ex(ssl_.get(), room.data(), room.size(), &count);
    if (outcome == 1) return count;
    switch (SSL_get_error(ssl_.get(), outcome)) {
        case SSL_ERROR_WANT_READ:
            return 0;
        case SSL_ERROR_ZERO_RETURN:
            return gnomon::fail(Errc::disconnected, "the other side ended the connection");
        default:
            return tl::unexpected{broken(fmt::format("TLS: {}", complaint()))};
    }
}

Result<void> TlsSession::write(std::span<const std::byte> plain) {
    GNOMON_EXPECTS(established_, "writing before the TLS handshake is complete");
    if (plain.empty()) return {};
    ERR_clear_error();
    records_ += (plain.size() + recordBytes - 1) / recordBytes;
    bool good = true;
    if (records_ >= recordsPerKey_) {
        records_ = 0;
        good = SSL_key_update(ssl_.get(), SSL_KEY_UPDATE_NOT_REQUESTED) == 1;
    }
    std::size_t count = 0;
    // output_ takes everything at once, so a write is never left half done.
    good = good && SSL_write_ex(ssl_.get(), plain.data(), plain.size(), &count) == 1 &&
           count == plain.size();
    if (!good) return tl::unexpected{broken(fmt::format("TLS: {}", complaint()))};
    return {};
}

void TlsSession::end() {
    if (!established_) return;
    ERR_clear_error();
    SSL_shutdown(ssl_.get());
    ERR_clear_error();
}

}  // namespace gnomon::net

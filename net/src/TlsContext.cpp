#include <algorithm>
#include <cstring>

#include "Tls.h"

namespace gnomon::net {

/// What OpenSSL calls. A session object finds itself in the connection's application data.
struct TlsCallbacks {
    static TlsSession& of(SSL* ssl) { return *static_cast<TlsSession*>(SSL_get_app_data(ssl)); }

    /// The key in OpenSSL's terms: a session that can be resumed.
    static SSL_SESSION* sessionOf(SSL* ssl, const ClusterKey& key) {
        constexpr unsigned char aes128GcmSha256[] = {0x13, 0x01};
        SSL_SESSION* session = SSL_SESSION_new();
        if (session == nullptr) return nullptr;
        const auto* secret = reinterpret_cast<const unsigned char*>(key.secret().data());
        if (SSL_SESSION_set1_master_key(session, secret, ClusterKey::bytes) == 1 &&
            SSL_SESSION_set_cipher(session, SSL_CIPHER_find(ssl, aes128GcmSha256)) == 1 &&
            SSL_SESSION_set_protocol_version(session, TLS1_3_VERSION) == 1)
            return session;
        SSL_SESSION_free(session);
        return nullptr;
    }

    static int offerKey(SSL* ssl, const EVP_MD* hash, const unsigned char** identity,
                        std::size_t* length, SSL_SESSION** session) {
        *session = nullptr;
        *identity = nullptr;
        *length = 0;
        if (hash != nullptr && EVP_MD_get_type(hash) != NID_sha256) return 1;  // none of ours
        const ClusterKey& key = of(ssl).context_->key();
        *session = sessionOf(ssl, key);
        *identity = reinterpret_cast<const unsigned char*>(key.fingerprint().data());
        *length = key.fingerprint().size();
        return *session != nullptr ? 1 : 0;
    }

    static int findKey(SSL* ssl, const unsigned char* identity, std::size_t length,
                       SSL_SESSION** session) {
        *session = nullptr;
        TlsSession& self = of(ssl);
        const std::string_view offered{reinterpret_cast<const char*>(identity), length};
        if (offered == self.context_->key().fingerprint()) {
            *session = sessionOf(ssl, self.context_->key());
            return *session != nullptr ? 1 : 0;
        }
        const bool isOne =
            length == 16 && offered.find_first_not_of("0123456789abcdef") == offered.npos;
        self.strangeKey_ = isOne ? std::string{offered} : "of a form unknown";
        return 1;  // goes on without a key, and fails for want of a certificate
    }

    static int take(BIO* bio, char* to, int length) {
        auto& input = static_cast<TlsSession*>(BIO_get_data(bio))->input_;
        BIO_clear_retry_flags(bio);
        if (input.empty()) {
            BIO_set_retry_read(bio);
            return -1;
        }
        const auto count = std::min(input.size(), static_cast<std::size_t>(length));
        std::memcpy(to, input.data(), count);
        input = input.subspan(count);
        return static_cast<int>(count);
    }

    static int give(BIO* bio, const char* from, int length) {
        auto& output = static_cast<TlsSession*>(BIO_get_data(bio))->output_;
        BIO_clear_retry_flags(bio);
        const auto* bytes = reinterpret_cast<const std::byte*>(from);
        output.insert(output.end(), bytes, bytes + length);
        return length;
    }

    static long control(BIO*, int command, long, void*) {
        return command == BIO_CTRL_FLUSH ? 1 : 0;
    }
};

TlsContext::TlsContext(TlsSide side, SharedKey key)
    : side_{side},
      key_{std::move(key)},
      transport_{BIO_meth_new(BIO_TYPE_SOURCE_SINK, "gnomon")},  // indices are few; none is needed
      context_{SSL_CTX_new(side == TlsSide::client ? TLS_client_method() : TLS_server_method())} {
    BIO_METHOD* method = transport_.get();
    SSL_CTX* context = context_.get();
    const bool made = method != nullptr && context != nullptr &&
                      BIO_meth_set_read(method, &TlsCallbacks::take) == 1 &&
                      BIO_meth_set_write(method, &TlsCallbacks::give) == 1 &&
                      BIO_meth_set_ctrl(method, &TlsCallbacks::control) == 1 &&
                      SSL_CTX_set_min_proto_version(context, TLS1_3_VERSION) == 1 &&
                      SSL_CTX_set_max_proto_version(context, TLS1_3_VERSION) == 1 &&
                      SSL_CTX_set_ciphersuites(context, "TLS_AES_128_GCM_SHA256") == 1 &&
                      SSL_CTX_set1_groups_list(context, "X25519:P-256") == 1 &&
                      SSL_CTX_set_num_tickets(context, 0) == 1 &&
                      SSL_CTX_set_max_early_data(context, 0) == 1;
    if (!made) throw Failure{Errc::process, "OpenSSL cannot set up TLS 1.3"};
    SSL_CTX_set_session_cache_mode(context, SSL_SESS_CACHE_OFF);
    // A server that offers a certificate instead is not to be believed: none is trusted.
    if (side == TlsSide::client) SSL_CTX_set_verify(context, SSL_VERIFY_PEER, nullptr);
    // Nobody looks for TLS between a client and its wall: no disguise as TLS 1.2.
    SSL_CTX_clear_options(context, SSL_OP_ENABLE_MIDDLEBOX_COMPAT);
    if (side == TlsSide::client)
        SSL_CTX_set_psk_use_session_callback(context, &TlsCallbacks::offerKey);
    else
        SSL_CTX_set_psk_find_session_callback(context, &TlsCallbacks::findKey);
}

}  // namespace gnomon::net

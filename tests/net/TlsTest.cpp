// The sealed connection in memory: who gets through, and what does not.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "Tls.h"

namespace gnomon::net {
namespace {

using Bytes = std::vector<std::byte>;

SharedKey keyOf(char digit) {
    return std::make_shared<const ClusterKey>(
        orThrow(ClusterKey::parse("gnomon-key-1 " + std::string(64, digit))));
}

std::shared_ptr<const TlsContext> contextOf(TlsSide side, char digit = '1') {
    return std::make_shared<const TlsContext>(side, keyOf(digit));
}

Bytes take(TlsSession& from) { return std::exchange(from.output(), {}); }

Bytes randomBytes(std::size_t count, unsigned seed = 1) {
    std::mt19937 random{seed};
    Bytes bytes(count);
    for (auto& b : bytes) b = static_cast<std::byte>(random());
    return bytes;
}

/// Both ends, and what either sends goes to the other.
struct Pair {
    explicit Pair(char clientKey = '1', char serverKey = '1',
                  std::uint64_t records = TlsSession::defaultRecordsPerKey)
        : client{contextOf(TlsSide::client, clientKey), records},
          server{contextOf(TlsSide::server, serverKey), records} {}

    /// The first error, on whichever side.
    Result<void> connect() {
        for (int round = 0; round < 4; ++round) {
            if (auto done = client.handshake(); !done) return tl::unexpected{done.error()};
            toServer = take(client);
            if (auto done = advance(server, toServer); !done) return done;
            toClient = take(server);
            if (auto done = advance(client, toClient); !done) return done;
        }
        return {};
    }
    static Result<void> advance(TlsSession& to, const Bytes& bytes) {
        if (to.established()) return {};
        to.feed(bytes);
        if (auto done = to.handshake(); !done) return tl::unexpected{done.error()};
        return {};
    }
    /// Carries @p plain over; what comes out, or an error.
    static Result<Bytes> carry(TlsSession& from, TlsSession& to, std::span<const std::byte> plain) {
        if (auto written = from.write(plain); !written) return tl::unexpected{written.error()};
        return open(to, take(from));
    }
    static Result<Bytes> open(TlsSession& to, const Bytes& sealed) {
        to.feed(sealed);
        Bytes opened;
        std::array<std::byte, 1000> room{};
        while (true) {
            auto count = to.read(room);
            if (!count) return tl::unexpected{count.error()};
            if (*count == 0) return opened;
            opened.insert(opened.end(), room.begin(),
                          room.begin() + static_cast<std::ptrdiff_t>(*count));
        }
    }

    TlsSession client, server;
    Bytes toServer, toClient;
};

TEST(Tls, TwoWithTheSameKeyTalkUnseen) {
    Pair pair;
    ASSERT_TRUE(pair.connect());
    ASSERT_TRUE(pair.client.established() && pair.server.established());
    for (const std::size_t size : {1U, 52U, 16384U, 16385U, 1000000U}) {
        const auto plain = randomBytes(size, static_cast<unsigned>(size));
        ASSERT_TRUE(pair.client.write(plain));
        const auto sealed = take(pair.client);
        EXPECT_LE(sealed.size(), size + 22 * (size / 16384 + 1));
        if (size >= 52) {
            EXPECT_EQ(std::search(sealed.begin(), sealed.end(), plain.begin(), plain.begin() + 16),
                      sealed.end());
        }
        EXPECT_EQ(Pair::open(pair.server, sealed), plain);
        EXPECT_EQ(Pair::carry(pair.server, pair.client, plain), plain);
    }
}

TEST(Tls, AHandshakeIsSmall) {
    Pair pair;
    ASSERT_TRUE(pair.client.handshake());
    const auto hello = take(pair.client);
    ASSERT_TRUE(Pair::advance(pair.server, hello));
    const auto answer = take(pair.server);
    EXPECT_LT(hello.size() + answer.size(), 512U);
}

TEST(Tls, AnotherKeyIsNamedOnBothSides) {
    Pair pair{'1', '2'};
    ASSERT_TRUE(pair.client.handshake());
    const auto refused = Pair::advance(pair.server, take(pair.client));
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().what.find("it has another cluster key (" + keyOf('1')->fingerprint()),
              std::string::npos)
        << refused.error().what;
    const auto told = Pair::advance(pair.client, take(pair.server));
    ASSERT_FALSE(told);
    EXPECT_NE(told.error().what.find("does not accept the cluster key"), std::string::npos)
        << told.error().what;
    EXPECT_FALSE(pair.client.established() || pair.server.established());
}

/// A plain OpenSSL end, as anybody can make one.
class Stranger {
public:
    explicit Stranger(const SSL_METHOD* method) : context_{SSL_CTX_new(method)} {
        SSL_CTX_set_verify(context_.get(), SSL_VERIFY_NONE, nullptr);
    }
    SSL_CTX* context() { return context_.get(); }
    void start() {
        ssl_.reset(SSL_new(context_.get()));
        in_ = BIO_new(BIO_s_mem());
        out_ = BIO_new(BIO_s_mem());
        SSL_set_bio(ssl_.get(), in_, out_);
    }
    SSL* get() { return ssl_.get(); }
    Bytes exchange(const Bytes& came) {
        if (!came.empty()) BIO_write(in_, came.data(), static_cast<int>(came.size()));
        SSL_do_handshake(ssl_.get());
        Bytes out(BIO_ctrl_pending(out_));
        if (!out.empty()) BIO_read(out_, out.data(), static_cast<int>(out.size()));
        return out;
    }

private:
    std::unique_ptr<SSL_CTX, detail::Free> context_;
    std::unique_ptr<SSL, detail::Free> ssl_;
    BIO *in_ = nullptr, *out_ = nullptr;
};

TEST(Tls, AClientWithoutAKeyGetsNothing) {
    for (const int version : {TLS1_2_VERSION, TLS1_3_VERSION}) {
        Stranger stranger{TLS_client_method()};
        SSL_CTX_set_max_proto_version(stranger.context(), version);
        stranger.start();
        SSL_set_connect_state(stranger.get());
        TlsSession server{contextOf(TlsSide::server)};
        const auto refused = Pair::advance(server, stranger.exchange({}));
        ASSERT_FALSE(refused);
        EXPECT_NE(refused.error().what.find("no TLS with the cluster key"), std::string::npos)
            << refused.error().what;
        EXPECT_FALSE(server.established());
        stranger.exchange(take(server));
        EXPECT_FALSE(SSL_is_init_finished(stranger.get()));
    }
}

TEST(Tls, AClientThatKnowsTheFingerprintButNotTheKeyGetsNothing) {
    static const std::string fingerprint = keyOf('1')->fingerprint();
    Stranger stranger{TLS_client_method()};
    SSL_CTX_set_psk_use_session_callback(
        stranger.context(), [](SSL* ssl, const EVP_MD*, const unsigned char** id, std::size_t* size,
                               SSL_SESSION** session) {
            const unsigned char cipher[] = {0x13, 0x01};
            const unsigned char guess[32] = {1, 2, 3};
            *session = SSL_SESSION_new();
            SSL_SESSION_set1_master_key(*session, guess, sizeof guess);
            SSL_SESSION_set_cipher(*session, SSL_CIPHER_find(ssl, cipher));
            SSL_SESSION_set_protocol_version(*session, TLS1_3_VERSION);
            *id = reinterpret_cast<const unsigned char*>(fingerprint.data());
            *size = fingerprint.size();
            return 1;
        });
    stranger.start();
    SSL_set_connect_state(stranger.get());
    TlsSession server{contextOf(TlsSide::server)};
    EXPECT_FALSE(Pair::advance(server, stranger.exchange({})));
    EXPECT_FALSE(server.established());
}

TEST(Tls, AServerWithACertificateInsteadOfTheKeyIsNotTrusted) {
    Stranger stranger{TLS_server_method()};
    std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)> pair{EVP_EC_gen("P-256"), &EVP_PKEY_free};
    std::unique_ptr<X509, decltype(&X509_free)> certificate{X509_new(), &X509_free};
    X509_set_pubkey(certificate.get(), pair.get());
    X509_gmtime_adj(X509_getm_notBefore(certificate.get()), 0);
    X509_gmtime_adj(X509_getm_notAfter(certificate.get()), 3600);
    ASSERT_GT(X509_sign(certificate.get(), pair.get(), EVP_sha256()), 0);
    ASSERT_EQ(SSL_CTX_use_certificate(stranger.context(), certificate.get()), 1);
    ASSERT_EQ(SSL_CTX_use_PrivateKey(stranger.context(), pair.get()), 1);
    stranger.start();
    SSL_set_accept_state(stranger.get());
    TlsSession client{contextOf(TlsSide::client)};
    ASSERT_TRUE(client.handshake());
    const auto offered = stranger.exchange(take(client));
    EXPECT_GT(offered.size(), 200U);  // its certificate is among it
    EXPECT_FALSE(Pair::advance(client, offered));
    EXPECT_FALSE(client.established());
}

TEST(Tls, ACutOrBentHandshakeNeverSucceeds) {
    Pair whole;
    ASSERT_TRUE(whole.client.handshake());
    const std::size_t size = take(whole.client).size();
    for (std::size_t at = 0; at < size; ++at) {
        {
            Pair cut;
            ASSERT_TRUE(cut.client.handshake());
            auto hello = take(cut.client);
            hello.resize(at);
            const auto done = Pair::advance(cut.server, hello);
            EXPECT_TRUE(done) << at;  // it waits for the rest
            EXPECT_TRUE(take(cut.server).empty()) << at;
            EXPECT_FALSE(cut.server.established());
        }
        if (at == 2) continue;  // legacy_record_version, which must be ignored (RFC 8446, 5.1)
        Pair bent;
        ASSERT_TRUE(bent.client.handshake());
        auto hello = take(bent.client);
        hello[at] ^= std::byte{0x55};
        // The server may go on where the change is in what only the transcript covers.
        if (Pair::advance(bent.server, hello)) {
            const auto back = Pair::advance(bent.client, take(bent.server));
            if (back) {
                EXPECT_FALSE(Pair::advance(bent.server, take(bent.client)) &&
                             bent.server.established())
                    << at;
            }
        }
        EXPECT_FALSE(bent.server.established()) << at;
    }
}

TEST(Tls, BentBytesAreNotOpened) {
    Pair pair;
    ASSERT_TRUE(pair.connect());
    ASSERT_TRUE(pair.client.write(randomBytes(100)));
    auto sealed = take(pair.client);
    sealed[50] ^= std::byte{1};
    EXPECT_FALSE(Pair::open(pair.server, sealed));
}

TEST(Tls, ReplayedBytesAreNotOpened) {
    Pair pair;
    ASSERT_TRUE(pair.client.handshake());
    const auto hello = take(pair.client);
    ASSERT_TRUE(Pair::advance(pair.server, hello));
    ASSERT_TRUE(Pair::advance(pair.client, take(pair.server)));
    ASSERT_TRUE(pair.client.write(randomBytes(100)));
    const auto rest = take(pair.client);  // its Finished, and a message
    ASSERT_TRUE(Pair::advance(pair.server, rest));
    ASSERT_TRUE(pair.server.established());

    // Within the connection, and at another server with the same key.
    ASSERT_TRUE(pair.client.write(randomBytes(10)));
    const auto message = take(pair.client);
    std::array<std::byte, 200> room{};
    while (*pair.server.read(room) > 0) continue;
    ASSERT_TRUE(Pair::open(pair.server, message));
    EXPECT_FALSE(Pair::open(pair.server, message));
    TlsSession other{contextOf(TlsSide::server)};
    ASSERT_TRUE(Pair::advance(other, hello));
    EXPECT_FALSE(take(other).empty());
    EXPECT_FALSE(Pair::advance(other, rest));
    EXPECT_FALSE(other.established());
}

TEST(Tls, AnEndlessHandshakeIsGivenUp) {
    TlsSession server{contextOf(TlsSide::server)};
    // Handshake records of one byte: a hello that promises much and goes on and on.
    Bytes drip{std::byte{22}, std::byte{3}, std::byte{1},    std::byte{0},   std::byte{4},
               std::byte{1},  std::byte{0}, std::byte{0x3f}, std::byte{0xff}};
    std::size_t sent = 0;
    Result<void> done;
    while (done && sent < 2 * TlsSession::maxHandshakeBytes) {
        done = Pair::advance(server, drip);
        sent += drip.size();
        drip = {std::byte{22}, std::byte{3}, std::byte{1},
                std::byte{0},  std::byte{1}, std::byte{3}};
    }
    EXPECT_FALSE(done);
    EXPECT_LE(sent, TlsSession::maxHandshakeBytes + drip.size());
}

TEST(Tls, WhatIsNoTlsIsSaidToBeNone) {
    const Bytes plain{std::byte{9}, std::byte{0}, std::byte{0}, std::byte{0}};
    TlsSession server{contextOf(TlsSide::server)};
    const auto refused = Pair::advance(server, plain);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().what.find("it has no cluster key"), std::string::npos);
    TlsSession client{contextOf(TlsSide::client)};
    ASSERT_TRUE(client.handshake());
    EXPECT_FALSE(Pair::advance(client, plain));
}

TEST(Tls, KeysAreRenewedOnTheWay) {
    Pair pair{'1', '1', 3};
    ASSERT_TRUE(pair.connect());
    std::size_t overhead = 0;
    for (unsigned n = 0; n < 50; ++n) {
        const auto plain = randomBytes(100, n);
        ASSERT_TRUE(pair.client.write(plain));
        const auto sealed = take(pair.client);
        overhead = std::max(overhead, sealed.size() - plain.size());
        ASSERT_EQ(Pair::open(pair.server, sealed), plain) << n;
        ASSERT_EQ(Pair::carry(pair.server, pair.client, plain), plain) << n;
    }
    EXPECT_GT(overhead, 22U);  // a KeyUpdate was among it
}

TEST(Tls, AnEndIsAnEnd) {
    Pair pair;
    ASSERT_TRUE(pair.connect());
    pair.client.end();
    const auto closed = Pair::open(pair.server, take(pair.client));
    ASSERT_FALSE(closed);
    EXPECT_EQ(closed.error().code, Errc::disconnected);
}

}  // namespace
}  // namespace gnomon::net

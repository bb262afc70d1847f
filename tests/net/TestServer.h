#pragma once

#include <gnomon/net/ClientHub.h>
#include <gnomon/net/ServerHost.h>

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "TestTypes.h"

namespace gnomon::net::test {

using namespace std::chrono_literals;
using SteadyClock = std::chrono::steady_clock;

inline SteadyClock::time_point in(std::chrono::milliseconds span) {
    return SteadyClock::now() + span;
}
/// For what must happen: far more than it takes, also under a sanitizer on a busy machine.
inline SteadyClock::time_point eventually() { return in(30s); }

/// Two keys, always the same ones.
SharedKey testKey(char digit = '1');
/// What servers and hubs have unless a test says otherwise: no key, or, in the programs built with
/// GNOMON_TEST_WITH_KEY, one and the same.
inline SharedKey usualKey() {
#ifdef GNOMON_TEST_WITH_KEY
    return testKey();
#else
    return {};
#endif
}

/// What a server saw.
struct Seen {
    std::vector<std::uint64_t> snapshots = {};
    std::vector<std::uint64_t> frames = {};
    std::vector<std::uint64_t> swaps = {};
    std::map<std::uint64_t, std::uint64_t> digests = {};  // after the frame or snapshot
    std::vector<std::string> left = {};
    std::string error = {};  // of a change list that could not be applied
    int joined = 0;
    bool quit = false;
};

struct TestServerOptions {
    std::uint16_t port = 0;
    bool exitWithClient = false;
    std::chrono::milliseconds handshakeTimeout{5000};
    std::function<void(field::TypeRegistry&)> types = {};  // default: testTypes()
    bool lieAboutDigest = false;
    int images = 0;  // pictures sent for a captured frame
    SharedKey key = usualKey();
    std::string announce = {};  // group
};

/// A server that renders nothing: a thread with ServerHost's main loop.
class TestServer {
public:
    explicit TestServer(std::string name, TestServerOptions options = {});
    ~TestServer();

    const std::string& name() const { return name_; }
    std::uint16_t port() const { return host_->port(); }
    ServerAddress address() const { return {.name = name_, .host = "127.0.0.1", .port = port()}; }

    /// The main thread stops before it makes this frame (or a later one) Ready, until release(), or
    /// until a later frame is named.
    void stallAt(std::uint64_t frame);
    void release();
    /// Ends the program as a crash does, as seen from outside.
    void kill();

    Seen seen() const;
    /// Whether someone was turned away with this reason before eventually().
    bool turnedAway(const std::string& why) const;
    /// Whether it became true before eventually().
    bool waitUntil(const std::function<bool(const Seen&)>& predicate) const;
    void send(const InputEvent& event);

private:
    void run();
    void handle(ServerEvent event);
    bool apply(const field::ChangeList& changes);
    void tellDepth(std::uint64_t n);
    void finish(std::uint64_t n);
    template <class Fn>
    void note(Fn&& fn);

    const std::string name_;
    const TestServerOptions options_;
    field::TypeRegistry types_;
    std::unique_ptr<ServerHost> host_;
    std::unique_ptr<field::Aspect> aspect_;
    std::optional<Frame> awaitingFit_;
    std::uint64_t shownFrame_ = 0;
    std::int64_t shownAt_ = 0;

    mutable std::mutex mutex_;
    mutable std::condition_variable changed_;
    Seen seen_;
    std::uint64_t stallAt_ = ~std::uint64_t{0};
    std::vector<InputEvent> toSend_;
    std::vector<std::string> turnedAway_;
    std::thread thread_;
};

/// A hub with log lines kept.
class TestHub {
public:
    explicit TestHub(SyncOptions options = {}, HubHooks hooks = {},
                     const SharedKey& key = usualKey());
    ClientHub* operator->() { return hub_.get(); }
    field::TypeRegistry& types() { return types_; }
    std::vector<std::string> log() const;
    bool logContains(const std::string& text) const;
    void end() { hub_.reset(); }

private:
    struct Lines {
        std::mutex mutex = {};
        std::vector<std::string> lines = {};
    };
    field::TypeRegistry types_ = testTypes();
    std::shared_ptr<Lines> lines_ = std::make_shared<Lines>();
    std::unique_ptr<ClientHub> hub_;
};

}  // namespace gnomon::net::test

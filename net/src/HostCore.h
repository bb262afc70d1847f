#pragma once

#include <gnomon/net/ServerHost.h>

#include <atomic>
#include <list>
#include <memory>

#include "Announcer.h"
#include "BulkSender.h"
#include "Channel.h"
#include "FrameGate.h"
#include "Inbox.h"
#include "Relays.h"
#include "Timer.h"

namespace gnomon::net {

/// How the main thread gets on; written by it, read for Pong by whoever runs the reactor.
struct Progress {
    std::atomic<std::uint64_t> lastFinished{0};
    std::atomic<std::uint64_t> current{0};
    std::atomic<std::int64_t> busySince{0};  // steady nanoseconds; 0: not busy
    std::atomic<Activity> activity{Activity::idle};
};

/// ServerHost's sockets: everything here runs on the thread that has the Reactor.
class HostCore final : public Receiver {
public:
    HostCore(asio::io_context& io, tcp::acceptor acceptor, ServerOptions options, Inbox& inbox,
             const Progress& progress);

    /// @throws Failure as Announcer
    void start();
    void stop();
    /// Nothing is left to be written.
    bool quiet() const;

    /// The main thread's answer to a SchemaOffer.
    void agreed(std::uint64_t session, Result<void> outcome, std::vector<std::byte> ourSchema);
    /// Stops reading control while too much waits, and goes on when less does.
    void throttle();
    void sendControl(Part part);
    void sendImage(std::shared_ptr<const Image> image);

    Result<void> received(Channel& from, MessageType type,
                          std::span<const std::byte> body) override;
    void drained(Channel& channel) override;
    void closed(Channel& channel, Error why) override;

private:
    /// A connection that has not said Hello yet, or is being sent away.
    struct Guest {
        std::shared_ptr<Channel> channel = {};
        std::unique_ptr<Timer> limit = {};
    };
    struct Session {
        std::uint64_t id = 0;
        std::uint64_t token = 0;
        SyncParameters sync = {};
        std::shared_ptr<Channel> control = {};
        std::shared_ptr<Channel> bulk = {};
        std::unique_ptr<FrameGate> gate = {};
        std::shared_ptr<Channel> relay = {};  // payloads that another server passes on
        std::unique_ptr<Relays> relays = {};  // those we pass ours on to
        Unpacker fromClient = {}, fromRelay = {};
        Packer plain{Compress::never};  // the client takes no Packed
        BulkSender images{plain};
        bool joined = false;  // the main thread knows of it
    };

    void accept();
    void admit(tcp::socket socket);
    Result<void> greeted(Channel& from, std::span<const std::byte> body);
    void joinRelay(std::shared_ptr<Channel> channel, std::uint64_t token);
    void beginSession(std::shared_ptr<Channel> control, wire::ClientHello hello);
    Result<void> control(MessageType type, std::span<const std::byte> body);
    Result<void> bulk(MessageType type, std::span<const std::byte> body);
    Result<void> relayed(MessageType type, std::span<const std::byte> body);
    void answer(const wire::Ping& ping);
    Milliseconds silence() const;
    bool givesWay() const;
    void watch();
    void endSession(const Error& why, bool tellClient);
    void refuse(std::shared_ptr<Channel> channel, const std::string& why,
                wire::Cure cure = wire::Cure::time);
    std::shared_ptr<Channel> takeGuest(Channel& channel);
    void makeRoom();
    void report(const std::string& why);

    asio::io_context& io_;
    tcp::acceptor acceptor_;
    const ServerOptions options_;
    const std::shared_ptr<const TlsContext> tls_;       // null: no key
    const std::shared_ptr<const TlsContext> dialling_;  // the same for connections of our own
    Inbox& inbox_;
    const Progress& progress_;
    std::list<Guest> guests_;
    std::unique_ptr<Session> session_;
    std::uint64_t sessionCount_ = 0;
    Timer acceptTimer_, bulkTimer_, silentTimer_;
    std::unique_ptr<Announcer> announcer_ = {};
    TimePoint reportedAt_ = {};
};

}  // namespace gnomon::net

#pragma once

#include <deque>
#include <list>
#include <map>
#include <memory>
#include <unordered_set>

#include "Channel.h"
#include "Dialer.h"
#include "FrameGate.h"
#include "Packer.h"

namespace gnomon::net {

/// The servers this one passes payloads on to, as the client asked for with Relay. A part goes on
/// as soon as it has come, so that a tree of servers takes little longer than one.
///
/// A server that cannot be reached, or is lost, is told of and forgotten: the client sees to it.
class Relays final : public Receiver, public UploadWatch {
public:
    using Lost = std::function<void(std::uint64_t token, const std::string& why)>;

    /// @param tls   to connect with; null: in the clear, and to this machine only
    /// @param gate  whose uploads they are; outlives this
    /// @param lost  never called from within another function of this
    Relays(asio::io_context& io, std::shared_ptr<const TlsContext> tls, const FrameGate& gate,
           Lost lost);
    ~Relays() override;

    void add(wire::Relay relay);
    void remove(std::uint64_t token);

    void arriving(const wire::Payload& part) override;
    void arrived(std::uint64_t serial, const field::Payload& payload) override;

    Result<void> received(Channel& from, MessageType type,
                          std::span<const std::byte> body) override;
    void drained(Channel& channel) override;
    void closed(Channel& channel, Error why) override;

private:
    /// One upload on its way on.
    struct Item {
        field::Hash128 hash = {};
        std::uint64_t serial = 0;
        std::uint64_t total = 0;
        field::Payload whole = {};  // once it is here
    };
    struct Child {
        wire::Relay relay = {};
        std::unordered_set<std::uint64_t> wanted = {};  // listed, not here yet
        SerialSet begun = {};
        std::deque<Item> items = {};
        std::uint64_t offset = 0;  // of the first item, sent
        std::unique_ptr<Dialer> dialer = {};
        std::shared_ptr<Channel> channel = {};
    };

    void connected(Child& child, tcp::socket socket);
    void enqueue(Item item);
    void pump(Child& child);
    std::list<Child>::iterator childOf(std::uint64_t token);
    void drop(std::uint64_t token, const std::string& why);

    asio::io_context& io_;
    const std::shared_ptr<const TlsContext> tls_;
    const FrameGate& gate_;
    const Lost lost_;
    std::list<Child> children_;
    std::map<Compress, Packer> packers_;
    // Says whether this still lives when a callback comes.
    std::shared_ptr<const bool> alive_ = std::make_shared<const bool>(true);
};

}  // namespace gnomon::net

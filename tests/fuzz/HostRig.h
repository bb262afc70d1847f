#pragma once

#include <gnomon/field/Aspect.h>
#include <gnomon/net/ServerEvent.h>
#include <gnomon/scene/FlatScene.h>

#include <array>
#include <memory>
#include <optional>
#include <span>

#include "HostCore.h"

namespace gnomon::fuzz {

/// A server without a renderer, and up to four connections to it. All on one thread, over sockets
/// of the Unix kind: what happens next is up to the caller, and nothing waits for a clock.
class HostRig {
public:
    static constexpr std::size_t connections = 4;

    /// @param key  null: in the clear
    explicit HostRig(net::SharedKey key);
    ~HostRig();
    HostRig(const HostRig&) = delete;
    HostRig& operator=(const HostRig&) = delete;

    /// Connects first where it is not; bytes that nobody takes are lost.
    void send(std::size_t connection, std::span<const std::byte> bytes);
    void disconnect(std::size_t connection);
    /// Until nothing is left to be done.
    void run();

    /// A client said Hello, or more.
    bool heardOfClient() const noexcept { return heard_; }

private:
    bool serve();
    void take(net::ServerEvent event);
    bool apply(const field::ChangeList& changes);
    void flatten(const field::Applied& applied);
    void answer(std::uint64_t n, bool capture);
    void readAway();

    net::asio::io_context io_{1};
    net::Inbox inbox_;
    net::Progress progress_;
    std::unique_ptr<field::TypeRegistry> types_;
    int listener_ = -1;
    std::array<int, connections> sockets_{-1, -1, -1, -1};
    std::unique_ptr<net::HostCore> core_;
    // What the main thread has:
    std::unique_ptr<field::Aspect> aspect_;
    std::unique_ptr<scene::FlatScene> flat_;
    std::optional<net::Frame> waiting_;  // for its Fit
    bool heard_ = false;
    bool strangeTypes_ = false;  // were learnt
};

}  // namespace gnomon::fuzz

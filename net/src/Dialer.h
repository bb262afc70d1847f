#pragma once

#include <gnomon/base/Error.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "Asio.h"

namespace gnomon::net {

/// Connects to a host by name or address; one attempt at a time.
class Dialer {
public:
    using Done = std::function<void(Result<tcp::socket> socket)>;

    /// @param anywhere  false: only to this machine, since without a cluster key nothing leaves it
    Dialer(asio::io_context& io, bool anywhere) : io_{io}, resolver_{io}, anywhere_{anywhere} {}
    ~Dialer() { cancel(); }
    Dialer(const Dialer&) = delete;
    Dialer& operator=(const Dialer&) = delete;

    /// @param label  begins the errors
    /// @param done   called once, and never from within dial() but where it fails at once
    void dial(const std::string& host, std::uint16_t port, std::string label, Done done);
    /// Gives up; done is not called.
    void cancel();

private:
    void connect(std::vector<tcp::endpoint> ends);
    void finish(Result<tcp::socket> outcome);

    asio::io_context& io_;
    tcp::resolver resolver_;
    const bool anywhere_;
    std::uint64_t attempt_ = 0;  // callbacks of earlier ones are stale
    // Says whether the dialer still lives when a callback comes.
    std::shared_ptr<const bool> alive_ = std::make_shared<const bool>(true);
    std::string label_;
    Done done_;
    std::shared_ptr<tcp::socket> socket_;
};

}  // namespace gnomon::net

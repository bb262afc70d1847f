#include "Dialer.h"

namespace gnomon::net {

void Dialer::dial(const std::string& host, std::uint16_t port, std::string label, Done done) {
    cancel();
    label_ = std::move(label);
    done_ = std::move(done);
    error_code ec;
    const auto address = asio::ip::make_address(host, ec);
    if (!ec) return connect({tcp::endpoint{address, port}});
    resolver_.async_resolve(
        host, std::to_string(port),
        [this, alive = std::weak_ptr{alive_}, mine = attempt_](error_code failed,
                                                               tcp::resolver::results_type found) {
            if (alive.expired() || mine != attempt_) return;
            if (failed)
                return finish(tl::unexpected{
                    Error{.code = Errc::disconnected, .what = label_, .cause = failed}});
            std::vector<tcp::endpoint> ends;
            for (const auto& entry : found) ends.push_back(entry.endpoint());
            connect(std::move(ends));
        });
}

void Dialer::connect(std::vector<tcp::endpoint> ends) {
    if (!anywhere_) {
        std::erase_if(ends, [](const tcp::endpoint& end) { return !isLoopback(end.address()); });
        if (ends.empty())
            return finish(fail(
                Errc::config,
                label_ + ": other computers are only spoken to with a cluster key, and there is "
                         "none"));
    }
    socket_ = std::make_shared<tcp::socket>(io_);
    auto to = std::make_shared<const std::vector<tcp::endpoint>>(std::move(ends));
    asio::async_connect(
        *socket_, *to,
        [this, alive = std::weak_ptr{alive_}, to, socket = socket_, mine = attempt_](
            error_code ec, const tcp::endpoint&) {
            if (alive.expired() || mine != attempt_) return;
            error_code ignored;
            // A loopback port nobody listens on can connect to itself, and would keep the server
            // from ever having it.
            if (!ec && socket->local_endpoint(ignored) == socket->remote_endpoint(ignored))
                ec = asio::error::connection_refused;
            socket_.reset();
            if (ec)
                return finish(
                    tl::unexpected{Error{.code = Errc::disconnected, .what = label_, .cause = ec}});
            finish(std::move(*socket));
        });
}

void Dialer::finish(Result<tcp::socket> outcome) {
    // It may dial anew or destroy this.
    const auto done = std::exchange(done_, {});
    done(std::move(outcome));
}

void Dialer::cancel() {
    ++attempt_;
    resolver_.cancel();
    done_ = {};
    if (!socket_) return;
    error_code ignored;
    socket_->close(ignored);
    socket_.reset();
}

}  // namespace gnomon::net

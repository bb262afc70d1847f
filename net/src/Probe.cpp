#include <fmt/format.h>
#include <gnomon/net/Probe.h>

#include <optional>

#include "Channel.h"
#include "Timer.h"

namespace gnomon::net {
namespace {

/// One server asked. Ends by itself at the limit at the latest.
class Question final : public Receiver {
public:
    Question(asio::io_context& io, std::shared_ptr<const TlsContext> tls)
        : tls_{std::move(tls)}, resolver_{io}, socket_{io}, timer_{io} {}

    void ask(const ServerAddress& server, Milliseconds limit) {
        timer_.after(limit, [this, limit] {
            answer(fail(Errc::timeout, fmt::format("no answer within {} ms", limit.count())));
        });
        resolver_.async_resolve(server.host, std::to_string(server.port),
                                [this](error_code ec, tcp::resolver::results_type found) {
                                    if (ec) return answer(fail(Errc::disconnected, "its name", ec));
                                    for (const auto& entry : found)
                                        if (tls_ || isLoopback(entry.endpoint().address()))
                                            ends_.push_back(entry.endpoint());
                                    connect();
                                });
    }
    const std::optional<Result<void>>& answer() const { return answer_; }

    Result<void> received(Channel&, MessageType, std::span<const std::byte>) override { return {}; }
    void secured(Channel&) override { answer({}); }
    void closed(Channel&, Error why) override { answer(tl::unexpected{std::move(why)}); }

private:
    void connect() {
        if (answer_) return;
        if (ends_.empty())
            return answer(fail(Errc::config, "other computers are only spoken to with a key"));
        asio::async_connect(socket_, ends_, [this](error_code ec, const tcp::endpoint&) {
            if (answer_) return;
            if (ec) return answer(fail(Errc::disconnected, "its port", ec));
            if (!tls_) return answer({});
            channel_ = std::make_shared<Channel>(std::move(socket_), Route::toClientControl, *this,
                                                 std::make_unique<TlsSession>(tls_));
            channel_->start();
        });
    }
    /// The first answer counts.
    void answer(Result<void> given) {
        if (answer_) return;
        answer_ = std::move(given);
        timer_.cancel();
        resolver_.cancel();
        error_code ignored;
        if (channel_)
            channel_->close();
        else
            socket_.close(ignored);
    }

    const std::shared_ptr<const TlsContext> tls_;
    tcp::resolver resolver_;
    tcp::socket socket_;
    Timer timer_;
    std::vector<tcp::endpoint> ends_;
    std::shared_ptr<Channel> channel_;
    std::optional<Result<void>> answer_;
};

}  // namespace

std::vector<Result<void>> probe(const std::vector<ServerAddress>& servers, const SharedKey& key,
                                std::chrono::milliseconds limit) {
    const auto tls = key ? std::make_shared<const TlsContext>(TlsSide::client, key) : nullptr;
    asio::io_context io{1};
    std::vector<std::unique_ptr<Question>> questions;
    for (const auto& server : servers) {
        questions.push_back(std::make_unique<Question>(io, tls));
        questions.back()->ask(server, limit);
    }
    io.run();
    std::vector<Result<void>> answers;
    for (const auto& question : questions) answers.push_back(question->answer().value());
    return answers;
}

}  // namespace gnomon::net

#pragma once

#include <functional>
#include <memory>

#include "Asio.h"

namespace gnomon::net {

/// Calls a function later, unless cancelled, re-armed or destroyed before. Asio's own cancel()
/// comes too late for a handler that is queued already; this one does not.
class Timer {
public:
    explicit Timer(asio::io_context& io)
        : timer_{io}, generation_{std::make_shared<std::uint64_t>(0)} {}
    ~Timer() { cancel(); }
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;

    void after(SteadyClock::duration delay, std::function<void()> call) {
        at(SteadyClock::now() + delay, std::move(call));
    }
    void at(TimePoint when, std::function<void()> call) {
        const std::uint64_t mine = ++*generation_;
        timer_.expires_at(when);
        timer_.async_wait([generation = generation_, mine, call = std::move(call)](error_code ec) {
            if (ec || *generation != mine) return;
            ++*generation;  // no longer armed
            call();
        });
        armed_ = mine;
    }
    void cancel() {
        ++*generation_;
        timer_.cancel();
    }
    bool armed() const noexcept { return armed_ == *generation_; }

private:
    asio::steady_timer timer_;
    std::shared_ptr<std::uint64_t> generation_;
    std::uint64_t armed_ = ~std::uint64_t{0};
};

}  // namespace gnomon::net

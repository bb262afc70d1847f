#pragma once

#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "Asio.h"

namespace gnomon::net {

/// Runs an io_context on one thread at a time: on its owner's while that waits for messages, and
/// on a helper's when the owner has been busy elsewhere for a while (rendering).
///
/// With a thread of its own, every frame would cost either side two more thread switches: one to
/// hand the message over, one to hand the answer back. Handlers need no locks: who has the baton is
/// alone, and the baton orders what the threads do.
///
/// What a handler throws on the helper's thread ends the helper, and the owner's next call throws
/// it.
class Reactor {
public:
    /// How long the owner may be away before the helper takes over; Ping waits so long at most.
    static constexpr Milliseconds patience{20};
    /// The same while messages are expected (see setEager).
    static constexpr Milliseconds eagerPatience{1};

    Reactor() : helper_{[this] { help(); }} {}
    ~Reactor() { end(); }
    Reactor(const Reactor&) = delete;
    Reactor& operator=(const Reactor&) = delete;

    asio::io_context& io() noexcept { return io_; }

    /// Ends the helper: from now on handlers run only within the owner's calls.
    void end() {
        if (!helper_.joinable()) return;
        {
            const std::lock_guard lock{mutex_};
            stop_ = true;
        }
        wake_.notify_all();
        nudge();
        helper_.join();
    }

    /// Owner only: handles what is there and what comes until done() or the deadline; asks done()
    /// once more after that.
    template <class Done>
    void runUntil(Done done, TimePoint deadline) {
        const Turn turn{*this};
        while (!done()) {
            if (SteadyClock::now() >= deadline) {
                io_.poll();
                done();
                break;
            }
            io_.run_one_until(deadline);
        }
    }
    /// Owner only: handles what is there.
    void poll() {
        const Turn turn{*this};
        io_.poll();
    }
    /// Owner only: calls fn as if from a handler, and returns when it has.
    template <class Fn>
    void alone(Fn fn) {
        const Turn turn{*this};
        fn();
    }
    /// Owner only: calls fn as if from a handler; at once, unless the helper is at work. The order
    /// of the calls holds.
    template <class Fn>
    void enter(Fn fn) {
        if (!baton_.try_lock()) {
            ++posted_;
            asio::post(io_, [this, fn = std::move(fn)]() mutable {
                --posted_;
                fn();
            });
            return;
        }
        while (posted_ > 0) io_.poll_one();
        fn();
        giveBack();
    }
    /// From within a handler or alone(): whether the helper is to take over soon after the owner
    /// has left.
    void setEager(bool eager) noexcept { eager_ = eager; }
    /// From any thread: makes runUntil() look at done() again.
    void nudge() {
        asio::post(io_, [] {});
    }

private:
    struct Turn {
        explicit Turn(Reactor& of) : reactor{of} { reactor.take(); }
        ~Turn() { reactor.giveBack(); }
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;
        Reactor& reactor;
    };
    void take() {
        wanted_ = true;
        if (!baton_.try_lock()) {
            nudge();  // the helper may sleep in the io_context
            baton_.lock();
        }
        wanted_ = false;
        if (error_) {
            baton_.unlock();
            std::rethrow_exception(error_);
        }
        inside_ = true;
    }
    void giveBack() {
        awaySince_ = SteadyClock::now().time_since_epoch();
        inside_ = false;
        baton_.unlock();
        // While the owner comes and goes the helper looks by itself now and then: to wake it each
        // time would cost a thread switch.
        if (!eager_ || !asleep_) return;
        const std::lock_guard lock{mutex_};
        wake_.notify_one();
    }
    void help() {
        std::unique_lock lock{mutex_};
        while (!stop_) {
            const Milliseconds limit = eager_ ? eagerPatience : patience;
            const auto away = SteadyClock::now().time_since_epoch() - awaySince_.load();
            if (inside_ || away < limit || !baton_.try_lock()) {
                asleep_ = limit == patience;
                wake_.wait_for(lock, limit);
                asleep_ = false;
                continue;
            }
            lock.unlock();
            serve();
            baton_.unlock();
            lock.lock();
            if (error_) return;
        }
    }
    void serve() noexcept {
        try {
            while (!wanted_ && !stop_) io_.run_one();
        } catch (...) {
            error_ = std::current_exception();
        }
    }

    asio::io_context io_{1};
    asio::executor_work_guard<asio::io_context::executor_type> work_{io_.get_executor()};
    std::mutex baton_;
    std::atomic<bool> wanted_{false};  // by the owner
    std::atomic<bool> inside_{false};  // the owner is
    std::atomic<SteadyClock::duration> awaySince_{SteadyClock::now().time_since_epoch()};
    std::atomic<int> posted_{0};  // by enter(), not called yet
    std::atomic<bool> eager_{false};
    std::atomic<bool> asleep_{false};  // the helper, for `patience`
    std::atomic<bool> stop_{false};
    std::exception_ptr error_;  // with the baton
    std::mutex mutex_;
    std::condition_variable wake_;
    std::thread helper_;
};

}  // namespace gnomon::net

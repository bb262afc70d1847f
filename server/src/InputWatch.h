#pragma once

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <functional>
#include <thread>
#include <utility>

namespace gnomon::server {

/// Tells when standard input ends. A server that a remote shell started learns so that nobody
/// waits for it any more: no signal crosses machines.
class InputWatch {
public:
    /// @param onEnd  called on a thread of this object's, once at most
    explicit InputWatch(std::function<void()> onEnd)
        : stop_{::eventfd(0, EFD_CLOEXEC)}, thread_{[this, call = std::move(onEnd)] {
              if (reachesEnd()) call();
          }} {}
    ~InputWatch() {
        const std::uint64_t one = 1;
        [[maybe_unused]] const auto written = ::write(stop_, &one, sizeof one);
        thread_.join();
        ::close(stop_);
    }
    InputWatch(const InputWatch&) = delete;
    InputWatch& operator=(const InputWatch&) = delete;

private:
    /// Reads and forgets; false where it was stopped before the end.
    bool reachesEnd() const {
        std::array<char, 4096> ignored{};
        while (true) {
            std::array<pollfd, 2> wait{{{STDIN_FILENO, POLLIN, 0}, {stop_, POLLIN, 0}}};
            if (::poll(wait.data(), wait.size(), -1) < 0) continue;
            if (wait[1].revents != 0) return false;
            if (::read(STDIN_FILENO, ignored.data(), ignored.size()) <= 0) return true;
        }
    }

    const int stop_;
    std::thread thread_;
};

}  // namespace gnomon::server

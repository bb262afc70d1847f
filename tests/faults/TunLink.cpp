#include "TunLink.h"

#include <fcntl.h>
#include <gnomon/base/Error.h>
#include <linux/if.h>
#include <linux/if_tun.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

namespace gnomon::faults {
namespace {

/// A TUN device of the namespace: what is written to the descriptor arrives there, and what is sent
/// there can be read from it.
int openTun(const Namespace& where, const std::string& address) {
    const Inside inside{where};
    const int fd = ::open("/dev/net/tun", O_RDWR | O_NONBLOCK | O_CLOEXEC);
    ifreq request{};
    request.ifr_flags = IFF_TUN | IFF_NO_PI;
    std::strncpy(request.ifr_name, "tun%d", sizeof request.ifr_name - 1);
    if (fd < 0 || ::ioctl(fd, TUNSETIFF, &request) != 0)
        throw Failure{Errc::process, "cannot make a TUN device"};
    command({"ip", "address", "add", address, "dev", request.ifr_name});
    command({"ip", "link", "set", request.ifr_name, "up"});
    return fd;
}

}  // namespace

TunLink::TunLink(const Namespace& one, const std::string& oneAddress, const Namespace& other,
                 const std::string& otherAddress, const Weather& weather)
    : weather_{weather},
      ends_{openTun(one, oneAddress), openTun(other, otherAddress)},
      wake_{::eventfd(0, EFD_CLOEXEC)},
      thread_{[this] { relay(); }} {}

TunLink::~TunLink() {
    ending_ = true;
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(wake_, &one, sizeof one);
    thread_.join();
    for (const int fd : {ends_[0], ends_[1], wake_}) ::close(fd);
}

void TunLink::relay() {
    while (!ending_) {
        timespec left{60, 0};
        if (!waiting_.empty()) {
            const auto span = std::max(Clock::duration{0}, waiting_.top().due - Clock::now());
            const auto seconds = std::chrono::floor<std::chrono::seconds>(span);
            left = {seconds.count(), std::chrono::nanoseconds{span - seconds}.count()};
        }
        std::array<pollfd, 3> entries{
            {{ends_[0], POLLIN, 0}, {ends_[1], POLLIN, 0}, {wake_, POLLIN, 0}}};
        if (::ppoll(entries.data(), entries.size(), &left, nullptr) < 0) continue;
        if (entries[0].revents != 0) take(0, 1);
        if (entries[1].revents != 0) take(1, 0);
        deliver(Clock::now());
    }
}

void TunLink::take(int from, int to) {
    std::array<char, 65536> buffer{};
    for (;;) {
        const auto got =
            ::read(ends_[static_cast<std::size_t>(from)], buffer.data(), buffer.size());
        if (got <= 0) return;
        ++packets_;
        const bool lost = std::uniform_real_distribution{0.0, 1.0}(random_) < weather_.loss;
        const auto more =
            std::uniform_int_distribution<std::int64_t>{0, weather_.jitter.count()}(random_);
        if (lost || cut_) {
            ++lost_;
            continue;
        }
        waiting_.push({.due = Clock::now() + weather_.delay + std::chrono::microseconds{more},
                       .number = packets_,
                       .to = to,
                       .bytes = {buffer.data(), buffer.data() + got}});
    }
}

void TunLink::deliver(Clock::time_point now) {
    for (; !waiting_.empty() && waiting_.top().due <= now; waiting_.pop()) {
        const Packet& packet = waiting_.top();
        if (cut_) continue;
        const auto to = static_cast<std::size_t>(packet.to);
        if (packet.number < newest_[to]) ++overtook_;
        newest_[to] = std::max(newest_[to], packet.number);
        [[maybe_unused]] const auto sent =
            ::write(ends_[to], packet.bytes.data(), packet.bytes.size());
    }
}

}  // namespace gnomon::faults

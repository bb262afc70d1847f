#include <fmt/format.h>
#include <gnomon/client/Launcher.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <mutex>
#include <thread>

#include "ServerProcess.h"

namespace gnomon::client {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

class Launcher::Impl {
public:
    explicit Impl(LauncherOptions options)
        : options_{std::move(options)}, wake_{::eventfd(0, EFD_CLOEXEC)} {
        if (wake_ < 0)
            throw Failure{Error{.code = Errc::process,
                                .what = "cannot make an eventfd for the launcher",
                                .cause = {errno, std::generic_category()}}};
        processes_.assign(options_.commands.size(), -1);
        deaths_.assign(options_.commands.size(), 0);
        thread_ = std::thread{[this] { run(); }};
    }
    ~Impl() {
        stop();
        ::close(wake_);
    }

    void stop() {
        stopping_ = true;
        const std::uint64_t one = 1;
        [[maybe_unused]] const auto written = ::write(wake_, &one, sizeof one);
        if (thread_.joinable()) thread_.join();
    }

    Result<void> health() const {
        const std::lock_guard lock{mutex_};
        if (failure_) return tl::unexpected{*failure_};
        return {};
    }
    void startupDone() {
        const std::lock_guard lock{mutex_};
        starting_ = false;
    }
    std::vector<int> processes() const {
        const std::lock_guard lock{mutex_};
        return processes_;
    }

private:
    void run() {
        std::vector<ServerProcess> servers;
        servers.reserve(options_.commands.size());
        for (const auto& command : options_.commands) servers.emplace_back(command, options_);
        while (!stopping_) {
            const auto now = Clock::now();
            for (std::size_t i = 0; i < servers.size(); ++i) startIfDue(servers[i], i, now);
            wait(servers);
            for (std::size_t i = 0; i < servers.size(); ++i)
                if (const auto status = servers[i].reap(Clock::now()))
                    onEnd(servers[i], i, *status);
        }
        end(servers);
    }

    void startIfDue(ServerProcess& server, std::size_t index, Clock::time_point now) {
        if (const auto started = server.startIfDue(now); !started) {
            fail({.code = Errc::process,
                  .what = fmt::format("server \"{}\": {}", server.command().server,
                                      started.error().what),
                  .cause = started.error().cause});
            return;
        }
        const std::lock_guard lock{mutex_};
        processes_[index] = server.pid();
    }

    /// Until something happens: output, an end, a time to start again, or a wake-up.
    void wait(std::vector<ServerProcess>& servers) {
        std::vector<pollfd> entries{{wake_, POLLIN, 0}};
        auto until = Clock::now() + 10s;
        for (const auto& server : servers) {
            // A negative descriptor is passed over by poll.
            for (const int fd : {server.output(), server.errors(), server.end()})
                entries.push_back({fd, POLLIN, 0});
            if (const auto due = server.due()) until = std::min(until, *due);
            // Without a pidfd (an old kernel) ends are noticed by looking.
            if (!server.due() && server.end() < 0) until = std::min(until, Clock::now() + 50ms);
        }
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
        ::poll(entries.data(), entries.size(),
               static_cast<int>(std::max<std::int64_t>(left.count(), 0)));
        for (std::size_t i = 0; i < servers.size(); ++i) {
            if (entries[1 + i * 3].revents != 0) servers[i].readOutput();
            if (entries[2 + i * 3].revents != 0) servers[i].readErrors();
        }
    }

    void onEnd(ServerProcess& server, std::size_t index, int status) {
        if (stopping_) return;
        bool starting = false;
        {
            const std::lock_guard lock{mutex_};
            processes_[index] = -1;
            starting = starting_;
        }
        ++deaths_[index];
        // Someone who kills a server while it starts wants to see it come back; one that gives up
        // by itself will do so again.
        if (starting && (WIFEXITED(status) || deaths_[index] >= 3)) {
            fail({.code = Errc::process,
                  .what = fmt::format("server \"{}\" {}", server.command().server, server.why())});
        }
    }

    void fail(Error error) {
        {
            const std::lock_guard lock{mutex_};
            if (starting_) {
                if (!failure_) failure_ = std::move(error);
                return;
            }
        }
        if (options_.log) options_.log(LogLevel::error, error.text());
    }

    /// All get the signal first, then share one deadline; whoever is left is killed by its Child.
    void end(std::vector<ServerProcess>& servers) {
        for (const auto& server : servers) server.signal(SIGTERM);
        const auto deadline = Clock::now() + 2s;
        const auto running = [](const ServerProcess& server) { return server.pid() > 0; };
        while (std::any_of(servers.begin(), servers.end(), running) && Clock::now() < deadline) {
            std::vector<pollfd> entries;
            for (auto& server : servers)
                for (const int fd : {server.output(), server.errors(), server.end()})
                    entries.push_back({fd, POLLIN, 0});
            const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
            ::poll(entries.data(), entries.size(),
                   static_cast<int>(std::clamp<std::int64_t>(left.count(), 0, 50)));
            for (std::size_t i = 0; i < servers.size(); ++i) {
                if (entries[i * 3].revents != 0) servers[i].readOutput();
                if (entries[1 + i * 3].revents != 0) servers[i].readErrors();
                servers[i].reap(Clock::now());
            }
        }
        const std::lock_guard lock{mutex_};
        processes_.assign(processes_.size(), -1);
    }

    const LauncherOptions options_;
    const int wake_;
    std::atomic<bool> stopping_{false};
    std::vector<int> deaths_ = {};  // the thread's

    mutable std::mutex mutex_;
    bool starting_ = true;               // guarded
    std::optional<Error> failure_ = {};  // guarded
    std::vector<int> processes_ = {};    // guarded

    std::thread thread_ = {};
};

Launcher::Launcher(LauncherOptions options) : impl_{std::make_unique<Impl>(std::move(options))} {}
Launcher::~Launcher() = default;
Result<void> Launcher::health() const { return impl_->health(); }
void Launcher::startupDone() { impl_->startupDone(); }
std::vector<int> Launcher::processes() const { return impl_->processes(); }
void Launcher::stop() { impl_->stop(); }

}  // namespace gnomon::client

// gnomon-server: one render process of a wall.

#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <exception>
#include <optional>
#include <thread>

#include "FrameLoop.h"
#include "InputWatch.h"

namespace {

/// SIGINT and SIGTERM end the loop: a thread waits for them, so no handler runs.
class SignalWatch {
public:
    /// Before any other thread starts: they inherit the mask.
    SignalWatch() {
        ::sigemptyset(&signals_);
        ::sigaddset(&signals_, SIGINT);
        ::sigaddset(&signals_, SIGTERM);
        ::pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
    }
    ~SignalWatch() {
        if (!thread_.joinable()) return;
        ended_ = true;
        ::pthread_kill(thread_.native_handle(), SIGTERM);
        thread_.join();
    }
    SignalWatch(const SignalWatch&) = delete;
    SignalWatch& operator=(const SignalWatch&) = delete;

    void onSignal(gnomon::net::ServerHost& host) {
        thread_ = std::thread{[this, &host] {
            int number = 0;
            ::sigwait(&signals_, &number);
            if (!ended_) host.quit();
        }};
    }

private:
    sigset_t signals_{};
    std::atomic<bool> ended_ = false;
    std::thread thread_;
};

}  // namespace

int main(int argc, char** argv) {
    gnomon::server::Options options;
    int exitCode = 0;
    if (!gnomon::server::parseOptions(argc, argv, options, exitCode)) return exitCode;
    const std::string name = options.name;
    const bool exitWithInput = options.exitWithInput;
    try {
        ::signal(SIGPIPE, SIG_IGN);
        // The loop, and with it the host, outlives the thread that may call into it.
        std::unique_ptr<gnomon::server::FrameLoop> loop;
        SignalWatch watch;
        loop = std::make_unique<gnomon::server::FrameLoop>(std::move(options));
        watch.onSignal(loop->host());
        std::optional<gnomon::server::InputWatch> input;
        if (exitWithInput) input.emplace([&host = loop->host()] { host.quit(); });
        std::printf("port %u\n", static_cast<unsigned>(loop->port()));
        std::fflush(stdout);
        loop->run();
        return 0;
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "gnomon-server %s: %s\n", name.c_str(), failure.what());
        return 1;
    }
}

#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <list>
#include <thread>
#include <vector>

namespace gnomon::faults {

/// Passes TCP connections on to a port of this machine, and stops reading on request: as a machine
/// whose program hangs and whose buffers are full.
class Proxy {
public:
    /// @param to  the port it passes connections on to
    explicit Proxy(int to);
    ~Proxy();
    Proxy(const Proxy&) = delete;
    Proxy& operator=(const Proxy&) = delete;

    /// Any address of this machine has it.
    int port() const { return port_; }
    /// From now on nothing is read of what clients send; what servers send still passes.
    void stopReading();
    void readAgain();

private:
    struct Pair {
        int client = -1;
        int server = -1;
    };
    void run();
    void wake();
    bool pass(int from, int to);

    const int to_;
    int listener_ = -1;
    int port_ = 0;
    int wake_ = -1;
    std::atomic<bool> stopped_{false};
    std::atomic<bool> ending_{false};
    std::list<Pair> pairs_ = {};  // the thread's
    std::thread thread_;
};

}  // namespace gnomon::faults

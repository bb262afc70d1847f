#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace gnomon::client {

/// Writes texts to a descriptor from a thread of its own, so that nobody who wants something said
/// waits for a reader that does not read or a disk that is full. From any thread.
///
/// Texts beyond a MiB that nobody took are left out, and how many is said in their place. What a
/// full disk or a closed pipe does not take is lost; the next text is tried again.
class BackgroundWriter {
public:
    /// Called on the thread with the system's words when a write fails, and again only after
    /// another one succeeded.
    using OnFailure = std::function<void(const std::string& why)>;

    /// @param fd  is ours from now on
    BackgroundWriter(int fd, OnFailure onFailure);
    /// Writes what waits, for at most a second.
    ~BackgroundWriter();
    BackgroundWriter(const BackgroundWriter&) = delete;
    BackgroundWriter& operator=(const BackgroundWriter&) = delete;

    void write(std::string text);

private:
    void run();
    std::string next();
    bool put(const std::string& text);
    bool waitForRoom() const;

    const int fd_;
    const int wake_;
    const OnFailure onFailure_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::string> texts_ = {};  // guarded
    std::size_t bytes_ = 0;               // of texts_; guarded
    std::uint64_t leftOut_ = 0;           // guarded
    bool ending_ = false;                 // guarded
    std::atomic<bool> giveUp_{false};
    bool failed_ = false;  // the thread's
    bool ended_ = false;   // guarded
    std::thread thread_;
};

}  // namespace gnomon::client

#pragma once

#include <gnomon/base/Error.h>
#include <gnomon/base/Process.h>
#include <gnomon/field/ChangeList.h>

#include <chrono>
#include <functional>
#include <span>
#include <string>

namespace gnomon::importer {

/// Reads an importer's standard output, and on the side its standard error: neither pipe ever fills
/// up while the other one is waited for.
class Receiver {
public:
    using Clock = std::chrono::steady_clock;
    using Progress = std::function<void(double, const std::string&)>;

    /// @p child outlives the receiver.
    Receiver(const Child& child, Clock::time_point deadline, Progress progress)
        : Receiver{child.output(), child.errors(), deadline, std::move(progress)} {}
    /// Its two pipes, which stay the caller's.
    Receiver(int output, int errors, Clock::time_point deadline, Progress progress);

    /// The whole stream. @p maxBytes: the most that its parts may hold together. Errors:
    /// Errc::timeout at the deadline; Errc::disconnected where it ends early; Errc::protocol;
    /// Errc::limit.
    Result<field::ChangeList> receive(std::uint64_t maxBytes);
    /// Reads on, and throws away, until both pipes are closed or the deadline has passed. How many
    /// bytes of standard output that were.
    Result<std::uint64_t> drain();
    /// The first line on standard error that is no progress; cut to a sane length.
    std::string complaint() const;

private:
    Result<void> read(std::span<std::byte> to);
    Result<std::vector<std::byte>> readBlock(std::uint64_t size);
    /// Waits for either pipe; looks after standard error itself. True: standard output is readable.
    Result<bool> await();
    void takeErrors();

    int out_ = -1;
    int err_ = -1;  // -1 once closed
    Clock::time_point deadline_;
    Progress progress_;
    std::string errors_;   // lines that are no progress
    std::string partial_;  // the line being read
};

}  // namespace gnomon::importer

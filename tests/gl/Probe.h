#pragma once

#include <gnomon/base/Process.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <string>
#include <vector>

namespace gnomon::gl {

/// Reads a pipe to its end, or until @p stopAt was read, for at most 60 seconds.
inline std::string readPipe(int fd, char stopAt = '\0') {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds{60};
    std::string text;
    for (;;) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
            deadline - std::chrono::steady_clock::now());
        pollfd entry{fd, POLLIN, 0};
        if (left.count() <= 0 || ::poll(&entry, 1, static_cast<int>(left.count())) <= 0)
            return text;
        std::array<char, 4096> chunk{};
        const auto got = ::read(fd, chunk.data(), chunk.size());
        if (got <= 0) return text;
        text.append(chunk.data(), static_cast<std::size_t>(got));
        if (stopAt != '\0' && text.find(stopAt) != std::string::npos) return text;
    }
}

struct ProbeRun {
    bool succeeded = false;
    std::string output = {};   ///< what it printed: `key value` lines
    std::string problem = {};  ///< how it ended otherwise, with its stderr
};

/// Runs the probe program with @p arguments and @p environment added to ours.
inline ProbeRun runProbe(std::vector<std::string> arguments,
                         std::vector<std::string> environment = {}) {
    arguments.insert(arguments.begin(), GNOMON_GL_PROBE);
    auto child =
        Child::start({.arguments = std::move(arguments), .environment = std::move(environment)});
    if (!child) return {.problem = child.error().text()};
    ProbeRun run;
    run.output = readPipe(child->output());
    const auto errors = readPipe(child->errors());
    const int status = child->wait(std::chrono::steady_clock::now() + std::chrono::seconds{10});
    run.succeeded = status == 0;
    run.problem = describeStatus(status) + "\n" + run.output + errors;
    return run;
}

/// What stands behind `key ` in the output, to the end of the line.
inline std::string value(const ProbeRun& run, const std::string& key) {
    const auto at = ("\n" + run.output).find("\n" + key + " ");
    if (at == std::string::npos) return "(no " + key + ")";
    const auto from = at + key.size() + 1;
    return run.output.substr(from, run.output.find('\n', from) - from);
}

/// For EXPECT_PRED_FORMAT2(contains, text, part).
inline testing::AssertionResult contains(const char*, const char*, const std::string& text,
                                         const std::string& part) {
    if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "\"" << text << "\" lacks \"" << part << "\"";
}

}  // namespace gnomon::gl

#include "FrameTrace.h"

#include <fmt/format.h>
#include <gnomon/base/Error.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace gnomon::client {

std::string csvField(const std::vector<std::string>& names) {
    std::string text;
    for (const auto& name : names) text += (text.empty() ? "" : " ") + name;
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string{"\"\""} : std::string{c};
    return quoted + "\"";
}

FrameTrace::FrameTrace(const std::filesystem::path& file,
                       std::function<void(const std::string&)> warn)
    : file_{file}, warn_{std::move(warn)}, out_{file} {
    if (!out_)
        throw Failure{Error{.code = Errc::file,
                            .what = file.string() + ": cannot be written",
                            .cause = {errno, std::generic_category()}}};
    out_ << header << "\n";
}

void FrameTrace::add(const net::FrameResult& frame, const std::vector<net::ServerStatus>& servers,
                     Clock::time_point now) {
    if (over_) return;
    const auto members = std::count_if(
        servers.begin(), servers.end(),
        [](const net::ServerStatus& server) { return server.state == net::ServerState::member; });
    if (!first_) first_ = now;
    const std::chrono::duration<double> since = now - *first_;
    const std::chrono::duration<double, std::milli> step = now - last_.value_or(now);
    last_ = now;
    errno = 0;
    out_ << fmt::format("{},{:.6f},{:.3f},{},{},{}\n", frame.shown, since.count(), step.count(),
                        members, csvField(frame.droppedNow), csvField(frame.joinedNow));
    if (!out_) giveUp();
}

void FrameTrace::finish() {
    if (over_) return;
    errno = 0;
    if (!out_.flush()) giveUp();
}

void FrameTrace::giveUp() {
    const std::error_code why{errno, std::generic_category()};
    over_ = true;
    warn_(fmt::format("{}: cannot be written{}; the trace ends", file_.string(),
                      why ? ": " + why.message() : std::string{}));
}

}  // namespace gnomon::client

#include <arpa/inet.h>
#include <fmt/format.h>
#include <gnomon/net/Codec.h>
#include <gnomon/net/Lookup.h>

#include <algorithm>
#include <charconv>

#include "Candidates.h"
#include "Finder.h"

namespace gnomon::net {

Result<LookupGroup> parseLookupGroup(std::string_view text) {
    const auto colon = text.rfind(':');
    LookupGroup group{.address = std::string{text.substr(0, colon)}};
    in_addr address{};
    bool good = colon != std::string_view::npos &&
                ::inet_pton(AF_INET, group.address.c_str(), &address) == 1 &&
                IN_MULTICAST(ntohl(address.s_addr));
    if (good) {
        const auto digits = text.substr(colon + 1);
        const char* end = digits.data() + digits.size();
        const auto read = std::from_chars(digits.data(), end, group.port);
        good = read.ec == std::errc{} && read.ptr == end && group.port != 0;
    }
    if (!good)
        return fail(Errc::config, fmt::format("\"{}\" is no IPv4 multicast group with a port, such "
                                              "as {}",
                                              text, defaultLookupGroup));
    return group;
}

std::string labelOf(const ServerAddress& server) {
    if (server.host.empty()) return server.name + " (looked up)";
    return fmt::format("{} ({}:{})", server.name, server.host, server.port);
}

namespace {

/// One name asked for.
struct Sought {
    std::string name = {};
    std::unique_ptr<Finder> finder = {};
    Candidates candidates{0};
    LookupAnswer answer = {};
    bool answered = false;

    void heard(const Finder::Heard& from) {
        if (from.version != protocolVersion) {
            answer.trouble = fmt::format("{}:{} speaks protocol version {}, expected {}", from.host,
                                         from.port, from.version, protocolVersion);
            return;
        }
        if (!std::exchange(answered, true)) {
            answer.ms = millisecondsOf(from.after);
            finder->settle();
        }
        candidates.add({.host = from.host, .port = from.port}, from.instance);
    }
};

}  // namespace

std::vector<LookupAnswer> lookUp(const std::vector<std::string>& names, const std::string& group,
                                 bool anywhere, std::chrono::milliseconds limit) {
    asio::io_context io{1};
    std::vector<std::unique_ptr<Sought>> questions;
    for (const auto& name : names) {
        auto question = std::make_unique<Sought>();
        question->name = name;
        question->finder = std::make_unique<Finder>(
            io, name, group, anywhere,
            [to = question.get()](const std::string& what) { to->answer.trouble = what; });
        question->finder->start(
            [to = question.get()](const Finder::Heard& from) { to->heard(from); });
        questions.push_back(std::move(question));
    }
    Timer timer{io};
    timer.after(limit, [&] {
        for (const auto& question : questions)
            if (!question->answered) question->finder->stop();
    });
    // Ends where all have stopped: who was answered does so by himself.
    const auto ended = [](const auto& question) {
        return question->answered && !question->finder->listens();
    };
    while (io.run_one() > 0)
        if (std::all_of(questions.begin(), questions.end(), ended)) break;
    std::vector<LookupAnswer> answers;
    for (const auto& question : questions) {
        for (auto& place : question->candidates.all())
            question->answer.places.push_back(
                {.name = question->name, .host = std::move(place.host), .port = place.port});
        answers.push_back(std::move(question->answer));
    }
    return answers;
}

}  // namespace gnomon::net

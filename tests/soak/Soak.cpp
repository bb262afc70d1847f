#include "Soak.h"

#include <fmt/format.h>
#include <gnomon/client/Application.h>
#include <gnomon/config/Load.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <fstream>
#include <optional>
#include <random>

#include "Processes.h"
#include "Scenery.h"

namespace gnomon::soak {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point from) {
    return std::chrono::duration<double>(Clock::now() - from).count();
}

config::Config wallOf(const SoakOptions& options) {
    auto wall = orThrow(config::loadConfig(options.wall));
    wall.sync.timeout = options.timeout;
    return wall;
}

class Run {
public:
    explicit Run(const SoakOptions& options) : options_{options}, random_{options.seed} {
        outcome_.filesBefore = openFiles(::getpid());
        client::ApplicationOptions made{.local = true, .backend = "none", .server = options.server};
        made.log = [this](client::LogLevel, const std::string& line) {
            if (line.find("drifted") != std::string::npos) ++drifts_;
        };
        app_.emplace(wallOf(options), std::move(made));
        app_->addDefaultSun();
        app_->setView({0.0, 5.0, 15.0}, {0.0, 0.0, 0.0});
        scenery_.emplace(*app_, options.seed);
        if (!options.csv.empty()) {
            csv_.open(options.csv);
            csv_ << "frame,s,client_kib,client_files,server_kib,server_files,largest_server_kib,"
                    "most_server_files,things,zombies\n";
        }
    }

    Outcome go() {
        orThrow(app_->start());
        begun_ = Clock::now();
        const std::uint64_t sampleEvery = std::max<std::uint64_t>(options_.frames / 200, 1);
        for (std::uint64_t i = 1; i <= options_.frames; ++i) {
            frame();
            if (i % sampleEvery == 0) sample(i);
            if (i % options_.faultEvery == 0 && i < options_.frames) fault();
        }
        outcome_.frames = options_.frames;
        outcome_.seconds = secondsSince(begun_);
        // Whoever is still away is to come back, and to agree about the scene.
        const auto limit = Clock::now() + std::chrono::seconds{60};
        while (!complete() && Clock::now() < limit) frame();
        for (int i = 0; i < 200; ++i) frame();
        finish();
        return std::move(outcome_);
    }

private:
    void frame() {
        scenery_->edit(options_.changes);
        const auto from = Clock::now();
        const auto result = app_->frame(secondsSince(begun_));
        frameMs_.push_back(static_cast<float>(secondsSince(from) * 1e3));
        if (stopped_ != 0 && !result.droppedNow.empty()) {
            ::kill(stopped_, SIGCONT);
            stopped_ = 0;
        }
    }

    bool complete() const {
        const auto all = app_->status();
        return std::all_of(all.begin(), all.end(), [](const net::ServerStatus& server) {
            return server.state == net::ServerState::member;
        });
    }

    /// Something happens to one or two servers; the first is left in peace.
    void fault() {
        const auto pids = app_->processes();
        if (pids.size() < 2 || stopped_ != 0) return;
        const auto anyOf = [&] { return pids[1 + random_() % (pids.size() - 1)]; };
        const pid_t victim = anyOf();
        if (victim <= 0) return;  // it is being started
        ++outcome_.faults;
        switch (random_() % 4) {
            case 0:
                ::kill(victim, SIGTERM);
                break;
            case 1:
                ::kill(victim, SIGSTOP);
                stopped_ = victim;
                break;
            case 2:
                if (const pid_t other = anyOf(); other > 0) ::kill(other, SIGKILL);
                [[fallthrough]];
            default:
                ::kill(victim, SIGKILL);
        }
    }

    void sample(std::uint64_t i) {
        const auto pids = app_->processes();
        Sample now{.frame = i,
                   .s = secondsSince(begun_),
                   .clientKib = residentKib(::getpid()),
                   .clientFiles = openFiles(::getpid()),
                   .serverKib = residentKib(pids.front()),
                   .serverFiles = openFiles(pids.front()),
                   .things = scenery_->size(),
                   .zombies = zombies()};
        for (const int pid : pids)
            if (pid > 0) {
                now.mostKib = std::max(now.mostKib, residentKib(pid));
                now.mostFiles = std::max(now.mostFiles, openFiles(pid));
            }
        if (csv_)
            csv_ << fmt::format("{},{:.2f},{},{},{},{},{},{},{},{}\n", now.frame, now.s,
                                now.clientKib, now.clientFiles, now.serverKib, now.serverFiles,
                                now.mostKib, now.mostFiles, now.things, now.zombies);
        outcome_.samples.push_back(now);
    }

    void finish() {
        const auto totals = app_->totals();
        outcome_.lost = totals.lost;
        outcome_.rejoined = totals.rejoined;
        if (stopped_ != 0) ::kill(stopped_, SIGCONT);
        scenery_.reset();
        app_.reset();
        outcome_.drifts = drifts_;
        outcome_.longestMs = *std::max_element(frameMs_.begin(), frameMs_.end());
        const auto middle = frameMs_.begin() + static_cast<std::ptrdiff_t>(frameMs_.size() / 2);
        std::nth_element(frameMs_.begin(), middle, frameMs_.end());
        outcome_.medianMs = *middle;
        if (csv_.is_open()) csv_.close();
        outcome_.filesAfter = openFiles(::getpid());
        outcome_.children = static_cast<int>(children().size());
    }

    const SoakOptions& options_;
    std::mt19937 random_;
    std::atomic<int> drifts_{0};
    Outcome outcome_ = {};
    std::ofstream csv_ = {};
    std::vector<float> frameMs_ = {};
    pid_t stopped_ = 0;
    Clock::time_point begun_ = Clock::now();
    std::optional<client::Application> app_ = {};
    std::optional<Scenery> scenery_ = {};  // ends first
};

long medianOf(const std::vector<Sample>& samples, std::size_t from, std::size_t to,
              long Sample::*what) {
    std::vector<long> all;
    for (std::size_t i = from; i < to; ++i) all.push_back(samples[i].*what);
    std::sort(all.begin(), all.end());
    return all[all.size() / 2];
}

/// What it takes in the last quarter, beyond the second one (the first fills pools and caches).
long growth(const std::vector<Sample>& samples, long Sample::*what) {
    const auto quarter = samples.size() / 4;
    return medianOf(samples, 3 * quarter, samples.size(), what) -
           medianOf(samples, quarter, 2 * quarter, what);
}

}  // namespace

Outcome soak(const SoakOptions& options) { return Run{options}.go(); }

std::vector<std::string> complaints(const Outcome& outcome) {
    std::vector<std::string> all;
    const auto expect = [&](bool fine, const std::string& what) {
        if (!fine) all.push_back(what);
    };
    expect(outcome.faults > 0 && outcome.lost > 0, "nothing happened to any server");
    expect(outcome.rejoined == outcome.lost,
           fmt::format("{} servers were lost, {} came back", outcome.lost, outcome.rejoined));
    expect(outcome.drifts == 0,
           fmt::format("a copy of the scene drifted {} times", outcome.drifts));
    expect(outcome.filesAfter == outcome.filesBefore,
           fmt::format("{} files open before, {} after", outcome.filesBefore, outcome.filesAfter));
    expect(outcome.children == 0, fmt::format("{} processes are left", outcome.children));
    const auto& samples = outcome.samples;
    if (samples.size() < 8) return all;
    // Pools and caches fill at first, a sanitizer's for long.
    const bool isLong = outcome.frames >= 10'000;
    for (const auto& [name, what] :
         {std::pair{"client", &Sample::clientKib}, std::pair{"server", &Sample::serverKib}}) {
        const long more = growth(samples, what);
        const long allowed = std::max(4096L, samples[samples.size() / 4].*what / 10);
        expect(!isLong || more <= allowed, fmt::format("the {} grew by {} KiB", name, more));
    }
    const auto least = [&](int Sample::*what) {
        int value = samples.back().*what;
        for (std::size_t i = samples.size() / 2; i < samples.size(); ++i)
            value = std::min(value, samples[i].*what);
        return value;
    };
    // Descriptors come and go with the servers; the fewest of a half are those that stay.
    int early = samples.front().clientFiles;
    for (std::size_t i = 0; i < samples.size() / 2; ++i)
        early = std::max(early, samples[i].clientFiles);
    expect(least(&Sample::clientFiles) <= early, "the client's descriptors grow");
    expect(least(&Sample::serverFiles) <= samples.front().serverFiles,
           "a server's descriptors grow");
    // One that is being dropped and taken up again has both connections twice for a moment.
    expect(least(&Sample::mostFiles) <= samples.front().serverFiles,
           "a server that was started again has descriptors of the client's");
    return all;
}

}  // namespace gnomon::soak

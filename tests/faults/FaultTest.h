#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <csignal>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "../wall/WallTest.h"
#include "TraceFile.h"

namespace gnomon::faults {

using namespace std::chrono_literals;
using wall::Program;

/// What a busy machine with fewer cores than programs may add to any time.
inline constexpr double slack = 2000.0;  // ms

/// A port that was free a moment ago.
inline int freePort() {
    const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    socklen_t length = sizeof address;
    ::bind(fd, reinterpret_cast<sockaddr*>(&address), sizeof address);
    ::getsockname(fd, reinterpret_cast<sockaddr*>(&address), &length);
    ::close(fd);
    return ntohs(address.sin_port);
}

/// Says when a fault has lasted long enough. Nothing is awaited here: the time itself is the test.
inline void last(std::chrono::milliseconds span) { std::this_thread::sleep_for(span); }

/// What happens to a server's process.
struct Way {
    const char* name = "";
    int signal = 0;
};

/// Two tiles, `left` and `right`; faults happen to `right`.
class FaultTest : public wall::WallTest {
protected:
    const std::string& left() const { return names[0]; }
    const std::string& right() const { return names[1]; }

    std::string key() {
        const auto path = folder.path("cluster.key");
        if (!keyMade_) {
            Program keygen{{"keygen", "--out", path}};
            keyMade_ = keygen.wait() == 0;
        }
        return path;
    }

    /// A wall whose servers run already, at these addresses.
    std::string standingWall(const std::string& sync, const std::vector<std::string>& hosts,
                             const std::vector<int>& ports) {
        auto lines = text(sync);
        for (std::size_t i = 0; i < names.size(); ++i)
            lines.insert(lines.find("\"" + names[i] + "\"") + names[i].size() + 3,
                         fmt::format("host = \"{}\"\nport = {}\n", hosts[i], ports[i]));
        return folder.write("standing.toml",
                            fmt::format("{}[cluster]\nkey = \"{}\"\n", lines, key()));
    }

    /// A server for whoever comes.
    std::unique_ptr<Program> standingServer(const std::string& name, const std::string& address,
                                            int port, const std::string& backend = "none") {
        auto server = std::make_unique<Program>(
            std::vector<std::string>{"--name", name, "--listen",
                                     fmt::format("{}:{}", address, port), "--backend", backend,
                                     "--key", key()},
            std::vector<std::string>{}, "gnomon-server");
        EXPECT_TRUE(server->says("port ")) << testing::PrintToString(server->errors());
        return server;
    }

    nlohmann::json told() const {
        std::ifstream in{folder.path("run.json")};
        return nlohmann::json::parse(in);
    }
    /// What `gnomon run` is told to write for that, and for trace().
    std::vector<std::string> measured(std::vector<std::string> words) const {
        for (const char* word : {"--trace", "trace.csv", "--json", "run.json"})
            words.push_back(word[0] == '-' ? std::string{word} : folder.path(word));
        return words;
    }
    TraceFile trace() const { return TraceFile{folder.path("trace.csv")}; }

    void end(Program& run) {
        run.signal(SIGINT);
        EXPECT_EQ(run.wait(), 0) << testing::PrintToString(run.errors()) << run.output();
        EXPECT_TRUE(run.errors().empty()) << testing::PrintToString(run.errors());
        EXPECT_EQ(run.output().find("drifted"), std::string::npos) << run.output();
    }

    /// `right` was dropped once, cost the wall one gap of at most the timeout, and came back; the
    /// rest went on at its full rate meanwhile.
    void expectOneGap(const TraceFile& trace, double timeoutMs) {
        const auto& rows = trace.rows();
        const auto drop = trace.dropOf(right());
        ASSERT_LT(drop, rows.size()) << "never dropped";
        const auto join = trace.joinOf(right(), drop);
        ASSERT_LT(join, rows.size()) << "never back";
        EXPECT_EQ(trace.dropOf(right(), drop + 1), rows.size()) << "dropped twice";
        EXPECT_EQ(trace.dropOf(left()), rows.size()) << "the other one dropped, too";
        EXPECT_EQ(rows[drop].members, 1);
        EXPECT_LT(rows[drop].ms, timeoutMs + slack);
        const double before = trace.median(1, drop);
        const double meanwhile = trace.median(drop + 1, join);
        const double after = trace.median(join, rows.size());
        // One server keeps a rate that two have, and the wall gets it back.
        EXPECT_LT(meanwhile, std::max(5.0 * before, 20.0));
        EXPECT_LT(after, std::max(5.0 * before, 20.0));
        EXPECT_LT(trace.longest(drop + 1, rows.size()), timeoutMs + slack);
        // For docs/faults.md.
        std::printf(
            "[  FIGURES ] gap %.0f ms; frame %.2f ms before, %.2f without it, %.2f after; "
            "away for %.2f s, %zu frames\n",
            rows[drop].ms, before, meanwhile, after, rows[join].s - rows[drop].s, join - drop);
    }

private:
    bool keyMade_ = false;
};

}  // namespace gnomon::faults

#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>

#include "Program.h"

namespace gnomon::wall {

/// A wall of two tiles side by side, each with a server of its own, whose names nobody else has.
class WallTest : public testing::Test {
protected:
    WallTest() {
        static std::atomic<int> count{0};
        const int number = count++;
        for (const char* side : {"left", "right"})
            names.push_back(fmt::format("{}-{}-{}", side, ::getpid(), number));
        file = folder.write("wall.toml", text());
    }
    void TearDown() override { EXPECT_TRUE(noneLeft(names)) << "servers are left over"; }

    /// @param more  lines of the servers' tables
    std::string text(const std::string& sync = "timeout = 0.5",
                     const std::string& more = {}) const {
        std::string all = fmt::format(
            "name = \"test\"\n[user]\nhead = [0, 1, 2]\n[sync]\n{}\n[[screen]]\nname = \"front\"\n"
            "lower_left = [-1, 0.5, 0]\nlower_right = [1, 0.5, 0]\nupper_left = [-1, 1.5, 0]\n"
            "tiles = [2, 1]\n",
            sync);
        for (int column = 0; column < 2; ++column)
            all += fmt::format(
                "[[server]]\nname = \"{}\"\n{}\n[[server.window]]\nsize = [80, 80]\n"
                "[[server.window.viewport]]\nscreen = \"front\"\ntile = [{}, 0]\n",
                names[static_cast<std::size_t>(column)], more, column);
        return all;
    }

    /// The server's process, once there is one other than @p before.
    pid_t processOf(const std::string& name, pid_t before = 0) const {
        const auto deadline = std::chrono::steady_clock::now() + patience;
        while (std::chrono::steady_clock::now() < deadline)
            for (const pid_t pid : serversNamed(name))
                if (pid != before) return pid;
        return -1;
    }

    Folder folder;
    std::vector<std::string> names;
    std::string file;
};

}  // namespace gnomon::wall

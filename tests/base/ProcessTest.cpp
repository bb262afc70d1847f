#include <gnomon/base/Process.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <string>

namespace gnomon {
namespace {

using std::chrono::steady_clock;

std::string readAll(int file) {
    std::string text;
    std::array<char, 256> buffer{};
    for (;;) {
        const auto count = ::read(file, buffer.data(), buffer.size());
        if (count <= 0) return text;
        text.append(buffer.data(), static_cast<std::size_t>(count));
    }
}

Result<Child> shell(const std::string& script, ChildOptions options = {}) {
    options.arguments = {"/bin/sh", "-c", script};
    return Child::start(options);
}

steady_clock::time_point soon() { return steady_clock::now() + std::chrono::seconds{30}; }

TEST(Process, ItsOutputAndExitCodeCanBeRead) {
    auto child = shell("echo out; echo err >&2; exit 3");
    ASSERT_TRUE(child.has_value()) << child.error().text();
    EXPECT_EQ(readAll(child->output()), "out\n");
    EXPECT_EQ(readAll(child->errors()), "err\n");
    const int status = child->wait(soon());
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 3);
    EXPECT_EQ(describeStatus(status), "exit code 3");
    EXPECT_EQ(child->ended(), status);
}

TEST(Process, ReadsWhatWeWriteToIt) {
    auto child = shell("read line; echo \"got $line\"; cat > /dev/null", {.takesInput = true});
    ASSERT_TRUE(child.has_value()) << child.error().text();
    ASSERT_GE(child->input(), 0);
    ASSERT_EQ(::send(child->input(), "this\n", 5, MSG_NOSIGNAL), 5);
    std::array<char, 16> buffer{};
    ASSERT_EQ(::read(child->output(), buffer.data(), buffer.size()), 9);
    EXPECT_STREQ(buffer.data(), "got this\n");
    EXPECT_EQ(shell("true")->input(), -1);
}

// A connection that we close would stay open where a child had it, too.
TEST(Process, NoneOfOurFilesIsOpenInIt) {
    const int ours = ::socket(AF_UNIX, SOCK_STREAM, 0);  // not closed at exec by itself
    ASSERT_GE(ours, 0);
    auto child = shell("for fd in /proc/self/fd/*; do [ -S $fd ] && echo $fd; done; true");
    ASSERT_TRUE(child.has_value()) << child.error().text();
    EXPECT_EQ(readAll(child->output()), "");
    auto fed = shell("[ -S /proc/self/fd/0 ] && echo fed", {.takesInput = true});
    EXPECT_EQ(readAll(fed->output()), "fed\n") << "the test finds no sockets";
    ::close(ours);
}

TEST(Process, TheEnvironmentIsAddedToOurs) {
    auto child =
        shell("echo \"$GNOMON_PROBE,${PATH:+has path}\"", {.environment = {"GNOMON_PROBE=there"}});
    ASSERT_TRUE(child.has_value());
    EXPECT_EQ(readAll(child->output()), "there,has path\n");
}

TEST(Process, AProgramThatIsNotThereFails) {
    auto child = Child::start({.arguments = {"/no/such/program"}});
    ASSERT_FALSE(child.has_value());
    EXPECT_EQ(child.error().code, Errc::process);
    EXPECT_NE(child.error().text().find("/no/such/program"), std::string::npos);
}

TEST(Process, IsKilledAtTheDeadlineAndWhenDropped) {
    auto child = shell("exec cat");  // its input stays open or not; either way we decide
    auto endless = shell("while :; do :; done");
    ASSERT_TRUE(child.has_value() && endless.has_value());
    EXPECT_FALSE(endless->ended().has_value());
    const int status = endless->wait(steady_clock::now() + std::chrono::milliseconds{50});
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_NE(describeStatus(status).find("signal"), std::string::npos);

    pid_t pid = 0;
    {
        auto dropped = shell("while :; do :; done");
        ASSERT_TRUE(dropped.has_value());
        pid = dropped->pid();
        EXPECT_EQ(::kill(pid, 0), 0);
    }
    EXPECT_EQ(::kill(pid, 0), -1) << "it was killed and waited for";
}

TEST(Process, AMemoryLimitHolds) {
    // One block of 256 MiB cannot be had in 64.
    auto child = shell("head -c 268435456 /dev/zero | tail -c 268435456 | wc -c",
                       {.memoryLimit = 64ULL << 20U});
    ASSERT_TRUE(child.has_value());
    EXPECT_NE(readAll(child->output()), "268435456\n");
    child->wait(soon());
}

TEST(Process, AProgramThatIsOnlyNamedIsLookedForInThePath) {
    auto child = Child::start({.arguments = {"sh", "-c", "echo $0"}});
    ASSERT_TRUE(child) << child.error().text();
    EXPECT_EQ(readAll(child->output()), "sh\n");
    const auto none = Child::start({.arguments = {"gnomon-no-such-program"}});
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().what, "cannot start gnomon-no-such-program: not found in PATH");
}

TEST(Process, ItsInputIsNoneOrEndsWithUs) {
    auto without = shell("cat; echo done");
    ASSERT_TRUE(without);
    EXPECT_EQ(readAll(without->output()), "done\n");
    auto child = shell("echo started; cat; echo done >&2", {.takesInput = true});
    ASSERT_TRUE(child);
    std::array<char, 8> started{};
    ASSERT_EQ(::read(child->output(), started.data(), started.size()), 8);
    EXPECT_FALSE(child->ended());  // cat waits for input
}

TEST(Process, MovesItsOwnership) {
    auto child = shell("exit 0");
    ASSERT_TRUE(child.has_value());
    Child moved = *std::move(child);
    EXPECT_GT(moved.pid(), 0);
    EXPECT_EQ(describeStatus(moved.wait(soon())), "exit code 0");
}

TEST(Process, TheProgramFolderHoldsThisTest) {
    EXPECT_TRUE(std::filesystem::exists(programFolder() / "BaseTest"));
}

}  // namespace
}  // namespace gnomon

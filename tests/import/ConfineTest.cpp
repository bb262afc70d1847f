#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <thread>

#include "Model.h"
#include "format/Sanitizer.h"
#include "program/Confine.h"

namespace gnomon::importer {
namespace {

/// What a confined process finds it can do, bit by bit.
enum Can : int {
    write = 1,
    create = 2,
    fork = 4,
    execute = 8,
    connect = 16,
    remove = 32,
    noRead = 64
};

int tried(const std::string& file) {
    int can = 0;
    const auto allowed = [&](long outcome, Can what) {
        if (outcome >= 0 || errno != EPERM) can |= what;
    };
    allowed(::open(file.c_str(), O_WRONLY | O_CLOEXEC), Can::write);
    allowed(::open((file + ".new").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600), Can::create);
    allowed(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0), Can::connect);
    allowed(::unlink(file.c_str()), Can::remove);
    const pid_t child = ::fork();
    if (child == 0) ::_exit(0);
    allowed(child, Can::fork);
    char name[] = "/bin/false";  // its exit code is not 0
    char* const words[] = {name, nullptr};
    allowed(::execv(name, words), Can::execute);
    if (::open(file.c_str(), O_RDONLY | O_CLOEXEC) < 0) can |= Can::noRead;
    // Threads are no processes: where they may not be, this ends the process.
    std::thread{[] {}}.join();
    return can;
}

TEST(Confined, AProcessReadsFilesAndDoesNothingElse) {
    if (reservesAddressSpace) GTEST_SKIP() << "sanitizers need what is forbidden";
    const TemporaryFolder folder;
    const auto file = folder.write("file", "text").string();
    const pid_t child = ::fork();
    if (child == 0) ::_exit(confineProcess() ? tried(file) : 255);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status)) << status;
    if (WEXITSTATUS(status) == 255) GTEST_SKIP() << "this kernel has no seccomp filters";
    EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace gnomon::importer

#include "Program.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace gnomon::wall {
namespace {

Child startGnomon(std::vector<std::string> arguments, std::vector<std::string> environment,
                  const std::string& name) {
    arguments.insert(arguments.begin(), name.starts_with('/') ? name : GNOMON_BIN_DIR "/" + name);
    return orThrow(
        Child::start({.arguments = std::move(arguments), .environment = std::move(environment)}));
}

}  // namespace

Program::Program(std::vector<std::string> arguments, std::vector<std::string> environment,
                 const std::string& name)
    : child_{startGnomon(std::move(arguments), std::move(environment), name)},
      outputReader_{[this] { read(child_.output(), output_); }},
      errorReader_{[this] { read(child_.errors(), errors_); }} {}

Program::~Program() {
    if (!status_) {
        child_.signal(SIGKILL);
        wait();
    }
    outputReader_.join();
    errorReader_.join();
}

void Program::read(int fd, std::vector<std::string>& lines) {
    std::string pending;
    std::array<char, 4096> buffer{};
    for (;;) {
        const auto got = ::read(fd, buffer.data(), buffer.size());
        if (got <= 0) break;
        pending.append(buffer.data(), static_cast<std::size_t>(got));
        const std::lock_guard lock{mutex_};
        for (auto end = pending.find('\n'); end != std::string::npos; end = pending.find('\n')) {
            lines.push_back(pending.substr(0, end));
            pending.erase(0, end + 1);
        }
        changed_.notify_all();
    }
    const std::lock_guard lock{mutex_};
    if (!pending.empty()) lines.push_back(pending);
    --open_;
    changed_.notify_all();
}

bool Program::says(const std::string& part) {
    const auto deadline = std::chrono::steady_clock::now() + patience;
    std::unique_lock lock{mutex_};
    for (;;) {
        while (seen_ < output_.size())
            if (output_[seen_++].find(part) != std::string::npos) return true;
        if (open_ < 2) return false;
        if (changed_.wait_until(lock, deadline) == std::cv_status::timeout) return false;
    }
}

int Program::wait() {
    if (!status_) status_ = child_.wait(std::chrono::steady_clock::now() + patience);
    std::unique_lock lock{mutex_};
    // The readers are done when the pipes are: servers hold no copy of them.
    changed_.wait_for(lock, patience, [&] { return open_ == 0; });
    return WIFEXITED(*status_) ? WEXITSTATUS(*status_) : 128 + WTERMSIG(*status_);
}

std::string Program::output() {
    const std::lock_guard lock{mutex_};
    std::string all;
    for (const auto& line : output_) all += line + "\n";
    return all;
}

std::vector<std::string> Program::errors() {
    const std::lock_guard lock{mutex_};
    return errors_;
}

std::vector<pid_t> serversNamed(const std::string& name) {
    std::vector<pid_t> found;
    std::error_code ec;
    for (const auto& entry : std::filesystem::directory_iterator{"/proc", ec}) {
        const auto folder = entry.path().filename().string();
        if (folder.find_first_not_of("0123456789") != std::string::npos) continue;
        std::ifstream in{entry.path() / "cmdline", std::ios::binary};
        std::ostringstream text;
        text << in.rdbuf();
        const std::string words = text.str();  // each ends with a zero byte
        const std::string wanted = std::string{"--name"} + '\0' + name + '\0';
        if (words.find("gnomon-server") != std::string::npos &&
            words.find(wanted) != std::string::npos)
            found.push_back(std::stoi(folder));
    }
    return found;
}

bool noneLeft(const std::vector<std::string>& names) {
    const auto deadline = std::chrono::steady_clock::now() + 10s;
    for (const auto& name : names)
        while (!serversNamed(name).empty())
            if (std::chrono::steady_clock::now() > deadline) return false;
    return true;
}

Folder::Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "gnomon-wall-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw Failure{Errc::file, "cannot make " + name};
    path_ = name;
}

Folder::~Folder() {
    std::error_code ec;
    std::filesystem::remove_all(path_, ec);
}

std::string Folder::write(const std::string& name, const std::string& text) const {
    std::ofstream{path(name), std::ios::binary} << text;
    return path(name);
}

}  // namespace gnomon::wall

#include <gnomon/base/Process.h>
#include <gnomon/import/Import.h>
#include <sys/wait.h>

#include <csignal>
#include <cstdlib>

#include "client/Receiver.h"
#include "format/Sanitizer.h"

namespace gnomon::importer {
namespace {

std::filesystem::path importerProgram(const ImportOptions& options) {
    if (!options.program.empty()) return options.program;
    if (const char* named = std::getenv("GNOMON_IMPORT"); named != nullptr && *named != '\0')
        return named;
    return programFolder() / "gnomon-import";
}

ChildOptions childOptions(const std::filesystem::path& file, const ImportOptions& options) {
    ChildOptions child;
    child.arguments = {importerProgram(options).string(),
                       file.string(),
                       "--output",
                       "-",
                       "--max-memory",
                       std::to_string(options.maxMemory),
                       "--max-time",
                       std::to_string(options.maxTime.count()),
                       "--progress"};
    // A path that begins with '-' is a path.
    if (child.arguments[1].rfind('-', 0) == 0) child.arguments[1].insert(0, "./");
    if (!reservesAddressSpace) child.memoryLimit = options.maxMemory;
    child.cpuLimit = options.maxTime + std::chrono::seconds{1};
    return child;
}

}  // namespace

Result<field::ChangeList> importScene(const std::filesystem::path& file,
                                      const ImportOptions& options) {
    const std::string name = file.string();
    auto child = Child::start(childOptions(file, options));
    if (!child) return tl::unexpected{std::move(child).error()};

    const auto deadline = Receiver::Clock::now() + options.maxTime;
    Receiver receiver{*child, deadline, options.progress};
    auto list = receiver.receive(options.maxMemory);
    const auto tooSlow = [&] {
        return fail(Errc::limit, name + ": the importer took longer than " +
                                     std::to_string(options.maxTime.count()) +
                                     " s and was stopped");
    };
    if (!list && list.error().code == Errc::timeout) return tooSlow();
    if (!list && list.error().code != Errc::disconnected)
        return fail(list.error().code, name + ": " + list.error().what);
    // It has said what it had to say; its end tells how that is to be taken.
    const auto drained = receiver.drain();
    if (!drained) return tooSlow();
    const int status = child->wait(deadline);

    if (WIFSIGNALED(status)) {
        const int number = WTERMSIG(status);
        if (number == SIGXCPU) return tooSlow();
        const bool killed = number == SIGKILL || number == SIGTERM;
        return fail(killed ? Errc::limit : Errc::file,
                    name + ": the importer " + (killed ? "was killed" : "crashed") + " (" +
                        describeStatus(status) + ") - " +
                        (killed ? "perhaps there is not enough memory for the file"
                                : "the file is probably malformed"));
    }
    if (const int code = WEXITSTATUS(status); code != 0) {
        const auto complaint = receiver.complaint();
        if (code != 1 || complaint.empty())
            return fail(Errc::process, name + ": the importer ended with " +
                                           describeStatus(status) +
                                           (complaint.empty() ? "" : ": " + complaint));
        return fail(Errc::file, complaint);
    }
    if (!list) return fail(Errc::protocol, name + ": " + list.error().what);
    if (*drained > 0)
        return fail(Errc::protocol, name + ": the importer's output goes on after its end");
    return list;
}

}  // namespace gnomon::importer

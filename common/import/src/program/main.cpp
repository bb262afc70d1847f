// gnomon-import: reads one model file and writes the scene it holds. A process of its own, so that
// whatever a file does to its reader ends with this process.
#include <fcntl.h>
#include <fmt/format.h>
#include <gnomon/scene/Types.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <new>

#include "build/SceneBuilder.h"
#include "format/Format.h"
#include "program/Confine.h"
#include "program/Limits.h"
#include "program/Options.h"
#include "program/ReadModel.h"
#include "program/Send.h"

namespace gnomon::importer {
namespace {

/// The descriptor the result goes to. Standard output is turned away from it: a library that prints
/// must not write into the stream.
Result<int> openOutput(const std::string& where) {
    const bool isNumber = where.find_first_not_of("0123456789") == std::string::npos;
    int fd = -1;
    if (where == "-" || (isNumber && where.size() < 6))
        fd = ::fcntl(where == "-" ? STDOUT_FILENO : std::stoi(where), F_DUPFD_CLOEXEC, 3);
    else
        fd = ::open(where.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (fd < 0)
        return fail(Errc::file, "cannot write to " + where, {errno, std::generic_category()});
    const int devNull = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (devNull >= 0) ::dup2(devNull, STDOUT_FILENO);
    return fd;
}

Report makeReport(bool progress) {
    if (!progress) return Report{};
    return Report{[](double share, std::string_view what) {
        fmt::print(stderr, "{}{:.3f} {}\n", progressMark, share, printable(what));
        std::fflush(stderr);
    }};
}

int complain(const std::string& file, const std::string& what) {
    const auto line = printable(file + ": " + what, 1500) + "\n";
    std::fputs(line.c_str(), stderr);
    return 1;
}

int run(const ProgramOptions& options) {
    const std::string name = options.file.string();
    limitProcess(name, options.maxMemory, options.maxTime);
    try {
        const int output = orThrow(openOutput(options.output));
        field::TypeRegistry types;
        scene::addTypes(types);
        Report report = makeReport(options.progress);
        confineProcess();
        SceneBuilder scene{types, report};
        readModel(options.file, scene);
        const auto list = scene.finish(options.file.filename().string());
        orThrow(send(list, types, output));
        if (::close(output) != 0) return complain(name, "closing the result failed");
        return 0;
    } catch (const Failure& failure) {
        return complain(name, failure.what());
    } catch (const std::bad_alloc&) {
        return complain(name, fmt::format("needs more memory than the {} MiB it may have",
                                          options.maxMemory >> 20U));
    } catch (const std::length_error&) {
        return complain(name, "asks for more memory than there can be");
    } catch (const std::exception& error) {
        return complain(name, fmt::format("cannot be read ({})", error.what()));
    }
}

}  // namespace
}  // namespace gnomon::importer

int main(int count, char** arguments) {
    using namespace gnomon::importer;
    const auto options = parsedOptions(count, arguments);
    if (!options) {
        fmt::print(stderr, "gnomon-import: {}; {}\n", options.error().what, usage());
        return 2;
    }
    if (options->help) {
        fmt::print("{}\n", usage());
        return 0;
    }
    return run(*options);
}

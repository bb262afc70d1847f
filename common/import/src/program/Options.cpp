#include "program/Options.h"

#include <charconv>
#include <string_view>

namespace gnomon::importer {

std::string usage() {
    return "usage: gnomon-import FILE --output FD|-|PATH [--max-memory BYTES] [--max-time SECONDS] "
           "[--progress]";
}

Result<ProgramOptions> parsedOptions(int count, const char* const* arguments) {
    ProgramOptions options;
    const auto number = [](std::string_view name, std::string_view text, auto& to) -> Result<void> {
        const auto [end, ec] = std::from_chars(text.data(), text.data() + text.size(), to);
        if (ec != std::errc{} || end != text.data() + text.size() || to == 0)
            return fail(Errc::config, std::string{name} + ": \"" + std::string{text} +
                                          "\", expected a whole number > 0");
        return {};
    };
    for (int i = 1; i < count; ++i) {
        const std::string_view argument = arguments[i];
        if (argument == "--help") {
            options.help = true;
            return options;
        }
        if (argument == "--progress") {
            options.progress = true;
            continue;
        }
        if (argument == "--output" || argument == "--max-memory" || argument == "--max-time") {
            if (++i == count)
                return fail(Errc::config, std::string{argument} + ": its value is missing");
            Result<void> done;
            if (argument == "--output") options.output = arguments[i];
            if (argument == "--max-memory")
                done = number(argument, arguments[i], options.maxMemory);
            if (argument == "--max-time") done = number(argument, arguments[i], options.maxTime);
            if (!done) return tl::unexpected{done.error()};
            continue;
        }
        if (argument.size() > 1 && argument.front() == '-')
            return fail(Errc::config, "unknown option " + std::string{argument});
        if (!options.file.empty())
            return fail(Errc::config, "more than one file: " + std::string{argument});
        options.file = argument;
    }
    if (options.file.empty()) return fail(Errc::config, "no file is given");
    if (options.output.empty()) return fail(Errc::config, "--output is missing");
    return options;
}

}  // namespace gnomon::importer

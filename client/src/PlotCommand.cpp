#include <gnomon/base/Error.h>

#include <cerrno>
#include <fstream>
#include <memory>
#include <system_error>

#include "Commands.h"
#include "bench/TracePlot.h"

namespace gnomon::client {
namespace {

struct PlotArguments {
    std::filesystem::path trace = {};
    std::filesystem::path out = {};
    std::string title = {};
};

[[noreturn]] void failOn(const std::filesystem::path& file, const char* what) {
    throw Failure{Error{.code = Errc::file,
                        .what = file.string() + ": " + what,
                        .cause = {errno, std::generic_category()}}};
}

int plot(const PlotArguments& arguments) {
    std::ifstream in{arguments.trace};
    if (!in) failOn(arguments.trace, "cannot be read");
    const auto rows = readTrace(in);
    if (!rows) throw Failure{rows.error().code, arguments.trace.string() + ":" + rows.error().what};
    const auto drawing = plotOf(
        *rows, arguments.title.empty() ? arguments.trace.filename().string() : arguments.title);
    if (arguments.out.extension() == ".png") {
        writePlotPng(arguments.out, drawing);
        return 0;
    }
    std::ofstream out{arguments.out, std::ios::binary};
    out << plotSvg(drawing);
    if (!out.flush()) failOn(arguments.out, "cannot be written");
    return 0;
}

}  // namespace

void addPlot(CLI::App& program, Action& action) {
    auto& command = *program.add_subcommand("plot", "Draw what gnomon run --trace wrote");
    const auto arguments = std::make_shared<PlotArguments>();
    command.add_option("TRACE", arguments->trace, "The trace, CSV")->required();
    command.add_option("--out", arguments->out, "The drawing, SVG or PNG")
        ->type_name("FILE")
        ->required();
    command.add_option("--title", arguments->title, "What stands above it");
    command.callback([arguments, &action] { action = [arguments] { return plot(*arguments); }; });
}

}  // namespace gnomon::client

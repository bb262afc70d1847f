#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace gnomon::client {

struct Choice;
struct ShotOptions;

/// What the chosen subcommand does once the command line is parsed; its value is the exit code.
/// A Failure it throws ends the program with exit code 1 and one line.
using Action = std::function<int()>;

/// Each adds its subcommand; when that is chosen, @p action becomes what it does.
/// @param choose  see RunOptions
void addRun(CLI::App& program, Action& action,
            std::function<Choice(const ShotOptions&)> choose = {});
void addCheck(CLI::App& program, Action& action);
void addKeygen(CLI::App& program, Action& action);
void addPlot(CLI::App& program, Action& action);
void addBench(CLI::App& program, Action& action);
void addShot(CLI::App& program, Action& action);
void addTruth(CLI::App& program, Action& action);
void addCompare(CLI::App& program, Action& action);

}  // namespace gnomon::client

#include <gnomon/base/Error.h>

#include <cstdio>
#include <exception>
#include <string>

#include "Commands.h"
#include "Shot.h"

namespace {

constexpr int failed = 1;
constexpr int wrongUsage = 2;

/// One line on standard error: what the program ends with.
int end(int code, std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    for (char& c : text)
        if (c == '\n' || c == '\r') c = ' ';
    std::fputs(("gnomon: " + text + "\n").c_str(), stderr);
    return code;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App program{"Gnomon: walls of render servers that show one scene, with shadows", "gnomon"};
    program.require_subcommand(1);
    gnomon::client::Action action;
    gnomon::client::addRun(program, action, gnomon::client::chooseTechnique);
    gnomon::client::addCheck(program, action);
    gnomon::client::addKeygen(program, action);
    gnomon::client::addBench(program, action);
    gnomon::client::addPlot(program, action);
    gnomon::client::addShot(program, action);
    gnomon::client::addTruth(program, action);
    gnomon::client::addCompare(program, action);
    try {
        program.parse(argc, argv);
    } catch (const CLI::Success& help) {
        return program.exit(help);
    } catch (const CLI::Error& error) {
        return end(wrongUsage, error.what());
    }
    try {
        return action();
    } catch (const std::exception& error) {
        return end(failed, error.what());
    }
}

#pragma once

#include <gnomon/client/Log.h>

#include <cstdio>
#include <mutex>
#include <string>

namespace gnomon::client {

/// What the program tells people, on standard output: lines, and below them one progress bar.
/// (Standard error has the one line a failed program ends with.) From any thread.
///
/// On a terminal the bar is drawn over itself; elsewhere it is a line each quarter of the way.
class Console {
public:
    explicit Console(std::FILE* out = stdout);
    /// Ends an unfinished bar's line.
    ~Console();
    Console(const Console&) = delete;
    Console& operator=(const Console&) = delete;

    void line(const std::string& text);
    /// Warnings and errors say so; debug lines are left out.
    void log(LogLevel level, const std::string& text);
    /// @param share  done, 0..1; at 1 the bar is finished
    void progress(const std::string& title, double share, const std::string& what);

private:
    void clearBar();
    void drawBar();
    void plainProgress(const std::string& title, double share, const std::string& what);

    std::FILE* const out_;
    const bool terminal_;
    std::mutex mutex_ = {};
    std::string bar_ = {};        // as drawn; empty: none
    std::string lastPlain_ = {};  // title of the last plain line
    int lastQuarter_ = -1;
};

}  // namespace gnomon::client

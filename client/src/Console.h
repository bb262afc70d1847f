#pragma once

#include <gnomon/client/Log.h>

#include <cstdio>
#include <memory>
#include <mutex>
#include <string>

#include "BackgroundWriter.h"

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

    /// From here on nothing waits for whoever reads us. Lines go to the file @p log, too, if it is
    /// not empty, each after its time. What cannot be written is said once: of the file here, of
    /// standard output on standard error. @throws Failure Errc::file
    void detach(const std::string& log);

    void line(const std::string& text);
    /// Warnings and errors say so; debug lines are left out.
    void log(LogLevel level, const std::string& text);
    /// @param share  done, 0..1; at 1 the bar is finished
    void progress(const std::string& title, double share, const std::string& what);

private:
    void put(const std::string& text);
    void keep(const std::string& text);
    void clearBar();
    void drawBar();
    void plainProgress(const std::string& title, double share, const std::string& what);

    std::FILE* const out_;
    const bool terminal_;
    std::mutex mutex_ = {};
    std::string bar_ = {};        // as drawn; empty: none
    std::string lastPlain_ = {};  // title of the last plain line
    int lastQuarter_ = -1;
    std::unique_ptr<BackgroundWriter> file_ = {};
    std::unique_ptr<BackgroundWriter> output_ = {};
};

}  // namespace gnomon::client

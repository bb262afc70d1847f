#include "TracePlot.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "../FrameTrace.h"
#include "Scale.h"

namespace gnomon::client {
namespace {

constexpr PlotColor blue{0.12, 0.47, 0.71};
constexpr PlotColor red{0.84, 0.15, 0.16};
constexpr PlotColor green{0.17, 0.63, 0.17};
constexpr PlotColor grey{0.55, 0.55, 0.55};
constexpr PlotColor pale{0.88, 0.88, 0.88};
constexpr PlotColor sky{0.65, 0.80, 0.92};

constexpr double width = 980.0, height = 430.0;
constexpr double left = 70.0, right = 950.0, top = 64.0, bottom = 310.0;
constexpr double membersTop = 340.0, membersBottom = 384.0;
constexpr double column = 3.0;  // pixels of one point of a line

/// Fields of a line, the quotes of CSV taken off.
std::vector<std::string> fieldsOf(const std::string& line) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
            fields.back() += line[++i];
        else if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            fields.emplace_back();
        else
            fields.back() += c;
    }
    return fields;
}

template <class Number>
bool read(const std::string& text, Number& to) {
    const auto done = std::from_chars(text.data(), text.data() + text.size(), to);
    return done.ec == std::errc{} && done.ptr == text.data() + text.size();
}

struct Columns {
    Plot::Line median = {}, longest = {};
};

/// Frames that share a pixel, as two points.
Columns columnsOf(const std::vector<TraceRow>& rows, const Scale& time, const Scale& ms) {
    Columns columns{.median = {.color = blue, .width = 1.4},
                    .longest = {.color = sky, .width = 1.2}};
    std::vector<double> together;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const double x = time.at(rows[i].s);
        together.push_back(rows[i].ms);
        if (i + 1 < rows.size() && time.at(rows[i + 1].s) < x + column - std::fmod(x, column))
            continue;
        std::sort(together.begin(), together.end());
        columns.median.points.push_back({x, ms.at(together[together.size() / 2])});
        columns.longest.points.push_back({x, ms.at(together.back())});
        together.clear();
    }
    return columns;
}

Plot::Line membersOf(const std::vector<TraceRow>& rows, const Scale& time, const Scale& members) {
    Plot::Line line{.color = grey, .width = 1.4};
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double x = time.at(rows[i].s);
        const double y = members.at(rows[i].members);
        const bool changed = i == 0 || rows[i].members != rows[i - 1].members;
        if (!changed && i + 1 < rows.size()) continue;
        if (!line.points.empty()) line.points.push_back({x, line.points.back()[1]});
        line.points.push_back({x, y});
    }
    return line;
}

void drawAxes(Plot& plot, const Scale& time, const Scale& ms, const Scale& members, int most) {
    using Align = Plot::Text::Align;
    for (const double s : time.ticks()) {
        const double x = time.at(s);
        plot.lines.push_back({.points = {{x, top}, {x, membersBottom}}, .color = pale});
        plot.texts.push_back({.x = x,
                              .y = membersBottom + 18.0,
                              .text = fmt::format("{:g} s", s),
                              .align = Align::centre});
    }
    const auto horizontal = [&](double y, const std::string& text) {
        plot.lines.push_back({.points = {{left, y}, {right, y}}, .color = pale});
        plot.texts.push_back({.x = left - 8.0, .y = y + 4.0, .text = text, .align = Align::right});
    };
    for (const double value : ms.ticks()) horizontal(ms.at(value), fmt::format("{:g}", value));
    for (const int count : {0, most}) horizontal(members.at(count), std::to_string(count));
    const auto upward = [&](double y, const char* text) {
        plot.texts.push_back(
            {.x = 20.0, .y = y, .text = text, .align = Align::centre, .upward = true});
    };
    upward((top + bottom) / 2.0, "from frame to frame, ms");
    upward((membersTop + membersBottom) / 2.0, "servers");
}

/// A line through both diagrams, with what happened above it.
void drawEvent(Plot& plot, double x, const std::string& text, const PlotColor& color, double y) {
    plot.lines.push_back({.points = {{x, y + 4.0}, {x, membersBottom}},
                          .color = color,
                          .width = 1.0,
                          .dashed = true});
    const bool atEnd = x > right - 150.0;
    plot.texts.push_back({.x = x,
                          .y = y,
                          .text = text,
                          .align = atEnd ? Plot::Text::Align::right : Plot::Text::Align::left,
                          .color = color});
}

}  // namespace

Result<std::vector<TraceRow>> readTrace(std::istream& in) {
    std::string line;
    if (!std::getline(in, line) || line != FrameTrace::header)
        return fail(Errc::file,
                    fmt::format("1: found \"{}\", expected \"{}\"", line, FrameTrace::header));
    std::vector<TraceRow> rows;
    for (int number = 2; std::getline(in, line); ++number) {
        const auto fields = fieldsOf(line);
        TraceRow row;
        if (fields.size() != 6 || !read(fields[0], row.frame) || !read(fields[1], row.s) ||
            !read(fields[2], row.ms) || !read(fields[3], row.members))
            return fail(Errc::file,
                        fmt::format("{}: found \"{}\", expected a frame's line", number, line));
        row.dropped = fields[4];
        row.joined = fields[5];
        rows.push_back(std::move(row));
    }
    return rows;
}

Plot plotOf(const std::vector<TraceRow>& rows, const std::string& title) {
    Plot plot{.width = width, .height = height};
    plot.texts.push_back({.x = left, .y = 20.0, .text = title});
    double least = 1e9;
    double most = 0.0;
    int servers = 1;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        if (rows[i].ms > 0.0) least = std::min(least, rows[i].ms);
        most = std::max(most, rows[i].ms);
        servers = std::max(servers, rows[i].members);
    }
    if (!(most > 0.0)) return plot;
    const Scale time{0.0, std::max(rows.back().s, 1e-3), left, right, false};
    const Scale ms{least * 0.8, most * 1.25, bottom, top, true};
    const Scale members{0.0, static_cast<double>(servers), membersBottom, membersTop, false};
    drawAxes(plot, time, ms, members, servers);
    auto columns = columnsOf(rows, time, ms);
    plot.lines.push_back(std::move(columns.longest));
    plot.lines.push_back(std::move(columns.median));
    plot.lines.push_back(membersOf(rows, time, members));
    for (std::size_t i = 1; i < rows.size(); ++i) {  // all joined to make the first
        const double x = time.at(rows[i].s);
        if (!rows[i].dropped.empty()) drawEvent(plot, x, "- " + rows[i].dropped, red, 44.0);
        if (!rows[i].joined.empty()) drawEvent(plot, x, "+ " + rows[i].joined, green, 58.0);
    }
    plot.texts.push_back({.x = right,
                          .y = 20.0,
                          .text = "dark: median, light: longest",
                          .align = Plot::Text::Align::right,
                          .color = grey});
    return plot;
}

}  // namespace gnomon::client

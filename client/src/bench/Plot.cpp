#include "Plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "Scale.h"

namespace gnomon::client {
namespace {

constexpr std::array<PlotColor, 12> colors{{{0.12, 0.47, 0.71},
                                            {1.00, 0.50, 0.05},
                                            {0.17, 0.63, 0.17},
                                            {0.84, 0.15, 0.16},
                                            {0.58, 0.40, 0.74},
                                            {0.55, 0.34, 0.29},
                                            {0.89, 0.47, 0.76},
                                            {0.35, 0.35, 0.35},
                                            {0.74, 0.74, 0.13},
                                            {0.09, 0.75, 0.81},
                                            {0.05, 0.25, 0.45},
                                            {0.60, 0.75, 0.30}}};
constexpr PlotColor black{0.1, 0.1, 0.1};
constexpr PlotColor grey{0.55, 0.55, 0.55};
constexpr PlotColor pale{0.88, 0.88, 0.88};

constexpr double width = 980.0, height = 540.0;
constexpr double left = 70.0, right = 770.0, top = 40.0, bottom = 480.0;
constexpr double legend = 795.0;

Scale timeScale(const std::vector<BenchRow>& rows) {
    double least = 1e9;
    double most = 0.0;
    for (const BenchRow& row : rows) {
        if (row.ratio.median > 0.0) least = std::min(least, row.ratio.low);
        most = std::max(most, row.ratio.high);
    }
    if (!(most > 0.0)) return {0.0, 1.0, left, right, false};
    // A peer may be twenty times slower; what lies close together must still be told apart.
    if (least > 0.0 && most > 12.0 * least) return {least * 0.8, most * 1.25, left, right, true};
    const double step = Scale::roundStep(most / 6.0);
    return {0.0, std::ceil(most / step) * step, left, right, false};
}

Scale errorScale(const std::vector<BenchRow>& rows) {
    double least = 1e9;
    double most = 0.0;
    for (const BenchRow& row : rows) {
        const double wrong = row.wrongPercent();
        if (!(wrong > 0.0)) continue;
        least = std::min(least, wrong);
        most = std::max(most, wrong);
    }
    if (!(most > 0.0)) return {0.01, 1.0, bottom, top, true};
    return {least * 0.7, most * 1.4, bottom, top, true};
}

/// What the time is a multiple of.
std::string timeLabel(const std::vector<BenchRow>& rows) {
    if (rows.empty()) return "frame time";
    return fmt::format("frame time, in pairs: 1 is {} {}, {:.1f} ms", rows.front().technique,
                       rows.front().mapSize, rows.front().frameMs.median);
}

void drawAxes(Plot& plot, const Scale& time, const Scale& error, const std::string& first) {
    using Align = Plot::Text::Align;
    for (const double ms : time.ticks()) {
        const double x = time.at(ms);
        plot.lines.push_back({.points = {{x, top}, {x, bottom}}, .color = pale});
        plot.texts.push_back(
            {.x = x, .y = bottom + 18.0, .text = fmt::format("{:g}", ms), .align = Align::centre});
    }
    for (const double percent : error.ticks()) {
        const double y = error.at(percent);
        plot.lines.push_back({.points = {{left, y}, {right, y}}, .color = pale});
        plot.texts.push_back({.x = left - 8.0,
                              .y = y + 4.0,
                              .text = fmt::format("{:g}", percent),
                              .align = Align::right});
    }
    plot.texts.push_back(
        {.x = (left + right) / 2.0, .y = bottom + 42.0, .text = first, .align = Align::centre});
    plot.texts.push_back({.x = 20.0,
                          .y = (top + bottom) / 2.0,
                          .text = "wrong pixels, %",
                          .align = Align::centre,
                          .upward = true});
}

/// Techniques in the order in which they first come up.
std::vector<std::string> techniquesOf(const std::vector<BenchRow>& rows) {
    std::vector<std::string> seen;
    for (const BenchRow& row : rows)
        if (std::find(seen.begin(), seen.end(), row.technique) == seen.end())
            seen.push_back(row.technique);
    return seen;
}

Plot::Mark markOf(const BenchRow& row, bool onFront, const PlotColor& color) {
    using Shape = Plot::Mark::Shape;
    return {.shape = row.peer ? Shape::diamond : Shape::circle,
            .radius = onFront ? 6.0 : 4.0,
            .filled = onFront && !row.peer,
            .color = color};
}

}  // namespace

Plot plotOf(const BenchTable& table) {
    Plot plot{.width = width, .height = height};
    const Scale time = timeScale(table.rows);
    const Scale error = errorScale(table.rows);
    drawAxes(plot, time, error, timeLabel(table.rows));
    plot.texts.push_back({.x = left, .y = 24.0, .text = table.title(), .size = 14.0});
    const auto place = [&](const BenchRow& row) {
        return std::array{time.at(row.ratio.median), error.at(row.wrongPercent())};
    };
    const auto front = paretoFront(table.rows);
    std::vector<std::array<double, 2>> dashes;
    const auto names = techniquesOf(table.rows);
    std::vector<Plot::Line> joined(names.size());
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const BenchRow& row = table.rows[i];
        const auto at = place(row);
        const auto name = static_cast<std::size_t>(
            std::find(names.begin(), names.end(), row.technique) - names.begin());
        const PlotColor color = colors[name % colors.size()];
        joined[name].color = color;
        joined[name].points.push_back(at);
        plot.lines.push_back(
            {.points = {{time.at(row.ratio.low), at[1]}, {time.at(row.ratio.high), at[1]}},
             .color = color,
             .width = 1.2});
        auto mark = markOf(row, front[i], color);
        mark.x = at[0];
        mark.y = at[1];
        plot.marks.push_back(mark);
        if (row.mapBytes > 0 || row.peer)  // texels are drawn only where none were kept
            plot.texts.push_back({.x = at[0] + 8.0,
                                  .y = at[1] - 6.0,
                                  .text = std::to_string(row.mapSize),
                                  .size = 9.0,
                                  .color = color});
        if (front[i]) dashes.push_back(at);
    }
    for (auto& line : joined)
        if (line.points.size() > 1) plot.lines.push_back(std::move(line));
    std::sort(dashes.begin(), dashes.end());
    if (dashes.size() > 1)
        plot.lines.push_back({.points = dashes, .color = grey, .width = 1.5, .dashed = true});
    double y = top + 8.0;
    for (std::size_t i = 0; i < names.size(); ++i, y += 20.0) {
        const auto row = std::find_if(table.rows.begin(), table.rows.end(),
                                      [&](const auto& r) { return r.technique == names[i]; });
        auto mark = markOf(*row, !row->peer, colors[i % colors.size()]);
        mark.x = legend;
        mark.y = y;
        plot.marks.push_back(mark);
        plot.texts.push_back({.x = legend + 12.0, .y = y + 4.0, .text = names[i], .color = black});
    }
    for (const char* note : {"filled, dashed: Pareto front", "numbers: texels a side of the map"}) {
        y += 18.0;
        plot.texts.push_back(
            {.x = legend - 6.0, .y = y, .text = note, .size = 10.0, .color = grey});
    }
    return plot;
}

}  // namespace gnomon::client

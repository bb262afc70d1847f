#include "GrowthPlot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "bench/Plot.h"

namespace gnomon::bench {
namespace {

constexpr double width = 640, height = 420, left = 70, right = 150, top = 30, bottom = 50;
constexpr std::array<client::PlotColor, 6> colors{{{0.12, 0.47, 0.71},
                                                   {0.84, 0.15, 0.16},
                                                   {0.17, 0.63, 0.17},
                                                   {0.58, 0.40, 0.74},
                                                   {1.00, 0.50, 0.05},
                                                   {0.40, 0.40, 0.40}}};
constexpr client::PlotColor black{0.1, 0.1, 0.1}, grid{0.85, 0.85, 0.85};

std::string label(const Row& row) {
    std::string text = row.name;
    if (row.name.find_first_not_of("0123456789") == std::string::npos) text += " changes";
    if (row.tls) text += ", TLS";
    if (row.pipeline != 1) text += fmt::format(", pipeline {}", row.pipeline);
    if (row.relay > 0) text += fmt::format(", relay {}", row.relay);
    return text;
}

/// From a range of values to one of pixels, logarithmically.
struct Axis {
    double low = 1, high = 10, from = 0, to = 1;
    double at(double value) const {
        return from + (to - from) * std::log(value / low) / std::log(high / low);
    }
};

std::string duration(double us) {
    if (us < 1e3) return fmt::format("{:g} us", us);
    return us < 1e6 ? fmt::format("{:g} ms", us / 1e3) : fmt::format("{:g} s", us / 1e6);
}

}  // namespace

std::string growthSvg(const std::vector<Row>& rows) {
    std::map<std::string, std::vector<const Row*>> lines;
    Axis x{.low = 1, .high = 2, .from = left, .to = width - right};
    Axis y{.low = 1e9, .high = 0, .from = height - bottom, .to = top};
    for (const Row& row : rows) {
        lines[label(row)].push_back(&row);
        x.high = std::max(x.high, static_cast<double>(row.servers));
        y.low = std::min(y.low, row.median);
        y.high = std::max(y.high, row.median);
    }
    y.low = std::pow(10.0, std::floor(std::log10(y.low)));
    y.high = std::pow(10.0, std::ceil(std::log10(y.high * 1.001)));
    client::Plot plot{.width = width, .height = height};
    for (double value = y.low; value < y.high * 1.5; value *= 10) {
        plot.lines.push_back(
            {.points = {{{left, y.at(value)}, {width - right, y.at(value)}}}, .color = grid});
        plot.texts.push_back({.x = left - 6,
                              .y = y.at(value) + 4,
                              .text = duration(value),
                              .align = client::Plot::Text::Align::right,
                              .color = black});
    }
    for (double value = 1; value <= x.high; value *= 2)
        plot.texts.push_back({.x = x.at(value),
                              .y = height - bottom + 18,
                              .text = fmt::format("{:g}", value),
                              .align = client::Plot::Text::Align::centre,
                              .color = black});
    plot.texts.push_back({.x = (left + width - right) / 2,
                          .y = height - 10,
                          .text = "servers",
                          .align = client::Plot::Text::Align::centre,
                          .color = black});
    std::size_t next = 0;
    std::vector<client::Plot::Text> labels;
    for (auto& [name, points] : lines) {
        const auto& color = colors[next++ % colors.size()];
        std::sort(points.begin(), points.end(),
                  [](const Row* a, const Row* b) { return a->servers < b->servers; });
        client::Plot::Line line{.color = color, .width = 1.5};
        for (const Row* row : points) {
            line.points.push_back({x.at(row->servers), y.at(row->median)});
            plot.marks.push_back({.x = line.points.back()[0],
                                  .y = line.points.back()[1],
                                  .radius = 3,
                                  .filled = true,
                                  .color = color});
        }
        labels.push_back({.x = line.points.back()[0] + 8,
                          .y = line.points.back()[1] + 4,
                          .text = name,
                          .color = color});
        plot.lines.push_back(std::move(line));
    }
    // One below the other where lines end close together.
    std::sort(labels.begin(), labels.end(), [](const auto& a, const auto& b) { return a.y < b.y; });
    double free = 0;
    for (auto& one : labels) {
        one.y = std::max(one.y, free);
        free = one.y + 14;
        plot.texts.push_back(one);
    }
    return client::plotSvg(plot);
}

std::string markdown(const std::vector<Row>& rows) {
    std::set<int> servers;
    std::vector<std::string> names;
    std::map<std::pair<std::string, int>, const Row*> cells;
    for (const Row& row : rows) {
        const auto name = label(row);
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
        servers.insert(row.servers);
        cells[{name, row.servers}] = &row;
    }
    std::string text = "| servers |", rule = "\n| --- |";
    for (const int count : servers) {
        text += fmt::format(" {} |", count);
        rule += " --- |";
    }
    text += rule + "\n";
    for (const auto& name : names) {
        text += fmt::format("| {} |", name);
        for (const int count : servers) {
            const auto found = cells.find({name, count});
            if (found == cells.end()) {
                text += " |";
                continue;
            }
            const Row& row = *found->second;
            text += fmt::format(" {:.4g} ({:.3g})", row.median, row.p99);
            if (row.bytes > 0) text += fmt::format(", {:.2f} GB/s", row.bytes / row.median * 1e-3);
            text += " |";
        }
        text += "\n";
    }
    return text;
}

}  // namespace gnomon::bench

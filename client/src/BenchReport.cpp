#include "BenchReport.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "TextFile.h"

namespace gnomon::client {
namespace {

constexpr std::array<const char*, 8> colors{"#3366aa", "#cc5533", "#338855", "#8855aa",
                                            "#bb8800", "#118899", "#aa3377", "#666666"};

double wrongPercent(const BenchRow& row) { return 100.0 * row.error.share(row.error.wrong); }

/// Text within XML.
std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else
            out += c;
    }
    return out;
}

/// The colour of a technique, by when it first comes up.
const char* colorOf(const std::vector<BenchRow>& rows, const std::string& technique) {
    std::vector<std::string> seen;
    for (const BenchRow& row : rows) {
        if (std::find(seen.begin(), seen.end(), row.technique) == seen.end())
            seen.push_back(row.technique);
    }
    const auto at = std::find(seen.begin(), seen.end(), technique) - seen.begin();
    return colors[static_cast<std::size_t>(at) % colors.size()];
}

std::string label(const BenchRow& row) { return fmt::format("{} {}", row.technique, row.mapSize); }

/// A round step that divides a span into some four to ten parts.
double roundStep(double span) {
    const double raw = span / 6.0;
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    for (const double step : {1.0, 2.0, 5.0})
        if (step * power >= raw) return step * power;
    return 10.0 * power;
}

/// From figures to places in the plot.
class Axes {
public:
    static constexpr double width = 860.0, height = 520.0;
    static constexpr double left = 70.0, right = 830.0, top = 30.0, bottom = 460.0;

    explicit Axes(const std::vector<BenchRow>& rows) {
        for (const BenchRow& row : rows) {
            mostMs_ = std::max(mostMs_, row.frameMs.high);
            const double wrong = wrongPercent(row);
            if (!(wrong > 0.0)) continue;
            low_ = std::min(low_, std::floor(std::log10(wrong) * 3.0) / 3.0);
            high_ = std::max(high_, std::ceil(std::log10(wrong) * 3.0) / 3.0);
        }
        if (low_ > high_) {
            low_ = -2.0;
            high_ = 0.0;
        }
        if (!(mostMs_ > 0.0)) mostMs_ = 1.0;
        step_ = roundStep(mostMs_);
        mostMs_ = std::ceil(mostMs_ / step_) * step_;
    }
    double step() const { return step_; }
    double mostMs() const { return mostMs_; }
    double lowest() const { return std::pow(10.0, low_); }
    double highest() const { return std::pow(10.0, high_); }
    double x(double ms) const { return left + (right - left) * ms / mostMs_; }
    /// Nothing wrong is at the very bottom.
    double y(double percent) const {
        const double at = std::max(percent > 0.0 ? std::log10(percent) : low_, low_);
        return bottom - (bottom - top) * (at - low_) / (high_ > low_ ? high_ - low_ : 1.0);
    }

private:
    double mostMs_ = 0.0, step_ = 1.0;
    double low_ = 9.0, high_ = -9.0;
};

void drawAxes(std::string& svg, const Axes& axes) {
    for (double ms = 0.0; ms <= axes.mostMs() * 1.0001; ms += axes.step()) {
        svg += fmt::format(
            "<line x1=\"{0:.1f}\" y1=\"{1}\" x2=\"{0:.1f}\" y2=\"{2}\" stroke=\"#ddd\"/>"
            "<text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4:g}</text>\n",
            axes.x(ms), Axes::top, Axes::bottom, Axes::bottom + 18.0, ms);
    }
    for (int power = -6; power <= 2; ++power) {
        for (const double digit : {1.0, 2.0, 5.0}) {
            const double percent = digit * std::pow(10.0, power);
            if (percent < axes.lowest() * 0.999 || percent > axes.highest() * 1.001) continue;
            svg += fmt::format(
                "<line x1=\"{0}\" y1=\"{1:.1f}\" x2=\"{2}\" y2=\"{1:.1f}\" stroke=\"#ddd\"/>"
                "<text x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5:g}</text>\n",
                Axes::left, axes.y(percent), Axes::right, Axes::left - 8.0, axes.y(percent) + 4.0,
                percent);
        }
    }
    svg += fmt::format(
        "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">median frame, ms</text>\n"
        "<text x=\"18\" y=\"{}\" text-anchor=\"middle\" transform=\"rotate(-90 18 {})\">wrong "
        "pixels, %</text>\n",
        (Axes::left + Axes::right) / 2.0, Axes::bottom + 42.0, (Axes::top + Axes::bottom) / 2.0,
        (Axes::top + Axes::bottom) / 2.0);
}

void drawFront(std::string& svg, const Axes& axes, const BenchTable& table,
               const std::vector<bool>& front) {
    std::vector<const BenchRow*> on;
    for (std::size_t i = 0; i < front.size(); ++i)
        if (front[i]) on.push_back(&table.rows[i]);
    std::sort(on.begin(), on.end(), [](const BenchRow* a, const BenchRow* b) {
        return a->frameMs.median < b->frameMs.median;
    });
    std::string line;
    for (const BenchRow* row : on)
        line += fmt::format("{}{:.1f},{:.1f}", line.empty() ? "" : " ", axes.x(row->frameMs.median),
                            axes.y(wrongPercent(*row)));
    svg += fmt::format(
        "<polyline points=\"{}\" fill=\"none\" stroke=\"#999\" stroke-dasharray=\"5 4\"/>\n", line);
}

}  // namespace

Interval medianOf(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const auto n = static_cast<double>(values.size());
    const auto at = [&](double rank) {
        return values[static_cast<std::size_t>(std::clamp(rank, 0.0, n - 1.0))];
    };
    const double half = 0.98 * std::sqrt(n);
    return {.median = at(std::floor(n / 2.0)),
            .low = at(std::floor(n / 2.0 - half)),
            .high = at(std::ceil(n / 2.0 + half))};
}

std::vector<bool> paretoFront(const std::vector<BenchRow>& rows) {
    std::vector<bool> front;
    for (const BenchRow& row : rows) {
        front.push_back(std::none_of(rows.begin(), rows.end(), [&](const BenchRow& other) {
            const double ms = other.frameMs.median - row.frameMs.median;
            const double wrong = wrongPercent(other) - wrongPercent(row);
            return ms <= 0.0 && wrong <= 0.0 && (ms < 0.0 || wrong < 0.0);
        }));
    }
    return front;
}

std::string benchCsv(const BenchTable& table) {
    std::string csv =
        "technique,map_size,frame_ms,frame_ms_low,frame_ms_high,ratio,ratio_low,ratio_high,"
        "wrong_percent,false_shadow,false_light,interior_percent,rmse,edge_mean_px,edge_95_px,"
        "ssim,flip,triangles,map_texels,map_bytes,degenerate,pareto\n";
    const auto front = paretoFront(table.rows);
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const BenchRow& row = table.rows[i];
        const truth::ShadowError& e = row.error;
        csv += fmt::format(
            "{},{},{:.4f},{:.4f},{:.4f},{:.5f},{:.5f},{:.5f},{:.5f},{},{},{:.5f},{:.6f},{:.4f},"
            "{:.4f},{:.6f},{:.6f},{},{},{},{},{}\n",
            row.technique, row.mapSize, row.frameMs.median, row.frameMs.low, row.frameMs.high,
            row.ratio.median, row.ratio.low, row.ratio.high, wrongPercent(row), e.falseShadow,
            e.falseLight, 100.0 * e.share(e.interior), e.rmse, e.edgeMean, e.edge95, e.ssim, e.flip,
            row.triangles, row.mapTexels, row.mapBytes, row.degenerate, front[i] ? 1 : 0);
    }
    return csv;
}

std::string benchJson(const BenchTable& table) {
    auto rows = nlohmann::ordered_json::array();
    const auto front = paretoFront(table.rows);
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const BenchRow& row = table.rows[i];
        rows.push_back({{"technique", row.technique},
                        {"map_size", row.mapSize},
                        {"frame_ms", {row.frameMs.low, row.frameMs.median, row.frameMs.high}},
                        {"ratio", {row.ratio.low, row.ratio.median, row.ratio.high}},
                        {"wrong", row.error.share(row.error.wrong)},
                        {"interior", row.error.share(row.error.interior)},
                        {"rmse", row.error.rmse},
                        {"edge_mean_px", row.error.edgeMean},
                        {"ssim", row.error.ssim},
                        {"flip", row.error.flip},
                        {"triangles", row.triangles},
                        {"map_texels", row.mapTexels},
                        {"map_bytes", row.mapBytes},
                        {"degenerate", row.degenerate},
                        {"pareto", static_cast<bool>(front[i])}});
    }
    return nlohmann::ordered_json{{"scene", table.scene},
                                  {"renderer", table.renderer},
                                  {"width", table.width},
                                  {"height", table.height},
                                  {"dynamic", table.dynamic},
                                  {"frames", table.frames},
                                  {"runs", rows}}
               .dump(2) +
           "\n";
}

std::string benchSvg(const BenchTable& table) {
    const Axes axes{table.rows};
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" "
        "height=\"{1:g}\" font-family=\"sans-serif\" font-size=\"12\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        Axes::width, Axes::height);
    drawAxes(svg, axes);
    const auto front = paretoFront(table.rows);
    drawFront(svg, axes, table, front);
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const BenchRow& row = table.rows[i];
        const double x = axes.x(row.frameMs.median);
        const double y = axes.y(wrongPercent(row));
        const char* color = colorOf(table.rows, row.technique);
        svg += fmt::format(
            "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>"
            "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\" stroke=\"{}\"/>"
            "<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"{}\">{}</text>\n",
            axes.x(row.frameMs.low), y, axes.x(row.frameMs.high), y, color, x, y, front[i] ? 6 : 4,
            front[i] ? color : "white", color, x + 9.0, y - 7.0, color, escaped(label(row)));
    }
    return svg + "</svg>\n";
}

std::string benchHtml(const BenchTable& table) {
    std::string html = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Shadows of "
        "{0}</title>\n<style>body{{font-family:sans-serif;max-width:70em;margin:2em auto}}"
        "table{{border-collapse:collapse}}td,th{{padding:.2em .6em;text-align:right}}"
        "td:first-child,th:first-child{{text-align:left}}tr:nth-child(even){{background:#f4f4f4}}"
        "figure{{display:inline-block;margin:.5em}}img{{max-width:32em}}</style></head><body>\n"
        "<h1>Shadows of {0}</h1>\n<p>{1} x {2} pixels, {3}, {4} frames each in turn, {5}. Wrong: "
        "pixels on the other side of one half than the ray-traced truth. Filled dots and bold "
        "rows: nothing here is both faster and closer to the truth.</p>\n",
        escaped(table.scene), table.width, table.height,
        table.dynamic ? "everything moves" : "a still scene", table.frames,
        escaped(table.renderer));
    html += benchSvg(table);
    html +=
        "<table><tr><th>technique</th><th>map</th><th>ms</th><th>to the first</th><th>95 %</th>"
        "<th>wrong %</th><th>inner %</th><th>RMSE</th><th>edge px</th><th>SSIM</th><th>FLIP</th>"
        "<th>triangles</th><th>texels drawn</th></tr>\n";
    const auto front = paretoFront(table.rows);
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const BenchRow& row = table.rows[i];
        html += fmt::format(
            "<tr{}><td>{}</td><td>{}</td><td>{:.2f}</td><td>{:.3f}</td><td>{:.3f} to {:.3f}</td>"
            "<td>{:.3f}</td><td>{:.3f}</td><td>{:.4f}</td><td>{:.2f}</td><td>{:.4f}</td>"
            "<td>{:.4f}</td><td>{}</td><td>{}</td></tr>\n",
            front[i] ? " style=\"font-weight:bold\"" : "", escaped(row.technique), row.mapSize,
            row.frameMs.median, row.ratio.median, row.ratio.low, row.ratio.high, wrongPercent(row),
            100.0 * row.error.share(row.error.interior), row.error.rmse, row.error.edgeMean,
            row.error.ssim, row.error.flip, row.triangles, row.mapTexels);
    }
    html += "</table>\n<p>The truth in grey; false shadow red, false light blue.</p>\n";
    for (const BenchRow& row : table.rows)
        if (!row.picture.empty())
            html += fmt::format(
                "<figure><a href=\"{0}\"><img src=\"{0}\" alt=\"error of "
                "{1}\"></a><figcaption>{1}, "
                "{2:.3f} % wrong</figcaption></figure>\n",
                escaped(row.picture), escaped(label(row)), wrongPercent(row));
    return html + "</body></html>\n";
}

void writeBenchReport(const std::filesystem::path& folder, const BenchTable& table) {
    makeFolder(folder);
    writeText(folder / "plot.svg", benchSvg(table));
    writeText(folder / "table.csv", benchCsv(table));
    writeText(folder / "table.json", benchJson(table));
    writeText(folder / "index.html", benchHtml(table));
}

}  // namespace gnomon::client

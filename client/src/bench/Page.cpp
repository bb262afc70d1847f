#include <fmt/format.h>

#include "Report.h"

namespace gnomon::client {
namespace {

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

std::string flickerCells(const std::optional<FlickerError>& flicker) {
    return flicker ? fmt::format("<td>{:.4f}</td>", 100.0 * flicker->share()) : "<td></td>";
}

std::string rowHtml(const BenchRow& row, bool onFront) {
    return fmt::format(
        "<tr{}><td>{}{}</td><td>{}</td><td>{:.2f}</td><td>{:.3f}</td><td>{:.3f} to {:.3f}</td>"
        "<td>{:.3f}</td><td>{:.3f}</td><td>{:.3f}</td><td>{:.3f}</td><td>{:.3f}</td><td>{:.4f}</td>"
        "<td>{:.2f}</td><td>{:.4f}</td><td>{:.4f}</td>{}{}<td>{}</td><td>{}</td></tr>\n",
        onFront ? " style=\"font-weight:bold\"" : "", escaped(row.technique),
        row.peer ? " (peer)" : "", row.mapSize, row.frameMs.median, row.ratio.median, row.ratio.low,
        row.ratio.high, row.wrongPercent(), 100.0 * row.bands[0], 100.0 * row.bands[1],
        100.0 * row.bands[2], 100.0 * row.error.share(row.error.interior), row.error.rmse,
        row.error.edgeMean, row.error.ssim, row.error.flip, flickerCells(row.cameraFlicker),
        flickerCells(row.lightFlicker), row.triangles, row.mapTexels);
}

std::string tableHtml(const BenchTable& table) {
    std::string html = fmt::format(
        "<h2>{}</h2>\n<p>{}, {} frames each in turn.</p>\n<p><a href=\"plot-{}.png\"><img "
        "class=\"plot\" src=\"plot-{}.svg\" alt=\"run time and error\"></a></p>\n",
        escaped(table.title()), escaped(table.renderer), table.frames, table.slug(), table.slug());
    html +=
        "<table><tr><th>technique</th><th>map</th><th>ms</th><th>to the first</th><th>95 %</th>"
        "<th>wrong %</th><th>near %</th><th>middle %</th><th>far %</th><th>inner %</th>"
        "<th>RMSE</th><th>edge px</th><th>SSIM</th><th>FLIP</th><th>flicker % eye</th><th>flicker "
        "% light</th><th>triangles</th><th>texels drawn</th></tr>\n";
    const auto front = paretoFront(table.rows);
    for (std::size_t i = 0; i < table.rows.size(); ++i) html += rowHtml(table.rows[i], front[i]);
    html += "</table>\n";
    for (const BenchRow& row : table.rows)
        if (!row.picture.empty() && !table.dynamic)
            html += fmt::format(
                "<figure><a href=\"{0}\"><img src=\"{0}\" alt=\"error of {1}\"></a><figcaption>{1} "
                "{2}, {3:.3f} % wrong</figcaption></figure>\n",
                escaped(row.picture), escaped(row.technique), row.mapSize, row.wrongPercent());
    return html;
}

}  // namespace

std::string benchHtml(const std::vector<BenchTable>& tables) {
    std::string html =
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Shadows: time and "
        "error</title>\n<style>body{font-family:sans-serif;max-width:90em;margin:2em auto}"
        "table{border-collapse:collapse;font-size:85%}td,th{padding:.2em .5em;text-align:right}"
        "td:first-child,th:first-child{text-align:left}tr:nth-child(even){background:#f4f4f4}"
        "figure{display:inline-block;margin:.5em}img{max-width:24em}img.plot{max-width:100%}"
        "</style></head><body>\n<h1>Shadows: time and error</h1>\n<p>Wrong: pixels on the other "
        "side of one half than the ray-traced truth; near, middle and far are thirds of the pixels "
        "by distance. Bold rows and filled dots: nothing here is both faster and closer to the "
        "truth. Hollow diamonds are peers. Flicker: pixels that change sides from frame to frame "
        "while the truth does not. Pictures show the truth in grey, false shadow red, false light "
        "blue.</p>\n";
    for (const BenchTable& table : tables) html += tableHtml(table);
    return html + "</body></html>\n";
}

}  // namespace gnomon::client

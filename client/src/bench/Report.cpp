#include "Report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "../TextFile.h"
#include "Plot.h"

namespace gnomon::client {
namespace {

using Ordered = nlohmann::ordered_json;

std::string csvFlicker(const std::optional<FlickerError>& flicker) {
    return flicker ? fmt::format("{:.5f},{:.6f}", 100.0 * flicker->share(), flicker->meanChange)
                   : ",";
}

Ordered jsonFlicker(const std::optional<FlickerError>& flicker) {
    if (!flicker) return nullptr;
    return {{"share", flicker->share()},
            {"mean_change", flicker->meanChange},
            {"counted", flicker->counted}};
}

/// A text within a table of commas.
std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? "\"\"" : std::string{c};
    return out + "\"";
}

Ordered jsonRow(const BenchRow& row, bool onFront) {
    return {{"technique", row.technique},
            {"map_size", row.mapSize},
            {"peer", row.peer},
            {"frame_ms", {row.frameMs.low, row.frameMs.median, row.frameMs.high}},
            {"ratio", {row.ratio.low, row.ratio.median, row.ratio.high}},
            {"wrong", row.error.share(row.error.wrong)},
            {"interior", row.error.share(row.error.interior)},
            {"wrong_near", row.bands[0]},
            {"wrong_middle", row.bands[1]},
            {"wrong_far", row.bands[2]},
            {"rmse", row.error.rmse},
            {"edge_mean_px", row.error.edgeMean},
            {"ssim", row.error.ssim},
            {"flip", row.error.flip},
            {"flicker_camera", jsonFlicker(row.cameraFlicker)},
            {"flicker_light", jsonFlicker(row.lightFlicker)},
            {"triangles", row.triangles},
            {"map_texels", row.mapTexels},
            {"map_bytes", row.mapBytes},
            {"degenerate", row.degenerate},
            {"pareto", onFront}};
}

}  // namespace

std::string benchCsv(const std::vector<BenchTable>& tables) {
    std::string csv =
        "chapter,scene,view,width,height,motion,technique,map_size,peer,frame_ms,frame_ms_low,"
        "frame_ms_high,ratio,ratio_low,ratio_high,wrong_percent,false_shadow,false_light,"
        "interior_percent,near_percent,middle_percent,far_percent,rmse,edge_mean_px,edge_95_px,"
        "ssim,flip,flicker_camera_percent,flicker_camera_mean,flicker_light_percent,"
        "flicker_light_mean,triangles,map_texels,map_bytes,degenerate,pareto\n";
    for (const BenchTable& table : tables) {
        const auto front = paretoFront(table.rows);
        for (std::size_t i = 0; i < table.rows.size(); ++i) {
            const BenchRow& row = table.rows[i];
            const truth::ShadowError& e = row.error;
            csv += fmt::format(
                "{},{},{},{},{},{},{},{},{},{:.4f},{:.4f},{:.4f},{:.5f},{:.5f},{:.5f},{:.5f},{},{},"
                "{:.5f},{:.5f},{:.5f},{:.5f},{:.6f},{:.4f},{:.4f},{:.6f},{:.6f},{},{},{},{},{},{},"
                "{}\n",
                quoted(table.chapter), quoted(table.scene), quoted(table.view), table.width,
                table.height, table.dynamic ? "dynamic" : "static", quoted(row.technique),
                row.mapSize, row.peer ? 1 : 0, row.frameMs.median, row.frameMs.low,
                row.frameMs.high, row.ratio.median, row.ratio.low, row.ratio.high,
                row.wrongPercent(), e.falseShadow, e.falseLight, 100.0 * e.share(e.interior),
                100.0 * row.bands[0], 100.0 * row.bands[1], 100.0 * row.bands[2], e.rmse,
                e.edgeMean, e.edge95, e.ssim, e.flip, csvFlicker(row.cameraFlicker),
                csvFlicker(row.lightFlicker), row.triangles, row.mapTexels, row.mapBytes,
                row.degenerate, front[i] ? 1 : 0);
        }
    }
    return csv;
}

std::string benchJson(const std::vector<BenchTable>& tables) {
    Ordered all = Ordered::array();
    for (const BenchTable& table : tables) {
        const auto front = paretoFront(table.rows);
        Ordered rows = Ordered::array();
        for (std::size_t i = 0; i < table.rows.size(); ++i)
            rows.push_back(jsonRow(table.rows[i], front[i]));
        all.push_back({{"chapter", table.chapter},
                       {"scene", table.scene},
                       {"view", table.view},
                       {"renderer", table.renderer},
                       {"width", table.width},
                       {"height", table.height},
                       {"dynamic", table.dynamic},
                       {"frames", table.frames},
                       {"runs", rows}});
    }
    return Ordered{{"tables", all}}.dump(2) + "\n";
}

std::string benchText(const BenchTable& table) {
    bool flickers = false;
    for (const BenchRow& row : table.rows) flickers = flickers || row.cameraFlicker;
    std::string text = table.title() + "\n";
    text +=
        fmt::format("{:24} {:>5} {:>9} {:>22} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8}{}\n", "technique",
                    "map", "ms", "ratio to the first", "wrong %", "near %", "middle %", "far %",
                    "inner %", "RMSE", flickers ? " flicker % eye    light" : "");
    const auto front = paretoFront(table.rows);
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const BenchRow& row = table.rows[i];
        text += fmt::format(
            "{:24} {:5} {:9.2f} {:8.3f} [{:.3f}, {:.3f}] {:8.3f} {:8.3f} {:8.3f} {:8.3f} {:8.3f} "
            "{:8.4f}",
            (front[i] ? "* " : "  ") + row.technique, row.mapSize, row.frameMs.median,
            row.ratio.median, row.ratio.low, row.ratio.high, row.wrongPercent(),
            100.0 * row.bands[0], 100.0 * row.bands[1], 100.0 * row.bands[2],
            100.0 * row.error.share(row.error.interior), row.error.rmse);
        if (row.cameraFlicker && row.lightFlicker)
            text += fmt::format("      {:8.4f} {:8.4f}", 100.0 * row.cameraFlicker->share(),
                                100.0 * row.lightFlicker->share());
        text += "\n";
    }
    return text;
}

void writeBenchReport(const std::filesystem::path& folder, const std::vector<BenchTable>& tables) {
    makeFolder(folder);
    for (const BenchTable& table : tables) {
        const Plot plot = plotOf(table);
        writeText(folder / ("plot-" + table.slug() + ".svg"), plotSvg(plot));
        writePlotPng(folder / ("plot-" + table.slug() + ".png"), plot);
    }
    writeText(folder / "table.csv", benchCsv(tables));
    writeText(folder / "table.json", benchJson(tables));
    writeText(folder / "index.html", benchHtml(tables));
}

}  // namespace gnomon::client

#include "Bench.h"

#include <fmt/format.h>
#include <gnomon/base/Process.h>
#include <unistd.h>

#include <algorithm>

#include "../LocalSession.h"
#include "../TextFile.h"
#include "Peers.h"
#include "Report.h"
#include "Trial.h"

namespace gnomon::client {
namespace {

/// Gone, with all in it, at the end.
class WorkFolder {
public:
    WorkFolder()
        : path_{std::filesystem::temp_directory_path() /
                fmt::format("gnomon-bench-{}", ::getpid())} {
        makeFolder(path_);
    }
    ~WorkFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    WorkFolder(const WorkFolder&) = delete;
    WorkFolder& operator=(const WorkFolder&) = delete;
    const std::filesystem::path& path() const noexcept { return path_; }

private:
    std::filesystem::path path_;
};

/// The project's own scene, made anew. @throws Failure
std::filesystem::path madePlaza(const std::filesystem::path& folder) {
    const auto program = programFolder() / "gnomon-demo-scene";
    auto file = folder / "plaza.glb";
    auto child = orThrow(
        Child::start({.arguments = {program.string(), "--scene", "plaza", "--out", file.string()},
                      .keepStderr = true}));
    const int status = child.wait(std::chrono::steady_clock::now() + std::chrono::seconds{120});
    if (status != 0) throw Failure{Errc::process, program.string() + ": " + describeStatus(status)};
    return file;
}

class Bench {
public:
    explicit Bench(const BenchOptions& options)
        : options_{options},
          context_{makeContext(options.backend)},
          peers_{options.peers, folder_.path(), console_} {
        if (!options.path.empty()) path_ = orThrow(CameraPath::load(options.path));
        if (!options.report.empty()) makeFolder(options.report);
    }

    int run() {
        auto scenes = options_.scenes;
        if (scenes.empty()) scenes.push_back(madePlaza(folder_.path()));
        checkViews(scenes);
        for (const auto& scene : scenes) {
            Reference reference{scene, console_};
            for (const Chapter& chapter : options_.chapters) runChapter(reference, chapter);
        }
        if (!options_.report.empty()) {
            writeBenchReport(options_.report, tables_);
            console_.line("wrote " + (options_.report / "index.html").string());
        }
        return 0;
    }

private:
    void checkViews(const std::vector<std::filesystem::path>& scenes) const {
        for (const Chapter& chapter : options_.chapters)
            for (const BenchView& view : chapter.views)
                if (std::none_of(scenes.begin(), scenes.end(),
                                 [&](const auto& scene) { return view.fits(scene.string()); }))
                    throw Failure{Errc::config,
                                  fmt::format("view \"{}\" is for the scene \"{}\", which is not "
                                              "among those named",
                                              view.name, view.scene)};
    }
    void runChapter(Reference& reference, const Chapter& chapter) {
        if (!chapter.about.empty()) console_.line("== " + chapter.name + ": " + chapter.about);
        for (const BenchView& view : chapter.views) {
            if (!view.fits(reference.file().string())) continue;
            for (const auto& size : chapter.sizes) runView(reference, chapter, view, size);
        }
    }
    void runView(Reference& reference, const Chapter& chapter, const BenchView& view,
                 std::array<int, 2> size) {
        const auto found =
            runTrial(*context_, reference,
                     {.chapter = chapter,
                      .view = reference.resolved(view, size),
                      .frames = options_.frames,
                      .path = path_ ? &*path_ : nullptr,
                      .pictures = options_.report,
                      .peers =
                          [&](const Judge& judge, const BenchView& resolved) {
                              return peers_.start(reference, chapter, judge, resolved);
                          }},
                     console_);
        for (const BenchTable& table : found) {
            console_.line(benchText(table));
            tables_.push_back(table);
        }
        // A sweep takes long: what is known so far is there if it is stopped.
        if (!options_.json.empty()) writeText(options_.json, benchJson(tables_));
        if (!options_.csv.empty()) writeText(options_.csv, benchCsv(tables_));
    }

    const BenchOptions& options_;
    Console console_;
    WorkFolder folder_;
    std::unique_ptr<gl::Context> context_;
    Peers peers_;
    std::optional<CameraPath> path_ = {};
    std::vector<BenchTable> tables_ = {};
};

}  // namespace

int bench(const BenchOptions& options) { return Bench{options}.run(); }

}  // namespace gnomon::client

#include <fmt/format.h>
#include <gnomon/config/Layout.h>

#include <map>
#include <tuple>

#include "Checks.h"
#include "Subject.h"
#include "Text.h"

namespace gnomon::config {
namespace {

// One viewport and what it is in.
struct Shown {
    const Server* server = nullptr;
    const Window* window = nullptr;
    const Viewport* viewport = nullptr;
};

std::string label(const Shown& shown) { return subject(*shown.server) + ", window, viewport"; }

using Spot = std::tuple<Eye, int, int>;  // eye, row, column

class Cover {
public:
    Cover(const Screen& screen, std::vector<Finding>& findings)
        : screen_{screen}, findings_{findings} {}

    void add(const Shown& shown) {
        const Viewport& viewport = *shown.viewport;
        const auto [column, row] = viewport.tile;
        if (column >= screen_.tiles[0] || row >= screen_.tiles[1]) {
            complain(shown, "tile",
                     fmt::format("tile is {}, {} has {} x {}, counted from [0, 0]",
                                 tomlText(viewport.tile), subject(screen_), screen_.tiles[0],
                                 screen_.tiles[1]));
            return;
        }
        const auto [it, isNew] = spots_.emplace(Spot{viewport.eye, row, column}, shown);
        if (!isNew) {
            complain(shown, "tile",
                     fmt::format("tile {} of {} is shown to the {} eye by server {} already",
                                 tomlText(viewport.tile), subject(screen_), name(viewport.eye),
                                 tomlText(it->second.server->name)));
        }
        if (!first_) first_ = shown;
        const PixelRect here = pixelRect(*shown.window, viewport);
        const PixelRect there = pixelRect(*first_->window, *first_->viewport);
        if (here.width != there.width || here.height != there.height) {
            findings_.push_back(
                {.place = sizePlace(shown),
                 .what =
                     fmt::format("{}: shows {} x {} pixels, must be {} x {} as in server {}: "
                                 "all tiles of {} have one size",
                                 label(shown), here.width, here.height, there.width, there.height,
                                 tomlText(first_->server->name), subject(screen_))});
        }
        if (!isMixed_ && (viewport.eye == Eye::mono) != (first_->viewport->eye == Eye::mono)) {
            isMixed_ = true;
            complain(shown, "eye",
                     fmt::format("eye is {}, server {} shows {} to {}: a screen is either mono or "
                                 "left and right",
                                 tomlText(viewport.eye), tomlText(first_->server->name),
                                 subject(screen_), tomlText(first_->viewport->eye)));
        }
    }

    void finish() {
        if (!first_) {
            warn("no server shows it");
            return;
        }
        if (isMixed_) return;
        for (const Eye eye : {Eye::mono, Eye::left, Eye::right}) missing(eye);
    }

private:
    // Where the number of pixels comes from.
    static const Place& sizePlace(const Shown& shown) {
        const Origin& origin = shown.viewport->origin;
        return origin.keys.contains("rect") ? origin.of("rect") : shown.window->origin.of("size");
    }

    void complain(const Shown& shown, std::string_view key, const std::string& what) {
        findings_.push_back(
            {.place = shown.viewport->origin.of(key), .what = label(shown) + ": " + what});
    }

    void warn(const std::string& what) {
        findings_.push_back({.level = Level::warning,
                             .place = screen_.origin.table,
                             .what = subject(screen_) + ": " + what});
    }

    void missing(Eye eye) {
        const bool isMono = first_->viewport->eye == Eye::mono;
        if (isMono != (eye == Eye::mono)) return;
        std::vector<std::string> tiles;
        for (int row = 0; row < screen_.tiles[1]; ++row) {
            for (int column = 0; column < screen_.tiles[0]; ++column) {
                if (spots_.contains(Spot{eye, row, column})) continue;
                tiles.push_back(tomlText(Cells{column, row}));
            }
        }
        if (tiles.empty()) return;
        const std::string who = isMono ? "" : fmt::format(" to the {} eye", name(eye));
        const int total = screen_.tiles[0] * screen_.tiles[1];
        if (static_cast<int>(tiles.size()) == total) {
            warn("no server shows it" + who);
            return;
        }
        std::string list;
        for (std::size_t i = 0; i < tiles.size() && i < 4; ++i) {
            if (i > 0) list += ", ";
            list += tiles[i];
        }
        if (tiles.size() > 4) list += fmt::format(" and {} more", tiles.size() - 4);
        warn(fmt::format("no server shows tile {}{}", list, who));
    }

    const Screen& screen_;
    std::vector<Finding>& findings_;
    std::map<Spot, Shown> spots_ = {};
    std::optional<Shown> first_ = {};
    bool isMixed_ = false;
};

}  // namespace

void checkCover(const Config& config, std::vector<Finding>& findings) {
    std::vector<Cover> covers;
    std::map<std::string_view, std::size_t> indices;
    std::vector<std::string_view> names;
    for (const Screen& screen : config.screens) {
        indices.emplace(screen.name, covers.size());
        covers.emplace_back(screen, findings);
        names.push_back(screen.name);
    }
    for (const Server& server : config.servers) {
        for (const Window& window : server.windows) {
            for (const Viewport& viewport : window.viewports) {
                const Shown shown{&server, &window, &viewport};
                const auto index = indices.find(viewport.screen);
                if (index != indices.end()) {
                    covers[index->second].add(shown);
                    continue;
                }
                findings.push_back({.place = viewport.origin.of("screen"),
                                    .what = fmt::format("{}: there is no screen {}{}", label(shown),
                                                        tomlText(viewport.screen),
                                                        suggestion(viewport.screen, names))});
            }
        }
    }
    for (Cover& cover : covers) cover.finish();
}

}  // namespace gnomon::config

#include "Grid.h"

#include <fmt/format.h>

#include <array>
#include <charconv>

#include "Text.h"

namespace gnomon::config {
namespace {

constexpr std::array<std::string_view, 7> words = {"screen", "column", "row", "tile",
                                                   "index",  "eye",    "eye1"};

// `word[+N|-N][:0N]`, the inside of one pair of braces
Result<std::string> filledInWord(std::string_view inside, const GridCell& cell) {
    const std::string_view word = inside.substr(0, inside.find_first_of("+-:"));
    std::string_view rest = inside.substr(word.size());
    int value = 0;
    if (word == "screen" && rest.empty()) return std::string{cell.screen};
    if (word == "eye" && rest.empty()) return std::string{config::name(cell.eye)};
    if (word == "eye1" && rest.empty()) return std::string{config::name(cell.eye).substr(0, 1)};
    if (word == "column") {
        value = cell.column;
    } else if (word == "row") {
        value = cell.row;
    } else if (word == "tile") {
        value = cell.tile;
    } else if (word == "index") {
        value = cell.index;
    } else {
        return fail(Errc::config, fmt::format("{{{}}}, must be one of {}{}", inside, oneOf(words),
                                              suggestion(word, words)));
    }

    const auto number = [&](int digits) -> std::optional<int> {
        int result = 0;
        const char* end = rest.data() + rest.size();
        const auto [stop, error] = std::from_chars(rest.data(), end, result);
        if (error != std::errc{} || result < 0 || stop - rest.data() > digits) return {};
        rest.remove_prefix(static_cast<std::size_t>(stop - rest.data()));
        return result;
    };
    bool good = true;
    int width = 0;
    if (!rest.empty() && rest.front() != ':') {
        const int sign = rest.front() == '-' ? -1 : 1;
        rest.remove_prefix(1);
        const auto offset = number(6);
        good = offset.has_value();
        value += sign * offset.value_or(0);
    }
    if (good && rest.substr(0, 2) == ":0") {
        rest.remove_prefix(2);
        const auto digits = number(1);
        good = digits.has_value();
        width = digits.value_or(0);
    }
    if (!good || !rest.empty()) {
        return fail(Errc::config,
                    fmt::format("{{{}}}, must be like {{{}}}, {{{}+1}} or {{{}+1:02}}", inside,
                                word, word, word));
    }
    return fmt::format("{:0{}}", value, width);
}

// The value for the i-th eye of a list that has one for all, or one an eye.
int forEye(const std::vector<int>& values, std::size_t eye) {
    return values.size() == 1 ? values.front() : values[eye];
}

class Expansion {
public:
    Expansion(const ServerGrid& grid, const Screen& screen, std::vector<Finding>& findings)
        : grid_{grid}, screen_{screen}, findings_{findings} {}

    // False if the grid cannot be expanded; says why.
    bool check() {
        const std::size_t before = findings_.size();
        if (grid_.eyes.empty()) complain("eyes", "eyes is an empty list, must name an eye");
        for (std::size_t i = 0; i < grid_.eyes.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                if (grid_.eyes[i] != grid_.eyes[j]) continue;
                complain("eyes", fmt::format("eyes is {}, must not name an eye twice",
                                             tomlText(grid_.eyes)));
            }
        }
        perEye("gpu", grid_.gpu);
        if (!grid_.port.empty() || grid_.origin.keys.contains("port")) perEye("port", grid_.port);
        pattern("name", grid_.name);
        pattern("host", grid_.host);
        return findings_.size() == before;
    }

    Server server(GridCell cell, std::size_t eye) const {
        Server server;
        server.name = *filledIn(grid_.name, cell);
        server.host = *filledIn(grid_.host, cell);
        server.port = grid_.port.empty() ? portOf(server.host) : forEye(grid_.port, eye);
        server.gpu = forEye(grid_.gpu, eye);
        server.origin = grid_.origin;
        Window window{.size = grid_.window,
                      .position = grid_.position,
                      .fullscreen = grid_.fullscreen,
                      .monitor = grid_.monitor};
        window.origin = grid_.origin;
        window.origin.keys["size"] = grid_.origin.of("window");
        Viewport viewport{.screen = grid_.screen, .tile = {cell.column, cell.row}, .eye = cell.eye};
        viewport.origin = grid_.origin;
        window.viewports.push_back(std::move(viewport));
        server.windows.push_back(std::move(window));
        return server;
    }

    void complain(std::string_view key, const std::string& what) {
        findings_.push_back(
            {.place = grid_.origin.of(key),
             .what = fmt::format("server_grid of screen {}: {}", tomlText(grid_.screen), what)});
    }

    std::size_t count() const {
        return grid_.eyes.size() * static_cast<std::size_t>(screen_.tiles[0] * screen_.tiles[1]);
    }

private:
    void perEye(std::string_view key, const std::vector<int>& values) {
        if (values.size() == 1 || (!values.empty() && values.size() == grid_.eyes.size())) return;
        complain(key, fmt::format("{} is {}, must be one number or one for each of the {} eyes",
                                  key, tomlText(values), grid_.eyes.size()));
    }

    void pattern(std::string_view key, std::string_view text) {
        const auto filled = filledIn(text, {.screen = grid_.screen});
        if (filled) return;
        complain(key, fmt::format("{} has {}", key, filled.error().what));
    }

    const ServerGrid& grid_;
    const Screen& screen_;
    std::vector<Finding>& findings_;
};

}  // namespace

Result<std::string> filledIn(std::string_view pattern, const GridCell& cell) {
    std::string result;
    while (!pattern.empty()) {
        const std::size_t open = pattern.find('{');
        result += pattern.substr(0, open);
        if (open == std::string_view::npos) break;
        const std::size_t close = pattern.find('}', open);
        if (close == std::string_view::npos) {
            return fail(Errc::config, "'{' without '}'");
        }
        auto word = filledInWord(pattern.substr(open + 1, close - open - 1), cell);
        if (!word) return word;
        result += *word;
        pattern.remove_prefix(close + 1);
    }
    return result;
}

void expand(const ServerGrid& grid, Config& config, std::vector<Finding>& findings) {
    const auto index = screenIndex(config, grid.screen);
    if (!index) {
        std::vector<std::string_view> screens;
        for (const Screen& screen : config.screens) screens.push_back(screen.name);
        findings.push_back(
            {.place = grid.origin.of("screen"),
             .what = fmt::format("server_grid: there is no screen {}{}", tomlText(grid.screen),
                                 suggestion(grid.screen, screens))});
        return;
    }
    const Screen& screen = config.screens[*index];
    Expansion expansion{grid, screen, findings};
    if (!expansion.check()) return;
    if (config.servers.size() + expansion.count() > maxServers) {
        expansion.complain("screen",
                           fmt::format("makes {} servers, a wall has at most {}",
                                       config.servers.size() + expansion.count(), maxServers));
        return;
    }
    GridCell cell{.screen = grid.screen};
    for (cell.row = 0; cell.row < screen.tiles[1]; ++cell.row) {
        for (cell.column = 0; cell.column < screen.tiles[0]; ++cell.column, ++cell.tile) {
            for (std::size_t eye = 0; eye < grid.eyes.size(); ++eye, ++cell.index) {
                cell.eye = grid.eyes[eye];
                config.servers.push_back(expansion.server(cell, eye));
            }
        }
    }
}

}  // namespace gnomon::config

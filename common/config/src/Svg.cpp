#include <fmt/format.h>
#include <gnomon/config/Layout.h>
#include <gnomon/config/Report.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "Room.h"
#include "Subject.h"

namespace gnomon::config {
namespace {

constexpr double margin = 24;  // units of the picture, as all below
constexpr double titleSize = 16;
constexpr double pageWidth = 1200;
constexpr double planSide = 260;

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '&':
                result += "&amp;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

// Neighbours in the list differ most: hues go round by the golden angle. As #rrggbb, since not
// every viewer knows hsl().
std::string hostColour(std::size_t index) {
    const double hue = std::fmod(static_cast<double>(index) * 137.50776405, 360.0) / 60;
    const auto channel = [&](double offset) {
        const double k = std::fmod(hue + offset, 6);
        const double ramp = std::clamp(std::min(k, 4 - k), 0.0, 1.0);
        return static_cast<int>(std::lround(255 * (0.93 - 0.32 * ramp)));
    };
    return fmt::format("#{:02x}{:02x}{:02x}", channel(5), channel(3), channel(1));
}

struct Box {
    double x = 0;
    double y = 0;
    double width = 0;
    double height = 0;
};

std::string rectangle(const Box& box, const std::string& fill, const char* stroke) {
    return fmt::format(
        "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\" "
        "stroke=\"{}\"/>\n",
        box.x, box.y, box.width, box.height, fill, stroke);
}

std::string words(double x, double y, double size, const char* anchor, std::string_view text) {
    return fmt::format(
        "<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.2f}\" text-anchor=\"{}\">{}</text>\n", x, y,
        size, anchor, escaped(text));
}

// Lines in the middle of a box, as large as fits.
std::string label(const Box& box, const std::vector<std::string>& lines) {
    std::size_t longest = 1;
    for (const std::string& line : lines) longest = std::max(longest, line.size());
    const double count = static_cast<double>(lines.size());
    // A letter of a sans-serif font is about 0.6 of its size wide.
    const double size = std::min({13.0, 0.95 * box.width / (0.6 * static_cast<double>(longest)),
                                  0.9 * box.height / (1.25 * count)});
    std::string text;
    double y = box.y + box.height / 2 - 1.25 * size * count / 2 + size;
    for (const std::string& line : lines) {
        text += words(box.x + box.width / 2, y, size, "middle", line);
        y += 1.25 * size;
    }
    return text;
}

class Drawing {
public:
    explicit Drawing(const Config& config) : config_{config} {
        for (const Server& server : config.servers) colours_.emplace(server.host, colours_.size());
        for (const Screen& screen : config.screens) {
            const auto [width, height] = extent(screen);
            metres_ += width;
            tallest_ = std::max(tallest_, height);
        }
    }

    std::string text() {
        const double count = static_cast<double>(config_.screens.size());
        const double room = pageWidth - margin * (count + 1);
        // Very many screens get a wider page rather than no room.
        scale_ = std::max(room, 40 * count) / std::max(metres_, 1e-6);
        double x = margin;
        const double top = margin + 2 * titleSize + 1.5 * titleSize;
        for (std::size_t i = 0; i < config_.screens.size(); ++i) {
            const auto [width, height] = extent(config_.screens[i]);
            const Box box{x, top, width * scale_, height * scale_};
            screen(i, box);
            x += box.width + margin;
        }
        const double below = top + tallest_ * scale_ + margin;
        plan({margin, below + 1.5 * titleSize, planSide, planSide});
        const double keyHeight = legend(2 * margin + planSide, below);
        const double height =
            std::max(below + 1.5 * titleSize + planSide, below + keyHeight) + margin;
        const double width = std::max(x, pageWidth);
        return fmt::format(
                   "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
                   "width=\"{0:.0f}\" height=\"{1:.0f}\" font-family=\"sans-serif\">\n",
                   width, height) +
               rectangle({0, 0, width, height}, "white", "none") +
               words(margin, margin + titleSize, 1.4 * titleSize, "start", config_.name) + body_ +
               "</svg>\n";
    }

private:
    void screen(std::size_t index, const Box& box) {
        const Screen& shown = config_.screens[index];
        const auto [width, height] = extent(shown);
        body_ += words(box.x, box.y - 6, 0.8 * titleSize, "start",
                       fmt::format("{}  {:.2f} x {:.2f} m", shown.name, width, height));
        body_ += rectangle(box, "#444444", "#444444");
        const auto grid = canvas(config_, index);
        if (!grid) return;
        for (int row = 0; row < shown.tiles[1]; ++row) {
            for (int column = 0; column < shown.tiles[0]; ++column) {
                const Share share = grid->share(column, row);
                tile(shown, {column, row},
                     {box.x + share.left * box.width, box.y + (1 - share.top) * box.height,
                      (share.right - share.left) * box.width,
                      (share.top - share.bottom) * box.height});
            }
        }
    }

    // A tile has a band for each server that shows it, left eye first.
    void tile(const Screen& shown, Cells at, const Box& box) {
        struct Band {
            Eye eye = Eye::mono;
            const Server* server = nullptr;
            int gpu = -1;
        };
        std::vector<Band> bands;
        for (const Server& server : config_.servers) {
            for (const Window& window : server.windows) {
                for (const Viewport& viewport : window.viewports) {
                    if (viewport.screen != shown.name || viewport.tile != at) continue;
                    bands.push_back({viewport.eye, &server, gpuOf(server, window)});
                }
            }
        }
        if (bands.empty()) {
            body_ += rectangle(box, "white", "#c00000");
            body_ += label(box, {"nobody"});
            return;
        }
        std::stable_sort(bands.begin(), bands.end(),
                         [](const Band& a, const Band& b) { return a.eye < b.eye; });
        const double width = box.width / static_cast<double>(bands.size());
        Box band{box.x, box.y, width, box.height};
        for (const Band& shownBy : bands) {
            const Server& server = *shownBy.server;
            body_ += rectangle(band, hostColour(colours_[server.host]), "#444444");
            std::vector<std::string> lines = {server.name, hostText(server)};
            if (shownBy.gpu >= 0) lines.push_back(fmt::format("gpu {}", shownBy.gpu));
            lines.push_back(fmt::format("{},{} {}", at[0], at[1], name(shownBy.eye)));
            body_ += label(band, lines);
            band.x += width;
        }
    }

    // The room from above, -z up the page: screens as outlines, the head as a dot.
    void plan(const Box& box) {
        const auto corners = [](const Screen& s) {
            const Point upperRight = plusScaled(s.upperLeft, minus(s.lowerRight, s.lowerLeft), 1);
            return std::array{s.lowerLeft, s.lowerRight, upperRight, s.upperLeft};
        };
        const Point& head = config_.user.head;
        std::array<double, 4> bounds = {head[0], head[2], head[0], head[2]};
        for (const Screen& screen : config_.screens) {
            for (const Point& corner : corners(screen)) {
                bounds[0] = std::min(bounds[0], corner[0]);
                bounds[1] = std::min(bounds[1], corner[2]);
                bounds[2] = std::max(bounds[2], corner[0]);
                bounds[3] = std::max(bounds[3], corner[2]);
            }
        }
        const double metres = std::max({bounds[2] - bounds[0], bounds[3] - bounds[1], 1e-6});
        const double scale = 0.9 * box.width / metres;
        const auto x = [&](const Point& p) {
            return box.x + box.width / 2 + (p[0] - (bounds[0] + bounds[2]) / 2) * scale;
        };
        const auto y = [&](const Point& p) {
            return box.y + box.height / 2 + (p[2] - (bounds[1] + bounds[3]) / 2) * scale;
        };
        body_ += words(box.x, box.y - 6, 0.8 * titleSize, "start",
                       fmt::format("from above, {:.2f} m across", metres / 0.9));
        body_ += rectangle(box, "#f7f7f7", "#bbbbbb");
        for (const Screen& screen : config_.screens) {
            std::string points;
            for (const Point& corner : corners(screen)) {
                points += fmt::format("{:.2f},{:.2f} ", x(corner), y(corner));
            }
            body_ += fmt::format(
                "<polygon points=\"{}\" fill=\"#8899aa\" fill-opacity=\"0.25\" stroke=\"#334455\" "
                "stroke-width=\"2\"/>\n",
                points);
            const Point middle =
                plusScaled(screen.lowerRight, minus(screen.upperLeft, screen.lowerRight), 0.5);
            // Beside the line, toward the head; a floor's below the head.
            const double dx = x(head) - x(middle);
            const double dy = y(head) - y(middle);
            const double distance = std::hypot(dx, dy);
            const bool isNear = distance < 20;
            body_ += words(x(middle) + (isNear ? 0 : 24 * dx / distance),
                           y(middle) + 4 + (isNear ? 20 : 14 * dy / distance), 0.7 * titleSize,
                           "middle", screen.name);
        }
        body_ += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"5\" fill=\"#c00000\"/>\n",
                             x(head), y(head));
        body_ += words(x(head) + 8, y(head) + 4, 0.7 * titleSize, "start", "head");
    }

    // Hosts and their colours, in columns; returns its height.
    double legend(double left, double top) {
        constexpr double lineHeight = 20;
        constexpr double columnWidth = 180;
        const int columns = std::max(1, static_cast<int>((pageWidth - left) / columnWidth));
        body_ += words(left, top + 1.5 * titleSize - 6, 0.8 * titleSize, "start", "hosts");
        std::vector<std::string_view> hosts(colours_.size());
        for (const auto& [host, index] : colours_) hosts[index] = host;
        int cell = 0;
        for (std::size_t i = 0; i < hosts.size(); ++i, ++cell) {
            const int row = cell / columns;
            const double x = left + columnWidth * (cell % columns);
            const double y = top + 1.5 * titleSize + lineHeight * row;
            body_ += rectangle({x, y, 14, 14}, hostColour(i), "#444444");
            body_ += words(x + 20, y + 12, 12, "start", hosts[i]);
        }
        const int rows = (cell + columns - 1) / columns;
        return 1.5 * titleSize + lineHeight * rows;
    }

    const Config& config_;
    std::map<std::string, std::size_t> colours_ = {};  // host -> number
    double metres_ = 0;                                // of all screens side by side
    double tallest_ = 0;
    double scale_ = 1;  // units per metre
    std::string body_ = {};
};

}  // namespace

std::string svg(const Config& config) { return Drawing{config}.text(); }

}  // namespace gnomon::config

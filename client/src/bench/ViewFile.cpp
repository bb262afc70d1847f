#include "ViewFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace gnomon::client {
namespace {

using Json = nlohmann::json;

constexpr std::array options{"eye", "center", "up", "fovy", "near", "far", "sun", "spot", "point"};

bool isList(const Json& value) {
    return value.is_array() && !value.empty() &&
           std::all_of(value.begin(), value.end(), [](const Json& n) { return n.is_number(); });
}

/// As it would stand on the command line; nothing where it cannot.
std::optional<std::string> word(const Json& value) {
    if (value.is_number()) return fmt::format("{}", value.get<double>());
    if (!isList(value)) return {};
    std::string text;
    for (const Json& number : value)
        text += fmt::format("{}{}", text.empty() ? "" : ",", number.get<double>());
    return text;
}

/// Adds `--key word` for each value. Errors say what was found.
Result<void> addWords(const std::string& key, const Json& value, std::vector<std::string>& words) {
    const bool light = key == "sun" || key == "spot" || key == "point";
    const bool several = light && value.is_array() && !value.empty() &&
                         std::all_of(value.begin(), value.end(), isList);
    for (const Json& one : several ? value : Json::array({value})) {
        const auto text = word(one);
        if (!text)
            return fail(Errc::file, fmt::format("\"{}\": found {}, expected numbers", key,
                                                value.dump().substr(0, 60)));
        words.push_back("--" + key);
        words.push_back(*text);
    }
    return {};
}

Result<BenchView> viewOf(const Json& object) {
    BenchView view{.name = {}};
    std::vector<std::string> words;
    for (const auto& [key, value] : object.items()) {
        if (key == "name" || key == "scene") {
            if (!value.is_string() || value.get<std::string>().empty())
                return fail(Errc::file, fmt::format("\"{}\": found {}, expected a text", key,
                                                    value.dump().substr(0, 60)));
            (key == "name" ? view.name : view.scene) = value.get<std::string>();
        } else if (std::find(options.begin(), options.end(), key) != options.end()) {
            if (auto added = addWords(key, value, words); !added)
                return tl::unexpected{added.error()};
        } else {
            return fail(Errc::file, fmt::format("unknown key \"{}\", expected name, scene, {}", key,
                                                fmt::join(options, ", ")));
        }
    }
    if (view.name.empty()) return fail(Errc::file, "\"name\" is missing");
    CLI::App command;
    addViewOptions(command, view.view);
    addLightOptions(command, view.lights);
    std::reverse(words.begin(), words.end());  // as CLI11 wants them
    try {
        command.parse(words);
        view.view.validate();
    } catch (const CLI::ParseError& error) {
        return fail(Errc::file, error.what());
    }
    return view;
}

}  // namespace

Result<std::vector<BenchView>> loadViews(const std::filesystem::path& file) {
    std::ifstream in{file, std::ios::binary};
    std::ostringstream text;
    if (!in || !(text << in.rdbuf()))
        return fail(Errc::file, fmt::format("{}: cannot be read", file.string()),
                    {errno, std::generic_category()});
    return parseViews(text.str(), file.string());
}

Result<std::vector<BenchView>> parseViews(std::string_view text, std::string_view filename) {
    std::vector<BenchView> views;
    for (int number = 1; !text.empty(); ++number) {
        const auto end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const auto start = line.find_first_not_of(" \t\r");
        if (start == std::string_view::npos || line[start] == '#') continue;
        const auto refuse = [&](const std::string& why) {
            return fail(Errc::file, fmt::format("{}:{}: {}", filename, number, why));
        };
        const Json object = Json::parse(line, nullptr, false);
        if (!object.is_object()) return refuse("expected a JSON object that describes a view");
        auto view = viewOf(object);
        if (!view) return refuse(view.error().what);
        if (std::any_of(views.begin(), views.end(), [&](const BenchView& other) {
                return other.name == view->name && other.scene == view->scene;
            }))
            return refuse(fmt::format("a view called \"{}\" was there before", view->name));
        views.push_back(*std::move(view));
    }
    if (views.empty()) return fail(Errc::file, fmt::format("{}: no line with a view", filename));
    return views;
}

}  // namespace gnomon::client

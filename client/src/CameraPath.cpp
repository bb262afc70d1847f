#include <fmt/format.h>
#include <gnomon/client/CameraPath.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace gnomon::client {
namespace {

using Json = nlohmann::json;

/// One line of the file, and how to name it in an error.
struct Line {
    Json object = {};
    std::string place = {};
};

Result<math::dvec3> vector(const Line& line, const char* key, const math::dvec3* fallback) {
    const auto found = line.object.find(key);
    if (found == line.object.end() && fallback != nullptr) return *fallback;
    const auto wrong = [&](const std::string& what) {
        return fail(Errc::file, fmt::format("{}: \"{}\" is {}, must be three finite numbers",
                                            line.place, key, what));
    };
    if (found == line.object.end()) return wrong("missing");
    if (!found->is_array() || found->size() != 3) return wrong(found->dump().substr(0, 60));
    math::dvec3 value{0.0};
    for (int i = 0; i < 3; ++i) {
        const Json& number = (*found)[static_cast<std::size_t>(i)];
        if (!number.is_number() || !std::isfinite(number.get<double>()))
            return wrong(found->dump().substr(0, 60));
        value[i] = number.get<double>();
    }
    return value;
}

}  // namespace

Result<CameraPath> CameraPath::load(const std::filesystem::path& file) {
    std::ifstream in{file, std::ios::binary};
    if (!in)
        return fail(Errc::file, fmt::format("{}: cannot be read", file.string()),
                    {errno, std::generic_category()});
    std::ostringstream text;
    text << in.rdbuf();
    return parse(text.str(), file.string());
}

Result<CameraPath> CameraPath::parse(std::string_view text, std::string_view filename) {
    CameraPath path;
    for (int number = 1; !text.empty(); ++number) {
        const auto end = std::min(text.find('\n'), text.size());
        const std::string_view raw = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (raw.find_first_not_of(" \t\r") == std::string_view::npos) continue;
        Line line{.object = Json::parse(raw, nullptr, false),
                  .place = fmt::format("{}:{}", filename, number)};
        if (line.object.is_discarded() || !line.object.is_object())
            return fail(Errc::file,
                        fmt::format("{}: expected a JSON object with time, eye, center and up",
                                    line.place));
        const auto time = line.object.find("time");
        if (time == line.object.end() || !time->is_number() || !std::isfinite(time->get<double>()))
            return fail(Errc::file,
                        fmt::format("{}: \"time\" must be a number of seconds", line.place));
        const math::dvec3 y{0.0, 1.0, 0.0};
        const auto eye = vector(line, "eye", nullptr);
        const auto center = vector(line, "center", nullptr);
        const auto up = vector(line, "up", &y);
        for (const auto* part : {&eye, &center, &up})
            if (!*part) return tl::unexpected{part->error()};
        if (*eye == *center)
            return fail(Errc::file,
                        fmt::format("{}: \"eye\" and \"center\" are the same point", line.place));
        const Key key{.time = time->get<double>(),
                      .look = {.eye = *eye, .center = *center, .up = *up}};
        if (!path.keys_.empty() && key.time <= path.keys_.back().time)
            return fail(Errc::file, fmt::format("{}: time {} does not come after {}", line.place,
                                                key.time, path.keys_.back().time));
        path.keys_.push_back(key);
    }
    if (path.keys_.empty())
        return fail(Errc::file, fmt::format("{}: no line with a camera in it", filename));
    return path;
}

Look CameraPath::at(double time) const noexcept {
    const auto after = std::upper_bound(keys_.begin(), keys_.end(), time,
                                        [](double t, const Key& key) { return t < key.time; });
    if (after == keys_.begin()) return keys_.front().look;
    if (after == keys_.end()) return keys_.back().look;
    const Key& from = *(after - 1);
    const double share = (time - from.time) / (after->time - from.time);
    Look look;
    look.eye = glm::mix(from.look.eye, after->look.eye, share);
    look.center = glm::mix(from.look.center, after->look.center, share);
    look.up = glm::mix(from.look.up, after->look.up, share);
    return look;
}

}  // namespace gnomon::client

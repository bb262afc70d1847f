#include "gltf/Json.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "input/Report.h"

namespace gnomon::importer {

using nlohmann::json;

namespace {

constexpr double largestWhole = 9007199254740992.0;  // 2^53: beyond it doubles skip whole numbers

void checkNesting(std::string_view text) {
    std::size_t depth = 0;
    bool inString = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (inString) {
            if (c == '\\')
                ++i;
            else if (c == '"')
                inString = false;
        } else if (c == '"') {
            inString = true;
        } else if (c == '{' || c == '[') {
            if (++depth > maxJsonDepth)
                refuse(
                    fmt::format("JSON: nested deeper than {} levels at byte {}", maxJsonDepth, i));
        } else if ((c == '}' || c == ']') && depth > 0) {
            --depth;
        }
    }
}

std::optional<std::uint64_t> whole(const json& value) {
    if (value.is_number_unsigned() && value.get<std::uint64_t>() <= std::uint64_t{1} << 53U)
        return value.get<std::uint64_t>();
    if (!value.is_number_float()) return {};
    const double number = value.get<double>();  // some writers put 5.0
    if (!(number >= 0.0 && number <= largestWhole) || number != std::floor(number)) return {};
    return static_cast<std::uint64_t>(number);
}

std::string shown(const json& value) {
    if (value.is_structured()) return value.is_array() ? "an array" : "an object";
    return printable(value.dump(-1, ' ', true, json::error_handler_t::replace), 60);
}

}  // namespace

json parsedJson(std::string_view text) {
    constexpr std::string_view byteOrderMark = "\xef\xbb\xbf";
    if (text.substr(0, 3) == byteOrderMark) text.remove_prefix(3);
    checkNesting(text);
    json parsed;
    try {
        parsed = json::parse(text.begin(), text.end());
    } catch (const json::exception& error) {
        std::string_view why = error.what();
        // "[json.exception.parse_error.101] parse error at ...": without the class in front.
        if (const auto end = why.find("] "); end != std::string_view::npos)
            why.remove_prefix(end + 2);
        refuse(fmt::format("JSON: {}", printable(why, 200)));
    }
    if (!parsed.is_object()) refuse("JSON: found " + shown(parsed) + ", expected an object");
    return parsed;
}

void JsonView::refuse(const std::string& what) const {
    importer::refuse(where_.empty() ? what : where_ + ": " + what);
}

const json* JsonView::find(const char* key) const {
    if (!json_->is_object()) return nullptr;
    const auto found = json_->find(key);
    return found == json_->end() ? nullptr : &*found;
}

void JsonView::wrong(const char* key, const json& found, const char* wanted) const {
    refuse(fmt::format("{} is {}, expected {}", key, shown(found), wanted));
}

bool JsonView::has(const char* key) const { return find(key) != nullptr; }

std::optional<JsonView> JsonView::object(const char* key) const {
    const json* found = find(key);
    if (found == nullptr) return {};
    if (!found->is_object()) wrong(key, *found, "an object");
    return JsonView{*found, where_.empty() ? key : where_ + ": " + key};
}

std::optional<JsonView> JsonView::extension(const char* name) const {
    const auto extensions = object("extensions");
    if (!extensions) return {};
    auto found = extensions->object(name);
    if (found) found->where_ = where_.empty() ? name : where_ + ": " + name;
    return found;
}

std::vector<JsonView> JsonView::objects(const char* key, const char* name) const {
    std::vector<JsonView> items;
    const json* found = find(key);
    if (found == nullptr) return items;
    if (!found->is_array()) wrong(key, *found, "an array");
    items.reserve(found->size());
    std::size_t i = 0;
    for (const json& item : *found) {
        std::string label = name != nullptr ? fmt::format("{} {}", name, i)
                                            : fmt::format("{}: {} {}", where_, key, i);
        ++i;
        if (!item.is_object())
            importer::refuse(fmt::format("{} is {}, expected an object", label, shown(item)));
        items.emplace_back(item, std::move(label));
    }
    return items;
}

std::size_t JsonView::arraySize(const char* key) const {
    const json* found = find(key);
    return found != nullptr && found->is_array() ? found->size() : 0;
}

std::optional<std::uint64_t> JsonView::unsignedInteger(const char* key) const {
    const json* found = find(key);
    if (found == nullptr) return {};
    const auto value = whole(*found);
    if (!value) wrong(key, *found, "a whole number >= 0");
    return value;
}

std::optional<std::size_t> JsonView::index(const char* key, std::size_t count,
                                           const char* things) const {
    const auto value = unsignedInteger(key);
    if (value && *value >= count)
        refuse(fmt::format("{} is {}, but there are {} {}", key, *value, count, things));
    return value;
}

std::vector<std::size_t> JsonView::indices(const char* key, std::size_t count,
                                           const char* things) const {
    std::vector<std::size_t> out;
    const json* found = find(key);
    if (found == nullptr) return out;
    if (!found->is_array()) wrong(key, *found, "an array");
    for (const json& item : *found) {
        const auto value = whole(item);
        if (!value) wrong(key, item, "whole numbers >= 0");
        if (*value >= count)
            refuse(fmt::format("{} names {}, but there are {} {}", key, *value, count, things));
        out.push_back(*value);
    }
    return out;
}

std::optional<double> JsonView::number(const char* key) const {
    const json* found = find(key);
    if (found == nullptr) return {};
    if (!found->is_number()) wrong(key, *found, "a number");
    return found->get<double>();
}

bool JsonView::numbers(const char* key, std::span<double> to) const {
    const json* found = find(key);
    if (found == nullptr) return false;
    const auto wanted = fmt::format("an array of {} numbers", to.size());
    if (!found->is_array() || found->size() != to.size()) wrong(key, *found, wanted.c_str());
    for (std::size_t i = 0; i < to.size(); ++i) {
        const json& item = (*found)[i];
        if (!item.is_number()) wrong(key, item, wanted.c_str());
        to[i] = item.get<double>();
    }
    return true;
}

std::optional<std::string> JsonView::string(const char* key) const {
    const json* found = find(key);
    if (found == nullptr) return {};
    if (!found->is_string()) wrong(key, *found, "a string");
    return found->get<std::string>();
}

std::string JsonView::string(const char* key, std::string_view otherwise) const {
    auto value = string(key);
    return value ? *std::move(value) : std::string{otherwise};
}

std::vector<std::string> JsonView::strings(const char* key) const {
    std::vector<std::string> out;
    const json* found = find(key);
    if (found == nullptr) return out;
    if (!found->is_array()) wrong(key, *found, "an array of strings");
    for (const json& item : *found) {
        if (!item.is_string()) wrong(key, item, "strings");
        out.push_back(item.get<std::string>());
    }
    return out;
}

bool JsonView::boolean(const char* key, bool otherwise) const {
    const json* found = find(key);
    if (found == nullptr) return otherwise;
    if (!found->is_boolean()) wrong(key, *found, "true or false");
    return found->get<bool>();
}

std::vector<std::string> JsonView::keys() const {
    std::vector<std::string> out;
    if (json_->is_object())
        for (const auto& item : json_->items()) out.push_back(item.key());
    return out;
}

}  // namespace gnomon::importer

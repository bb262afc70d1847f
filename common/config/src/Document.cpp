#include "Document.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "Precheck.h"
#include "Text.h"

// The library is compiled here and nowhere else. It recurses once for each nested value.
// Version 3.3 takes for granted that a table header starts with a key ("[=]" does not), as an
// assertion or, with NDEBUG and clang, as a promise to the optimizer, though it handles the case:
// switch off both.
#undef NDEBUG
#define TOML_ASSERT(expr) static_assert(true)
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#define TOML_MAX_NESTED_VALUES 32
#include <toml++/toml.h>

namespace gnomon::config {
namespace {

Place placeAt(const toml::source_position& position, std::string_view filename) {
    return {.file = std::string{filename},
            .line = static_cast<int>(position.line),
            .column = static_cast<int>(position.column)};
}

// As deep as the parser allows: 32 values, each under a key of 16 parts.
Node converted(  // NOLINT(misc-no-recursion)
    const toml::node& from, std::string_view filename) {
    Node node;
    node.place = placeAt(from.source().begin, filename);
    if (const auto* table = from.as_table()) {
        node.kind = Node::Kind::table;
        for (auto&& [key, value] : *table) {
            Node item = converted(value, filename);
            item.key = key.str();
            item.keyPlace = placeAt(key.source().begin, filename);
            node.items.push_back(std::move(item));
        }
        // The library sorts by name.
        std::sort(node.items.begin(), node.items.end(), [](const Node& a, const Node& b) {
            return std::tie(a.keyPlace.line, a.keyPlace.column) <
                   std::tie(b.keyPlace.line, b.keyPlace.column);
        });
    } else if (const auto* array = from.as_array()) {
        node.kind = Node::Kind::list;
        for (const toml::node& value : *array) node.items.push_back(converted(value, filename));
    } else if (const auto* text = from.as_string()) {
        node.kind = Node::Kind::text;
        node.text = text->get();
    } else if (const auto* integer = from.as_integer()) {
        node.kind = Node::Kind::integer;
        node.integer = integer->get();
        node.number = static_cast<double>(node.integer);
    } else if (const auto* number = from.as_floating_point()) {
        node.kind = Node::Kind::number;
        node.number = number->get();
    } else if (const auto* boolean = from.as_boolean()) {
        node.kind = Node::Kind::boolean;
        node.boolean = boolean->get();
    } else {
        node.kind = Node::Kind::date;
    }
    return node;
}

}  // namespace

const Node* Node::find(std::string_view name) const {
    const auto is = [&](const Node& item) { return item.key == name; };
    const auto it = std::find_if(items.begin(), items.end(), is);
    return it == items.end() ? nullptr : &*it;
}

std::string found(const Node& node) {
    switch (node.kind) {
        case Node::Kind::boolean:
            return tomlText(node.boolean);
        case Node::Kind::integer:
            return std::to_string(node.integer);
        case Node::Kind::number:
            return tomlText(node.number);
        case Node::Kind::text: {
            if (node.text.size() <= 60) return tomlText(node.text);
            std::size_t end = 57;  // not inside a character of several bytes
            while ((static_cast<unsigned char>(node.text[end]) & 0xc0U) == 0x80U) --end;
            return tomlText(node.text.substr(0, end) + "...");
        }
        case Node::Kind::list:
            return fmt::format("a list of {} value{}", node.items.size(),
                               node.items.size() == 1 ? "" : "s");
        case Node::Kind::table:
            return "a table";
        case Node::Kind::date:
            break;
    }
    return "a date or time";
}

std::optional<Node> parseToml(std::string_view text, std::string_view filename,
                              std::vector<Finding>& findings) {
    if (auto refused = precheck(text, filename)) {
        findings.push_back(*std::move(refused));
        return {};
    }
    const toml::parse_result result = toml::parse(text, filename);
    if (result) return converted(result.table(), filename);

    const toml::parse_error& error = result.error();
    std::string what{error.description()};
    // "Error while parsing value: ..." says no more than the position does.
    if (const auto end = what.find(": "); what.starts_with("Error while ") && end != what.npos) {
        what.erase(0, end + 2);
    }
    std::replace_if(
        what.begin(), what.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
    findings.push_back(
        {.place = placeAt(error.source().begin, filename), .what = "not TOML: " + what});
    return {};
}

}  // namespace gnomon::config

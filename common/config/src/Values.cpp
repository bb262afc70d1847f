#include "Values.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "Text.h"

namespace gnomon::config {
namespace {

template <class Enum, std::size_t n>
std::string readWord(const Node& node, const std::array<Enum, n>& values, Enum& value) {
    std::array<std::string_view, n> words = {};
    for (std::size_t i = 0; i < n; ++i) words[i] = name(values[i]);
    if (node.kind == Node::Kind::text) {
        for (std::size_t i = 0; i < n; ++i) {
            if (node.text != words[i]) continue;
            value = values[i];
            return {};
        }
    }
    return oneOf(words) + (node.kind == Node::Kind::text ? suggestion(node.text, words) : "");
}

}  // namespace

std::string read(const Node& node, bool& value) {
    if (node.kind != Node::Kind::boolean) return "true or false";
    value = node.boolean;
    return {};
}

std::string read(const Node& node, int& value) {
    using Limits = std::numeric_limits<int>;
    if (node.kind != Node::Kind::integer) return "a whole number";
    if (node.integer < Limits::min() || node.integer > Limits::max()) {
        return fmt::format("a whole number from {} to {}", Limits::min(), Limits::max());
    }
    value = static_cast<int>(node.integer);
    return {};
}

std::string read(const Node& node, double& value) {
    if (node.kind != Node::Kind::integer && node.kind != Node::Kind::number) return "a number";
    if (!std::isfinite(node.number)) return "a finite number";
    value = node.number;
    return {};
}

std::string read(const Node& node, std::string& value) {
    if (node.kind != Node::Kind::text) return "a text in quotes";
    value = node.text;
    return {};
}

std::string read(const Node& node, Eye& value) {
    return readWord(node, std::array{Eye::left, Eye::right, Eye::mono}, value);
}

std::string read(const Node& node, DepthRange& value) {
    return readWord(node, std::array{DepthRange::off, DepthRange::previous, DepthRange::exact},
                    value);
}

std::string read(const Node& node, Compress& value) {
    return readWord(node, std::array{Compress::automatic, Compress::never, Compress::always},
                    value);
}

std::string read(const Node& node, Launch& value) {
    return readWord(node, std::array{Launch::none, Launch::ssh, Launch::slurm, Launch::mpi}, value);
}

std::string read(const Node& node, OnTimeout& value) {
    return readWord(node, std::array{OnTimeout::drop, OnTimeout::wait}, value);
}

std::string read(const Node& node, std::array<Colour, 2>& value) {
    if (node.kind == Node::Kind::list && node.items.size() == 2 &&
        read(node.items[0], value[0]).empty() && read(node.items[1], value[1]).empty()) {
        return {};
    }
    if (!read(node, value[0]).empty()) {
        return "[red, green, blue] or [[red, green, blue] at the top, [...] at the bottom]";
    }
    value[1] = value[0];
    return {};
}

std::string read(const Node& node, std::vector<int>& value) {
    std::string wrong = "a whole number or a list of them";
    const bool isList = node.kind == Node::Kind::list;
    std::vector<int> numbers(isList ? node.items.size() : 1);
    if (!isList && !read(node, numbers.front()).empty()) return wrong;
    for (std::size_t i = 0; isList && i < numbers.size(); ++i) {
        if (!read(node.items[i], numbers[i]).empty()) return wrong;
    }
    value = std::move(numbers);
    return {};
}

std::string read(const Node& node, std::vector<Eye>& value) {
    std::string wrong = "a list of \"left\", \"right\" or \"mono\"";
    if (node.kind != Node::Kind::list) return wrong;
    std::vector<Eye> eyes(node.items.size());
    for (std::size_t i = 0; i < eyes.size(); ++i) {
        if (!read(node.items[i], eyes[i]).empty()) return wrong;
    }
    value = std::move(eyes);
    return {};
}

std::string read(const Node& node, std::vector<std::string>& value) {
    std::string wrong = "a list of texts in quotes";
    if (node.kind != Node::Kind::list) return wrong;
    std::vector<std::string> texts(node.items.size());
    for (std::size_t i = 0; i < texts.size(); ++i) {
        if (!read(node.items[i], texts[i]).empty()) return wrong;
    }
    value = std::move(texts);
    return {};
}

std::string listExpectation(std::size_t count, const char* elements) {
    return fmt::format("a list of {} {}", count, elements);
}

}  // namespace gnomon::config

#pragma once

#include <gnomon/config/Config.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "Document.h"

/// From a node to a value. Each returns what the node must be instead, or nothing if it was read.
namespace gnomon::config {

std::string read(const Node& node, bool& value);
std::string read(const Node& node, int& value);
std::string read(const Node& node, double& value);
std::string read(const Node& node, std::string& value);
std::string read(const Node& node, Eye& value);
std::string read(const Node& node, OnTimeout& value);
std::string read(const Node& node, DepthRange& value);
std::string read(const Node& node, Launch& value);
std::string read(const Node& node, Compress& value);
/// Two colours, top and bottom, or one for both.
std::string read(const Node& node, std::array<Colour, 2>& value);
/// One number or a list.
std::string read(const Node& node, std::vector<int>& value);
std::string read(const Node& node, std::vector<Eye>& value);
std::string read(const Node& node, std::vector<std::string>& value);

/// @p elements: "whole numbers"
std::string listExpectation(std::size_t count, const char* elements);

template <std::size_t n>
std::string read(const Node& node, std::array<int, n>& value) {
    std::string wrong = listExpectation(n, "whole numbers");
    if (node.kind != Node::Kind::list || node.items.size() != n) return wrong;
    for (std::size_t i = 0; i < n; ++i) {
        if (!read(node.items[i], value[i]).empty()) return wrong;
    }
    return {};
}

template <std::size_t n>
std::string read(const Node& node, std::array<double, n>& value) {
    std::string wrong = listExpectation(n, "numbers");
    if (node.kind != Node::Kind::list || node.items.size() != n) return wrong;
    for (std::size_t i = 0; i < n; ++i) {
        if (!read(node.items[i], value[i]).empty()) return wrong;
    }
    return {};
}

template <class T>
std::string read(const Node& node, std::optional<T>& value) {
    return read(node, value.emplace());
}

}  // namespace gnomon::config

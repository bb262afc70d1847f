#include "gltf/Graph.h"

#include <fmt/format.h>

#include <numeric>

namespace gnomon::importer {
namespace {

constexpr std::size_t none = GltfGraph::none;

struct Tree {
    std::vector<std::vector<std::size_t>> children = {};
    std::vector<std::size_t> parent = {};
};

Tree readTree(const GltfDocument& document) {
    const auto& nodes = document.nodes();
    Tree tree{.children = std::vector<std::vector<std::size_t>>(nodes.size()),
              .parent = std::vector<std::size_t>(nodes.size(), none)};
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        tree.children[i] = nodes[i].indices("children", nodes.size(), "nodes");
        for (const auto child : tree.children[i]) {
            if (child == i) nodes[i].refuse("is its own child");
            if (tree.parent[child] == i)
                nodes[child].refuse(fmt::format("is a child of node {} twice", i));
            if (tree.parent[child] != none)
                nodes[child].refuse(
                    fmt::format("has two parents, node {} and node {}", tree.parent[child], i));
            tree.parent[child] = i;
        }
    }
    return tree;
}

/// With one parent a node, what cannot be reached from a root is on a cycle or below one.
void refuseCycles(const Tree& tree) {
    std::vector<bool> reached(tree.parent.size());
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < tree.parent.size(); ++i)
        if (tree.parent[i] == none) open.push_back(i);
    while (!open.empty()) {
        const auto node = open.back();
        open.pop_back();
        reached[node] = true;
        open.insert(open.end(), tree.children[node].begin(), tree.children[node].end());
    }
    for (std::size_t i = 0; i < reached.size(); ++i)
        if (!reached[i]) refuse(fmt::format("node {}: is on or below a cycle of nodes", i));
}

std::vector<std::size_t> sceneRoots(const GltfDocument& document, const Tree& tree,
                                    Report& report) {
    const auto scenes = document.root().objects("scenes", "scene");
    std::vector<std::size_t> roots;
    if (scenes.empty()) {
        for (std::size_t i = 0; i < tree.parent.size(); ++i)
            if (tree.parent[i] == none) roots.push_back(i);
        return roots;
    }
    const auto number = document.root().index("scene", scenes.size(), "scenes").value_or(0);
    std::vector<bool> listed(tree.parent.size());
    const auto wanted = scenes[number].indices("nodes", tree.parent.size(), "nodes");
    for (const auto node : wanted) {
        if (tree.parent[node] != none)
            report.warn(fmt::format("{}: lists node {}, which has a parent; drawn only below it",
                                    scenes[number].where(), node));
        else if (!listed[node])
            roots.push_back(node);
        listed[node] = true;
    }
    return roots;
}

}  // namespace

GltfGraph gltfGraph(const GltfDocument& document, Report& report) {
    Tree tree = readTree(document);
    refuseCycles(tree);
    GltfGraph graph;
    graph.order = sceneRoots(document, tree, report);
    std::vector<std::size_t> depth(tree.parent.size(), 1);
    // Grows while it is walked: breadth first.
    for (std::size_t i = 0; i < graph.order.size(); ++i) {
        const auto node = graph.order[i];
        if (tree.parent[node] != none) depth[node] = depth[tree.parent[node]] + 1;
        graph.depth = std::max(graph.depth, depth[node]);
        if (depth[node] > maxNodeDepth)
            refuse(fmt::format("node {}: lies deeper than {} levels", node, maxNodeDepth));
        graph.order.insert(graph.order.end(), tree.children[node].begin(),
                           tree.children[node].end());
    }
    graph.parent = std::move(tree.parent);
    return graph;
}

}  // namespace gnomon::importer

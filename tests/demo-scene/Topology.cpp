#include "Topology.h"

#include <array>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <utility>

namespace gnomon::demo {
namespace {

using Key = std::array<float, 3>;

std::size_t rootOf(std::vector<std::size_t>& parents, std::size_t i) {
    while (parents[i] != i) i = parents[i] = parents[parents[i]];
    return i;
}

}  // namespace

Topology examined(const Mesh& mesh) {
    Topology result;
    std::map<Key, std::size_t> places;
    std::vector<std::size_t> corners;
    for (const std::uint32_t index : mesh.indices) {
        const glm::vec3& p = mesh.vertices[index].position;
        corners.push_back(places.try_emplace(Key{p.x, p.y, p.z}, places.size()).first->second);
    }
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> edges;
    std::vector<std::size_t> parents(places.size());
    std::iota(parents.begin(), parents.end(), std::size_t{0});
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t from = corners[i + k];
            const std::size_t to = corners[i + (k + 1) % 3];
            ++edges[{from, to}];
            parents[rootOf(parents, from)] = rootOf(parents, to);
        }
        const Vertex& a = mesh.vertices[mesh.indices[i]];
        const Vertex& b = mesh.vertices[mesh.indices[i + 1]];
        const Vertex& c = mesh.vertices[mesh.indices[i + 2]];
        const glm::vec3 area = glm::cross(b.position - a.position, c.position - a.position);
        if (glm::length(area) == 0.0F) ++result.flatTriangles;
        for (const Vertex* v : {&a, &b, &c}) {
            if (!(glm::dot(area, v->normal) > 0.0F)) ++result.contraryNormals;
        }
    }
    for (const auto& [edge, count] : edges) {
        const auto partner = edges.find({edge.second, edge.first});
        if (count != 1 || partner == edges.end()) ++result.unmatchedEdges;
    }
    std::map<std::size_t, double> volumes;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
        const glm::dvec3 a{mesh.vertices[mesh.indices[i]].position};
        const glm::dvec3 b{mesh.vertices[mesh.indices[i + 1]].position};
        const glm::dvec3 c{mesh.vertices[mesh.indices[i + 2]].position};
        volumes[rootOf(parents, corners[i])] += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    for (const auto& [root, volume] : volumes) result.volumes.push_back(volume);
    return result;
}

}  // namespace gnomon::demo

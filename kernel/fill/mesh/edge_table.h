// The edges of a tetrahedral mesh, each with a number.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/core/types.h"

namespace kerf {

/// The edges of a tetrahedron in the order of the nodes of a quadratic one, as VTK has them.
inline constexpr std::array<std::array<int, 2>, 6> tet_edges = {{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
/// The edges of a triangle, in the same way.
inline constexpr std::array<std::array<int, 2>, 3> triangle_edges = {{{0, 1}, {1, 2}, {0, 2}}};

/// All edges, ascending by their ends. While it is made, it takes 4 bytes for each edge of each tetrahedron; O(n) for
/// bounded vertex degrees.
class EdgeTable {
 public:
    EdgeTable() = default;
    EdgeTable(const std::vector<Tetrahedron>& tets, std::size_t vertex_count)
        : EdgeTable(tets, vertex_count, tet_edges) {}
    /// Makes the table of the edges of triangles.
    EdgeTable(const std::vector<Triangle>& triangles, std::size_t vertex_count)
        : EdgeTable(triangles, vertex_count, triangle_edges) {}

    std::size_t size() const { return upper_.size(); }
    /// Returns the number of an edge, which must be one of the table.
    std::int32_t find(const UndirectedEdge& edge) const {
        const std::int32_t v = edge[0];
        const auto begin = upper_.begin() + first_[v], end = upper_.begin() + first_[v + 1];
        return std::lower_bound(begin, end, edge[1]) - upper_.begin();
    }
    /// Returns whether the table has an edge, given by two vertices of the mesh.
    bool contains(const UndirectedEdge& edge) const {
        const std::int32_t v = edge[0];
        return std::binary_search(upper_.begin() + first_[v], upper_.begin() + first_[v + 1], edge[1]);
    }
    /// Calls visit(number, edge) for all edges in their order.
    template <class Visit>
    void for_all(Visit visit) const {
        for (std::int32_t v = 0; v + 1 < std::ssize(first_); ++v)
            for (std::int64_t e = first_[v]; e < first_[v + 1]; ++e) visit(e, UndirectedEdge{v, upper_[e]});
    }

 private:
    template <class Cell, class Edges>
    EdgeTable(const std::vector<Cell>& cells, std::size_t vertex_count, const Edges& edges) : first_(vertex_count + 1) {
        const auto for_edges = [&](auto visit) {
            for (const Cell& cell : cells)
                for (const auto& [i, j] : edges) visit(undirected(cell[i], cell[j]));
        };
        for_edges([&](const UndirectedEdge& edge) { ++first_[edge[0] + 1]; });
        for (std::size_t v = 0; v < vertex_count; ++v) first_[v + 1] += first_[v];
        std::vector<std::int64_t> next(first_.begin(), first_.end() - 1);
        upper_.resize(first_.back());
        for_edges([&](const UndirectedEdge& edge) { upper_[next[edge[0]]++] = edge[1]; });
        keep_each_once();
    }
    void keep_each_once() {
        std::int64_t kept = 0;
        for (std::size_t v = 0; v + 1 < first_.size(); ++v) {
            const auto begin = upper_.begin() + first_[v], end = upper_.begin() + first_[v + 1];
            std::sort(begin, end);
            const auto last = std::unique(begin, end);
            first_[v] = kept;
            for (auto it = begin; it != last; ++it) upper_[kept++] = *it;
        }
        first_.back() = kept;
        upper_.resize(kept);
        upper_.shrink_to_fit();
    }

    std::vector<std::int64_t> first_ = {0};  // number of each vertex's first edge to a larger vertex
    std::vector<std::int32_t> upper_;
};

}  // namespace kerf

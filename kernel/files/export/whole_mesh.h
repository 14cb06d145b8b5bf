// Walks over all parts as one mesh, without ever holding more than one of them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "files/part/part.h"

namespace kerf {

// Memory, whatever the size of the mesh: 48 MB of points and 6 bytes a tetrahedron of the largest part in
// for_each_node(), 18 bytes a tetrahedron in for_each_part() for cells, 48 MB in for_each_patch_triangle(); so parts
// of 2.5e6 tetrahedra are merged below 100 MB beside what the PartSource holds. Of order 2 a part takes what its nodes
// on edges take, too.

/// The number of nodes that cells of an order have.
constexpr int nodes_of_tets(int order) { return order == 1 ? 4 : 10; }
constexpr int nodes_of_triangles(int order) { return order == 1 ? 3 : 6; }

/// The nodes of a cell by global numbers: its corners, then of order 2 those on its edges, in VTK's order
/// (fill/mesh/edge_table.h).
class CellNodes {
 public:
    template <std::size_t n>
    explicit CellNodes(const std::array<std::int64_t, n>& ids) : size_(n) {
        static_assert(n <= most);
        std::copy(ids.begin(), ids.end(), ids_.begin());
    }
    /// Returns the nodes in another order: `order` has the places of the nodes here that come first, second ...
    CellNodes in_order(const std::array<std::int8_t, 10>& order) const {
        CellNodes nodes = *this;
        for (std::size_t i = 0; i < size_; ++i) nodes.ids_[i] = ids_[order[i]];
        return nodes;
    }
    const std::int64_t* begin() const { return ids_.data(); }
    const std::int64_t* end() const { return ids_.data() + size_; }
    std::size_t size() const { return size_; }
    std::int64_t operator[](std::size_t i) const { return ids_[i]; }

 private:
    static constexpr std::size_t most = 10;

    std::array<std::int64_t, most> ids_;
    std::size_t size_;
};

/// Return the nodes of a tetrahedron of a part, and of a boundary triangle; for triangles patch_content() is enough.
CellNodes nodes_of_tet(const Part& part, std::int64_t t);
CellNodes nodes_of_facet(const Part& part, std::int64_t f);

/// Calls take(f) with the boundary triangles that files list (Part::is_listed()).
template <class Take>
void for_each_listed_facet(const Part& part, const Take& take) {
    for (std::size_t f = 0; f < part.facets.size(); ++f)
        if (part.is_listed(f)) take(f);
}

/// Returns the content that must be loaded of parts for the nodes of their boundary triangles.
PartContent patch_content(const MeshOutline& outline);

/// Calls visit(parts, nodes) for each group of nodes that the same parts hold. The part must have everything.
template <class Visit>
void for_each_shared_group(const Part& part, const Visit& visit) {
    for (const SharedGroup& group : part.shared) visit(group.parts, group.vertices);
    if (part.order() == 1) return;
    for (const SharedEdgeGroup& group : part.shared_edges) {
        std::vector<std::int32_t> nodes;
        for (const auto& [a, b] : group.edges)
            nodes.push_back(part.vertex_count() + part.edge_nodes.edges.find(undirected(a, b)));
        visit(group.parts, nodes);
    }
}

/// Tells for each node of a part whether the part owns it: of all parts that hold a node, one owns it. The part must
/// have everything. O(#V + #E).
std::vector<bool> own_nodes(const Part& part);

/// Calls take(first, points) with the nodes of the whole mesh in the order of their global numbers: a piece at a time,
/// whose first node has the number `first`. A part is loaded for each piece of which it has nodes.
void for_each_node(const PartSource& parts,
                   const std::function<void(std::int64_t first, std::span<const Vec3> points)>& take);

/// Calls take(first, rows) with the numbers of Part::values[k] at nodes, a row for each node, as for_each_node() does.
void for_each_node_value(const PartSource& parts, std::size_t k,
                         const std::function<void(std::int64_t first, std::span<const double> rows)>& take);

/// Calls take(index, part) with every part, in the order of the tree, loaded with this content.
void for_each_part(const PartSource& parts, PartContent content,
                   const std::function<void(PartIndex index, const Part& part)>& take);

/// Returns the number of triangles on each patch that all parts list: a wall between two regions counts once.
std::vector<std::int64_t> patch_sizes(const PartSource& parts);

/// A boundary triangle on the user's surface with its corners or, of order 2, its six nodes; of a wall between two
/// regions that of one side.
template <std::size_t n>
struct PatchTriangle {
    std::int32_t patch;
    std::array<std::int64_t, n> nodes;  ///< global numbers; corners seen from outside of its part
};

/// The triangles on patches that are wanted.
enum class OnPatches {
    all,    ///< those that files list (Part::is_listed()); patch_sizes() counts them
    outer,  ///< all but the walls between regions; Bodies::boundary_sizes() counts them
};

/// Calls take(patch, triangles) with the triangles of patch after patch, in the order of the tree within a patch; the
/// triangles of a large patch come in several calls in a row. `sizes`: number of triangles of each patch. n: 3 for the
/// corners, 6 for the nodes of a mesh of order 2. Surfaces are read once for each 1e6 triangles, with six nodes for
/// each 5e5.
template <std::size_t n>
void for_each_patch_triangle(
    const PartSource& parts, std::span<const std::int64_t> sizes,
    const std::function<void(std::int32_t patch, std::span<const PatchTriangle<n>> triangles)>& take,
    OnPatches wanted = OnPatches::all);

/// Throws Error(usage), naming the format, if the mesh has more than `most` nodes, tetrahedra or boundary triangles.
void require_numbers_fit(const MeshOutline& outline, std::string_view format, std::int64_t most);
inline constexpr std::int64_t most_of_32_bits = std::numeric_limits<std::int32_t>::max();

/// Returns the corners of a cell of the part as global numbers.
template <std::size_t n>
std::array<std::int64_t, n> global_corners(const Part& part, const std::array<std::int32_t, n>& cell) {
    std::array<std::int64_t, n> ids;
    for (std::size_t i = 0; i < n; ++i) ids[i] = part.global_id[cell[i]];
    return ids;
}

}  // namespace kerf

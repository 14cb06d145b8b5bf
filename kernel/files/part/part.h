// The mesh of one subdomain with all that relates it to the whole.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/core/ids.h"
#include "files/part/edge_nodes.h"
#include "files/part/inside/name_table.h"
#include "fill/mesh/tet_mesh.h"

namespace kerf {

/// Boundary vertices that the same parts hold.
struct SharedGroup {
    std::vector<NodeId> parts;           ///< two or more, in the order of the tree; the first owns the vertices
    std::vector<std::int32_t> vertices;  ///< numbers in this part, ascending by global number: same order in every part

    template <class Archive>
    void archive(Archive& a) {
        a(parts, vertices);
    }
};

/// Edges that the same parts hold.
struct SharedEdgeGroup {
    std::vector<NodeId> parts;          ///< two or more, in the order of the tree
    std::vector<UndirectedEdge> edges;  ///< ends in this part, that with the smaller global number first; ascending by
                                        ///< global numbers: the same order in every part

    template <class Archive>
    void archive(Archive& a) {
        a(parts, edges);
    }
};

/// Values that a program has computed for a part, at its nodes or in its tetrahedra. Boundary triangles have the values
/// of the tetrahedron behind them, NaN if there is none.
struct PartValues {
    enum class Of { points, tets };
    std::string name;
    Of of = Of::points;
    int components = 1;
    std::variant<std::vector<float>, std::vector<double>>
        numbers;  ///< all components of the first node or tetrahedron, then of the second ...

    bool is_double() const { return std::holds_alternative<std::vector<double>>(numbers); }
    double number(std::size_t i) const {
        return std::visit([i](const auto& all) -> double { return all[i]; }, numbers);
    }
};

/// Tells whether files list a triangle of `part` with this patch and neighbour, see Part::is_listed().
constexpr bool is_listed_triangle(std::int32_t patch, NodeId part, NodeId neighbour) {
    return patch >= 0 && (!neighbour.is_valid() || part < neighbour);
}

/// Tetrahedra of a part that follow each other and lie in one region.
struct RegionRun {
    std::int32_t first_tet = 0;
    RegionIndex region;

    template <class Archive>
    void archive(Archive& a) {
        a(first_tet, region);
    }
};

/// The boundary of a part, and what it shares with other parts: all but its vertices and cells.
struct PartBoundary {
    NodeId id = root_node;            ///< leaf of the tree
    std::vector<Triangle> facets;     ///< #F; boundary triangles, over the boundary vertices, seen from outside
    std::vector<std::int32_t> patch;  ///< #F; number on the user's surface, -1 on interfaces
    std::vector<std::int32_t> facet;  ///< #F; facet of the input that is or contains the triangle, -1 on interfaces
    std::vector<NodeId> neighbour;    ///< #F; part on the other side of an interface or wall, else none
    NameTable patch_names;            ///< names of the patches on the boundary at least
    NameTable region_names;           ///< names of the regions of the cells at least; empty if there is one region
    std::vector<RegionRun> regions;   ///< runs of all tetrahedra, ascending; one unless parts were joined;
                                      ///< empty if there is one region
    std::vector<std::int32_t> contact_vertices;  ///< vertices where parts may be that share no triangle with this one
    std::vector<UndirectedEdge> contact_edges;   ///< edges where parts may be that share no triangle with this one
    std::vector<SharedGroup> shared;  ///< all vertices that other parts have, too; ascending by SharedGroup::parts,
                                      ///< compared in the order of the tree
    std::vector<SharedEdgeGroup> shared_edges;  ///< all edges that other parts have, too; in the same order
};

/// One part of a distributed mesh. A boundary triangle lies on the user's surface with nothing beyond it, or another
/// part has the same triangle in opposite orientation over the same global numbers: then it lies on an interface, which
/// a cut has made, or on a wall, a facet of the user's with regions on both sides.
struct Part : PartBoundary {
    TetMesh mesh;                            ///< vertices of the boundary first
    std::vector<std::int32_t> tet_at_facet;  ///< #F; the tetrahedron behind the triangle, -1 if there is none
    std::vector<std::int64_t> global_id;  ///< #V; dense over the whole mesh, the same in every part that has the vertex
    std::vector<PartValues> values = {};  ///< values of a solution (files/part/solution_parts.h), else empty
    EdgeNodes edge_nodes = {};            ///< nodes on edges of order 2; empty for order 1

    /// Tells whether another part lies on the other side of a boundary triangle.
    bool is_interface(std::size_t f) const { return neighbour[f].is_valid(); }
    /// Tells whether nothing lies on the other side of a boundary triangle.
    bool is_on_outer_boundary(std::size_t f) const { return !neighbour[f].is_valid(); }
    /// Tells whether a boundary triangle is a facet of the input, or a piece of one.
    bool is_of_input(std::size_t f) const { return facet[f] >= 0; }
    /// Tells whether a boundary triangle lies between two regions.
    bool is_wall(std::size_t f) const { return is_interface(f) && is_of_input(f); }
    /// Tells whether a boundary triangle is one of the triangles on patches of the user's that files list. Of the two
    /// sides of a wall, files list that of the part with the smaller number.
    bool is_listed(std::size_t f) const { return is_listed_triangle(patch[f], id, neighbour[f]); }

    /// Returns the region of a tetrahedron, number 0 where there is only one. O(log #runs).
    RegionIndex region_of(std::int32_t tet) const;

    std::int64_t tet_count() const { return std::ssize(mesh.tets); }
    std::int64_t vertex_count() const { return std::ssize(mesh.vertices); }

    /// Returns the order of the cells. Nodes are the vertices, then for order 2 those on the edges; their numbers are
    /// known without points (PartContent::cells), too.
    int order() const { return edge_nodes.global_id.empty() ? 1 : 2; }
    std::int64_t first_edge_node() const { return std::ssize(global_id); }
    std::int64_t node_count() const { return first_edge_node() + std::ssize(edge_nodes.global_id); }
    const Vec3& node_point(std::int64_t n) const {
        return n < first_edge_node() ? mesh.vertices[n] : edge_nodes.points[n - first_edge_node()];
    }
    std::int64_t node_id(std::int64_t n) const {
        return n < first_edge_node() ? global_id[n] : edge_nodes.global_id[n - first_edge_node()];
    }
    /// Returns the nodes of a cell of order 2: corners, then the nodes on tet_edges, or on triangle_edges. O(log of the
    /// edges at a vertex).
    std::array<std::int32_t, 10> nodes_of_tet(std::int64_t t) const { return with_edges(mesh.tets[t], tet_edges); }
    std::array<std::int32_t, 6> nodes_of_facet(std::int64_t f) const { return with_edges(facets[f], triangle_edges); }

 private:
    template <std::size_t N, std::size_t M>
    std::array<std::int32_t, N + M> with_edges(const std::array<std::int32_t, N>& corners,
                                               const std::array<std::array<int, 2>, M>& edges) const {
        std::array<std::int32_t, N + M> nodes;
        std::copy(corners.begin(), corners.end(), nodes.begin());
        const std::int32_t first = first_edge_node();
        for (std::size_t e = 0; e < M; ++e)
            nodes[N + e] = first + edge_nodes.edges.find(undirected(corners[edges[e][0]], corners[edges[e][1]]));
        return nodes;
    }
};

/// Returns the boundary of a part without the cells: all that its surface file holds, and what it shares with others.
Part boundary_of(const Part& part);

/// Returns for each vertex of the part the part that owns it: the first, in the order of the tree, of those that hold
/// it. O(#V).
std::vector<NodeId> owners_of_vertices(const Part& part);

/// The counts of a part, by which writers of other parts know how large the whole is.
struct PartExtent {
    NodeId id = root_node;
    std::int64_t vertices = 0, tets = 0;
    std::int64_t patch_facets = 0;      ///< boundary triangles that files list, see Part::is_listed()
    std::int64_t interface_facets = 0;  ///< boundary triangles that files do not list
    std::int64_t edge_nodes = 0;        ///< nodes on edges, of order 2
};

/// The whole mesh without its cells.
struct MeshOutline {
    Array<PartIndex, PartExtent> parts;  ///< in the order of the tree
    std::int64_t vertices = 0;           ///< distinct ones
    std::vector<std::string> patch_names;
    std::vector<std::string> region_names = {};  ///< empty if there is one region
    std::vector<std::string> patch_types = {};   ///< words NAME=TYPE of --patch-type that the run was given
    bool is_whole = true;                        ///< false: parts that could not be meshed may be neighbours of these
    std::vector<PartValues> values = {};         ///< values that all parts have, without their numbers
    int order = 1;                               ///< 2: a node on each edge, too
    std::int64_t edge_nodes = 0;                 ///< distinct ones

    std::int64_t nodes() const { return vertices + edge_nodes; }
    /// Returns the place of a part, nothing if the mesh has no such part. O(log K).
    std::optional<PartIndex> find(NodeId id) const;
    /// Returns the place of a part. Throws Error(internal) if the mesh has no such part. O(log K).
    PartIndex index_of(NodeId id) const;
    std::int64_t tets() const;
    /// Returns the number of tetrahedra of all parts before this one: the first of its own in a numbering of all.
    std::int64_t first_tet(PartIndex index) const;
    /// Returns the number of triangles that files list of all parts before: the first of the part's own in a numbering
    /// of all.
    std::int64_t first_patch_facet(PartIndex index) const;
    std::int64_t patch_facets() const;
};

/// The content of a part that is loaded, for callers whose memory matters. Of order 2 it includes nodes on edges: their
/// points where vertices have theirs, the edges where there are facets or cells.
enum class PartContent {
    all,
    surface,   ///< nothing of the inside: boundary vertices, facets and what belongs to them, global numbers of both
    cells,     ///< tetrahedra, facets and what belongs to them, global numbers: 18 bytes a tetrahedron
    vertices,  ///< mesh.vertices and global numbers: 6 bytes a tetrahedron
};

class Bodies;
class RegionWalls;

/// Parts of one mesh that can be loaded one at a time.
class PartSource {
 public:
    PartSource();
    virtual ~PartSource();
    PartSource(const PartSource&) = delete;
    PartSource& operator=(const PartSource&) = delete;
    virtual const MeshOutline& outline() const = 0;
    /// Returns one part. Its mesh need not have face neighbours: a caller that needs them finds them
    /// (fill/mesh/adjacency.h). From any thread. Throws Error(io).
    virtual Part load(PartIndex index) const = 0;
    /// Returns the part without content that is not asked for, where that spares time or memory; only PartContent::all
    /// asks for Part::shared, and for neighbours of tetrahedra if the source has them. As load().
    virtual Part load_only(PartIndex index, PartContent) const { return load(index); }
    /// Returns the bodies that the parts belong to (files/part/bodies.h), which are found when they are first asked
    /// for. From any thread. Throws Error(io).
    const Bodies& bodies() const;
    /// Returns the walls of the regions (files/part/region_walls.h), in the same way as bodies().
    virtual const RegionWalls& walls() const;

 private:
    mutable std::mutex finding_;
    mutable std::unique_ptr<const Bodies> bodies_;
    mutable std::unique_ptr<const RegionWalls> walls_;
};

}  // namespace kerf

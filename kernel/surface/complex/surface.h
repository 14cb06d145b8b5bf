// The closed surface of a body or subdomain: a half-edge mesh with keys.
#pragma once

#include <iterator>
#include <memory>
#include <variant>
#include <vector>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

// Specialises what the header above declares.
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>

#include "base/core/check.h"
#include "base/core/ids.h"
#include "base/core/types.h"
#include "base/geometry/union_find.h"

namespace kerf {

/// A closed surface as flat arrays: the form in which it is built, sent to a worker and written to a file.
struct SurfaceArrays {
    std::vector<Vec3> vertices;       ///< #V
    std::vector<Triangle> facets;     ///< #F; normals point out of the body
    std::vector<Key> vertex_key;      ///< #V
    std::vector<Key> facet_key;       ///< #F; node 0: a facet of the input, else of the interface of that node
    std::vector<std::int32_t> patch;  ///< #F; patch of the input, -1 on interfaces

    template <class Archive>
    void archive(Archive& a) {
        a(vertices, facets, vertex_key, facet_key, patch);
    }
};

/// Whether the sizes agree, and every facet has three different vertices in range. O(#F).
bool is_well_formed(const SurfaceArrays& arrays);

struct SurfaceTraits : OpenMesh::DefaultTraits {
    using Point = Vec3;
    using Normal = Vec3;
    VertexAttributes(OpenMesh::Attributes::None);
    FaceAttributes(OpenMesh::Attributes::None);
    EdgeAttributes(OpenMesh::Attributes::None);
    HalfedgeAttributes(OpenMesh::Attributes::None);
};
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<SurfaceTraits>;

/// A place where a set of triangles is not a closed, oriented 2-manifold.
struct ManifoldDefect {
    enum class Kind { open_edge, edge_orientation, non_manifold_edge, non_manifold_vertex };
    Kind kind;
    std::vector<std::int32_t> vertices;  ///< the two ends of the edge, or the vertex
    std::vector<std::int32_t> facets;    ///< facets at the place, ascending
    Vec3 where = Vec3::Zero();           ///< the first vertex; set only by Surface::build(), which knows the points
};

/// Every place where `facets` over `vertex_count` vertices fail to be a closed, oriented 2-manifold, ordered by vertex.
/// A vertex at an edge with a defect is named, too, if one of its fans of facets is closed by itself, so that the
/// vertex stays pinched when the edges are mended. Requires indices in range and no facet with a repeated vertex.
/// Vertices without facets are allowed. O(#V + #F).
std::vector<ManifoldDefect> find_manifold_defects(std::size_t vertex_count, const std::vector<Triangle>& facets);

/// The numbers of the parts of a Surface, each of a kind of its own.
using Vertex = Id<struct VertexTag>;
using Facet = Id<struct FacetTag>;
using Edge = Id<struct EdgeTag>;
using HalfEdge = Id<struct HalfEdgeTag>;

/// The half-edges that start at a vertex, clockwise seen from outside, for loops.
class HalfEdgesAround {
 public:
    class Iterator {
     public:
        Iterator(const HalfEdgeMesh& mesh, HalfEdge first) : mesh_(&mesh), first_(first), at_(first) {}

        HalfEdge operator*() const { return at_; }
        Iterator& operator++() {
            at_ = HalfEdge(mesh_->cw_rotated_halfedge_handle(HalfEdgeMesh::HalfedgeHandle(at_.value())).idx());
            is_round_ = at_ == first_;
            return *this;
        }
        bool operator==(std::default_sentinel_t) const { return is_round_; }

     private:
        const HalfEdgeMesh* mesh_;
        HalfEdge first_, at_;
        bool is_round_ = false;
    };

    HalfEdgesAround(const HalfEdgeMesh& mesh, HalfEdge first) : mesh_(mesh), first_(first) {}
    Iterator begin() const { return {mesh_, first_}; }
    static std::default_sentinel_t end() { return {}; }

 private:
    const HalfEdgeMesh& mesh_;
    HalfEdge first_;
};

/// A closed, oriented 2-manifold. Facets and vertices have the numbers of the arrays that it was built from, and the
/// half-edges of edge e are 2 e and 2 e + 1. Immutable; copies share the half-edges. Ids passed to it must be in range.
class Surface {
 public:
    Surface();

    /// Builds the half-edges in O(#V + #F), or returns the first manifold defect. The arrays must be well-formed.
    static std::variant<Surface, ManifoldDefect> build(SurfaceArrays arrays);
    /// Builds as above where the neighbours of most facets are known. Corner 3 f + i is the half-edge of facet f from
    /// its vertex i to the next; `partner` (3 #F) is the opposite corner, or -1 where it has to be found. Known
    /// partners must be each other's over the same edge; only the others are paired, and only the vertices at them are
    /// proven to be manifold.
    static std::variant<Surface, ManifoldDefect> build(SurfaceArrays arrays, std::vector<std::int32_t> partner);
    /// Builds from arrays that are known to be a closed 2-manifold. Throws Error(internal) naming the defect.
    explicit Surface(SurfaceArrays arrays);

    std::int32_t vertex_count() const { return count_of(vertex_key_); }
    std::int32_t facet_count() const { return count_of(facet_key_); }
    std::int32_t edge_count() const { return 3 * facet_count() / 2; }
    IdRange<Vertex> vertices() const { return ids<Vertex>(vertex_count()); }
    IdRange<Facet> facets() const { return ids<Facet>(facet_count()); }
    IdRange<Edge> edges() const { return ids<Edge>(edge_count()); }
    bool has_vertex(Vertex vertex) const { return vertex.is_valid() && vertex.value() < vertex_count(); }

    const Vec3& point(Vertex vertex) const {
        KERF_CHECK(has_vertex(vertex));
        return points_[vertex.value()];
    }
    Key vertex_key(Vertex vertex) const {
        KERF_CHECK(has_vertex(vertex));
        return vertex_key_[vertex.value()];
    }
    Key facet_key(Facet facet) const {
        KERF_CHECK(has_facet(facet));
        return facet_key_[facet.value()];
    }
    std::int32_t patch(Facet facet) const {
        KERF_CHECK(has_facet(facet));
        return patch_[facet.value()];
    }

    /// Half-edges of a facet in the order of its corners: half-edge i runs from corner i to corner i+1.
    std::array<HalfEdge, 3> half_edges(Facet facet) const {
        KERF_CHECK(has_facet(facet));
        const HalfEdge h(mesh_->halfedge_handle(HalfEdgeMesh::FaceHandle(facet.value())).idx());
        const HalfEdge n = next(h);
        return {h, n, next(n)};
    }
    std::array<Vertex, 3> corners(Facet facet) const {
        const auto h = half_edges(facet);
        return {to_vertex(h[2]), to_vertex(h[0]), to_vertex(h[1])};
    }
    /// Returns the corners as SurfaceArrays has them.
    Triangle triangle(Facet facet) const {
        const auto [a, b, c] = corners(facet);
        return {a.value(), b.value(), c.value()};
    }
    /// Returns for each i the facet across half-edge i.
    std::array<Facet, 3> neighbours(Facet facet) const {
        const auto h = half_edges(facet);
        return {facet_of(opposite(h[0])), facet_of(opposite(h[1])), facet_of(opposite(h[2]))};
    }
    Vertex from_vertex(HalfEdge half_edge) const { return to_vertex(opposite(half_edge)); }
    Vertex to_vertex(HalfEdge half_edge) const { return Vertex(mesh_->to_vertex_handle(handle(half_edge)).idx()); }
    Facet facet_of(HalfEdge half_edge) const { return Facet(mesh_->face_handle(handle(half_edge)).idx()); }
    HalfEdge next(HalfEdge half_edge) const { return HalfEdge(mesh_->next_halfedge_handle(handle(half_edge)).idx()); }
    static HalfEdge opposite(HalfEdge half_edge) { return HalfEdge(half_edge.value() ^ 1); }
    static Edge edge_of(HalfEdge half_edge) { return Edge(half_edge.value() / 2); }
    static HalfEdge first_half_edge(Edge edge) { return HalfEdge(2 * edge.value()); }
    /// The half-edges that start at a vertex, which must have facets.
    HalfEdgesAround around(Vertex vertex) const {
        KERF_CHECK(has_vertex(vertex));
        const HalfEdge first(mesh_->halfedge_handle(HalfEdgeMesh::VertexHandle(vertex.value())).idx());
        KERF_CHECK(first.is_valid());
        return {*mesh_, first};
    }

    /// Returns the half-edge between two vertices, or none. `from` must have facets. O(degree).
    HalfEdge find_half_edge(Vertex from, Vertex to) const;

    SurfaceArrays arrays() const;

 private:
    bool has_facet(Facet facet) const { return facet.is_valid() && facet.value() < facet_count(); }
    bool has_half_edge(HalfEdge half_edge) const {
        return half_edge.is_valid() && half_edge.value() < 3 * facet_count();
    }
    HalfEdgeMesh::HalfedgeHandle handle(HalfEdge half_edge) const {
        KERF_CHECK(has_half_edge(half_edge));
        return HalfEdgeMesh::HalfedgeHandle(half_edge.value());
    }

    struct Paired {};  // every corner has its partner
    Surface(Paired, SurfaceArrays&& arrays, std::vector<std::int32_t> partner);

    std::shared_ptr<const HalfEdgeMesh> mesh_;  // OpenMesh cannot be moved, only copied
    const Vec3* points_ = nullptr;              // the points of the mesh, whose own accessor is slower than an array
    std::vector<Key> vertex_key_;
    std::vector<Key> facet_key_;
    std::vector<std::int32_t> patch_;
};

/// Returns the connected components of facets (shells). O(#F).
Components find_shells(const Surface& surface);

}  // namespace kerf

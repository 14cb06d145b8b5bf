// The closed surface of a body or subdomain: a half-edge mesh with keys.
#pragma once

#include <memory>
#include <variant>
#include <vector>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

// Specialises what the header above declares.
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>

#include "base/core/check.h"
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

/// A closed, oriented 2-manifold. Facets and vertices have the numbers of the arrays that it was built from. Immutable;
/// copies share the half-edges. Numbers of vertices, facets and half-edges passed to it must be in range.
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

    const HalfEdgeMesh& mesh() const { return *mesh_; }
    std::int32_t vertex_count() const { return static_cast<std::int32_t>(vertex_key_.size()); }
    std::int32_t facet_count() const { return static_cast<std::int32_t>(facet_key_.size()); }

    const Vec3& point(std::int32_t vertex) const {
        KERF_CHECK(has_vertex(vertex));
        return points_[vertex];
    }
    Key vertex_key(std::int32_t vertex) const {
        KERF_CHECK(has_vertex(vertex));
        return vertex_key_[vertex];
    }
    Key facet_key(std::int32_t facet) const {
        KERF_CHECK(has_facet(facet));
        return facet_key_[facet];
    }
    std::int32_t patch(std::int32_t facet) const {
        KERF_CHECK(has_facet(facet));
        return patch_[facet];
    }

    /// Half-edges of a facet in the order of its vertices: half-edge i runs from vertex i to vertex i+1.
    std::array<std::int32_t, 3> half_edges(std::int32_t facet) const {
        KERF_CHECK(has_facet(facet));
        const std::int32_t h = mesh_->halfedge_handle(HalfEdgeMesh::FaceHandle(facet)).idx();
        const std::int32_t n = next(h);
        return {h, n, next(n)};
    }
    Triangle vertices(std::int32_t facet) const {
        const auto h = half_edges(facet);
        return {to_vertex(h[2]), to_vertex(h[0]), to_vertex(h[1])};
    }
    /// Returns for each i the facet across half-edge i.
    std::array<std::int32_t, 3> neighbours(std::int32_t facet) const {
        const auto h = half_edges(facet);
        return {facet_of(opposite(h[0])), facet_of(opposite(h[1])), facet_of(opposite(h[2]))};
    }
    std::int32_t from_vertex(std::int32_t half_edge) const { return to_vertex(half_edge ^ 1); }
    std::int32_t to_vertex(std::int32_t half_edge) const {
        KERF_CHECK(half_edge >= 0 && half_edge < 3 * facet_count());
        return mesh_->to_vertex_handle(HalfEdgeMesh::HalfedgeHandle(half_edge)).idx();
    }
    std::int32_t facet_of(std::int32_t half_edge) const {
        KERF_CHECK(half_edge >= 0 && half_edge < 3 * facet_count());
        return mesh_->face_handle(HalfEdgeMesh::HalfedgeHandle(half_edge)).idx();
    }
    std::int32_t next(std::int32_t half_edge) const {
        KERF_CHECK(half_edge >= 0 && half_edge < 3 * facet_count());
        return mesh_->next_halfedge_handle(HalfEdgeMesh::HalfedgeHandle(half_edge)).idx();
    }
    static std::int32_t opposite(std::int32_t half_edge) { return half_edge ^ 1; }
    /// The half-edges that start at a vertex, which must have facets, clockwise seen from outside: a range of handles h
    /// with h.idx().
    auto around(std::int32_t vertex) const {
        KERF_CHECK(has_vertex(vertex) && !mesh_->is_isolated(HalfEdgeMesh::VertexHandle(vertex)));
        return mesh_->voh_cw_range(HalfEdgeMesh::VertexHandle(vertex));
    }

    /// Returns the half-edge between two vertices, or -1 if there is none. `from` must have facets. O(degree).
    std::int32_t find_half_edge(std::int32_t from, std::int32_t to) const;

    SurfaceArrays arrays() const;

 private:
    bool has_vertex(std::int32_t vertex) const { return vertex >= 0 && vertex < vertex_count(); }
    bool has_facet(std::int32_t facet) const { return facet >= 0 && facet < facet_count(); }

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

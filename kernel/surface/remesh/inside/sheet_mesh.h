// The half-edge mesh of the remesher, with its data and queries.
#pragma once

#include <utility>
#include <vector>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

// Specialises what the header above declares.
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>

#include "surface/complex/surface.h"

namespace kerf {

/// The reason for the wanted length of the edges at a vertex: `asked`, the user asks for it; `bound`, the surface is
/// curved, and the bound allows no longer chord; `features`, strips between features; `walls`, thin walls.
enum class LengthRule : std::uint8_t { asked, bound, features, walls };

struct WantedLength {
    double length = 0;
    LengthRule rule = LengthRule::asked;

    void shorten(double other, LengthRule other_rule) {
        if (other < length) *this = {other, other_rule};
    }
};

struct SheetMeshTraits : OpenMesh::DefaultTraits {
    using Point = Vec3;
    using Normal = Vec3;
    VertexAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    HalfedgeAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::PrevHalfedge);
    VertexTraits {
        WantedLength wanted;       // of the edges at the vertex
        double asked = 0;          // by the user alone, at least the wanted length
        double tolerance = 0;      // the smallest of the input around
        std::int32_t input = -1;   // the vertex of the input that it is, -1: none
        std::int64_t changed = 0;  // the last operation that changed a facet around it
        bool is_fixed = false;     // corner of a facet that is kept
        bool is_end = false;       // a copy at which seams end, part or touch: stays where it is
        std::int32_t place = -1;   // number of the place that it shares with its copies, -1: it has none
    };
    FaceTraits {
        std::int32_t patch = 0;
        std::int32_t region = -1;       // flat region that contains its corners, -1: none
        std::int32_t near = -1;         // a facet of the input near it
        std::int32_t first_point = -1;  // head of the list of the input's vertices that it stands for
        std::int64_t changed = 0;       // the last operation that changed it
        bool is_kept = false;           // stays as it was given
        bool is_wall = false;           // has a body on both sides
    };
    EdgeTraits {
        bool is_feature = false;
        std::int32_t fold = -1;  // number of the fold that it is a piece of, -1: none
        std::int32_t seam = -1;  // number of the seam that it is an edge of, -1: it is in one sheet only
    };
};

/// A surface in sheets. Where more than two facets meet in an edge of the surface, sheets end at a seam, and each of
/// them has the edge. Each fan of facets around a vertex, from seam to seam, has a copy of the vertex. A change of one
/// edge of a seam, or of one copy, must be made to all.
class SheetMesh : public OpenMesh::TriMesh_ArrayKernelT<SheetMeshTraits> {
 public:
    using Corners = std::array<Vec3, 3>;

    // --- copies ---

    void make_copies(std::vector<VertexHandle> vertices);
    /// Makes a seam of more than one edges, whatever their directions.
    void make_seam(std::vector<EdgeHandle> edges);
    /// Replaces the edges of a seam by those that are left of it.
    void change_seam(std::int32_t seam, std::vector<EdgeHandle> edges) { seams_[seam] = std::move(edges); }
    bool has_copies(VertexHandle v) const { return data(v).place >= 0; }
    /// Calls visit(copy) for the vertices at the place of v, including v.
    template <class Visit>
    void for_each_copy(VertexHandle v, Visit visit) const {
        if (!has_copies(v)) return visit(v);
        for (const VertexHandle copy : places_[data(v).place]) visit(copy);
    }
    template <class Visit>
    void for_each_copy(EdgeHandle e, Visit visit) const {
        if (data(e).seam < 0) return visit(e);
        for (const EdgeHandle copy : seams_[data(e).seam]) visit(copy);
    }
    /// Lists the half-edges of all sheets along this one, in its direction, including itself.
    void list_copies(HalfedgeHandle h, std::vector<HalfedgeHandle>& list) const;
    bool is_first_copy(VertexHandle v) const { return !has_copies(v) || places_[data(v).place].front() == v; }
    bool is_first_copy(EdgeHandle e) const { return data(e).seam < 0 || seams_[data(e).seam].front() == e; }
    /// Whether some edge leads from a copy of v to a copy of w.
    bool are_joined(VertexHandle v, VertexHandle w) const;

    // --- shape ---

    Corners corners(FaceHandle f) const;
    /// Returns the sine of the smallest angle of a facet.
    double sine(FaceHandle f) const;
    double size(VertexHandle v) const { return data(v).wanted.length; }
    /// Returns the number of features that meet at the vertex, at this copy alone.
    int feature_count(VertexHandle v) const;
    /// Whether all facets around the vertex belong to one patch.
    bool has_one_patch(VertexHandle v) const;
    EdgeHandle edge_between(VertexHandle v, VertexHandle w) const { return edge_handle(find_halfedge(v, w)); }
    /// Returns the ends of the edge's first half-edge: from, to.
    std::array<VertexHandle, 2> ends(EdgeHandle e) const {
        const HalfedgeHandle h = halfedge_handle(e, 0);
        return {from_vertex_handle(h), to_vertex_handle(h)};
    }
    /// Returns the facets at an edge; at the end of the sheet the one facet twice.
    std::array<FaceHandle, 2> facets_at(EdgeHandle e) const {
        const FaceHandle f = face_handle(halfedge_handle(e, 0)), g = face_handle(halfedge_handle(e, 1));
        return {f.is_valid() ? f : g, g.is_valid() ? g : f};
    }
    /// Whether a facet at the edge is kept, in any sheet.
    bool is_fixed(EdgeHandle e) const;
    /// Whether the facets at the edge lie in one flat region, and the edge is no feature.
    bool is_flat(EdgeHandle e) const;
    /// Whether all facets around the vertex lie in one flat region, and no feature is there.
    bool is_inside_region(VertexHandle v) const;
    /// Returns the cosine of the angle between the normals of the facets at the edge.
    double fold_cosine(EdgeHandle e) const;
    /// Returns the number of the operation that last changed the facets around a vertex or at an edge: an operation
    /// that was refused since then would be refused again.
    std::int64_t last_change(VertexHandle v) const;
    std::int64_t last_change(EdgeHandle e) const;
    void note_change(FaceHandle f, std::int64_t operation);
    std::int64_t feature_edges() const;
    /// Returns the remaining facets and vertices, in order, copies with one key. Renumbers everything.
    SurfaceArrays arrays();

 private:
    std::vector<std::vector<VertexHandle>> places_;  // only vertices that are left
    std::vector<std::vector<EdgeHandle>> seams_;
};

/// Returns the cross product of two edges: along the normal, twice the area of the triangle in length.
Vec3 area_normal(const SheetMesh::Corners& t);

}  // namespace kerf

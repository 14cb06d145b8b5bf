// The half-edge mesh of the remesher, with its data and queries.
#pragma once

#include <utility>
#include <vector>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

// Specialises what the header above declares.
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>

#include "base/core/ids.h"
#include "surface/remesh/inside/sheet_state.h"

namespace kerf {

struct SheetMeshTraits : OpenMesh::DefaultTraits {
    using Point = Vec3;
    using Normal = Vec3;
    VertexAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    HalfedgeAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::PrevHalfedge);
    VertexTraits { SheetVertex own; };
    FaceTraits { SheetFacet own; };
    EdgeTraits { SheetEdge own; };
};

/// A part of a surface in sheets, or all of it.
struct SheetPiece {
    SheetArrays arrays;
    std::vector<std::int32_t> partner;  // 3 #F; the corner on the other side of an edge, -1: none
    std::int32_t places = 0, seams = 0;
};

/// A surface in sheets. Where more than two facets meet in an edge of the surface, sheets end at a seam, and each of
/// them has the edge. Each fan of facets around a vertex, from seam to seam, has a copy of the vertex. A change of one
/// edge of a seam, or of one copy, must be made to all.
class SheetMesh : public OpenMesh::TriMesh_ArrayKernelT<SheetMeshTraits> {
 public:
    using Corners = std::array<Vec3, 3>;

    /// Takes the vertices, facets and edges of a piece; its vertices must have one fan of facets each. O(#F).
    explicit SheetMesh(const SheetPiece& piece);
    /// Returns the remaining vertices and facets, in order. O(#F).
    SheetArrays arrays() const;

    SheetVertex& data(VertexHandle v) { return Base::data(v).own; }
    const SheetVertex& data(VertexHandle v) const { return Base::data(v).own; }
    SheetFacet& data(FaceHandle f) { return Base::data(f).own; }
    const SheetFacet& data(FaceHandle f) const { return Base::data(f).own; }
    SheetEdge& data(EdgeHandle e) { return Base::data(e).own; }
    const SheetEdge& data(EdgeHandle e) const { return Base::data(e).own; }

    // --- copies ---

    void make_copies(std::vector<VertexHandle> vertices);
    /// Makes a seam of more than one edges, whatever their directions.
    void make_seam(std::vector<EdgeHandle> edges);
    /// Replaces the edges of a seam by those that are left of it.
    void change_seam(std::int32_t seam, std::vector<EdgeHandle> edges) { seams_[seam] = std::move(edges); }
    /// The numbers of places and seams that have been given.
    std::int32_t place_count() const { return count_of(places_); }
    std::int32_t seam_count() const { return count_of(seams_); }
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
    /// Whether some edge leads from a copy of v to a copy of w.
    bool are_joined(VertexHandle v, VertexHandle w) const;

    // --- shape ---

    Corners corners(FaceHandle f) const;
    /// Returns the sine of the smallest angle of a facet, as it was at its last change.
    double sine(FaceHandle f) const { return sines_[f.idx()]; }
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
    /// Whether the edge lies on the border of the block, or a facet at it is kept, in any sheet.
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
    /// To be called for each facet that is new or has got other corners.
    void note_change(FaceHandle f, std::int64_t operation);

 private:
    using Base = OpenMesh::TriMesh_ArrayKernelT<SheetMeshTraits>;

    void connect(const SheetPiece& piece);
    double sine_of(FaceHandle f) const;

    std::vector<double> sines_;                      // by facet; they are asked far more often than they change
    std::vector<std::vector<VertexHandle>> places_;  // only vertices that are left
    std::vector<std::vector<EdgeHandle>> seams_;
};

/// Returns the cross product of two edges: along the normal, twice the area of the triangle in length.
Vec3 area_normal(const SheetMesh::Corners& t);

}  // namespace kerf

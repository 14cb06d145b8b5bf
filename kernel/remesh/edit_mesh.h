// The half-edge mesh of the remesher, and what can be asked about it.
#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

// Specialises what the header above declares.
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>

#include "surface/surface.h"

namespace kerf {

/// What the edges at a vertex are to be so short for: what is asked for; curvature, which the bound allows no longer
/// chord of; strips between features; thin walls.
enum class LengthRule : std::uint8_t { asked, bound, features, walls };

struct WantedLength {
    double length = 0;
    LengthRule rule = LengthRule::asked;

    void shorten(double other, LengthRule other_rule) {
        if (other < length) *this = {other, other_rule};
    }
};

struct EditTraits : OpenMesh::DefaultTraits {
    using Point = Vec3;
    using Normal = Vec3;
    VertexAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    HalfedgeAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::PrevHalfedge);
    VertexTraits {
        WantedLength wanted;       // of the edges
        double asked = 0;          // by the user alone, at least the wanted length
        double tolerance = 0;      // of the input around
        std::int32_t input = -1;   // vertex of the input that it is, -1: none
        std::int64_t changed = 0;  // number of the operation that last changed a facet around it
        bool is_fixed = false;     // corner of a facet that is kept
    };
    FaceTraits {
        std::int32_t patch = 0;
        std::int32_t region = -1;       // flat region that holds its corners, -1: none
        std::int32_t near = -1;         // some facet of the input near it
        std::int32_t first_point = -1;  // of the input's vertices that it stands for
        std::int64_t changed = 0;       // number of the operation that last changed it
        bool is_kept = false;           // stays as it was given
    };
    EdgeTraits {
        bool is_feature = false;
        std::int32_t fold = -1;  // number of the fold that it is a piece of
    };
};

class EditMesh : public OpenMesh::TriMesh_ArrayKernelT<EditTraits> {
 public:
    using Corners = std::array<Vec3, 3>;

    Corners corners(FaceHandle f) const;
    /// Smallest of the angles of a facet, as its sine.
    double sine(FaceHandle f) const;
    double size(VertexHandle v) const { return data(v).wanted.length; }
    /// Features that meet at the vertex.
    int feature_count(VertexHandle v) const;
    /// Whether the facets around the vertex are of one patch.
    bool has_one_patch(VertexHandle v) const;
    EdgeHandle edge_between(VertexHandle v, VertexHandle w) const { return edge_handle(find_halfedge(v, w)); }
    /// Those of its first half-edge: from, to.
    std::array<VertexHandle, 2> ends(EdgeHandle e) const {
        const HalfedgeHandle h = halfedge_handle(e, 0);
        return {from_vertex_handle(h), to_vertex_handle(h)};
    }
    std::array<FaceHandle, 2> facets_at(EdgeHandle e) const {
        return {face_handle(halfedge_handle(e, 0)), face_handle(halfedge_handle(e, 1))};
    }
    /// Whether a facet at the edge is kept.
    bool is_fixed(EdgeHandle e) const {
        const auto [f, g] = facets_at(e);
        return data(f).is_kept || data(g).is_kept;
    }
    /// Whether the facets at the edge lie in one flat region, and it is no feature.
    bool is_flat(EdgeHandle e) const;
    /// Whether all facets around the vertex lie in one flat region, and no feature is there.
    bool is_inside_region(VertexHandle v) const;
    /// cos of the angle between the normals of the facets at the edge.
    double fold_cosine(EdgeHandle e) const;
    /// Number of the operation that last changed the facets around a vertex or at an edge: what was refused there since
    /// then is refused again.
    std::int64_t last_change(VertexHandle v) const { return data(v).changed; }
    std::int64_t last_change(EdgeHandle e) const;
    void note_change(FaceHandle f, std::int64_t operation);
    std::int64_t feature_edges() const;
    /// The facets and vertices that are left, in order. Renumbers everything.
    SurfaceArrays arrays();
};

/// The cross product of two edges: twice the area of the triangle, along its normal.
Vec3 area_normal(const EditMesh::Corners& t);

}  // namespace kerf

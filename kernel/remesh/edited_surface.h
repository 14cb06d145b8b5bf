// A surface that is changed by split, collapse, flip and move, and stays within the bound of the input.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

// Specialises what the header above declares.
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>

#include "remesh/input_shape.h"
#include "remesh/remesh.h"
#include "surface/nearness.h"

namespace kerf {

struct EditTraits : OpenMesh::DefaultTraits {
    using Point = Vec3;
    using Normal = Vec3;
    VertexAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    HalfedgeAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::PrevHalfedge);
    VertexTraits {
        double size = 0;          // wanted length of the edges
        double asked = 0;         // by the user alone, at least size
        double tolerance = 0;     // of the input around
        std::int32_t input = -1;  // vertex of the input that it is, -1: none
    };
    FaceTraits {
        std::int32_t patch = 0;
        std::int32_t region = -1;       // flat region that holds its corners, -1: none
        std::int32_t near = -1;         // some facet of the input near it
        std::int32_t first_point = -1;  // of the input's vertices that it stands for
        std::int64_t changed = 0;       // number of the operation that last changed it
    };
    EdgeTraits {
        bool is_feature = false;
        std::int32_t fold = -1;  // number of the fold that it is a piece of
    };
};
using EditMesh = OpenMesh::TriMesh_ArrayKernelT<EditTraits>;

/// The half-edge mesh of the remesher. Its operations change nothing and return false where they would leave the bound
/// of the input, turn a facet over, lose a feature, change the topology or make the worst triangle worse.
///
/// The bound both ways: every new facet is near the input (Nearness), and every vertex of the
/// input that is no vertex any more is within its tolerance of a facet that stands for it. Facets that stay in a flat
/// region are near it as a whole.
class EditedSurface {
 public:
    using Vertex = OpenMesh::VertexHandle;
    using Edge = OpenMesh::EdgeHandle;
    using HalfEdge = OpenMesh::HalfedgeHandle;
    using Facet = OpenMesh::FaceHandle;

    explicit EditedSurface(const InputShape& input);

    const EditMesh& mesh() const { return mesh_; }
    const InputShape& input() const { return input_; }
    const Vec3& point(Vertex v) const { return mesh_.point(v); }
    double size(Vertex v) const { return mesh_.data(v).size; }
    /// `asked` is what the user wants, whatever the shape needs.
    void set_size(Vertex v, double size, double asked) {
        mesh_.data(v).size = size;
        mesh_.data(v).asked = asked;
    }
    double asked(Vertex v) const { return mesh_.data(v).asked; }
    /// Number of the operation that last changed the facets around a vertex or at an edge: what was refused there since
    /// then is refused again.
    std::int64_t last_change(Vertex v) const;
    std::int64_t last_change(Edge e) const;
    /// How many operations have changed something.
    std::int64_t changes() const { return changes_; }
    void set_fold(Edge e, std::int32_t fold) { mesh_.data(e).fold = fold; }
    /// What operations may use of the tolerances, 1 in the beginning: what is left out first leaves room for the rest.
    void set_share(double share) { share_ = share; }
    /// Finds flat regions anew, of facets that lie within `share` of the tolerance of a plane, so that what is flat by
    /// now can be changed as such. Renumbers everything.
    void find_regions(double share);
    double length(Edge e) const;
    /// Smallest of the angles of a facet, as its sine.
    double sine(Facet f) const;

    /// Features that meet at the vertex.
    int feature_count(Vertex v) const;
    /// Whether the facets at the edge lie in one flat region or are of one nearly flat piece of the surface.
    bool is_flat(Edge e) const;
    /// cos of the angle between the normals of its facets.
    double fold_cosine(Edge e) const;

    struct CollapseRules {
        double good_sine;        ///< triangles may get worse down to this
        double worst_share = 1;  ///< of the worst sine before, which the new ones must have at least
        double longest = std::numeric_limits<double>::infinity();  ///< a new edge over the smaller size at its ends
    };
    /// Moves the start of the half-edge to its end, which keeps its place.
    bool collapse(HalfEdge h, const CollapseRules& rules);
    /// Turns the edge if the smallest angle of its two facets grows.
    bool flip(Edge e);
    /// As flip(), only within a flat region, by the empty circle. Cheap.
    bool make_delaunay(Edge e);
    /// Puts a vertex on the edge at from + t (to - from), 0 < t < 1, of half-edge 0. Always possible.
    Vertex split(Edge e, double t);
    /// Moves a vertex towards `wanted` along what it lies on: a flat region, a straight line between two, or the
    /// surface.
    bool move(Vertex v, const Vec3& wanted);

    std::int64_t feature_edges() const;
    /// The facets and vertices that are left, in order.
    SurfaceArrays arrays();

 private:
    using Corners = std::array<Vec3, 3>;
    struct Star {  // facets and what they would become
        std::vector<Facet> facets;
        std::vector<Corners> corners;
        std::vector<char> stays;  // in its flat region
    };
    static constexpr std::int32_t unlisted = -2;

    Corners corners(Facet f) const;
    bool is_inside_region(Vertex v) const;
    bool keeps_turn(Facet f, const Corners& now) const;
    bool stays_in_region(Facet f, const Corners& now) const;
    bool is_near_input(Facet f, const Corners& now);
    bool accepts_star(Vertex v, bool is_inside);
    void commit_star();
    void note_change(std::span<const Facet> facets);
    bool take_flip(Edge e, bool is_exact_only);
    std::optional<Vec3> place_near(Vertex v, const Vec3& wanted, bool is_inside) const;

    bool holds_points(std::span<const std::int32_t> points, std::span<const Corners> facets) const;
    void list_points(Facet f, std::vector<std::int32_t>& points) const;
    void list_vertex(Vertex v, std::vector<std::int32_t>& points) const;
    void give_points(std::span<const std::int32_t> points, std::span<const Facet> facets);

    const InputShape& input_;
    Nearness near_input_;
    EditMesh mesh_;
    std::vector<FlatRegion> planes_;
    double share_ = 1;
    std::int64_t changes_ = 0;
    std::vector<std::int32_t> next_point_;  // of the vertices of the input: the list of a facet
    std::vector<std::int32_t> points_;      // scratch
    Star star_;                             // scratch
};

}  // namespace kerf

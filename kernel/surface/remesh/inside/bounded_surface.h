// A surface that is changed by split, collapse, flip and move, and stays within the bound of the input.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "surface/remesh/inside/input_bound.h"

namespace kerf {

/// A SheetMesh within the bound of the input, and the operations of the remesher on it. An operation changes nothing
/// and returns false if it would change a facet that is kept or the border of the piece, leave the bound (InputBound),
/// turn a facet over, lose a feature, change the topology or make the worst triangle worse. An operation on a seam
/// changes all its sheets, if each of them allows it.
class BoundedSurface {
 public:
    using Vertex = SheetMesh::VertexHandle;
    using Edge = SheetMesh::EdgeHandle;
    using HalfEdge = SheetMesh::HalfedgeHandle;
    using Facet = SheetMesh::FaceHandle;

    /// Takes a piece of the surface that `bound` is of.
    BoundedSurface(InputBound bound, const SheetPiece& piece) : bound_(std::move(bound)), mesh_(piece), stars_(1) {}

    const SheetMesh& mesh() const { return mesh_; }
    const InputShape& input() const { return bound_.input(); }
    /// Sets the sizes of all copies of a vertex. `asked` is the size that the user wants, whatever the shape needs.
    void set_size(Vertex v, const WantedLength& wanted, double asked) {
        mesh_.for_each_copy(v, [&](Vertex copy) {
            mesh_.data(copy).wanted = wanted;
            mesh_.data(copy).asked = asked;
        });
    }
    void set_fold(Edge e, std::int32_t fold) { mesh_.data(e).fold = fold; }
    /// The number of operations that have changed something.
    std::int64_t changes() const { return changes_; }
    /// Sets the share of the tolerances that may be used, see InputBound.
    void set_share(double share) { bound_.set_share(share); }

    struct CollapseRules {
        double good_sine;        ///< sine of the angle down to which triangles may get worse
        double worst_share = 1;  ///< share of the worst sine before that the new triangles must have at least
        double longest = std::numeric_limits<double>::infinity();  ///< greatest ratio of a new edge to the smaller size
                                                                   ///< at its ends
        bool merges_features = false;  ///< whether the start may be of other features than the end, if it is of one
                                       ///< patch
    };
    /// Moves the start of the half-edge to its end, which keeps its place.
    bool collapse(HalfEdge h, const CollapseRules& rules);
    /// Collapses the edge, if possible away from the end with fewer edges, else the other way.
    bool collapse_either_way(Edge e, const CollapseRules& rules);
    /// Flips the edge if the smallest angle of its two facets grows.
    bool flip(Edge e) { return flip_if_better(e, false); }
    /// Flips the edge like flip(), but only within a flat region, where the bound needs no proof. Cheap.
    bool make_delaunay(Edge e) { return flip_if_better(e, true); }
    /// Puts a vertex on the edge at from + t (to - from), 0 < t < 1, along half-edge 0, and returns its copy in the
    /// sheet of this edge. Possible for every edge that is not fixed.
    Vertex split(Edge e, double t);
    /// Moves a vertex towards `wanted` within a flat region, along a straight line between two, or on the surface,
    /// depending on which of these it lies on.
    bool move(Vertex v, const Vec3& wanted, InputBound::Evidence evidence);

 private:
    bool stays(Vertex v) const;
    bool joins_what_is_apart(HalfEdge h) const;
    /// Whether a collapse would leave nothing but two facets back to back.
    bool is_of_tetrahedron(HalfEdge h) const;
    bool may_collapse(HalfEdge h, const CollapseRules& rules, NewFacets& star);
    void commit_collapse(HalfEdge h, const NewFacets& star);
    bool may_move(Vertex v, const Vec3& place, bool is_inside, InputBound::Evidence evidence, NewFacets& star);
    void commit_move(Vertex v, const Vec3& place, bool is_inside, const NewFacets& star);
    Vertex split_in_sheet(HalfEdge h, const Vec3& place);
    void commit_star(const NewFacets& star);
    void note_change(std::span<const Facet> facets);
    bool flip_if_better(Edge e, bool is_exact_only);

    InputBound bound_;
    SheetMesh mesh_;
    std::int64_t changes_ = 0;
    // Scratch; stars_ has a star for each sheet.
    std::vector<std::int32_t> points_;
    std::vector<HalfEdge> along_;
    std::vector<Vertex> copies_;
    std::vector<NewFacets> stars_;
};

}  // namespace kerf

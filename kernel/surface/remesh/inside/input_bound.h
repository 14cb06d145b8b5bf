// The rules by which the input refuses changes of the surface.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "surface/diagnosis/nearness.h"
#include "surface/remesh/inside/input_shape.h"
#include "surface/remesh/inside/sheet_mesh.h"

namespace kerf {

/// Facets of a SheetMesh, and the corners that they would get.
struct NewFacets {
    std::vector<SheetMesh::FaceHandle> facets;
    std::vector<SheetMesh::Corners> corners;
    std::vector<char> stays;   ///< set by accepts_star(): whether each facet stays in its flat region
    bool points_stay = false;  ///< set by accepts_star(): whether each facet goes on standing for the same points

    void clear() {
        facets.clear();
        corners.clear();
    }
};

/// The bound in both directions: every new facet is near the input (Nearness), and every vertex of the input that has
/// left the mesh is within its tolerance of a facet that stands for it. Facets that stay in a flat region are near it
/// as a whole.
class InputBound {
 public:
    /// Keeps the references. Pieces of one state may be changed on several threads, each with a bound of its own.
    InputBound(const InputShape& input, SheetState& state);

    const InputShape& input() const { return *input_; }
    /// Sets the share of the tolerances that may be used, at first 1: early operations use less, to leave room for
    /// later ones.
    void set_share(double share) { share_ = share; }

    // --- rules; facets remember a facet of the input near which they were found ---

    /// Whether no facet turns over.
    bool keeps_turns(const SheetMesh& mesh, const NewFacets& star) const;
    /// By what a new facet is found near the input: `proof`, all of it; `samples`, its centre and the middles of its
    /// edges, which is some five times as fast. What only samples have accepted is to be inspected in the end.
    enum class Evidence { proof, samples };
    /// Whether the facets of `star` may take the place of those around v; `is_inside`: v lies inside a flat region.
    bool accepts_star(SheetMesh& mesh, SheetMesh::VertexHandle v, bool is_inside, Evidence evidence, NewFacets& star);
    /// Whether these two facets, which keeps_turns() has accepted, may take the place of those at an edge that is not
    /// flat.
    bool accepts_flip(SheetMesh& mesh, SheetMesh::EdgeHandle e, const NewFacets& pair);
    /// Whether a facet with these corners, in the place of f, is proven to be near the input.
    bool is_near_input(SheetMesh& mesh, SheetMesh::FaceHandle f, const SheetMesh::Corners& now);
    /// Whether exactly two borders of flat regions meet at the vertex, so that it may move along them.
    static bool lies_on_line(const SheetMesh& mesh, SheetMesh::VertexHandle v);
    /// Returns the place nearest to `wanted` to which a vertex may go: in its flat region, along the line that it lies
    /// on, or on the input.
    std::optional<Vec3> place_near(const SheetMesh& mesh, SheetMesh::VertexHandle v, const Vec3& wanted,
                                   bool is_inside) const;

    // --- the vertices of the input that a facet stands for ---

    /// Appends the points of a list that begins with SheetMeshTraits' first_point.
    void list_points(std::int32_t first, std::vector<std::int32_t>& points) const {
        for (std::int32_t p = first; p >= 0; p = (*next_point_)[p]) points.push_back(p);
    }
    /// Appends a vertex of the input that is about to leave its place, unless a list has it already.
    static void list_vertex(const SheetMesh& mesh, SheetMesh::VertexHandle v, std::vector<std::int32_t>& points);
    /// Gives each point to the closest of the facets, whose former lists are dropped.
    void give_points(SheetMesh& mesh, std::span<const std::int32_t> points,
                     std::span<const SheetMesh::FaceHandle> facets);

 private:
    bool stays_in_region(std::int32_t region, const SheetMesh::Corners& now) const;
    struct ListedPoint {
        std::int32_t point;
        std::int32_t own;  // number of the new facet that stands for it so far, -1: none
    };

    bool has_near_samples(SheetMesh& mesh, SheetMesh::FaceHandle f, const SheetMesh::Corners& now);
    void list_points(std::int32_t first, std::int32_t own);
    /// Whether each of points_ is within its tolerance of some facet. `stay`: whether their own ones are near enough.
    bool holds_points(std::span<const SheetMesh::Corners> facets, bool& stay) const;

    const InputShape* input_;
    Nearness near_input_;
    const std::vector<FlatRegion>* planes_;
    std::vector<std::int32_t>* next_point_;  // see SheetState
    double share_ = 1;
    std::vector<ListedPoint> points_;  // scratch
};

}  // namespace kerf

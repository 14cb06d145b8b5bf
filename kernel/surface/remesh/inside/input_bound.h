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
    std::vector<char> stays;  ///< set by accepts_star(): whether each facet stays in its flat region

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
    /// Keeps the reference.
    explicit InputBound(const InputShape& input);

    const InputShape& input() const { return input_; }
    /// Sets the share of the tolerances that may be used, at first 1: early operations use less, to leave room for
    /// later ones.
    void set_share(double share) { share_ = share; }
    /// Finds the flat regions anew, of facets that lie within `share` of the tolerance of a plane. Renumbers
    /// everything.
    void find_regions(SheetMesh& mesh, double share);

    // --- rules; facets remember a facet of the input near which they were found ---

    /// Whether no facet turns over.
    bool keeps_turns(const SheetMesh& mesh, const NewFacets& star) const;
    /// Whether the facets of `star` may take the place of those around v; `is_inside`: v lies inside a flat region.
    bool accepts_star(SheetMesh& mesh, SheetMesh::VertexHandle v, bool is_inside, NewFacets& star);
    /// Whether these two facets, which keeps_turns() has accepted, may take the place of those at an edge that is not
    /// flat.
    bool accepts_flip(SheetMesh& mesh, SheetMesh::EdgeHandle e, const NewFacets& pair);
    /// Whether exactly two borders of flat regions meet at the vertex, so that it may move along them.
    static bool lies_on_line(const SheetMesh& mesh, SheetMesh::VertexHandle v);
    /// Returns the place nearest to `wanted` to which a vertex may go: in its flat region, along the line that it lies
    /// on, or on the input.
    std::optional<Vec3> place_near(const SheetMesh& mesh, SheetMesh::VertexHandle v, const Vec3& wanted,
                                   bool is_inside) const;

    // --- the vertices of the input that a facet stands for ---

    /// Appends the points of a list that begins with SheetMeshTraits' first_point.
    void list_points(std::int32_t first, std::vector<std::int32_t>& points) const {
        for (std::int32_t p = first; p >= 0; p = next_point_[p]) points.push_back(p);
    }
    /// Appends a vertex of the input that is about to leave its place, unless a list has it already.
    void list_vertex(const SheetMesh& mesh, SheetMesh::VertexHandle v, std::vector<std::int32_t>& points) const;
    /// Gives each point to the closest of the facets, whose former lists are dropped.
    void give_points(SheetMesh& mesh, std::span<const std::int32_t> points,
                     std::span<const SheetMesh::FaceHandle> facets);

 private:
    static constexpr std::int32_t unlisted = -2;

    bool stays_in_region(std::int32_t region, const SheetMesh::Corners& now) const;
    bool is_near_input(SheetMesh& mesh, SheetMesh::FaceHandle f, const SheetMesh::Corners& now);
    bool holds_points(std::span<const std::int32_t> points, std::span<const SheetMesh::Corners> facets) const;

    const InputShape& input_;
    Nearness near_input_;
    std::vector<FlatRegion> planes_;
    double share_ = 1;
    std::vector<std::int32_t> next_point_;  // per vertex of the input: the next one in the list of a facet
    std::vector<std::int32_t> points_;      // scratch
};

}  // namespace kerf

// The rules by which the input refuses a change of its surface.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "remesh/edit_mesh.h"
#include "remesh/input_shape.h"
#include "surface/nearness.h"

namespace kerf {

/// Facets of an EditMesh, and the corners that they would get.
struct NewFacets {
    std::vector<EditMesh::FaceHandle> facets;
    std::vector<EditMesh::Corners> corners;
    std::vector<char> stays;  ///< whether each stays in its flat region; found by accepts_star()

    void clear() {
        facets.clear();
        corners.clear();
    }
};

/// The bound both ways: every new facet is near the input (Nearness), and every vertex of the input that is no vertex
/// any more is within its tolerance of a facet that stands for it. Facets that stay in a flat region are near it as a
/// whole.
class InputBound {
 public:
    /// Keeps the reference.
    explicit InputBound(const InputShape& input);

    const InputShape& input() const { return input_; }
    /// What may be used of the tolerances, 1 in the beginning: what is left out first leaves room for the rest.
    void set_share(double share) { share_ = share; }
    /// Finds flat regions anew, of facets that lie within `share` of the tolerance of a plane. Renumbers everything.
    void find_regions(EditMesh& mesh, double share);

    // --- rules; facets keep where the input was found to be near ---

    /// Whether no facet turns over.
    bool keeps_turns(const EditMesh& mesh, const NewFacets& star) const;
    /// Whether these facets may take the place of those around v, which is inside a flat region or not.
    bool accepts_star(EditMesh& mesh, EditMesh::VertexHandle v, bool is_inside, NewFacets& star);
    /// Whether these two facets, which keep their turns, may take the place of those at an edge that is not flat.
    bool accepts_flip(EditMesh& mesh, EditMesh::EdgeHandle e, const NewFacets& pair);
    /// Whether two borders of flat regions meet at the vertex, along which it may go.
    static bool lies_on_line(const EditMesh& mesh, EditMesh::VertexHandle v);
    /// Where a vertex may go: in its flat region, along the line that it lies on, or on the input.
    std::optional<Vec3> place_near(const EditMesh& mesh, EditMesh::VertexHandle v, const Vec3& wanted,
                                   bool is_inside) const;

    // --- which vertices of the input a facet stands for ---

    /// Appends those of a list: EditTraits, first_point.
    void list_points(std::int32_t first, std::vector<std::int32_t>& points) const {
        for (std::int32_t p = first; p >= 0; p = next_point_[p]) points.push_back(p);
    }
    /// Appends a vertex of the input that is about to leave its place, if no list has it yet.
    void list_vertex(const EditMesh& mesh, EditMesh::VertexHandle v, std::vector<std::int32_t>& points) const;
    /// Gives each to the closest of the facets, which forget those that they had.
    void give_points(EditMesh& mesh, std::span<const std::int32_t> points,
                     std::span<const EditMesh::FaceHandle> facets);

 private:
    static constexpr std::int32_t unlisted = -2;

    bool stays_in_region(std::int32_t region, const EditMesh::Corners& now) const;
    bool is_near_input(EditMesh& mesh, EditMesh::FaceHandle f, const EditMesh::Corners& now);
    bool holds_points(std::span<const std::int32_t> points, std::span<const EditMesh::Corners> facets) const;

    const InputShape& input_;
    Nearness near_input_;
    std::vector<FlatRegion> planes_;
    double share_ = 1;
    std::vector<std::int32_t> next_point_;  // of the vertices of the input: the list of a facet
    std::vector<std::int32_t> points_;      // scratch
};

}  // namespace kerf

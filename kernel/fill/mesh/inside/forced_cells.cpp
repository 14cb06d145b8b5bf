#include "fill/mesh/inside/forced_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/core/check.h"
#include "base/core/ids.h"
#include "base/geometry/angles.h"
#include "base/geometry/triangle.h"
#include "fill/mesh/buckets.h"
#include "fill/mesh/tet_mesh.h"

namespace kerf {

ForcedCells::ForcedCells(const std::vector<Vec3>& vertices, const BoundaryTriangles& boundary)
    : vertices_(vertices), boundary_(boundary), end_(vertices.size() + 1, 0) {
    KERF_CHECK(boundary.facets.size() == boundary.is_interface.size());
    const auto for_each_facet = [&](const auto& take) {
        for (std::size_t f = 0; f < boundary.facets.size(); ++f) {
            if (boundary.is_interface[f]) continue;
            Triangle corners = boundary.facets[f];
            std::sort(corners.begin(), corners.end());
            take(corners[0], UndirectedEdge{corners[1], corners[2]});
        }
    };
    others_.reserve(boundary.facets.size());
    visit_buckets<UndirectedEdge>(vertices.size(), boundary.facets.size(), for_each_facet,
                                  [&](std::size_t vertex, std::span<UndirectedEdge> others) {
                                      others_.insert(others_.end(), others.begin(), others.end());
                                      end_[vertex + 1] = count_of(others_);
                                  });
}

bool ForcedCells::is_on_surface(Triangle face) const {
    std::sort(face.begin(), face.end());
    const auto begin = others_.begin() + end_[face[0]], end = others_.begin() + end_[face[0] + 1];
    return std::find(begin, end, UndirectedEdge{face[1], face[2]}) != end;
}

bool ForcedCells::contains(const Tetrahedron& cell, double smallest_deg) {
    if (!(smallest_deg > 0) || smallest_deg >= largest_bound_deg) return false;
    const double limit = std::min(largest_bound_deg, smallest_deg / least_share) * std::numbers::pi / 180;
    std::array<Triangle, 4> faces;
    std::array<bool, 4> is_facet{};
    std::array<Vec3, 4> normals;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto& [a, b, c] = tet_faces[i];
        faces[i] = {cell[a], cell[b], cell[c]};
        is_facet[i] = is_on_surface(faces[i]);
    }
    if (std::count(is_facet.begin(), is_facet.end(), true) == 0) return false;
    for (std::size_t i = 0; i < 4; ++i) normals[i] = doubled_area_vector(vertices_, faces[i]).normalized();
    for (std::size_t i = 0; i < 4; ++i) {
        if (!is_facet[i]) continue;
        double smallest = std::numbers::pi;
        for (std::size_t j = 0; j < 4; ++j) {
            if (i == j) continue;
            const double angle = angle_between(normals[i], -normals[j]);
            if (is_facet[j] && angle < limit) return true;
            smallest = std::min(smallest, angle);
        }
        if (smallest < limit && is_shallow(faces[i], std::tan(smallest), std::tan(limit))) return true;
    }
    return false;
}

// Returns whether the body ends behind a face of a cell, at less than `limit` times the radius of the face's inscribed
// circle. The cell itself lies there, so that the body does not end before `cell_depth` of these radii.
bool ForcedCells::is_shallow(const Triangle& face, double cell_depth, double limit) {
    if (!tree_) tree_.emplace(vertices_, std::vector<Triangle>(boundary_.facets.begin(), boundary_.facets.end()));
    const auto [centre, radius] = inscribed_circle(vertices_[face[0]], vertices_[face[1]], vertices_[face[2]]);
    constexpr double rounding = 1e-6;
    const double from = cell_depth * (1 - rounding);
    const auto is_interface = [&](std::int32_t f) { return boundary_.is_interface[f] != 0; };
    const double wall =
        tree_->first_hit(centre, -radius, from, limit, [&](std::int32_t f) { return !is_interface(f); });
    return wall < limit && tree_->first_hit(centre, -radius, from, wall, is_interface) >= wall;
}

}  // namespace kerf

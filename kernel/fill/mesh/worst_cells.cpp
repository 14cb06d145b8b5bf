// Causes are asked for one after the other, the inevitable ones first. The body is sharp at an edge of a cell if two
// facets meet there with an angle of which the cell has a good part (ForcedCells::least_share). Walls are near if rays
// from the cell's centre, across its largest face, leave the body to both sides within a part of the circle in that
// face: a cell that lies flat on one wall has the depth of the body on its other side, and a needle is narrower than
// the fibre on which it lies is thick. All lists and trees are made only where there are sharp cells.
#include "fill/mesh/worst_cells.h"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <optional>
#include <vector>

#include "base/core/check.h"
#include "base/geometry/angles.h"
#include "base/geometry/triangle.h"
#include "fill/mesh/quality.h"
#include "surface/soup/triangle_tree.h"

namespace kerf {

namespace {

constexpr double needle_deg = 10;        // smallest angle of a facet that counts as a needle
constexpr double walls_of_radius = 0.5;  // most distance of walls, as a share of the radius of the circle in a face

std::vector<Tetrahedron> sharp_cells(const TetMesh& mesh, std::vector<double>& angles) {
    constexpr std::size_t at_once = 256;
    std::vector<Tetrahedron> sharp;
    std::array<double, at_once> degrees;
    const std::span<const Tetrahedron> all(mesh.tets.data(), mesh.tets.size());
    for (std::size_t begin = 0; begin < all.size(); begin += at_once) {
        const auto cells = all.subspan(begin, std::min(at_once, all.size() - begin));
        measure_min_dihedrals(mesh.vertices, cells, std::span(degrees).first(cells.size()));
        for (std::size_t i = 0; i < cells.size(); ++i)
            if (degrees[i] < WorstCells::bound_deg) {
                sharp.push_back(cells[i]);
                angles.push_back(degrees[i]);
            }
    }
    return sharp;
}

class Surroundings {
 public:
    Surroundings(const TetMesh& mesh, const BoundaryTriangles& boundary)
        : vertices_(mesh.vertices),
          boundary_(boundary),
          tree_(mesh.vertices, std::vector<Triangle>(boundary.facets.begin(), boundary.facets.end())),
          on_cut_(mesh.vertices.size(), 0) {
        for (std::int32_t f = 0; f < count_of(boundary.facets); ++f) {
            const Triangle& corners = boundary.facets[f];
            for (std::size_t i = 0; i < 3; ++i) {
                if (boundary.is_interface[f]) {
                    on_cut_[corners[i]] = 1;
                    continue;
                }
                corners_.push_back({corners[i], f});
                sides_.push_back({undirected(corners[i], corners[(i + 1) % 3]), f});
            }
        }
        std::sort(sides_.begin(), sides_.end());
        std::sort(corners_.begin(), corners_.end());
    }

    struct Cause {
        SharpnessCause kind = SharpnessCause::unknown;
        double measure = 0;
        std::int32_t facet = -1;
    };
    Cause cause_of(const Tetrahedron& cell, double angle_deg) const {
        const std::vector<std::int32_t> facets = facets_at(cell);
        if (const auto cause = sharp_edge(facets, angle_deg)) return *cause;
        if (const auto cause = near_walls(cell)) return *cause;
        if (const auto cause = needle(facets)) return *cause;
        if (const auto cause = needle(facets_around(cell))) return *cause;
        const bool at_cut = std::any_of(cell.begin(), cell.end(), [&](std::int32_t v) { return on_cut_[v] != 0; });
        return {at_cut ? SharpnessCause::cut : SharpnessCause::unknown, 0, facets.empty() ? -1 : facets.front()};
    }

 private:
    struct Side {
        UndirectedEdge edge;
        std::int32_t facet;
        auto operator<=>(const Side&) const = default;
    };

    // Returns the user's facets at the edges of a cell, those of an edge behind each other.
    std::vector<std::int32_t> facets_at(const Tetrahedron& cell) const {
        std::vector<std::int32_t> facets;
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = i + 1; j < 4; ++j) {
                const UndirectedEdge edge = undirected(cell[i], cell[j]);
                auto side = std::lower_bound(sides_.begin(), sides_.end(), Side{edge, -1});
                for (; side != sides_.end() && side->edge == edge; ++side) facets.push_back(side->facet);
            }
        return facets;
    }

    // Returns the user's facets at the vertices of a cell.
    std::vector<std::int32_t> facets_around(const Tetrahedron& cell) const {
        std::vector<std::int32_t> facets;
        for (const std::int32_t v : cell) {
            auto corner = std::lower_bound(corners_.begin(), corners_.end(), std::array{v, -1});
            for (; corner != corners_.end() && (*corner)[0] == v; ++corner) facets.push_back((*corner)[1]);
        }
        return facets;
    }

    Vec3 normal(std::int32_t f) const { return doubled_area_vector(vertices_, boundary_.facets[f]); }

    // The angle of the body between two facets with a common edge; 180 where it is hollow there.
    double angle_of_body(std::int32_t f, std::int32_t g) const {
        const Triangle &a = boundary_.facets[f], &b = boundary_.facets[g];
        for (std::size_t i = 0; i < 3; ++i) {
            const std::int32_t apex = b[i];
            if (std::find(a.begin(), a.end(), apex) != a.end()) continue;
            if ((vertices_[apex] - vertices_[a[0]]).dot(normal(f)) >= 0) return 180;
        }
        return angle_between(normal(f), -normal(g)) * 180 / std::numbers::pi;
    }

    bool share_an_edge(std::int32_t f, std::int32_t g) const {
        const Triangle &a = boundary_.facets[f], &b = boundary_.facets[g];
        return std::count_if(a.begin(), a.end(),
                             [&](std::int32_t v) { return std::find(b.begin(), b.end(), v) != b.end(); }) == 2;
    }

    std::optional<Cause> sharp_edge(const std::vector<std::int32_t>& facets, double angle_deg) const {
        Cause sharpest{SharpnessCause::edge, std::min(angle_deg / ForcedCells::least_share, needle_deg), -1};
        for (std::size_t i = 0; i + 1 < facets.size(); ++i) {
            const std::int32_t f = facets[i], g = facets[i + 1];
            if (f == g || !share_an_edge(f, g)) continue;
            if (const double angle = angle_of_body(f, g); angle < sharpest.measure)
                sharpest = {sharpest.kind, angle, f};
        }
        if (sharpest.facet < 0) return std::nullopt;
        return sharpest;
    }

    std::optional<Cause> near_walls(const Tetrahedron& cell) const {
        Triangle largest{};
        double largest_area = 0;
        Vec3 centre = Vec3::Zero();
        for (std::size_t i = 0; i < 4; ++i) {
            centre += vertices_[cell[i]] / 4;
            const Triangle face = {cell[tet_faces[i][0]], cell[tet_faces[i][1]], cell[tet_faces[i][2]]};
            const double area = doubled_area_vector(vertices_, face).norm();
            if (area > largest_area) largest = face, largest_area = area;
        }
        if (largest_area == 0) return std::nullopt;
        const auto [middle, radius] =
            inscribed_circle(vertices_[largest[0]], vertices_[largest[1]], vertices_[largest[2]]);
        std::int32_t facet = -1;
        const auto is_users = [&](std::int32_t f) { return boundary_.is_interface[f] == 0 && (facet = f, true); };
        const double outwards = tree_.first_hit(centre, radius, 0, walls_of_radius, is_users),
                     inwards = tree_.first_hit(centre, -radius, 0, walls_of_radius, is_users);
        if (!(outwards + inwards < walls_of_radius)) return std::nullopt;
        return Cause{SharpnessCause::walls, (outwards + inwards) * radius.norm(), facet};
    }

    std::optional<Cause> needle(const std::vector<std::int32_t>& facets) const {
        Cause sharpest{SharpnessCause::facet, needle_deg, -1};
        for (const std::int32_t f : facets) {
            const auto& [a, b, c] = boundary_.facets[f];
            const double angle = smallest_angle_degrees({vertices_[a], vertices_[b], vertices_[c]});
            if (angle < sharpest.measure) sharpest = {sharpest.kind, angle, f};
        }
        if (sharpest.facet < 0) return std::nullopt;
        return sharpest;
    }

    const std::vector<Vec3>& vertices_;
    BoundaryTriangles boundary_;
    TriangleTree tree_;
    std::vector<char> on_cut_;                          // #V
    std::vector<Side> sides_;                           // of the user's facets, ascending
    std::vector<std::array<std::int32_t, 2>> corners_;  // vertices with the user's facets, ascending
};

}  // namespace

void SharpCells::add(const SharpCells& other) {
    const std::int64_t both = count + other.count;
    if (other.angle_deg < angle_deg) *this = other;
    count = both;
}

std::int64_t WorstCells::count() const {
    return std::accumulate(by_cause.begin(), by_cause.end(), std::int64_t{0},
                           [](std::int64_t sum, const SharpCells& cells) { return sum + cells.count; });
}

WorstCells find_worst_cells(const TetMesh& mesh, const BoundaryTriangles& boundary,
                            std::span<const std::int32_t> patch) {
    KERF_CHECK(patch.size() == boundary.facets.size());
    WorstCells worst;
    std::vector<double> angles;
    const std::vector<Tetrahedron> cells = sharp_cells(mesh, angles);
    if (cells.empty()) return worst;
    const Surroundings surroundings(mesh, boundary);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto& [a, b, c, d] = cells[i];
        const auto& at = mesh.vertices;
        const Surroundings::Cause cause = surroundings.cause_of(cells[i], angles[i]);
        const std::int32_t of_facet = cause.facet < 0 ? -1 : patch[cause.facet];
        worst.by_cause[static_cast<std::size_t>(cause.kind)].add(
            {1, angles[i], (at[a] + at[b] + at[c] + at[d]) / 4, cause.measure, of_facet});
    }
    return worst;
}

}  // namespace kerf

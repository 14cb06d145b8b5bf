// The body-centred cubic lattice and its tetrahedra, the best of those that fill space with a single shape.
//
// The sites of a lattice of edge a are the corners of the cubes of edge a that fill space, and their centres. Their
// coordinates are integers in units of a/2, all three even (corners) or all three odd (centres). A cube has the number
// of its lowest corner divided by 2, and two sites, this corner and its centre: 2 * cube + parity is the site.
//
// Each site has 14 neighbours, 6 at distance a along the axes and 8 at sqrt(3)/2 a. A cell is the hull of two edges of
// length a at right angles, one of corners and one of centres, a/2 apart: 6 cells a site, 24 around each, of volume
// a^3/12, with dihedral angles of 60 (four) and 90 degrees (two). They are the Delaunay triangulation of the sites.
#pragma once

#include <array>
#include <cstdint>

#include "base/core/check.h"
#include "base/core/mixed_bits.h"
#include "base/core/types.h"

namespace kerf {

/// Coordinates of a site in half edges: all even or all odd.
using LatticeSite = std::array<std::int32_t, 3>;

constexpr LatticeSite operator+(const LatticeSite& a, const LatticeSite& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

/// The places of the sites of a lattice. Its origin and axes are the same for all surfaces, so that all parts of a body
/// have the same points: these depend on edge and site alone.
class BccLattice {
 public:
    /// Bound of the coordinates of sites, so that doubles resolve the jitter.
    static constexpr std::int32_t most_half_edges = 1 << 30;
    /// Most distance of a coordinate of a point from its place, in edges. The sign of a determinant of points in exact
    /// position is 0 as often as not, and slow to find; this much is enough to avoid that, and changes no angle.
    static constexpr double jitter = 1e-6;

    /// Takes the length of an edge, finite and positive.
    explicit BccLattice(double edge) : edge_(edge), half_edge_(edge / 2) { KERF_CHECK(edge > 0); }

    double edge() const { return edge_; }
    /// Returns the volume of a cell, but for the jitter.
    double cell_volume() const { return edge_ * edge_ * edge_ / 12; }

    /// Returns the point of a site, whose coordinates must be below most_half_edges.
    Vec3 point(const LatticeSite& site) const {
        std::uint64_t bits = hash(site);
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis, bits >>= 21) {
            constexpr double to_one = 0x1p-20;
            const double random = to_one * (bits & 0x1fffff) - 1;
            p[axis] = (site[axis] + origin[axis] + 2 * jitter * random) * half_edge_;
        }
        return p;
    }
    /// Returns the coordinates of a point in the units of sites, without jitter.
    Vec3 coordinates(const Vec3& p) const {
        return {p[0] / half_edge_ - origin[0], p[1] / half_edge_ - origin[1], p[2] / half_edge_ - origin[2]};
    }

 private:
    // Position of site 0, in half edges: a place that surfaces in regular position hardly share.
    static constexpr std::array<double, 3> origin = {0.8191725134, 0.6710436067, 0.5497004779};

    // Returns 64 bits in which every bit of the site has a say.
    static constexpr std::uint64_t hash(const LatticeSite& site) {
        const auto word = [&](int axis) -> std::uint64_t { return static_cast<std::uint32_t>(site[axis]); };
        return mixed_bits(word(0) * 0x9e3779b97f4a7c15 ^ word(1) * 0xc2b2ae3d27d4eb4f ^ word(2) * 0x165667b19e3779f9);
    }

    double edge_, half_edge_;
};

/// A cell at site 0, by its three other corners: positively oriented after site 0.
struct LatticeCell {
    std::array<LatticeSite, 3> corners;
    /// Corner 0 of the cell across the face of these three.
    LatticeSite mirrored;
};

/// The steps from a site to its neighbours.
inline constexpr std::array<LatticeSite, 14> lattice_neighbours = {{{2, 0, 0},
                                                                    {-2, 0, 0},
                                                                    {0, 2, 0},
                                                                    {0, -2, 0},
                                                                    {0, 0, 2},
                                                                    {0, 0, -2},
                                                                    {1, 1, 1},
                                                                    {1, 1, -1},
                                                                    {1, -1, 1},
                                                                    {1, -1, -1},
                                                                    {-1, 1, 1},
                                                                    {-1, 1, -1},
                                                                    {-1, -1, 1},
                                                                    {-1, -1, -1}}};

namespace detail {

constexpr LatticeCell make_lattice_cell(int axis, int direction, int quarter) {
    // The centre of an edge along the axis lies in a square of sites of the other kind, two of which in a row belong to
    // a cell.
    constexpr std::array<std::array<int, 2>, 4> square = {{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    LatticeCell cell{};
    cell.corners[0][axis] = 2 * direction;
    for (int i = 0; i < 2; ++i) {
        // Turning in the other direction keeps the orientation.
        const auto& corner = square[(quarter + (direction > 0 ? i : 1 - i)) % 4];
        LatticeSite& site = cell.corners[1 + i];
        site[axis] = direction, site[u] = corner[0], site[v] = corner[1];
    }
    cell.mirrored = cell.corners[1] + cell.corners[2];
    return cell;
}

constexpr std::array<LatticeCell, 24> make_lattice_cells() {
    std::array<LatticeCell, 24> cells{};
    for (int i = 0; i < 24; ++i) cells[i] = make_lattice_cell(i / 4 % 3, i < 12 ? 1 : -1, i % 4);
    return cells;
}

}  // namespace detail

/// All cells at site 0. Taken at all even sites, they have every cell twice; their first 12 have every cell once.
inline constexpr std::array<LatticeCell, 24> lattice_cells = detail::make_lattice_cells();
inline constexpr int cells_per_cube = 12;

}  // namespace kerf

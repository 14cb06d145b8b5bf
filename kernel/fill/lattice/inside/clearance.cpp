// One facet after the other takes sites away. Blocks in its box are asked first: by the distance of a block's middle,
// all of its sites may be far, or all near. Else the sites in the box, of each parity, are tried, by the distance from
// the facet's plane and then from the facet. A distance from the same corners in another order may differ in its last
// bit, so the corners of a facet are sorted by their coordinates; that makes the result independent of their order.
// `slack` covers jitter and rounding, so that no site is lost by a box that is too small.
#include "fill/lattice/inside/clearance.h"

#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "base/geometry/closest_point.h"
#include "base/geometry/predicates.h"
#include "base/geometry/triangle.h"

namespace kerf {

namespace {

// The cubes from first to last along an axis; none if last < first.
struct CubeRange {
    std::int32_t first, last;
};

// A facet, and the distance that sites must have from it.
struct Obstacle {
    Vec3 a, b, c;  // corners in an order that depends on the points alone
    Vec3 normal;
    double distance;

    Obstacle(const SurfaceArrays& surface, const Triangle& facet, double lattice_edge) {
        std::array<Vec3, 3> corners;
        for (int i = 0; i < 3; ++i) corners[i] = surface.vertices[facet[i]];
        std::sort(corners.begin(), corners.end(), lexicographically_less);
        a = corners[0], b = corners[1], c = corners[2];
        normal = doubled_area_vector(a, b, c).normalized();
        distance = clearance(((b - a).norm() + (c - b).norm() + (a - c).norm()) / 3, lattice_edge);
    }

    double distance_to_plane(const Vec3& p) const { return std::abs(normal.dot(p - a)); }
    double distance_to(const Vec3& p) const { return point_triangle_distance(p, a, b, c); }
};

// Removes the sites near one facet after the other.
class SiteRemover {
 public:
    SiteRemover(const BccLattice& lattice, SiteSet& sites) : lattice_(lattice), sites_(sites) {}

    void remove_near(const Obstacle& obstacle) {
        if (sites_.blocks.size() == 0) return;
        const Vec3 margin = Vec3::Constant(obstacle.distance + slack * lattice_.edge());
        const Vec3 low = lattice_.coordinates(obstacle.a.cwiseMin(obstacle.b).cwiseMin(obstacle.c) - margin);
        const Vec3 high = lattice_.coordinates(obstacle.a.cwiseMax(obstacle.b).cwiseMax(obstacle.c) + margin);
        const BlockCoordinates lowest = sites_.blocks.lowest(), highest = sites_.blocks.highest();
        BlockCoordinates first, last;
        for (int axis = 0; axis < 3; ++axis) {
            for (int parity = 0; parity < 2; ++parity) range_[parity][axis] = cubes(low[axis], high[axis], parity);
            first[axis] = std::max(std::min(range_[0][axis].first, range_[1][axis].first) >> 3, lowest[axis]);
            last[axis] = std::min(std::max(range_[0][axis].last, range_[1][axis].last) >> 3, highest[axis]);
        }
        for (std::int32_t z = first[2]; z <= last[2]; ++z)
            for (std::int32_t y = first[1]; y <= last[1]; ++y) {
                const std::int32_t end = sites_.blocks.lower_bound({last[0] + 1, y, z});
                for (std::int32_t i = sites_.blocks.lower_bound({first[0], y, z}); i < end; ++i)
                    remove_in_block(obstacle, i);
            }
    }

 private:
    // A length in edges, far above the jitter and rounding errors.
    static constexpr double slack = 1e-5;

    // Returns the cubes whose site of the parity is between low and high.
    static CubeRange cubes(double low, double high, int parity) {
        const auto limit = [](double x) {
            constexpr double most = BccLattice::most_half_edges;
            return std::clamp(x, -most, most);
        };
        return {static_cast<std::int32_t>(limit(std::ceil((low - parity) / 2))),
                static_cast<std::int32_t>(limit(std::floor((high - parity) / 2)))};
    }

    void remove_in_block(const Obstacle& obstacle, std::int32_t block) {
        const LatticeSite lowest = sites_.blocks.lowest_site(block);
        constexpr int middle_site = block_edge;
        const Vec3 middle = lattice_.point(lowest + LatticeSite{middle_site, middle_site, middle_site});
        const double radius = (0.5 * block_edge * std::sqrt(3.0) + slack) * lattice_.edge();
        const double distance = obstacle.distance_to(middle);
        if (distance - radius >= obstacle.distance) return;
        if (distance + radius < obstacle.distance) {
            sites_.bits[block] = {};
            return;
        }
        for (int parity = 0; parity < 2; ++parity) remove_in_block(obstacle, block, parity, lowest);
    }

    void remove_in_block(const Obstacle& obstacle, std::int32_t block, int parity, const LatticeSite& lowest) {
        std::array<CubeRange, 3> in_block;
        for (int axis = 0; axis < 3; ++axis)
            in_block[axis] = {std::max(range_[parity][axis].first - lowest[axis] / 2, 0),
                              std::min(range_[parity][axis].last - lowest[axis] / 2, block_edge - 1)};
        const auto& [x, y, z] = in_block;
        if (x.last < x.first) return;
        const unsigned mask = (2U << x.last) - (1U << x.first);
        for (std::int32_t k = z.first; k <= z.last; ++k)
            for (std::int32_t j = y.first; j <= y.last; ++j) {
                std::uint8_t& row = sites_.bits[block][row_number(parity, j, k)];
                if ((row & mask) == 0) continue;
                const LatticeSite first = lowest + LatticeSite{parity, 2 * j + parity, 2 * k + parity};
                row &= ~near_sites(obstacle, first, row & mask);
            }
    }

    // Returns those of the candidates, a bit each in a row, that are near the obstacle.
    unsigned near_sites(const Obstacle& obstacle, const LatticeSite& first, unsigned candidates) const {
        unsigned near = 0;
        for_each_bit(candidates, [&](int x) {
            const Vec3 p = lattice_.point(first + LatticeSite{2 * x, 0, 0});
            if (obstacle.distance_to_plane(p) > obstacle.distance * (1 + slack)) return;
            if (obstacle.distance_to(p) < obstacle.distance) near |= 1U << x;
        });
        return near;
    }

    const BccLattice& lattice_;
    SiteSet& sites_;
    std::array<std::array<CubeRange, 3>, 2> range_ = {};  // cubes around the obstacle, for both parities
};

}  // namespace

void remove_sites_near(const SurfaceArrays& surface, const BccLattice& lattice, SiteSet& sites) {
    SiteRemover remover(lattice, sites);
    for (const Triangle& facet : surface.facets) remover.remove_near(Obstacle(surface, facet, lattice.edge()));
}

}  // namespace kerf

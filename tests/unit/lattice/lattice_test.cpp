// The lattice and the core that is stamped of it, against definitions that are tried on every site.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "base/core/error.h"
#include "base/geometry/closest_point.h"
#include "fill/lattice/lattice_core.h"
#include "support/face.h"
#include "support/shapes.h"

namespace kerf {
namespace {

using namespace test;

using Coordinates = std::array<double, 3>;
using PointSet = std::set<Coordinates>;
using CellSet = std::set<std::array<Coordinates, 4>>;

Coordinates to_array(const Vec3& p) { return {p[0], p[1], p[2]}; }

double volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return (b - a).dot((c - a).cross(d - a)) / 6;
}

// ---------------------------------------------------------------------------------------------- the lattice by itself

Vec3 to_vector(const LatticeSite& site) { return Vec3(site[0], site[1], site[2]); }

TEST(BccLattice, CellsAreTheHullsOfTwoEdgesAtRightAngles) {
    const std::set<LatticeSite> neighbours(lattice_neighbours.begin(), lattice_neighbours.end());
    EXPECT_EQ(neighbours.size(), 14U);
    for (const LatticeCell& cell : lattice_cells) {
        const std::array<Vec3, 4> p = {Vec3::Zero(), to_vector(cell.corners[0]), to_vector(cell.corners[1]),
                                       to_vector(cell.corners[2])};
        EXPECT_EQ(volume(p[0], p[1], p[2], p[3]), 8.0 / 12);  // the edge has two units
        std::multiset<double> lengths_sq;
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < i; ++j) lengths_sq.insert((p[i] - p[j]).squaredNorm());
        EXPECT_EQ(lengths_sq, (std::multiset<double>{3, 3, 3, 3, 4, 4}));
        for (const LatticeSite& corner : cell.corners) EXPECT_TRUE(neighbours.contains(corner));
        // The cell across has the face and its other corner on the other side.
        const Vec3 other = to_vector(cell.mirrored);
        EXPECT_EQ(volume(other, p[1], p[2], p[3]), -8.0 / 12);
        for (int i = 1; i < 4; ++i) {
            const Vec3 d = other - p[i];
            EXPECT_TRUE(d.squaredNorm() == 3 || d.squaredNorm() == 4);
        }
    }
}

TEST(BccLattice, CellsFillSpaceOnce) {
    // Periodic: 4 cubes along each axis.
    constexpr int period = 8;
    const auto wrapped = [](LatticeSite site) {
        for (std::int32_t& x : site) x &= period - 1;
        return site;
    };
    std::map<std::set<LatticeSite>, int> faces;
    std::set<std::set<LatticeSite>> cells, cells_at_all_sites;
    for (int i = 0; i < period * period * period; ++i) {
        const LatticeSite site = {i % period, i / period % period, i / period / period};
        const bool is_even = site[0] % 2 == 0 && site[1] % 2 == 0 && site[2] % 2 == 0;
        const bool is_odd = site[0] % 2 == 1 && site[1] % 2 == 1 && site[2] % 2 == 1;
        if (!is_even && !is_odd) continue;
        for (int c = 0; c < 24; ++c) {
            std::set<LatticeSite> cell = {site};
            for (const LatticeSite& corner : lattice_cells[c].corners) cell.insert(wrapped(site + corner));
            ASSERT_EQ(cell.size(), 4U);
            cells_at_all_sites.insert(cell);
            if (!is_even || c >= cells_per_cube) continue;
            EXPECT_TRUE(cells.insert(cell).second);
            for (const LatticeSite& left_out : cell) {
                std::set<LatticeSite> face = cell;
                face.erase(left_out);
                ++faces[face];
            }
        }
    }
    EXPECT_EQ(cells.size(), 4U * 4 * 4 * cells_per_cube);
    EXPECT_EQ(cells, cells_at_all_sites);
    for (const auto& [face, count] : faces) EXPECT_EQ(count, 2);
}

TEST(BccLattice, PointsAreBesideTheirPlacesByTheJitter) {
    const BccLattice lattice(0.37);
    double largest = 0, smallest = 1;
    for (int i = -500; i < 500; ++i) {
        const LatticeSite site = {2 * i + 1, 6 * i - 3, 1 - 4 * i};
        const Vec3 away = (lattice.coordinates(lattice.point(site)) - to_vector(site)).cwiseAbs() / 2;
        largest = std::max(largest, away.maxCoeff());
        smallest = std::min(smallest, away.maxCoeff());
    }
    EXPECT_LE(largest, 1.001e-6);
    EXPECT_GE(largest, 0.99e-6);
    EXPECT_LE(smallest, 0.5e-6);
}

TEST(BccLattice, IsTheSameAtEveryScale) {
    for (int i = -20; i < 20; ++i) {
        const LatticeSite site = {2 * i, 100 - 6 * i, 4 * i};
        EXPECT_EQ(8 * BccLattice(0.3).point(site), BccLattice(2.4).point(site));
    }
}

// ------------------------------------------------------------------------------------------------------------- bodies

struct Body {
    std::string name;
    SurfaceArrays surface;
    double edge;
};

SurfaceArrays turned_at_random(Soup soup, std::mt19937& random, const Vec3& offset = Vec3::Zero()) {
    const auto next = [&] { return 0x1p-31 * random() - 1; };
    const double angle = 3 * next();
    const Vec3 axis = Vec3(next(), next(), next()).normalized();
    const Eigen::AngleAxisd rotation(angle, axis);
    for (Vec3& p : soup.vertices) p = rotation * p + offset;
    return to_arrays(soup);
}

Soup hollow_sphere() { return join(icosphere(2), inside_out(icosphere(1, 0.3, Vec3(0.1, 0, 0)))); }

std::vector<Body> bodies() {
    std::mt19937 random(7);
    const Vec3 low = Vec3::Zero(), high(1.3, 1, 1.6);
    const Vec3 far(1e5, -3e4, 7e3);
    return {{"sphere", to_arrays(icosphere(2)), 0.13},
            {"torus", to_arrays(torus(1, 0.45, 24, 12)), 0.12},
            {"box", to_arrays(box(low, high, 8)), 0.11},
            {"box whose sides are planes of sites", to_arrays(box(BccLattice(0.125).point({0, 0, 0}), high, 8)), 0.125},
            {"coarse box", to_arrays(box(low, high, {5, 4, 6})), 0.1},
            {"turned box", turned_at_random(box(low, high, 8), random), 0.11},
            {"hollow sphere", to_arrays(hollow_sphere()), 0.12},
            {"hollow sphere, turned", turned_at_random(hollow_sphere(), random), 0.12},
            {"boxes in boxes", turned_at_random(nested_boxes(2, 8), random), 0.2},
            {"linked rings", turned_at_random(linked_rings(2, 30, 10), random), 0.25},
            {"plate", turned_at_random(box(low, Vec3(2, 2, 0.4), {16, 16, 4}), random), 0.1},
            {"far torus", turned_at_random(torus(1, 0.45, 24, 12), random, far), 0.12},
            {"far from the origin", to_arrays(translated(icosphere(2), far)), 0.125}};
}

// How often the surface goes around the point; from the solid angles of its facets.
int winding_number(const SurfaceArrays& surface, const Vec3& point) {
    double angle = 0;
    for (const Triangle& t : surface.facets) {
        const Vec3 a = surface.vertices[t[0]] - point, b = surface.vertices[t[1]] - point,
                   c = surface.vertices[t[2]] - point;
        angle += 2 * std::atan2(a.dot(b.cross(c)), a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                                                       b.dot(c) * a.norm() + c.dot(a) * b.norm());
    }
    return static_cast<int>(std::lround(angle / (4 * std::numbers::pi)));
}

// A facet, what is too near, and where that cannot be.
struct Obstacle {
    Vec3 a, b, c;
    double distance, reach_sq;  // from a

    bool is_near(const Vec3& p) const {
        return (p - a).squaredNorm() < reach_sq && point_triangle_distance(p, a, b, c) < distance;
    }
};

std::vector<Obstacle> obstacles_of(const SurfaceArrays& surface, double edge) {
    std::vector<Obstacle> obstacles;
    for (const Triangle& t : surface.facets) {
        const Vec3 &a = surface.vertices[t[0]], &b = surface.vertices[t[1]], &c = surface.vertices[t[2]];
        const double perimeter = (b - a).norm() + (c - b).norm() + (a - c).norm();
        const double distance = std::max(0.5 * perimeter / 3, 0.8 * edge), reach = distance + perimeter;
        obstacles.push_back({a, b, c, distance, reach * reach});
    }
    return obstacles;
}

using Sites = std::set<LatticeSite>;

// Far enough from all facets, on either side.
Sites sites_away(const SurfaceArrays& surface, const BccLattice& lattice) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : surface.vertices) box.extend(lattice.coordinates(p));
    const auto first = [&](int axis) { return static_cast<std::int32_t>(std::floor(box.min()[axis])); };
    const std::vector<Obstacle> obstacles = obstacles_of(surface, lattice.edge());
    const auto is_away = [&](const Vec3& p) {
        return std::none_of(obstacles.begin(), obstacles.end(), [&](const Obstacle& o) { return o.is_near(p); });
    };
    Sites away;
    for (std::int32_t z = first(2); z <= box.max()[2]; ++z)
        for (std::int32_t y = first(1); y <= box.max()[1]; ++y)
            for (std::int32_t x = first(0); x <= box.max()[0]; ++x)
                if ((x & 1) == (y & 1) && (x & 1) == (z & 1) && is_away(lattice.point({x, y, z})))
                    away.insert({x, y, z});
    return away;
}

// Neighbours that are both further away than half the distance between them are on the same side of the surface.
Sites kept_sites(const SurfaceArrays& surface, const BccLattice& lattice) {
    Sites away = sites_away(surface, lattice), kept;
    while (!away.empty()) {
        std::vector<LatticeSite> reached = {*away.begin()};
        away.erase(away.begin());
        for (std::size_t i = 0; i < reached.size(); ++i)
            for (const LatticeSite& step : lattice_neighbours)
                if (away.erase(reached[i] + step) > 0) reached.push_back(reached[i] + step);
        if (winding_number(surface, lattice.point(reached[0])) == 1) kept.insert(reached.begin(), reached.end());
    }
    return kept;
}

struct ExpectedCore {
    PointSet kept, interior;
    CellSet cells;
};

ExpectedCore expected_core(const SurfaceArrays& surface, double edge) {
    const BccLattice lattice(edge);
    const Sites kept = kept_sites(surface, lattice);
    ExpectedCore core;
    for (const LatticeSite& site : kept) {
        core.kept.insert(to_array(lattice.point(site)));
        const bool is_deep = std::all_of(lattice_neighbours.begin(), lattice_neighbours.end(),
                                         [&](const LatticeSite& step) { return kept.contains(site + step); });
        if (!is_deep) continue;
        core.interior.insert(to_array(lattice.point(site)));
        for (const LatticeCell& cell : lattice_cells) {
            std::array<Coordinates, 4> corners = {to_array(lattice.point(site))};
            for (int i = 0; i < 3; ++i) corners[i + 1] = to_array(lattice.point(site + cell.corners[i]));
            std::sort(corners.begin(), corners.end());
            core.cells.insert(corners);
        }
    }
    return core;
}

// ---------------------------------------------------------------------------------------------------------- the core

struct StampedCore {
    explicit StampedCore(const LatticeCore& core)
        : points(core.boundary_points()), boundary(core.boundary_faces()), free(core.free_points()) {
        core.append_interior_points(points);
        core.append_cells(0, core.boundary_point_count(), cells);
    }
    bool operator==(const StampedCore&) const = default;

    std::vector<Vec3> points;  // of the boundary, then those inside
    std::vector<Tetrahedron> cells;
    std::vector<Triangle> boundary;
    std::vector<Vec3> free;
};

PointSet to_set(const std::vector<Vec3>& points) {
    PointSet set;
    for (const Vec3& p : points) set.insert(to_array(p));
    EXPECT_EQ(set.size(), points.size());
    return set;
}

CellSet cell_set(const StampedCore& core) {
    CellSet set;
    for (const Tetrahedron& cell : core.cells) {
        std::array<Coordinates, 4> corners;
        for (int i = 0; i < 4; ++i) corners[i] = to_array(core.points[cell[i]]);
        std::sort(corners.begin(), corners.end());
        set.insert(corners);
    }
    EXPECT_EQ(set.size(), core.cells.size());
    return set;
}

TEST(LatticeCore, HasTheCellsOfItsDefinition) {
    for (const auto& [name, surface, edge] : bodies()) {
        SCOPED_TRACE(name);
        const ExpectedCore expected = expected_core(surface, edge);
        const LatticeCore core(surface, edge);
        const StampedCore stamped(core);
        EXPECT_GT(core.cell_count(), 0);
        EXPECT_EQ(core.cell_count(), static_cast<std::int64_t>(stamped.cells.size()));
        EXPECT_TRUE(cell_set(stamped) == expected.cells);
        std::vector<Vec3> interior;
        core.append_interior_points(interior);
        EXPECT_TRUE(to_set(interior) == expected.interior);
        PointSet all = to_set(stamped.points), free = to_set(stamped.free);
        const std::size_t in_core = all.size();
        all.merge(free);
        EXPECT_EQ(all.size(), in_core + stamped.free.size());
        EXPECT_TRUE(all == expected.kept);
    }
}

// A vertex is used, and no number is beyond the points.
void expect_used_vertices(const StampedCore& core) {
    std::vector<char> is_used(core.points.size(), 0);
    for (const Tetrahedron& cell : core.cells)
        for (const std::int32_t v : cell) {
            ASSERT_TRUE(v >= 0 && v < static_cast<std::int32_t>(is_used.size()));
            is_used[v] = 1;
        }
    EXPECT_EQ(std::count(is_used.begin(), is_used.end(), 0), 0);
}

TEST(LatticeCore, CellsArePositiveAndAllOfOneShape) {
    constexpr double tolerance = 20 * BccLattice::jitter;
    for (const auto& [name, surface, edge] : bodies()) {
        SCOPED_TRACE(name);
        const LatticeCore core(surface, edge);
        const StampedCore stamped(core);
        expect_used_vertices(stamped);
        const double short_edge = std::sqrt(3.0) / 2 * edge;
        for (const Tetrahedron& cell : stamped.cells) {
            std::array<Vec3, 4> p;
            for (int i = 0; i < 4; ++i) p[i] = stamped.points[cell[i]];
            ASSERT_NEAR(volume(p[0], p[1], p[2], p[3]) / core.lattice().cell_volume(), 1, tolerance);
            std::array<double, 6> lengths = {(p[0] - p[1]).norm(), (p[0] - p[2]).norm(), (p[0] - p[3]).norm(),
                                             (p[1] - p[2]).norm(), (p[1] - p[3]).norm(), (p[2] - p[3]).norm()};
            std::sort(lengths.begin(), lengths.end());
            for (int i = 0; i < 6; ++i) ASSERT_NEAR(lengths[i], i < 4 ? short_edge : edge, tolerance * edge);
        }
    }
}

// Faces seen from outside of their cells.
std::map<Face, int> faces_of(const std::vector<Tetrahedron>& cells) {
    std::map<Face, int> faces;
    for (const auto& [a, b, c, d] : cells)
        for (const Face& face : {Face{b, c, d}, Face{a, d, c}, Face{a, b, d}, Face{a, c, b}}) ++faces[rotated(face)];
    return faces;
}

TEST(LatticeCore, BoundaryHasEachFaceOfOneCellOnce) {
    for (const auto& [name, surface, edge] : bodies()) {
        SCOPED_TRACE(name);
        const StampedCore core{LatticeCore(surface, edge)};
        const std::map<Face, int> faces = faces_of(core.cells);
        std::set<Face> outer;
        for (const auto& [face, count] : faces) {
            ASSERT_EQ(count, 1);
            if (!faces.contains(rotated(turned(face)))) outer.insert(face);
        }
        std::set<Face> boundary;
        for (const Triangle& face : core.boundary)
            EXPECT_TRUE(boundary.insert(rotated({face[0], face[1], face[2]})).second);
        EXPECT_TRUE(boundary == outer);
        const LatticeCore again(surface, edge);
        std::set<std::int32_t> at_boundary;
        for (const Face& face : outer) at_boundary.insert(face.begin(), face.end());
        EXPECT_EQ(static_cast<std::int32_t>(at_boundary.size()), again.boundary_point_count());
        ASSERT_FALSE(at_boundary.empty());
        EXPECT_EQ(*at_boundary.rbegin() + 1, again.boundary_point_count());
    }
}

TEST(LatticeCore, BoundaryIsClosedAndEnclosesTheCells) {
    for (const auto& [name, surface, edge] : bodies()) {
        SCOPED_TRACE(name);
        const StampedCore core{LatticeCore(surface, edge)};
        std::map<std::pair<std::int32_t, std::int32_t>, int> balance;
        double enclosed = 0, cells = 0;
        const Vec3 origin = core.points[0];
        for (const auto& [a, b, c] : core.boundary) {
            for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}})
                balance[std::minmax(from, to)] += from < to ? 1 : -1;
            enclosed += volume(origin, core.points[a], core.points[b], core.points[c]);
        }
        for (const auto& [ends, sum] : balance) EXPECT_EQ(sum, 0);
        for (const auto& [a, b, c, d] : core.cells)
            cells += volume(core.points[a], core.points[b], core.points[c], core.points[d]);
        EXPECT_NEAR(enclosed, cells, 1e-9 * cells);
    }
}

TEST(LatticeCore, IsInsideAndAwayFromTheSurface) {
    for (const auto& [name, surface, edge] : bodies()) {
        SCOPED_TRACE(name);
        const StampedCore core{LatticeCore(surface, edge)};
        // Where the core is nearest to the surface: all over the faces of its boundary.
        for (std::size_t i = 0; i < core.boundary.size(); i += 7) {
            const auto& [a, b, c] = core.boundary[i];
            const Vec3 centre = (core.points[a] + core.points[b] + core.points[c]) / 3;
            double nearest = edge;
            for (const auto& [p, q, r] : surface.facets)
                nearest = std::min(nearest, point_triangle_distance(centre, surface.vertices[p], surface.vertices[q],
                                                                    surface.vertices[r]));
            EXPECT_GT(nearest, 0.24 * edge);
            EXPECT_EQ(winding_number(surface, centre), 1);
        }
    }
}

TEST(LatticeCore, IsTheSameInAnyOrderOfFacets) {
    constexpr unsigned seed = 3;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    for (auto& [name, surface, edge] : bodies()) {
        SCOPED_TRACE(name);
        const StampedCore core{LatticeCore(surface, edge)};
        std::shuffle(surface.facets.begin(), surface.facets.end(), random);
        for (Triangle& t : surface.facets) std::rotate(t.begin(), t.begin() + random() % 3, t.end());
        EXPECT_TRUE(StampedCore{LatticeCore(surface, edge)} == core);
        for (Triangle& t : surface.facets) std::swap(t[0], t[1]);
        EXPECT_TRUE(StampedCore{LatticeCore(surface, edge)} == core);
    }
}

TEST(LatticeCore, HasThePointsOfTheWholeInItsParts) {
    constexpr double edge = 0.1;
    const auto points_of = [&](const Soup& soup) {
        const StampedCore core{LatticeCore(to_arrays(soup), edge)};
        PointSet points = to_set(core.points), free = to_set(core.free);
        points.merge(free);
        return points;
    };
    const PointSet whole = points_of(box(Vec3::Zero(), Vec3(2, 1, 1), {20, 10, 10}));
    PointSet parts = points_of(box(Vec3::Zero(), Vec3::Ones(), 10));
    PointSet other = points_of(box(Vec3(1, 0, 0), Vec3(2, 1, 1), 10));
    EXPECT_GT(parts.size(), 500U);
    EXPECT_GT(other.size(), 500U);
    EXPECT_TRUE(std::includes(whole.begin(), whole.end(), parts.begin(), parts.end()));
    EXPECT_TRUE(std::includes(whole.begin(), whole.end(), other.begin(), other.end()));
}

TEST(LatticeCore, IsEmptyInThinBodies) {
    std::mt19937 random(11);
    for (int i = 0; i < 20; ++i) {
        const LatticeCore core(turned_at_random(box(Vec3::Zero(), Vec3(3, 3, 0.3), {30, 30, 3}), random), 0.2);
        const StampedCore stamped(core);
        EXPECT_EQ(core.cell_count(), 0);
        EXPECT_EQ(core.boundary_point_count() + core.interior_point_count(), 0);
        EXPECT_TRUE(stamped.points.empty() && stamped.boundary.empty() && stamped.cells.empty());
    }
    EXPECT_EQ(LatticeCore(SurfaceArrays(), 1).block_count(), 0);
    EXPECT_EQ(LatticeCore(to_arrays(tetrahedron()), 100).cell_count(), 0);
}

TEST(LatticeCore, NumbersAndAppendsAsItIsTold) {
    const LatticeCore core(to_arrays(icosphere(2)), 0.15);
    const StampedCore stamped(core);
    std::vector<Tetrahedron> cells = {{7, 8, 9, 10}};
    core.append_cells(1000, 500000, cells);
    ASSERT_EQ(cells.size(), stamped.cells.size() + 1);
    EXPECT_EQ(cells[0], (Tetrahedron{7, 8, 9, 10}));
    const std::int32_t boundary = core.boundary_point_count();
    for (std::size_t i = 0; i < stamped.cells.size(); ++i)
        for (int k = 0; k < 4; ++k) {
            const std::int32_t v = stamped.cells[i][k];
            ASSERT_EQ(cells[i + 1][k], v < boundary ? v + 1000 : v - boundary + 500000);
        }
    EXPECT_THROW(core.append_cells(0, std::numeric_limits<std::int32_t>::max(), cells), Error);
    EXPECT_EQ(cells.size(), stamped.cells.size() + 1);
}

TEST(LatticeCore, TakesMemoryForTheBodyAndNotForItsBox) {
    const auto blocks_of_rod = [](double length, const Vec3& axis) {
        const auto parts = static_cast<int>(length / 6);
        Soup rod = box(Vec3(-3, -3, 0), Vec3(3, 3, length), {1, 1, parts});
        const Eigen::AngleAxisd rotation(std::acos(axis.normalized().z()), Vec3::UnitZ().cross(axis).normalized());
        for (Vec3& p : rod.vertices) p = rotation * p;
        return LatticeCore(to_arrays(rod), 1).block_count();
    };
    // A block is 8 edges wide: the rod touches 2 x 2 beside each other if it lies along an axis, about 8 if it is
    // askew.
    for (const Vec3& axis : {Vec3(0, 0, 1), Vec3(1, 1, 1), Vec3(1, -2, 0.3), Vec3(-1, 0.1, 0.1)}) {
        const std::int32_t blocks = blocks_of_rod(1200, axis);
        EXPECT_GE(blocks, 1200 / 8);
        EXPECT_LE(blocks, 8 * 1200 / 8);
        EXPECT_NEAR(blocks_of_rod(2400, axis), 2 * blocks, 0.05 * blocks);
    }
}

TEST(LatticeCore, KeepsLessThanAByteACell) {
    const LatticeCore core(to_arrays(icosphere(3)), 0.02);
    EXPECT_GT(core.cell_count(), 4000000);
    EXPECT_LT(static_cast<double>(core.bytes()), 0.3 * static_cast<double>(core.cell_count()));
}

ErrorCode error_of(const SurfaceArrays& surface, double edge) {
    try {
        const LatticeCore core(surface, edge);
    } catch (const Error& error) {
        return error.code();
    }
    return ErrorCode::cancelled;
}

TEST(LatticeCore, RefusesWhatItCannotTellApart) {
    const Soup sphere = icosphere(1);
    EXPECT_EQ(error_of(to_arrays(translated(sphere, Vec3(0, 0, 1e9))), 0.5), ErrorCode::usage);
    EXPECT_EQ(error_of(to_arrays(sphere), 1e-9), ErrorCode::usage);
    Soup open = sphere;
    open.facets.erase(open.facets.begin() + 5);
    EXPECT_EQ(error_of(to_arrays(open), 0.1), ErrorCode::internal);
}

}  // namespace
}  // namespace kerf

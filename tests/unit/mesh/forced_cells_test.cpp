#include "fill/mesh/inside/forced_cells.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "base/geometry/angles.h"
#include "base/geometry/ray.h"
#include "fill/mesh/quality.h"
#include "fill/volume/mesher.h"
#include "support/shapes.h"

namespace kerf {
namespace {

// A wedge of this angle between two faces as long as its edge, in layers along it.
Soup wedge(double degrees, int layers) {
    const double angle = degrees * std::numbers::pi / 180;
    Soup soup;
    for (int z = 0; z <= layers; ++z)
        for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(std::cos(angle), std::sin(angle), 0)})
            soup.vertices.push_back(p + Vec3(0, 0, static_cast<double>(z) / layers));
    const auto quad = [&](std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
        soup.facets.insert(soup.facets.end(), {{a, b, c}, {a, c, d}});
    };
    for (std::int32_t v = 0; v < 3 * layers; v += 3) {
        quad(v, v + 1, v + 4, v + 3);
        quad(v + 1, v + 2, v + 5, v + 4);
        quad(v, v + 3, v + 5, v + 2);
    }
    soup.facets.push_back({0, 2, 1});
    soup.facets.push_back({3 * layers, 3 * layers + 1, 3 * layers + 2});
    soup.patch.assign(soup.facets.size(), 0);
    return soup;
}

TetMesh meshed(const SurfaceArrays& surface, double max_volume) {
    MesherOptions options;
    options.name = "tetgen";
    options.size = SizeField(max_volume);
    return mesh_volume(surface, options).mesh;
}

PartQuality quality_of(const TetMesh& mesh, const std::vector<Triangle>& facets, const std::vector<char>& cut = {}) {
    const std::vector<char> none(facets.size(), 0);
    return measure_quality(mesh, {facets, cut.empty() ? none : cut}, 2);
}

// The bounds of a cell by their definition, in degrees, the smallest of them; 180 if there is none.
class Bounds {
 public:
    explicit Bounds(const SurfaceArrays& surface) : surface_(surface) {
        for (Triangle facet : surface.facets) {
            std::sort(facet.begin(), facet.end());
            facets_.insert(facet);
        }
    }

    double of(const TetMesh& mesh, const Tetrahedron& cell) const {
        double bound = 180;
        Tetrahedron corners = cell;
        std::sort(corners.begin(), corners.end());
        do {
            const auto& [a, b, c, d] = corners;
            const auto& at = mesh.vertices;
            if (!is_facet(a, b, c)) continue;
            bound = std::min(bound, of_facet(at[a], at[b], at[c], at[d]));
            if (is_facet(a, b, d)) bound = std::min(bound, dihedral_degrees(at[a], at[b], at[c], at[d]));
        } while (std::next_permutation(corners.begin(), corners.end()));
        return bound;
    }

 private:
    bool is_facet(std::int32_t a, std::int32_t b, std::int32_t c) const {
        Triangle face = {a, b, c};
        std::sort(face.begin(), face.end());
        return facets_.contains(face);
    }
    double of_facet(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& inside) const {
        const double from_a = (c - b).norm(), from_b = (a - c).norm(), from_c = (b - a).norm();
        const double perimeter = from_a + from_b + from_c;
        const Vec3 centre = (from_a * a + from_b * b + from_c * c) / perimeter;
        Vec3 inwards = (b - a).cross(c - a).normalized();
        const double radius = (b - a).cross(c - a).norm() / perimeter;
        if (inwards.dot(inside - a) < 0) inwards = -inwards;
        double depth = 1e300;
        for (const auto& [i, j, k] : surface_.facets) {
            const auto& at = surface_.vertices;
            const double t = line_triangle_distance(centre, inwards, at[i], at[j], at[k]);
            if (t > 1e-9) depth = std::min(depth, t);
        }
        return std::atan(depth / radius) * 180 / std::numbers::pi;
    }

    const SurfaceArrays& surface_;
    std::set<Triangle> facets_;
};

TEST(ForcedCells, MayFillAnEdgeAlone) {
    // Three cells: the first has both faces at the edge from 0 to 3.
    const Soup soup = wedge(10, 1);
    TetMesh mesh;
    mesh.vertices = soup.vertices;
    mesh.tets = {{0, 1, 2, 3}};
    const std::vector<Triangle> facets = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}};
    EXPECT_EQ(quality_of(mesh, facets).angles.forced.count(), 1);
    EXPECT_EQ(quality_of(mesh, facets).angles.unforced.count(), 0);
    // An interface could have been put elsewhere.
    const PartQuality of_part = quality_of(mesh, facets, {0, 1, 0});
    EXPECT_EQ(of_part.angles.forced.count(), 0);
    EXPECT_EQ(of_part.interface.measures[0].count(), 1);
}

TEST(ForcedCells, AreThoseOfTheDefinitionAndNoCellExceedsItsBound) {
    const std::vector<std::pair<Soup, double>> bodies = {
        {wedge(10, 6), 1e-4},
        {wedge(20, 3), 1},
        {test::box(Vec3::Zero(), Vec3::Ones(), 4), 0.01},
        {test::box(Vec3(-5, -5, 0), Vec3(5, 5, 0.3), std::array{8, 8, 1}), 1},
        {test::icosphere(2), 0.01},
        {test::torus(2, 0.6, 16, 8), 0.1},
        {test::prism(24, 3, 0.4), 0.02},
        {test::plate_with_hole(12), 0.1},
        {test::nested_boxes(2, 3), 0.1},
        {test::tetrahedron(), 1}};
    for (const auto& [soup, volume] : bodies) {
        const SurfaceArrays surface = test::to_arrays(soup);
        const Bounds bounds(surface);
        const TetMesh mesh = meshed(surface, volume);
        const std::vector<char> none(surface.facets.size(), 0);
        ForcedCells forced(mesh.vertices, {surface.facets, none});
        std::int64_t count = 0;
        for (const auto& [a, b, c, d] : mesh.tets) {
            const auto& at = mesh.vertices;
            const double smallest = tet_quality(at[a], at[b], at[c], at[d]).min_dihedral_deg;
            const double bound = bounds.of(mesh, {a, b, c, d});
            EXPECT_LT(smallest, bound + 1e-5);
            const bool is_forced = forced.contains({a, b, c, d}, smallest);
            count += is_forced;
            if (std::abs(bound - ForcedCells::largest_bound_deg) < 1e-5 ||
                std::abs(bound * ForcedCells::least_share - smallest) < 1e-5)
                continue;
            EXPECT_EQ(is_forced, bound < ForcedCells::largest_bound_deg && bound * ForcedCells::least_share < smallest);
        }
        const ForcedDistributions angles = quality_of(mesh, surface.facets).angles;
        EXPECT_EQ(angles.forced.count(), count);
        EXPECT_EQ(angles.unforced.count(), std::ssize(mesh.tets) - count);
    }
}

TEST(ForcedCells, AreThereInWedgesAndThinPlatesNotInCubes) {
    for (const double degrees : {2.0, 10.0, 20.0}) {
        const SurfaceArrays surface = test::to_arrays(wedge(degrees, 2));
        const ForcedDistributions angles = quality_of(meshed(surface, 1e-3), surface.facets).angles;
        EXPECT_GE(angles.forced.count(), 2);
        EXPECT_GE(angles.forced.max(), degrees / 4);
    }
    const SurfaceArrays cube = test::to_arrays(test::box(Vec3::Zero(), Vec3::Ones(), 4));
    EXPECT_EQ(quality_of(meshed(cube, 0.01), cube.facets).angles.forced.count(), 0);
    const SurfaceArrays plate = test::to_arrays(test::box(Vec3(-5, -5, 0), Vec3(5, 5, 0.1), std::array{8, 8, 1}));
    EXPECT_GE(quality_of(meshed(plate, 1), plate.facets).angles.forced.count(), std::ssize(plate.facets) / 2);
}

// What lies behind an interface is not known.
TEST(ForcedCells, AreNotForcedByInterfaces) {
    const SurfaceArrays plate = test::to_arrays(test::box(Vec3(-5, -5, 0), Vec3(5, 5, 0.1), std::array{8, 8, 1}));
    std::vector<char> is_interface;
    for (const Triangle& facet : plate.facets) {
        double highest = 0;
        for (const std::int32_t v : facet) highest = std::max(highest, plate.vertices[v].z());
        is_interface.push_back(highest > 0);
    }
    EXPECT_EQ(quality_of(meshed(plate, 1), plate.facets, is_interface).angles.forced.count(), 0);
}

// The same cells whatever the order of corners and cells.
TEST(ForcedCells, DoNotDependOnOrders) {
    const SurfaceArrays surface = test::to_arrays(wedge(10, 6));
    TetMesh mesh = meshed(surface, 1e-3);
    std::vector<Triangle> facets = surface.facets;
    const std::int64_t expected = quality_of(mesh, facets).angles.forced.count();
    std::mt19937 random(5);
    std::shuffle(facets.begin(), facets.end(), random);
    std::shuffle(mesh.tets.begin(), mesh.tets.end(), random);
    for (Triangle& facet : facets) std::rotate(facet.begin(), facet.begin() + random() % 3, facet.end());
    for (Tetrahedron& cell : mesh.tets) std::rotate(cell.begin() + 1, cell.begin() + 1 + random() % 3, cell.end());
    EXPECT_EQ(quality_of(mesh, facets).angles.forced.count(), expected);
}

TEST(ForcedCells, CannotBeFlat) {
    TetMesh mesh;
    mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
    mesh.tets = {{0, 1, 2, 3}};
    const std::vector<Triangle> facets = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    EXPECT_EQ(quality_of(mesh, facets).angles.forced.count(), 0);
}

}  // namespace
}  // namespace kerf

#include "fill/shell/shell.h"

#include <cmath>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "base/core/error.h"
#include "base/geometry/predicates.h"
#include "fill/delaunay/delaunay.h"
#include "fill/delaunay/enclosing_faces.h"
#include "fill/lattice/lattice_core.h"
#include "fill/mesh/verification.h"
#include "fill/shell/inside/crossing.h"
#include "fill/shell/inside/face_recovery.h"
#include "fill/shell/inside/ring_flips.h"
#include "support/point_sets.h"
#include "support/shapes.h"

namespace kerf {
namespace {

constexpr unsigned shell_seed = 16;

using Random = std::mt19937;

double uniform(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}
int integer(Random& random, int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); }

std::set<Triangle> constrained_triangles(const SpatialTriangulation& triangulation) {
    std::set<Triangle> triangles;
    for (CellFace face = 0; face < 4 * triangulation.cell_count(); ++face) {
        if (!triangulation.is_constrained(face)) continue;
        Triangle corners = triangulation.face_vertices(face);
        std::sort(corners.begin(), corners.end());
        triangles.insert(corners);
    }
    return triangles;
}

std::vector<Tetrahedron> all_cells(const SpatialTriangulation& triangulation) {
    std::vector<Tetrahedron> cells;
    for (const CellId cell : triangulation.cells()) cells.push_back(triangulation.vertices(cell));
    return cells;
}

double six_volumes_of(const SpatialTriangulation& triangulation) {
    double sum = 0;
    for (const CellId cell : triangulation.cells()) {
        if (triangulation.is_ghost(cell)) continue;
        const auto& v = triangulation.vertices(cell);
        const auto& points = triangulation.points();
        const Vec3& a = points[v[0]];
        sum += (points[v[1]] - a).cross(points[v[2]] - a).dot(points[v[3]] - a);
    }
    return sum;
}

// One flip at a random place. Whether it changed anything.
bool flip_somewhere(SpatialTriangulation& triangulation, Random& random) {
    const CellId cell(integer(random, 0, triangulation.cell_count() - 1));
    if (triangulation.is_ghost(cell)) return false;
    const int i = integer(random, 0, 3), j = (i + integer(random, 1, 3)) % 4, kind = integer(random, 0, 4);
    if (kind == 0) return replace_face_by_edge(triangulation, cell_face(cell, i));
    const EdgeRing ring =
        ring_around(triangulation, cell, triangulation.vertices(cell)[i], triangulation.vertices(cell)[j]);
    const auto n = static_cast<int>(ring.size());
    const std::int32_t a = ring.ring[integer(random, 0, n - 1)], b = ring.ring[integer(random, 0, n - 1)];
    if (kind == 1) return remove_ring_edge(triangulation, ring, {});
    if (a == b || a < 0 || b < 0) return false;
    const auto new_vertices = kind == 4 ? NewVertices::allowed : NewVertices::none;
    if (kind == 2) return span_ring(triangulation, ring, a, b);
    return remove_ring_edge(triangulation, ring, std::array{a, b}, {}, new_vertices);
}

TEST(RingFlips, LeaveTriangulationsValid) {
    SCOPED_TRACE(testing::Message() << "seed " << shell_seed);
    Random random(shell_seed);
    int flipped = 0, refused = 0;
    for (const auto& [name, points] : test::point_sets()) {
        if (name.starts_with("flat")) continue;
        SCOPED_TRACE(name);
        SpatialTriangulation triangulation = delaunay(points).triangulation;
        for (CellFace face = 0; face < 4 * triangulation.cell_count(); face += 97)
            if (!triangulation.is_ghost(cell_of(face))) triangulation.constrain(face);
        const std::set<Triangle> constrained = constrained_triangles(triangulation);
        const double volume = six_volumes_of(triangulation);
        for (int k = 0; k < 400; ++k) {
            const std::vector<Tetrahedron> before = k % 20 == 0 ? all_cells(triangulation) : std::vector<Tetrahedron>();
            const std::size_t vertices = triangulation.points().size();
            if (flip_somewhere(triangulation, random)) {
                ++flipped;
                continue;
            }
            ++refused;
            ASSERT_EQ(triangulation.points().size(), vertices);
            if (!before.empty()) {
                ASSERT_EQ(all_cells(triangulation), before);
            }
        }
        test::expect_valid(triangulation);
        EXPECT_EQ(constrained_triangles(triangulation), constrained);
        EXPECT_NEAR(six_volumes_of(triangulation), volume, 1e-9 * std::abs(volume));
    }
    EXPECT_GT(flipped, 500);
    EXPECT_GT(refused, 500);
}

// What a flip makes for an edge does not cross it: less and less does.
TEST(RingFlips, MakeNothingThatCrossesTheirGoal) {
    Random random(shell_seed);
    std::vector<Vec3> points;
    for (int k = 0; k < 300; ++k)
        points.emplace_back(uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1));
    SpatialTriangulation triangulation = delaunay(points).triangulation;
    int flipped = 0;
    for (std::int32_t a = 0; a < 100; ++a) {
        const std::int32_t b = 299 - a;
        std::size_t before = crossings_of(triangulation, a, b).size();
        for (int k = 0; k < 20; ++k) {
            const std::vector<Crossing> crossings = crossings_of(triangulation, a, b);
            ASSERT_LE(crossings.size(), before);
            if (crossings.empty()) break;
            before = crossings.size();
            const Crossing& at = crossings[integer(random, 0, static_cast<int>(before) - 1)];
            if (at.is_through_edge()) continue;
            const Triangle face = triangulation.face_vertices(at.face);
            flipped += replace_face_by_edge(triangulation, at.face, Goal::edge(a, b)) ||
                       remove_ring_edge(triangulation, ring_around(triangulation, at.cell, face[0], face[1]), {},
                                        Goal::edge(a, b));
        }
    }
    EXPECT_GT(flipped, 100);
    test::expect_valid(triangulation);
}

// --- recovery ---

Soup turned(Soup soup, Random& random) {
    const Vec3 axis(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, 0.1, 1));
    const Eigen::AngleAxisd rotation(uniform(random, 0, 3), axis.normalized());
    for (Vec3& p : soup.vertices) p = rotation * p;
    return soup;
}

// A box whose sides' squares have diagonals at random, so that its Delaunay triangulation has other ones.
Soup box_with_any_diagonals(int n, Random& random) {
    Soup soup = test::box(Vec3::Zero(), Vec3(1, 1.3, 0.8), n);
    for (std::size_t f = 0; f < soup.facets.size(); f += 2) {
        Triangle &t = soup.facets[f], &s = soup.facets[f + 1];
        if (integer(random, 0, 1) == 0) continue;
        std::array<std::int32_t, 4> corners = {t[0], t[1], t[2], s[2]};
        if (s[2] == t[0] || s[2] == t[1] || s[2] == t[2]) corners = {t[0], s[1], t[1], t[2]};
        t = {corners[1], corners[2], corners[3]};
        s = {corners[0], corners[1], corners[3]};
    }
    return soup;
}

std::vector<std::pair<std::string, Soup>> surfaces_to_recover() {
    Random random(shell_seed);
    std::vector<std::pair<std::string, Soup>> surfaces;
    for (int n = 1; n <= 8; ++n) {
        const Soup box = box_with_any_diagonals(n, random);
        surfaces.emplace_back("box", box);
        surfaces.emplace_back("turned box", turned(box, random));
    }
    for (int n = 8; n <= 40; n += 8) {
        const Soup cylinder = test::twisted_cylinder(n, 6, 1, 1.5, 0.4), prism = test::prism(n, 1, 0.6);
        surfaces.emplace_back("cylinder", cylinder);
        surfaces.emplace_back("turned cylinder", turned(cylinder, random));
        surfaces.emplace_back("turned prism", turned(prism, random));
    }
    surfaces.emplace_back("turned ring", turned(test::uneven_ring(), random));
    surfaces.emplace_back("turned plate", turned(test::box(Vec3::Zero(), Vec3(9, 9, 0.5), {18, 18, 1}), random));
    return surfaces;
}

void expect_recovered(const Soup& soup) {
    SpatialTriangulation triangulation = delaunay(soup.vertices).triangulation;
    const auto before = find_faces(triangulation, soup.facets);
    const RecoveredFaces result = recover_faces(triangulation, soup.facets);
    test::expect_valid(triangulation);
    EXPECT_EQ(result.missing, std::count(before.begin(), before.end(), SpatialTriangulation::none));
    EXPECT_LE(result.split, result.missing);
    ASSERT_TRUE(result.lost.empty());
    for (const CellFace face : result.faces) EXPECT_TRUE(triangulation.is_constrained(face));
    const auto behind = cells_behind(triangulation, result.faces);
    ASSERT_TRUE(behind.has_value());
    triangulation.keep_cells(*behind);
    triangulation.add_cells(result.caps);
    TetMesh mesh = triangulation.take_mesh(true);
    mesh.boundary_vertex_count = static_cast<std::int32_t>(soup.vertices.size());
    EXPECT_TRUE(verify_mesh(mesh, test::to_arrays(soup)).hold());
}

TEST(FaceRecovery, LeavesTheBoundaryAsItIs) {
    for (const auto& [name, soup] : surfaces_to_recover()) {
        SCOPED_TRACE(testing::Message() << name << " of " << soup.facets.size() << " facets");
        expect_recovered(soup);
    }
}

// A prism whose upper side is turned, so that its sides bend inwards: no tetrahedra fill it without another vertex.
TEST(FaceRecovery, AddsAVertexToSchoenhardtsPolyhedron) {
    Soup soup = test::tetrahedron();
    soup.vertices.clear();
    for (int i = 0; i < 6; ++i) {
        const double angle = 2 * std::numbers::pi / 3 * i + (i < 3 ? 0 : 0.5);
        soup.vertices.emplace_back(std::cos(angle), std::sin(angle), i < 3 ? 0 : 1);
    }
    soup.facets = {{0, 2, 1}, {3, 4, 5}};
    for (std::int32_t i = 0; i < 3; ++i) {
        const std::int32_t j = (i + 1) % 3;
        soup.facets.insert(soup.facets.end(), {{i, j, 3 + i}, {j, 3 + j, 3 + i}});
    }
    soup.patch.assign(soup.facets.size(), 0);
    EXPECT_EQ(fill_shell(test::to_arrays(soup), {}, {}).recovery.added_vertices, 0);
    for (std::size_t f = 2; f < soup.facets.size(); f += 2) {
        const std::int32_t i = soup.facets[f][0], j = soup.facets[f][1];
        soup.facets[f] = {i, j, 3 + j};
        soup.facets[f + 1] = {i, 3 + j, 3 + i};
    }
    const FilledShell filled = fill_shell(test::to_arrays(soup), {}, {});
    EXPECT_TRUE(verify_mesh(filled.mesh, test::to_arrays(soup)).hold());
    EXPECT_GT(filled.recovery.added_vertices, 0);
}

// --- shells ---

struct Shell {
    SurfaceArrays surface;
    ShellCore core;
};

Shell shell_of(const Soup& soup, double edge) {
    Shell shell{test::to_arrays(soup), {}};
    const LatticeCore core(shell.surface, edge);
    if (core.cell_count() > 0) shell.core = {core.boundary_points(), core.boundary_faces(), core.free_points()};
    return shell;
}

// What bounds the shell: the surface, and the core's boundary turned round.
SurfaceArrays boundary_of(const Shell& shell) {
    Soup soup = test::tetrahedron();
    soup.vertices = shell.surface.vertices;
    soup.facets = shell.surface.facets;
    const auto first = static_cast<std::int32_t>(soup.vertices.size());
    soup.vertices.insert(soup.vertices.end(), shell.core.points.begin(), shell.core.points.end());
    for (const auto& [a, b, c] : shell.core.faces) soup.facets.push_back({first + a, first + c, first + b});
    soup.patch.assign(soup.facets.size(), 0);
    return test::to_arrays(soup);
}

double share_above(const TetMesh& mesh, double bound) {
    double above = 0, all = 0;
    for (const Tetrahedron& v : mesh.tets) {
        const Vec3& a = mesh.vertices[v[0]];
        const double volume = (mesh.vertices[v[1]] - a).cross(mesh.vertices[v[2]] - a).dot(mesh.vertices[v[3]] - a) / 6;
        all += volume;
        if (volume > bound * (1 + 1e-9)) above += volume;
    }
    return above / all;
}

TEST(FillShell, ObeysTheLawsAndTheBound) {
    Random random(shell_seed);
    const std::vector<std::pair<Soup, double>> cases = {
        {turned(test::box(Vec3::Zero(), Vec3::Ones(), 8), random), 0.1},
        {test::icosphere(3), 0.15},
        {turned(test::torus(2, 0.7, 40, 16), random), 0.2},
        {turned(test::nested_boxes(2, 10), random), 0.25},
        {test::join(test::icosphere(2), test::translated(test::icosphere(2), Vec3(2.05, 0, 0))), 0.2},
        {test::uv_sphere(14, 24), 0.15}};
    for (const auto& [soup, edge] : cases) {
        SCOPED_TRACE(testing::Message() << soup.patch_names[0] << ", " << soup.facets.size() << " facets");
        const Shell shell = shell_of(soup, edge);
        EXPECT_GT(shell.core.points.size(), 0U);
        const double bound = edge * edge * edge / 12 / 0.6;
        const FilledShell filled = fill_shell(shell.surface, shell.core, {SizeField(bound), 1.4});
        EXPECT_TRUE(verify_mesh(filled.mesh, boundary_of(shell)).hold());
        EXPECT_LT(share_above(filled.mesh, bound), 0.1);
        std::vector<bool> is_used(filled.mesh.vertices.size());
        for (const Tetrahedron& tet : filled.mesh.tets)
            for (const std::int32_t v : tet) is_used[v] = true;
        EXPECT_EQ(std::count(is_used.begin(), is_used.end(), false), 0);
        const FilledShell again = fill_shell(shell.surface, shell.core, {SizeField(bound), 1.4});
        EXPECT_EQ(again.mesh.tets, filled.mesh.tets);
        EXPECT_EQ(again.mesh.vertices, filled.mesh.vertices);
        EXPECT_GE(fill_shell(shell.surface, shell.core, {SizeField(bound / 8), 1.4}).refining_points,
                  filled.refining_points);
    }
}

ErrorCode error_of(const Soup& soup) {
    try {
        fill_shell(test::to_arrays(soup), {}, {});
    } catch (const Error& error) {
        return error.code();
    }
    return ErrorCode::internal;
}

TEST(FillShell, RefusesWhatHasNoInside) {
    Soup flat = test::tetrahedron(), coincident = test::box();
    for (Vec3& p : flat.vertices) p[2] = 0;
    EXPECT_EQ(error_of(flat), ErrorCode::subdomain);
    coincident.vertices.push_back(coincident.vertices[0]);
    EXPECT_EQ(error_of(coincident), ErrorCode::subdomain);
    EXPECT_EQ(error_of(test::inside_out(test::box())), ErrorCode::subdomain);
}

// With small angles between facets no bound of radius over edge can be met: it must end all the same.
TEST(Refinement, EndsNextToSmallAngles) {
    Random random(shell_seed);
    std::vector<Soup> soups;
    for (const double height : {0.3, 0.02, 1e-3}) {
        Soup wedge = test::tetrahedron();
        wedge.vertices[3] = Vec3(0.2, 0.2, height);
        soups.push_back(wedge);
        soups.push_back(turned(test::prism(12, height, 1), random));
        soups.push_back(test::box(Vec3::Zero(), Vec3(1, 1, height), {6, 6, 1}));
    }
    for (const Soup& soup : soups) {
        const SurfaceArrays surface = test::to_arrays(soup);
        for (const double bound : {0.0, 1e-4}) try {
                const FilledShell filled = fill_shell(surface, {}, {SizeField(bound), 1.2});
                EXPECT_TRUE(verify_mesh(filled.mesh, surface).hold());
                EXPECT_LT(filled.refining_points, 100000);
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ErrorCode::subdomain);
            }
    }
}

}  // namespace
}  // namespace kerf

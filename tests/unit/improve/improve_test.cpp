#include "fill/improve/improve.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "base/core/error.h"
#include "fill/improve/inside/edge_removal.h"
#include "fill/improve/inside/improved_mesh.h"
#include "fill/mesh/adjacency.h"
#include "fill/mesh/verification.h"
#include "fill/shell/shell.h"
#include "fill/volume/mesher.h"
#include "support/shapes.h"

namespace kerf {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct NamedMesh {
    std::string name;
    SurfaceArrays surface;
    TetMesh mesh;
};

NamedMesh meshed(const std::string& name, Soup soup, const SizeField& size = {}) {
    NamedMesh result{name, test::to_arrays(soup), {}};
    MesherOptions options;
    options.name = "tetgen";
    options.size = size;
    options.improve = false;
    result.mesh = mesh_volume(result.surface, options).mesh;
    return result;
}

Soup turned(Soup soup, double scale, const Vec3& offset) {
    const auto turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized());
    for (Vec3& p : soup.vertices) p = scale * (turn * p) + offset;
    return soup;
}

const std::vector<NamedMesh>& meshes() {
    static const std::vector<NamedMesh> all = {
        meshed("tetrahedron", test::tetrahedron()),
        meshed("box", test::box(Vec3::Zero(), Vec3::Ones(), 6)),
        meshed("fine box", test::box(), SizeField(2e-4)),
        meshed("plate", test::box(Vec3(-5, -5, 0), Vec3(5, 5, 0.3), std::array{8, 8, 1})),
        meshed("needle", turned(test::prism(24, 0.1, 3), 1, Vec3::Zero())),
        meshed("sphere", test::icosphere(3)),
        meshed("turned sphere far away", turned(test::uv_sphere(12, 20), 7, Vec3(1e5, -2e5, 3e5))),
        meshed("torus", turned(test::torus(2, 0.6, 32, 14), 1e-3, Vec3::Zero()), SizeField(1e-11)),
        meshed("box with a void", test::nested_boxes(2, 4)),
        meshed("two boxes", test::join(test::box(), test::translated(test::box(), Vec3(2, 3, 4))), SizeField(0.01)),
        meshed("plate with a hole", test::plate_with_hole(16))};
    return all;
}

CellShape shape_of(const TetMesh& mesh, const Tetrahedron& cell) {
    return cell_shape(mesh.vertices[cell[0]], mesh.vertices[cell[1]], mesh.vertices[cell[2]], mesh.vertices[cell[3]]);
}

double excess_of(const TetMesh& mesh, const Tetrahedron& cell, const SizeField& size) {
    Vec3 centroid = Vec3::Zero();
    for (const std::int32_t v : cell) centroid += mesh.vertices[v] / 4;
    return shape_of(mesh, cell).six_volumes / 6 / size.max_volume_at(centroid);
}

double most_excess(const TetMesh& mesh, const SizeField& size) {
    double excess = 1;
    for (const Tetrahedron& cell : mesh.tets) excess = std::max(excess, excess_of(mesh, cell, size));
    return excess;
}

struct DihedralAngles {
    Distribution smallest, largest;
};

DihedralAngles angles_of(const TetMesh& mesh) {
    const PartQuality quality = measure_quality(mesh, {}, 1);
    return {quality.all.measures[0], quality.all.measures[1]};
}

// That what was said of the angles in fact was.
void expect_angles(const Distribution& told, const TetMesh& mesh) {
    const Distribution smallest = angles_of(mesh).smallest;
    EXPECT_EQ(told.count(), smallest.count());
    EXPECT_NEAR(told.min(), smallest.min(), 1e-6);
    EXPECT_NEAR(told.percentile(0.01), smallest.percentile(0.01), 0.3);
}

std::int64_t count_bad(const TetMesh& mesh, double threshold_deg) {
    return std::count_if(mesh.tets.begin(), mesh.tets.end(), [&](const Tetrahedron& cell) {
        return shape_of(mesh, cell).badness() > square_from_degrees(threshold_deg);
    });
}

void expect_no_worse(const TetMesh& mesh, const TetMesh& as_it_was) {
    const DihedralAngles before = angles_of(as_it_was), after = angles_of(mesh);
    EXPECT_GE(after.smallest.min(), before.smallest.min() - 1e-9);
    EXPECT_LE(after.largest.max(), before.largest.max() + 1e-9);
}

// No law, but so it is.
void expect_better(const Improvement& improvement, const TetMesh& mesh, const TetMesh& as_it_was) {
    expect_no_worse(mesh, as_it_was);
    const DihedralAngles before = angles_of(as_it_was), after = angles_of(mesh);
    for (const double fraction : {0.001, 0.01, 0.03}) {
        EXPECT_GE(after.smallest.percentile(fraction), before.smallest.percentile(fraction) - 0.1);
        EXPECT_LE(after.largest.percentile(1 - fraction), before.largest.percentile(1 - fraction) + 0.1);
    }
    EXPECT_LE(improvement.bad_cells_after, improvement.bad_cells_before);
}

// The limit is that of the numbers of faces; here it is lower.
TEST(ImprovedMesh, RefusesMoreCellsThanNumbersWithoutAChange) {
    TetMesh two;  // above and below a triangle; three lie around the edge between their apices
    two.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.3, 0.3, 1), Vec3(0.3, 0.3, -1)};
    two.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}};
    two.boundary_vertex_count = 5;
    const std::array<Tetrahedron, 3> three = {{{4, 3, 0, 1}, {4, 3, 1, 2}, {4, 3, 2, 0}}};
    const auto replaced = [&](std::int32_t most) {
        ImprovedMesh improved(
            two, 0, {}, [](const CellShape&) {}, most);
        try {
            improved.replace(std::array{CellId(0), CellId(1)}, three);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::memory);
        }
        return improved.finish().tets;
    };
    EXPECT_EQ(replaced(2), two.tets);
    EXPECT_EQ(replaced(3), (std::vector<Tetrahedron>{three[0], three[1], three[2]}));
    EXPECT_THROW(replaced(1), Error);
}

TEST(Improve, ObeysTheLawsOfMeshes) {
    for (const NamedMesh& named : meshes()) {
        SCOPED_TRACE(named.name);
        for (const bool has_neighbours : {false, true}) {
            TetMesh mesh = named.mesh;
            if (has_neighbours) connect_tets(mesh);
            const Improvement improvement = improve(mesh);
            EXPECT_TRUE(verify_mesh(mesh, named.surface).hold());
            EXPECT_EQ(mesh.neighbours.size(), has_neighbours ? mesh.tets.size() : 0);
            EXPECT_EQ(static_cast<std::int64_t>(mesh.vertices.size()),
                      static_cast<std::int64_t>(named.mesh.vertices.size()) + improvement.new_vertices);
            EXPECT_EQ(mesh.boundary_vertex_count, named.mesh.boundary_vertex_count);
            expect_angles(improvement.smallest_before, named.mesh);
        }
    }
}

TEST(Improve, MakesTheWorstBetter) {
    std::int64_t bad = 0, left = 0;
    for (const NamedMesh& named : meshes())
        for (const double threshold_deg : {12.0, 25.0, 32.0}) {
            SCOPED_TRACE(named.name);
            TetMesh mesh = named.mesh;
            const Improvement improvement = improve(mesh, {.threshold_deg = threshold_deg, .evaluation_budget = 50});
            expect_better(improvement, mesh, named.mesh);
            EXPECT_EQ(improvement.bad_cells_before, count_bad(named.mesh, threshold_deg));
            EXPECT_EQ(improvement.bad_cells_after, count_bad(mesh, threshold_deg));
            bad += improvement.bad_cells_before;
            left += improvement.bad_cells_after;
        }
    EXPECT_LT(left, bad / 2);
}

// Corners of spheres one in the other lie on rays, so that four of them span a cell without volume. There are more than
// other bad cells would get vertices.
TEST(Improve, LeavesNoCellWithoutVolumeBetweenShells) {
    constexpr int shells = 10;
    Soup soup;
    for (int i = 0; i < shells; ++i) {
        const Soup sphere = test::icosphere(1, 1 - static_cast<double>(i) / (shells + 1));
        soup = test::join(std::move(soup), i % 2 ? test::inside_out(sphere) : sphere);
    }
    const SurfaceArrays surface = test::to_arrays(soup);
    TetMesh mesh = fill_shell(surface, {}, {SizeField(), 1.4}).mesh;
    ASSERT_LT(angles_of(mesh).smallest.min(), 1e-6);
    const Improvement improvement = improve(mesh);
    EXPECT_GT(improvement.new_vertices, 0);
    EXPECT_GT(angles_of(mesh).smallest.min(), 4);
    EXPECT_TRUE(verify_mesh(mesh, surface).hold());
}

// Where the surface makes most cells bad, the time it takes is bounded; the worst cells come first.
TEST(Improve, EndsWhereItHasLookedAtEnoughCells) {
    const NamedMesh named = meshed("sphere", test::icosphere(3), SizeField(4e-5));
    double last_p1 = angles_of(named.mesh).smallest.percentile(0.01);
    std::int64_t last_operations = 0;
    for (const double evaluation_budget : {0.0, 2.0, 5.0, 1e3}) {
        TetMesh mesh = named.mesh;
        const Improvement improvement = improve(mesh, {.threshold_deg = 35, .evaluation_budget = evaluation_budget});
        EXPECT_TRUE(verify_mesh(mesh, named.surface).hold());
        EXPECT_EQ(improvement.bad_cells_after, count_bad(mesh, 35));
        const std::int64_t operations = improvement.removed_edges + improvement.moved_vertices;
        EXPECT_GT(operations, last_operations);
        const double p1 = angles_of(mesh).smallest.percentile(0.01);
        EXPECT_GT(p1, last_p1);
        last_operations = operations;
        last_p1 = p1;
    }
}

TEST(Improve, AddsUp) {
    Improvement sum;
    EXPECT_TRUE(sum.is_empty());
    std::int64_t cells = 0, bad = 0;
    for (const NamedMesh& named : meshes()) {
        TetMesh mesh = named.mesh;
        const Improvement one = improve(mesh);
        sum.add(one);
        sum.add(Improvement());
        cells += static_cast<std::int64_t>(named.mesh.tets.size());
        bad += one.bad_cells_before;
    }
    EXPECT_FALSE(sum.is_empty());
    EXPECT_EQ(sum.smallest_before.count(), cells);
    EXPECT_EQ(sum.bad_cells_before, bad);
}

TEST(Improve, LeavesGoodCellsAlone) {
    for (const NamedMesh& named : meshes()) {
        TetMesh mesh = named.mesh;
        const Improvement improvement = improve(mesh, {.threshold_deg = 0.01});
        EXPECT_EQ(improvement.removed_edges + improvement.moved_vertices + improvement.bad_cells_before, 0);
        EXPECT_EQ(mesh.tets, named.mesh.tets);
        EXPECT_EQ(mesh.vertices, named.mesh.vertices);
    }
}

TEST(Improve, IsDeterministic) {
    for (const NamedMesh& named : meshes()) {
        SCOPED_TRACE(named.name);
        TetMesh first = named.mesh, second = named.mesh;
        connect_tets(second);
        improve(first);
        improve(second);
        EXPECT_EQ(first.tets, second.tets);
        EXPECT_EQ(first.vertices, second.vertices);
    }
}

TEST(Improve, IsTheSameOfAScaledMesh) {
    for (const NamedMesh& named : meshes()) {
        SCOPED_TRACE(named.name);
        TetMesh mesh = named.mesh;
        improve(mesh);
        for (const double scale : {0x1p-160, 0x1p-20, 0x1p150}) {  // 1e-48 to 1e45
            TetMesh scaled = named.mesh;
            for (Vec3& p : scaled.vertices) p *= scale;
            improve(scaled);
            EXPECT_EQ(mesh.tets, scaled.tets);
        }
    }
}

TEST(Improve, TakesCellsInAnyOrder) {
    constexpr unsigned seed = 3;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    for (const NamedMesh& named : meshes()) {
        SCOPED_TRACE(named.name);
        TetMesh mesh = named.mesh;
        std::shuffle(mesh.tets.begin(), mesh.tets.end(), random);
        for (Tetrahedron& cell : mesh.tets)  // an even permutation
            if (random() % 2) cell = {cell[1], cell[2], cell[0], cell[3]};
        expect_better(improve(mesh), mesh, named.mesh);
        EXPECT_TRUE(verify_mesh(mesh, named.surface).hold());
    }
}

TEST(Improve, LeavesFrozenCellsAlone) {
    for (const NamedMesh& named : meshes())
        for (const std::size_t share : {1, 2, 10}) {
            SCOPED_TRACE(named.name);
            TetMesh mesh = named.mesh;
            const std::size_t frozen = mesh.tets.size() / share;
            const Improvement improvement = improve(mesh, {.frozen_cells = static_cast<std::int64_t>(frozen)});
            EXPECT_TRUE(verify_mesh(mesh, named.surface).hold());
            expect_no_worse(mesh, named.mesh);
            for (std::size_t cell = 0; cell < frozen; ++cell) {
                ASSERT_EQ(mesh.tets[cell], named.mesh.tets[cell]);
                for (const std::int32_t v : mesh.tets[cell]) ASSERT_EQ(mesh.vertices[v], named.mesh.vertices[v]);
            }
            EXPECT_TRUE(share > 1 || improvement.removed_edges + improvement.moved_vertices == 0);
        }
}

// A part of a mesh whose boundary is none of its surface.
TEST(Improve, KeepsTheBoundaryOfAnyCells) {
    for (const NamedMesh& named : meshes()) {
        SCOPED_TRACE(named.name);
        TetMesh mesh = named.mesh;
        mesh.tets.resize((mesh.tets.size() + 1) / 2);
        const auto boundary = [](const TetMesh& of) {
            std::vector<std::array<Vec3, 3>> faces;
            const TetNeighbours neighbours = find_neighbours(of);
            for (std::size_t cell = 0; cell < of.tets.size(); ++cell)
                for (std::size_t i = 0; i < 4; ++i) {
                    if (neighbours[cell][i].is_valid()) continue;
                    const auto& [a, b, c] = tet_faces[i];
                    std::array<Vec3, 3>& face = faces.emplace_back();
                    face = {of.vertices[of.tets[cell][a]], of.vertices[of.tets[cell][b]],
                            of.vertices[of.tets[cell][c]]};
                    const auto less = [](const Vec3& p, const Vec3& q) {
                        return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
                    };
                    std::rotate(face.begin(), std::min_element(face.begin(), face.end(), less), face.end());
                }
            std::sort(faces.begin(), faces.end(), [](const auto& f, const auto& g) {
                return std::lexicographical_compare(f[0].data(), f[0].data() + 9, g[0].data(), g[0].data() + 9);
            });
            return faces;
        };
        const auto before = boundary(mesh);
        const TetMesh half = mesh;
        improve(mesh);
        expect_no_worse(mesh, half);
        EXPECT_EQ(boundary(mesh), before);
    }
}

TEST(Improve, ObeysTheBoundOfVolume) {
    for (const NamedMesh& named : meshes()) {
        SCOPED_TRACE(named.name);
        double largest = 0;
        for (const Tetrahedron& cell : named.mesh.tets)
            largest = std::max(largest, shape_of(named.mesh, cell).six_volumes / 6);
        for (const double share : {1 + 1e-9, 0.5, 0.1}) {
            const SizeField size(share * largest);
            TetMesh mesh = named.mesh;
            improve(mesh, {.threshold_deg = 30, .max_size = size});
            expect_no_worse(mesh, named.mesh);
            EXPECT_LE(most_excess(mesh, size), most_excess(named.mesh, size) + 1e-9);
        }
    }
}

TEST(Improve, ObeysTheBoundOfVolumeAtEachPlace) {
    SizeSources sources;
    sources.growth = 0.2;
    sources.spheres.push_back({Vec3::Zero(), 0.1, 0.05});
    const SizeField size(0, sources);
    const NamedMesh named = meshed("graded box", test::box(Vec3::Zero(), Vec3::Ones(), 6), size);
    for (const double factor : {1.0, 0.6, std::cbrt(most_excess(named.mesh, size)) * (1 + 1e-9)}) {
        const SizeField bound = size.coarser(factor * factor * factor);
        TetMesh mesh = named.mesh;
        const Improvement improvement = improve(mesh, {.max_size = bound});
        EXPECT_GT(improvement.removed_edges, 0);
        EXPECT_LE(most_excess(mesh, bound), most_excess(named.mesh, bound) + 1e-9);
        EXPECT_TRUE(verify_mesh(mesh, named.surface).hold());
    }
}

TEST(Improve, EndsWhereItIsCancelledWithAValidMesh) {
    const NamedMesh named = meshed("sphere", test::icosphere(3), SizeField(4e-5));
    for (const int after : {0, 1}) {
        TetMesh mesh = named.mesh;
        int questions = 0;
        try {
            improve(mesh, {.threshold_deg = 30, .is_cancelled = [&] { return questions++ == after; }});
            ADD_FAILURE() << "was not cancelled";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::cancelled);
        }
        EXPECT_EQ(questions, after + 1);
        EXPECT_TRUE(verify_mesh(mesh, named.surface).hold());
        EXPECT_EQ(mesh.tets == named.mesh.tets, after == 0);
    }
}

// --- the shape of one cell ---

TEST(CellShape, HasTheAnglesOfTetQuality) {
    constexpr unsigned seed = 7;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    for (int i = 0; i < 2000; ++i) {
        std::array<Vec3, 4> p;
        for (Vec3& q : p) q = Vec3(coordinate(random), coordinate(random), coordinate(random) * (i % 3 ? 1 : 0.01));
        const CellShape shape = cell_shape(p[0], p[1], p[2], p[3]), turned = cell_shape(p[1], p[0], p[2], p[3]);
        EXPECT_NE(shape.badness() == infinity, turned.badness() == infinity);
        const CellShape& positive = shape.badness() == infinity ? turned : shape;
        const TetQuality quality = tet_quality(p[0], p[1], p[2], p[3]);
        EXPECT_NEAR(degrees_from_square(positive.sharpest), quality.min_dihedral_deg, 1e-7);
        EXPECT_NEAR(180 - degrees_from_square(positive.flattest), quality.max_dihedral_deg, 1e-7);
        EXPECT_NEAR(positive.six_volumes / 6, std::abs(quality.volume), 1e-12);
    }
}

TEST(CellShape, ComparesAsAnglesDo) {
    for (double angle = 1; angle < 179; ++angle) {
        EXPECT_NEAR(degrees_from_square(square_from_degrees(angle)), angle, 1e-9);
        EXPECT_GT(square_from_degrees(angle), square_from_degrees(angle + 1));
    }
    EXPECT_NEAR(cell_shape(Vec3(1, 1, 1), Vec3(-1, 1, -1), Vec3(1, -1, -1), Vec3(-1, -1, 1)).badness(), 0.125, 1e-12);
    const CellShape flat = cell_shape(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0));
    EXPECT_EQ(flat.badness(), infinity);
}

// --- what a new cell must be ---

std::array<Vec3, 4> random_cell(std::mt19937& random) {
    std::uniform_real_distribution<double> coordinate(-1, 1);
    std::array<Vec3, 4> p;
    for (Vec3& q : p) q = Vec3(coordinate(random), coordinate(random), coordinate(random));
    if (cell_shape(p[0], p[1], p[2], p[3]).six_volumes < 0) std::swap(p[0], p[1]);
    return p;
}

TEST(ImprovedMesh, AdmitsNoAngleBeyondThoseOfTheMesh) {
    constexpr unsigned seed = 13;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    int refused_for_one = 0;
    for (int i = 0; i < 2000; ++i) {
        const std::array<Vec3, 4> p = random_cell(random), q = random_cell(random);
        TetMesh mesh{{p.begin(), p.end()}, 4, {{0, 1, 2, 3}}, {}};
        const ImprovedMesh improved(mesh, 0, {}, [](const CellShape&) {});
        const TetQuality old_cell = tet_quality(p[0], p[1], p[2], p[3]), cell = tet_quality(q[0], q[1], q[2], q[3]);
        const bool is_sharper =
            cell.min_dihedral_deg<old_cell.min_dihedral_deg, is_flatter = cell.max_dihedral_deg> old_cell
                .max_dihedral_deg;
        refused_for_one += is_sharper != is_flatter;
        EXPECT_EQ(improved.badness_of(q[0], q[1], q[2], q[3], 1) == infinity, is_sharper || is_flatter);
    }
    EXPECT_GT(refused_for_one, 100);
}

// The regular tetrahedron, and vertex 4 inside of it, or not.
TetMesh four_cells(const Vec3& inside) {
    TetMesh mesh;
    mesh.vertices = {Vec3(1, 1, 1), Vec3(-1, 1, -1), Vec3(1, -1, -1), Vec3(-1, -1, 1), inside};
    mesh.boundary_vertex_count = 4;
    mesh.tets = {{4, 1, 2, 3}, {0, 4, 2, 3}, {0, 1, 4, 3}, {0, 1, 2, 4}};
    return mesh;
}

TEST(ImprovedMesh, MovesNoVertexToWhereACellIsNotPositive) {
    TetMesh mesh = four_cells(Vec3::Zero());
    ImprovedMesh improved(mesh, 0, {}, [](const CellShape&) {});
    std::vector<CellId> star;
    ASSERT_TRUE(improved.find_star(CellId(0), 0, star));
    ASSERT_EQ(star.size(), 4u);
    const double badness = improved.badness(CellId(0));
    const Vec3 in_a_face(-0.5, -0.25, -0.25);
    constexpr double least = 0x1p-54;
    for (const Vec3& to : {Vec3(2, 2, 2), in_a_face, Vec3(in_a_face - Vec3(2 * least, 0, 0))}) {
        EXPECT_FALSE(improved.move(4, to, star));
        EXPECT_EQ(improved.point(4), Vec3(0, 0, 0));
        EXPECT_EQ(improved.badness(CellId(0)), badness);
    }
    EXPECT_TRUE(improved.move(4, in_a_face + Vec3(least, 0, 0), star));  // flat, but for the last bit
    EXPECT_GT(improved.badness(CellId(0)), 1e20);
}

// --- one operation alone ---

// n cells around an edge from vertex 0 to vertex 1, others after them in a ring.
TetMesh cells_around_edge(const std::vector<Vec3>& ring, const Vec3& a, const Vec3& b) {
    TetMesh mesh;
    mesh.vertices = {a, b};
    mesh.vertices.insert(mesh.vertices.end(), ring.begin(), ring.end());
    mesh.boundary_vertex_count = static_cast<std::int32_t>(mesh.vertices.size());
    const auto n = static_cast<std::int32_t>(ring.size());
    for (std::int32_t i = 0; i < n; ++i) mesh.tets.push_back({0, 1, 2 + i, 2 + (i + 1) % n});
    return mesh;
}

std::vector<Vec3> random_ring(std::mt19937& random, int n) {
    std::uniform_real_distribution<double> radius(0.6, 1.4), height(-0.3, 0.3);
    std::vector<Vec3> ring;
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * i / n, r = radius(random);
        ring.emplace_back(r * std::cos(angle), r * std::sin(angle), height(random));
    }
    return ring;
}

// The least largest badness of all triangulations of the ring's vertices from `from` to `to`, one by one.
double best_of_all(const ImprovedMesh& mesh, std::int32_t from, std::int32_t to) {
    if (to - from < 2) return -infinity;
    double best = infinity;
    for (std::int32_t middle = from + 1; middle < to; ++middle) {
        const Vec3 &p = mesh.point(from), &q = mesh.point(middle), &r = mesh.point(to);
        const double below = mesh.badness_of(mesh.point(0), p, q, r, 1),
                     above = mesh.badness_of(p, q, r, mesh.point(1), 1);
        best = std::min(best, std::max({below, above, best_of_all(mesh, from, middle), best_of_all(mesh, middle, to)}));
    }
    return best;
}

TEST(EdgeRemoval, FindsTheBestOfAllTriangulations) {
    constexpr unsigned seed = 11;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    int found = 0;
    for (int n = 3; n <= 10; ++n)
        for (int i = 0; i < 60; ++i) {
            TetMesh mesh = cells_around_edge(random_ring(random, n), Vec3(0.1, 0, -0.8), Vec3(0, 0.1, 0.8));
            const TetMesh input = mesh;
            const ImprovedMesh improved(mesh, 0, {}, [](const CellShape&) {});
            EdgeRing ring;
            ASSERT_TRUE(improved.find_ring(CellId(0), 0, 1, ring));
            ASSERT_EQ(ring.size(), static_cast<std::size_t>(n));
            double limit = -infinity;
            for (const Tetrahedron& cell : input.tets) limit = std::max(limit, shape_of(input, cell).badness());
            EdgeRemoval removal;
            const double best = best_of_all(improved, 2, n + 1);
            ASSERT_EQ(removal.find(improved, ring, limit), best < limit);
            if (best >= limit) continue;
            ++found;
            EXPECT_EQ(removal.badness(), best);
            EXPECT_EQ(removal.cells().size(), static_cast<std::size_t>(2 * (n - 2)));
            double worst = -infinity;
            for (const Tetrahedron& cell : removal.cells()) worst = std::max(worst, shape_of(input, cell).badness());
            EXPECT_NEAR(worst, best, 1e-9 * std::abs(best));
        }
    EXPECT_GT(found, 50);
}

TEST(EdgeRemoval, RefusesEdgesOfTheBoundaryAndOfTooManyCells) {
    std::mt19937 random(1);
    TetMesh mesh = cells_around_edge(random_ring(random, 11), Vec3(0, 0, -1), Vec3(0, 0, 1));
    const ImprovedMesh improved(mesh, 0, {}, [](const CellShape&) {});
    EdgeRing ring;
    EXPECT_FALSE(improved.find_ring(CellId(0), 0, 1, ring));
    for (int i = 0; i < 4; ++i)
        for (int j = 2; j < 4; ++j) EXPECT_TRUE(i == j || !improved.find_ring(CellId(0), i, j, ring));
}

// Four vertices almost in a plane, with cells above and below.
TEST(EdgeRemoval, CuresASliver) {
    TetMesh mesh;
    mesh.vertices = {Vec3(1, 0, 0.01),   Vec3(0, 1, -0.01), Vec3(-1, 0, 0.01),
                     Vec3(0, -1, -0.01), Vec3(0, 0, 1),     Vec3(0, 0, -1)};
    mesh.boundary_vertex_count = 6;
    // The edge 0-2 passes above the edge 1-3.
    mesh.tets = {{0, 2, 1, 3}, {0, 1, 2, 4}, {0, 2, 3, 4}, {0, 1, 5, 3}, {1, 2, 5, 3}};
    for (Tetrahedron& cell : mesh.tets)
        if (shape_of(mesh, cell).six_volumes < 0) std::swap(cell[0], cell[1]);
    const Improvement improvement = improve(mesh);
    EXPECT_EQ(improvement.bad_cells_before, 1);
    EXPECT_EQ(improvement.bad_cells_after, 0);
    EXPECT_EQ(improvement.removed_edges, 1);
    EXPECT_EQ(mesh.tets.size(), 4u);
    EXPECT_LT(improvement.smallest_before.min(), 3);
    EXPECT_GT(angles_of(mesh).smallest.min(), 40);
}

// A vertex that is almost in a face of the tetrahedron around it.
TEST(Smoothing, CuresACap) {
    TetMesh mesh = four_cells(Vec3(-0.32, -0.32, -0.32));
    const Improvement improvement = improve(mesh, {.threshold_deg = 20});
    EXPECT_GT(improvement.bad_cells_before, 0);
    EXPECT_EQ(improvement.bad_cells_after, 0);
    EXPECT_GT(improvement.moved_vertices, 0);
    EXPECT_EQ(mesh.tets.size(), 4u);
}

// Four cells whose only short edge goes from a corner of the octahedron to the vertex inside.
TEST(Smoothing, CuresWedges) {
    TetMesh mesh;
    mesh.vertices = {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0),  Vec3(0, -1, 0),
                     Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(0.9, 0, 0)};
    mesh.boundary_vertex_count = 6;
    for (const std::int32_t x : {0, 1})
        for (const std::int32_t y : {2, 3})
            for (const std::int32_t z : {4, 5})
                mesh.tets.push_back((x + y + z) % 2 ? Tetrahedron{6, y, x, z} : Tetrahedron{6, x, y, z});
    ASSERT_EQ(verify_mesh(mesh, {}).inverted_tets, 0);
    // The cells around the short edge have none that could go without it.
    const Improvement improvement = improve(mesh, {.threshold_deg = 20});
    EXPECT_EQ(improvement.bad_cells_before, 4);
    EXPECT_EQ(improvement.bad_cells_after, 0);
}

// All corners are on the boundary, so that none can be moved.
TEST(VertexInsertion, HelpsWhereNothingElseDoes) {
    for (const Soup& soup : {test::icosphere(2), test::icosphere(3)}) {
        const SurfaceArrays surface = test::to_arrays(soup);
        MesherOptions options;
        options.name = "tetgen";
        options.radius_edge = 0;
        options.improve = false;
        const TetMesh input = mesh_volume(surface, options).mesh;
        ASSERT_EQ(input.vertices.size(), surface.vertices.size());
        TetMesh without = input, with = input;
        EXPECT_EQ(improve(without, {.adds_vertices = false}).new_vertices, 0);
        const Improvement improvement = improve(with);
        EXPECT_GT(improvement.new_vertices, 0);
        EXPECT_EQ(static_cast<std::int64_t>(with.vertices.size()),
                  static_cast<std::int64_t>(input.vertices.size()) + improvement.new_vertices);
        EXPECT_EQ(without.vertices, input.vertices);
        EXPECT_TRUE(verify_mesh(with, surface).hold());
        EXPECT_GT(angles_of(with).smallest.min(), angles_of(without).smallest.min());
    }
}

TEST(Smoothing, MovesOnlyWhatMayMove) {
    TetMesh mesh = four_cells(Vec3::Zero());
    std::vector<CellId> star;
    for (const std::int32_t boundary_vertices : {4, 5}) {
        mesh.boundary_vertex_count = boundary_vertices;
        ImprovedMesh improved(mesh, 0, {}, [](const CellShape&) {});
        EXPECT_EQ(improved.find_star(CellId(0), 0, star), boundary_vertices == 4);
        EXPECT_FALSE(improved.find_star(CellId(0), 1, star));
    }
    mesh.boundary_vertex_count = 0;  // those of the boundary are known by its faces
    EXPECT_FALSE(ImprovedMesh(mesh, 0, {}, [](const CellShape&) {}).find_star(CellId(0), 1, star));
    EXPECT_FALSE(ImprovedMesh(mesh, 1, {}, [](const CellShape&) {}).find_star(CellId(1), 1, star));
}

}  // namespace
}  // namespace kerf

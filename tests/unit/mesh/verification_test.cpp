#include "fill/mesh/verification.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "base/core/elements.h"
#include "base/geometry/predicates.h"
#include "base/geometry/tetrahedron.h"
#include "fill/mesh/adjacency.h"
#include "fill/mesh/inside/boundary_chain.h"
#include "support/shapes.h"

namespace kerf {
namespace {

constexpr int cells_along = 3;  // along each axis of the mesh below

struct MeshedSurface {
    TetMesh mesh;
    SurfaceArrays surface;
};

// Both proofs, which say the same.
MeshLaws laws_of(const MeshedSurface& m) {
    const MeshLaws laws = verify_mesh(m.mesh, m.surface, FaceProof::matching);
    const MeshLaws by_sum = verify_mesh(m.mesh, m.surface, FaceProof::sum);
    EXPECT_EQ(by_sum.hold(), laws.hold());
    EXPECT_EQ(by_sum.missing_facets, laws.missing_facets);
    EXPECT_EQ(by_sum.extra_boundary_faces, laws.extra_boundary_faces);
    EXPECT_EQ(by_sum.mismatched_neighbours, laws.mismatched_neighbours);
    return laws;
}

std::int32_t grid_vertex(int x, int y, int z) { return (x * (cells_along + 1) + y) * (cells_along + 1) + z; }

// Kuhn's six tetrahedra around the main diagonal of a cube, one for each order of the axes.
void add_cell(TetMesh& mesh, const Vec3& corner) {
    std::array<int, 3> axes = {0, 1, 2};
    do {
        Vec3 p = corner;
        Tetrahedron tet;
        for (int i = 0; i < 4; ++i) {
            tet[i] = grid_vertex(int(p.x()), int(p.y()), int(p.z()));
            if (i < 3) p[axes[i]] += 1;
        }
        const auto at = [&](int i) { return mesh.vertices[tet[i]]; };
        if ((at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) < 0) std::swap(tet[2], tet[3]);
        mesh.tets.push_back(tet);
    } while (std::next_permutation(axes.begin(), axes.end()));
}

Triangle face_of(const Tetrahedron& tet, int i) {
    return {tet[tet_faces[i][0]], tet[tet_faces[i][1]], tet[tet_faces[i][2]]};
}

Triangle sorted(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
}

constexpr std::array no_neighbours = {CellId::none(), CellId::none(), CellId::none(), CellId::none()};

void set_neighbours(TetMesh& mesh) {
    std::map<Triangle, std::vector<std::pair<CellId, int>>> sides;
    mesh.neighbours.assign(mesh.tets.size(), no_neighbours);
    for (const CellId t : mesh.tets.ids())
        for (int i = 0; i < 4; ++i) sides[sorted(face_of(mesh.tets[t], i))].push_back({t, i});
    for (const auto& [face, side] : sides)
        if (side.size() == 2) {
            mesh.neighbours[side[0].first][side[0].second] = side[1].first;
            mesh.neighbours[side[1].first][side[1].second] = side[0].first;
        }
}

// A cube of cells_along^3 cells. All its vertices belong to the surface as numbered here, also the 8 in the middle.
MeshedSurface meshed_cube() {
    MeshedSurface cube;
    TetMesh& mesh = cube.mesh;
    for (int x = 0; x <= cells_along; ++x)
        for (int y = 0; y <= cells_along; ++y)
            for (int z = 0; z <= cells_along; ++z) mesh.vertices.emplace_back(x, y, z);
    for (int x = 0; x < cells_along; ++x)
        for (int y = 0; y < cells_along; ++y)
            for (int z = 0; z < cells_along; ++z) add_cell(mesh, Vec3(x, y, z));
    set_neighbours(mesh);
    mesh.boundary_vertex_count = static_cast<std::int32_t>(mesh.vertices.size());
    cube.surface.vertices = mesh.vertices;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
        for (int i = 0; i < 4; ++i)
            if (!mesh.neighbours[t][i].is_valid()) cube.surface.facets.push_back(face_of(mesh.tets[t], i));
    return cube;
}

struct Counts {
    std::int64_t inverted = 0, missing = 0, extra = 0, mismatched = 0, moved = 0, without_volume = 0;
    bool operator==(const Counts&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Counts& c) {
    return out << "inverted " << c.inverted << ", missing " << c.missing << ", extra " << c.extra << ", mismatched "
               << c.mismatched << ", moved " << c.moved << ", without volume " << c.without_volume;
}

Counts counts(const MeshedSurface& m) {
    const MeshLaws laws = laws_of(m);
    return {laws.inverted_tets,         laws.missing_facets, laws.extra_boundary_faces,
            laws.mismatched_neighbours, laws.moved_vertices, laws.tets_without_volume};
}

int boundary_faces(const TetMesh& mesh, std::int32_t t) {
    return static_cast<int>(std::count(mesh.neighbours[t].begin(), mesh.neighbours[t].end(), CellId::none()));
}

// A tetrahedron in the inside and one at the boundary, so that every kind of damage meets both.
std::vector<std::int32_t> samples(const TetMesh& mesh) {
    std::vector<std::int32_t> found(2, -1);
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh.tets.size()); ++t)
        found[boundary_faces(mesh, t) > 0] = t;
    return found;
}

TEST(Verification, HoldsForACorrectMesh) {
    const MeshedSurface cube = meshed_cube();
    const MeshLaws laws = laws_of(cube);
    EXPECT_EQ(counts(cube), Counts{});
    EXPECT_DOUBLE_EQ(laws.volume, cells_along * cells_along * cells_along);
    EXPECT_TRUE(laws.hold());
}

TEST(Verification, DoesNotDependOnOrderAndRotation) {
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        MeshedSurface cube = meshed_cube();
        for (std::size_t f = 0; f < cube.surface.facets.size(); ++f) {
            std::swap(cube.surface.facets[f], cube.surface.facets[random() % cube.surface.facets.size()]);
            std::rotate(cube.surface.facets[f].begin(), cube.surface.facets[f].begin() + random() % 3,
                        cube.surface.facets[f].end());
        }
        EXPECT_EQ(counts(cube), Counts{});
        const auto behind = tets_at_facets(cube.mesh, cube.surface.facets);
        for (std::size_t f = 0; f < behind.size(); ++f) {
            ASSERT_GE(behind[f], 0);
            int same = 0;
            for (int i = 0; i < 4; ++i)
                same += cube.mesh.neighbours[behind[f]][i] == CellId::none() &&
                        sorted(face_of(cube.mesh.tets[behind[f]], i)) == sorted(cube.surface.facets[f]);
            EXPECT_EQ(same, 1);
        }
    }
}

TEST(Verification, FindsAFlippedTetrahedron) {
    for (const std::int32_t t : samples(meshed_cube().mesh)) {
        SCOPED_TRACE(t);
        MeshedSurface cube = meshed_cube();
        std::swap(cube.mesh.tets[t][0], cube.mesh.tets[t][1]);
        std::swap(cube.mesh.neighbours[t][0], cube.mesh.neighbours[t][1]);
        const int outer = boundary_faces(cube.mesh, t);
        EXPECT_EQ(counts(cube), (Counts{1, outer, outer, 2 * (4 - outer), 0}));
    }
}

TEST(Verification, FindsADroppedTetrahedron) {
    for (const std::int32_t t : samples(meshed_cube().mesh)) {
        SCOPED_TRACE(t);
        MeshedSurface cube = meshed_cube();
        const int outer = boundary_faces(cube.mesh, t);
        cube.mesh.tets.erase(cube.mesh.tets.begin() + t);
        set_neighbours(cube.mesh);
        EXPECT_EQ(counts(cube), (Counts{0, outer, 4 - outer, 0, 0}));
        EXPECT_FALSE(laws_of(cube).hold());
    }
}

TEST(Verification, FindsADoubledTetrahedron) {
    MeshedSurface cube = meshed_cube();
    const std::int32_t t = samples(cube.mesh)[0];
    cube.mesh.tets.push_back(cube.mesh.tets[t]);
    cube.mesh.neighbours.push_back(cube.mesh.neighbours[t]);
    EXPECT_EQ(counts(cube), (Counts{0, 0, 0, 4, 0}));
}

// The laws are those of the mesh, whether it names its neighbours or not.
TEST(Verification, FindsTheNeighboursOfAMeshThatNamesNone) {
    std::mt19937 random(7);
    const std::int32_t inside = samples(meshed_cube().mesh)[0];
    const auto flip = [&](std::vector<Tetrahedron>& tets) { std::swap(tets[inside][0], tets[inside][1]); };
    const auto drop = [&](std::vector<Tetrahedron>& tets) { tets.erase(tets.begin() + inside); };
    const auto copy = [&](std::vector<Tetrahedron>& tets) { tets.push_back(Tetrahedron(tets[inside])); };
    const std::vector<std::function<void(std::vector<Tetrahedron>&)>> damages = {[](auto&) {}, flip, drop, copy};
    for (std::size_t i = 0; i < damages.size(); ++i) {
        SCOPED_TRACE(i);
        MeshedSurface cube = meshed_cube();
        for (Tetrahedron& tet : cube.mesh.tets) {  // any order of the corners that leaves it positive
            std::rotate(tet.begin(), tet.begin() + random() % 3, tet.begin() + 3);
            std::rotate(tet.begin() + 1, tet.begin() + 1 + random() % 3, tet.end());
        }
        damages[i](cube.mesh.tets);
        connect_tets(cube.mesh);
        const Counts named = counts(cube);
        EXPECT_EQ(named == Counts{}, i == 0);
        cube.mesh.neighbours = {};
        EXPECT_EQ(counts(cube), named);
    }
}

// Of any cells, however they overlap: the sum over them is that over their faces.
TEST(BoundaryChain, OfCellsIsThatOfTheirFaces) {
    for (std::uint32_t seed = 1; seed <= 50; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const auto vertex = [&] { return static_cast<std::int32_t>(random() >> (random() % 2 ? 1 : 28)); };
        BoundaryChain of_cells, of_faces, of_others;
        for (int t = 0; t < 100; ++t) {
            const Tetrahedron cell = {vertex(), vertex(), vertex(), vertex()};
            of_cells.add(cell);
            for (int i = 3; i >= 0; --i) of_faces.add(face_of(cell, i));
            EXPECT_TRUE(of_cells == of_faces);
            Triangle wrong = face_of(cell, 1);
            if (has_repeated_vertex(wrong)) continue;  // it counts nothing
            of_others = of_faces;
            of_others.add(wrong);
            EXPECT_FALSE(of_others == of_cells);
            std::swap(wrong[0], wrong[1]);
            of_others.add(wrong);
            EXPECT_TRUE(of_others == of_cells);
        }
    }
}

// Cells with the same faces but other numbers of their vertices, one facet exchanged for another: sums do not collide.
TEST(BoundaryChain, DiffersForEveryTriangle) {
    constexpr std::int32_t vertices = 40;
    std::vector<BoundaryChain> chains;
    for (std::int32_t a = 0; a < vertices; ++a)
        for (std::int32_t b = 0; b < vertices; ++b)
            for (std::int32_t c = 0; c < vertices; ++c)
                if (a < std::min(b, c) && b != c) chains.emplace_back().add(Triangle{a, b, c});
    for (std::size_t i = 0; i < chains.size(); i += 97)
        for (std::size_t j = 0; j < chains.size(); ++j) EXPECT_EQ(chains[i] == chains[j], i == j);
}

TEST(Verification, FindsAMovedVertex) {
    for (std::size_t v = 0; v < meshed_cube().mesh.vertices.size(); ++v) {
        SCOPED_TRACE(v);
        MeshedSurface cube = meshed_cube();
        double& x = cube.mesh.vertices[v].x();
        x = std::nextafter(x, 10.0);
        EXPECT_EQ(counts(cube), (Counts{0, 0, 0, 0, 1}));
        EXPECT_FALSE(laws_of(cube).hold());
    }
    MeshedSurface cube = meshed_cube();
    cube.mesh.boundary_vertex_count -= 3;
    EXPECT_EQ(counts(cube), (Counts{0, 0, 0, 0, 3}));
}

TEST(Verification, FindsABrokenNeighbour) {
    const TetMesh whole = meshed_cube().mesh;
    const auto tet_count = static_cast<std::int32_t>(whole.tets.size());
    for (std::int32_t t = 0; t < tet_count; t += 7)
        for (int i = 0; i < 4; ++i) {
            SCOPED_TRACE(testing::Message() << "tetrahedron " << t << ", face " << i);
            const int inner = whole.neighbours[t][i].is_valid();
            for (const std::int32_t wrong : {t, tet_count, -2, std::numeric_limits<std::int32_t>::max()}) {
                MeshedSurface cube = meshed_cube();
                cube.mesh.neighbours[t][i] = CellId(wrong);
                EXPECT_EQ(counts(cube), (Counts{0, 1 - inner, 0, 1 + inner, 0}));
            }
            MeshedSurface cut = meshed_cube();
            cut.mesh.neighbours[t][i] = CellId::none();
            EXPECT_EQ(counts(cut), (Counts{0, 0, inner, inner, 0}));
        }
}

TEST(Verification, FindsExchangedNeighbours) {
    MeshedSurface cube = meshed_cube();
    const std::int32_t t = samples(cube.mesh)[0];
    std::swap(cube.mesh.neighbours[t][0], cube.mesh.neighbours[t][1]);
    // Seen from t both faces lead to the wrong tetrahedron, and seen from these t names them over another face.
    EXPECT_EQ(counts(cube), (Counts{0, 0, 0, 4, 0}));
}

TEST(Verification, FindsADeletedDoubledOrTurnedFacet) {
    for (std::size_t f = 0; f < meshed_cube().surface.facets.size(); f += 5) {
        SCOPED_TRACE(f);
        MeshedSurface deleted = meshed_cube(), doubled = meshed_cube(), turned = meshed_cube();
        deleted.surface.facets.erase(deleted.surface.facets.begin() + static_cast<std::ptrdiff_t>(f));
        EXPECT_EQ(counts(deleted), (Counts{0, 0, 1, 0, 0}));
        doubled.surface.facets.push_back(doubled.surface.facets[f]);
        EXPECT_EQ(counts(doubled), (Counts{0, 1, 0, 0, 0}));
        std::swap(turned.surface.facets[f][0], turned.surface.facets[f][1]);
        EXPECT_EQ(counts(turned), (Counts{0, 1, 1, 0, 0}));
        EXPECT_EQ(tets_at_facets(turned.mesh, turned.surface.facets)[f], -1);
    }
}

TEST(Verification, OrientationIsExact) {
    // d lies one rounding step above, in, or below the plane of a, b and c.
    MeshedSurface one;
    const auto inverted = [&](double z) {
        one.mesh.vertices = {Vec3(0.1, 0.1, 0.1), Vec3(1.1, 0.1, 1.1), Vec3(0.1, 1.1, 1.1), Vec3(0.6, 0.6, z)};
        one.mesh.tets = {{0, 1, 2, 3}};
        one.mesh.neighbours = {no_neighbours};
        return counts(one).inverted;
    };
    int changes = 0;
    double z = 1.1 - 1e-15;
    for (std::int64_t last = inverted(z); z < 1.1 + 1e-15; z = std::nextafter(z, 2.0)) {
        changes += inverted(z) != last;
        last = inverted(z);
    }
    EXPECT_EQ(changes, 1);
    EXPECT_EQ(inverted(1.2), 0);
    EXPECT_EQ(inverted(1.0), 1);
}

// Points in the plane of three others but for rounding: some cells are positive, and have no volume as doubles have it.
TEST(Verification, CellsWithoutVolumeByRoundingAreCounted) {
    const unsigned seed = 7;
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(0, 1);
    const auto point = [&] { return Vec3(coordinate(random), coordinate(random), coordinate(random)); };
    int positive = 0, without_volume = 0;
    for (int i = 0; i < 2000; ++i) {
        MeshedSurface one;
        const Vec3 a = point(), b = point(), c = point(),
                   d = a + coordinate(random) * (b - a) + coordinate(random) * (c - a);
        one.mesh.vertices = {a, b, c, d};
        one.mesh.tets = {{0, 1, 2, 3}};
        one.mesh.neighbours = {no_neighbours};
        const bool is_positive = orientation(a, b, c, d) > 0, has_volume = has_volume_in_any_order(a, b, c, d);
        EXPECT_EQ(counts(one).inverted, !is_positive) << i;
        EXPECT_EQ(counts(one).without_volume, is_positive && !has_volume) << i;
        positive += is_positive && has_volume;
        without_volume += is_positive && !has_volume;
    }
    EXPECT_GT(positive, 100);
    EXPECT_GT(without_volume, 100) << "or this shows nothing";
    // Where products underflow only the sign is known, and it counts.
    MeshedSurface tiny = meshed_cube();
    for (Vec3& p : tiny.mesh.vertices) p *= 1e-110;
    tiny.surface.vertices = tiny.mesh.vertices;
    EXPECT_EQ(counts(tiny), Counts());
}

TEST(Verification, VolumesMustAgree) {
    MeshLaws laws;
    laws.volume = laws.surface_volume = 2;
    EXPECT_TRUE(laws.hold());
    laws.volume_error = 1e-10;
    laws.volume = 2 + 0.5e-10;
    EXPECT_TRUE(laws.hold());
    laws.volume = 2 + 2e-10;
    EXPECT_FALSE(laws.hold());
    laws.volume = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(laws.hold());
}

// A sheet, up to 900 million times as long as it is thick, somewhere in space: cones from one corner cancel to 1e-10 of
// its volume and worse, and that is no error. A cell too few is one, also by the volume alone.
TEST(Verification, AThinSheetHoldsUnlessACellIsMissing) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    double worst = 0;
    for (const double thickness : {1e-2, 1e-4, 1e-6}) {
        SCOPED_TRACE(thickness);
        MeshedSurface sheet = meshed_cube();
        for (Vec3& p : sheet.mesh.vertices)
            p = turn * p.cwiseProduct(Vec3(300, 300, thickness / 3)) + Vec3(1e4, -2e4, 3e4);
        sheet.surface.vertices = sheet.mesh.vertices;
        const MeshLaws laws = laws_of(sheet);
        EXPECT_EQ(counts(sheet), Counts{});
        EXPECT_TRUE(laws.hold()) << laws.volume - laws.surface_volume << " of " << laws.volume_error;
        EXPECT_LT(laws.volume_error, 1e-3 * laws.volume);
        worst = std::max(worst, std::abs(laws.volume - laws.surface_volume) / laws.volume);
        MeshedSurface without = sheet;
        without.mesh.tets.pop_back();
        without.mesh.neighbours.clear();
        const MeshLaws broken = laws_of(without);
        EXPECT_FALSE(broken.hold());
        EXPECT_GT(std::abs(broken.volume - broken.surface_volume), broken.volume_error);
    }
    EXPECT_GT(worst, 1e-10);  // or this shows nothing
}

}  // namespace
}  // namespace kerf

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "fill/mesh/quality.h"
#include "fill/mesh/verification.h"
#include "fill/volume/meshers.h"
#include "support/voxels.h"
#include "surface/complex/mass_properties.h"
#include "surface/complex/touching.h"

namespace kerf {
namespace {

// Bodies that touch themselves, each point one vertex.
struct TouchingBody {
    std::string name;
    SurfaceArrays surface;
    double volume;
};

TouchingBody touching_body(const std::string& name, const test::Voxels& voxels, int n) {
    return {name, test::to_arrays(test::voxel_surface(voxels, n)), static_cast<double>(voxels.size())};
}

// Of 3^3 cubes all but these.
test::Voxels block_without(const test::Voxels& left_out) {
    test::Voxels voxels;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k)
                if (!left_out.contains({i, j, k})) voxels.insert({i, j, k});
    return voxels;
}

std::vector<TouchingBody> touching_bodies() {
    std::vector<TouchingBody> bodies;
    for (const int n : {1, 3}) {
        bodies.push_back(touching_body("cubes at a vertex", {{0, 0, 0}, {1, 1, 1}}, n));
        bodies.push_back(touching_body("cubes at an edge", {{0, 0, 0}, {1, 1, 0}}, n));
        bodies.push_back(touching_body("a chain", {{0, 0, 0}, {1, 1, 0}, {2, 2, 1}, {3, 1, 1}}, n));
        bodies.push_back(touching_body("checkerboard", {{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}}, n));
        bodies.push_back(touching_body("notch with a double edge", test::notched_voxels(), n));
        bodies.push_back(touching_body("void at an edge of the outside", block_without({{1, 1, 1}, {0, 0, 1}}), n));
        bodies.push_back(touching_body("void at a vertex of the outside", block_without({{1, 1, 1}, {0, 0, 0}}), n));
        test::Voxels shell;
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j)
                for (int k = 0; k < 4; ++k)
                    if (i == 0 || j == 0 || k == 0 || i == 3 || j == 3 || k == 3) shell.insert({i, j, k});
        test::Voxels two = shell;
        two.insert({1, 1, 1}), two.insert({2, 2, 1});
        bodies.push_back(touching_body("two cubes in a void", two, n));
    }
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        test::SeededNumbers random(seed);
        const test::Voxels voxels = test::random_voxels(4, random.between(0.2, 0.9), random);
        Soup soup = test::voxel_surface(voxels, 1 + static_cast<int>(seed % 2));
        if (seed % 3 == 0) {  // long cells in any direction
            const Eigen::AngleAxisd turn(random.between(0, 3), Vec3(1, random.share(), random.share()).normalized());
            for (Vec3& p : soup.vertices) p = turn * Vec3(4 * p.x(), p.y(), p.z() / 4) + Vec3(0.1, 0.2, 0.3);
        }
        bodies.push_back({"voxels of seed " + std::to_string(seed), test::to_arrays(soup), double(voxels.size())});
    }
    return bodies;
}

class TouchingBodies : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Meshers, TouchingBodies, testing::Values("lattice", "tetgen"),
                         [](const auto& instance) { return instance.param; });

TEST_P(TouchingBodies, AreFilled) {
    for (const auto& [name, surface, volume] : touching_bodies())
        for (const double max_volume : {0.0, 0.02}) {
            SCOPED_TRACE(testing::Message() << name << ", V " << max_volume);
            MesherOptions options;
            options.name = GetParam();
            options.size = SizeField(max_volume);
            const Filling filling = mesh_volume(surface, options);
            EXPECT_EQ(filling.reason, "");
            const MeshLaws laws = verify_mesh(filling.mesh, surface);
            EXPECT_TRUE(laws.hold()) << laws.missing_facets << " " << laws.extra_boundary_faces;
            EXPECT_NEAR(laws.volume, volume, 1e-9 * volume);
            const std::vector<char> is_interface(surface.facets.size(), 0);
            const PartQuality quality = measure_quality(filling.mesh, {surface.facets, is_interface}, 5);
            EXPECT_EQ(quality.all.measures[0].count(), static_cast<std::int64_t>(filling.mesh.tets.size()));
            for (const std::int32_t tet : tets_at_facets(filling.mesh, surface.facets)) EXPECT_GE(tet, 0);
        }
}

TEST(HolePointsOfTouchingBodies, LieInRoomsThatTouchTheOutside) {
    for (const auto& [left_out, voids] :
         {std::pair<test::Voxels, std::size_t>{{{1, 1, 1}, {0, 0, 1}}, 1},
          {{{1, 1, 1}, {0, 0, 0}}, 1},
          {{{1, 1, 1}, {0, 1, 1}}, 0},
          {{{1, 1, 1}, {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {2, 2, 0}, {2, 0, 2}, {0, 2, 2}, {2, 2, 2}}, 1}}) {
        const std::vector<Vec3> points = hole_points(test::to_arrays(test::voxel_surface(block_without(left_out))));
        ASSERT_EQ(points.size(), voids);
        for (const Vec3& p : points) EXPECT_LT((p - Vec3(1.5, 1.5, 1.5)).cwiseAbs().maxCoeff(), 0.5);
    }
}

}  // namespace
}  // namespace kerf

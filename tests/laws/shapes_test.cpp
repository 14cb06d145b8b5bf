// The laws of whole runs for surfaces by formula that are hard to cut: thin, long, nested, interlinked, symmetric,
// full of cavities, porous. Each is cut into 2, 8 and, with enough facets, 32 parts, and also askew to the axes.
#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "support/checked_run.h"
#include "support/shapes.h"
#include "support/slice.h"
#include "support/write_off.h"

namespace kerf {
namespace {

constexpr std::int32_t facets_for_a_part = 300;

struct Shape {
    std::string name;
    Soup soup;
    std::int64_t shells, genus;
    double volume, volume_rel_tolerance = 1e-12;
};

std::ostream& operator<<(std::ostream& out, const Shape& shape) { return out << shape.name; }

std::vector<Shape> shapes() {
    using namespace test;
    const double ring = 2 * std::numbers::pi * std::numbers::pi * 3 * 0.6 * 0.6;
    const double ball = 4 * std::numbers::pi / 3, cavity = ball * 0.3 * 0.3 * 0.3;
    return {
        {"thin_plate", box(Vec3::Zero(), Vec3(100, 100, 0.5), {100, 100, 1}), 1, 0, 5000},
        {"needle", box(Vec3::Zero(), Vec3(250, 1, 1), {600, 2, 2}), 1, 0, 250},
        {"hollow_box_in_a_hollow_box", nested_boxes(4, 15), 4, 0, 343 - 125 + 27 - 1},
        {"two_linked_rings", linked_rings(2, 72, 15), 2, 2, 2 * ring, 0.05},
        {"chain_of_five_rings", linked_rings(5, 72, 15), 5, 5, 5 * ring, 0.05},
        {"symmetric_cube", box(Vec3::Constant(-1), Vec3::Ones(), 29), 1, 0, 8},
        {"symmetric_sphere", icosphere(5), 1, 0, ball, 0.01},
        {"block_with_200_cavities", block_with_cavities({8, 5, 5}), 201, 0, 200 * (1 - cavity), 0.02},
        {"porous_frame", porous_frame(3, 3), 1, 81, 64 + 144},
    };
}

class GeneratedShape : public testing::TestWithParam<Shape> {
 protected:
    std::string written(const std::vector<Vec3>& vertices) const {
        test::write_off(folder_.file("shape.off"), vertices, GetParam().soup.facets);
        return folder_.file("shape.off");
    }
    std::string written() const { return written(GetParam().soup.vertices); }
    // Sides that lie in no coordinate plane: their vertices are coplanar only up to rounding.
    std::string written_turned() const {
        const Eigen::AngleAxisd rotation(0.7, Vec3(1, 2, 3).normalized());
        std::vector<Vec3> vertices = GetParam().soup.vertices;
        for (Vec3& p : vertices) p = rotation * p;
        return written(vertices);
    }
    static void expect_laws(const std::string& path, std::int32_t parts) {
        if (parts * facets_for_a_part > static_cast<std::int32_t>(GetParam().soup.facets.size())) return;
        SCOPED_TRACE(testing::Message() << parts << " parts");
        test::run_and_check(path, parts);
    }

 private:
    test::TemporaryFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(Shapes, GeneratedShape, testing::ValuesIn(shapes()),
                         [](const auto& param) { return param.param.name; });

TEST_P(GeneratedShape, IsWhatItsNameSays) {
    const Input input = read_input(written());
    EXPECT_EQ(input.components, GetParam().shells);
    EXPECT_EQ(input.genus, GetParam().genus);
    EXPECT_EQ(input.facets, static_cast<std::int64_t>(GetParam().soup.facets.size()));
    EXPECT_EQ(input.tidied.welded_vertices + input.tidied.unused_vertices, 0);
    EXPECT_EQ(input.orientation.facets_flipped + input.orientation.shells_flipped, 0);
    EXPECT_NEAR(input.volume / GetParam().volume, 1, GetParam().volume_rel_tolerance);
}

TEST_P(GeneratedShape, ObeysEveryLawInManyParts) {
    const std::string path = written();
    for (const std::int32_t parts : test::slice({2, 8, 32}, {8})) expect_laws(path, parts);
}

TEST_P(GeneratedShape, ObeysEveryLawWhenTurned) {
    const std::string path = written_turned();
    for (const std::int32_t parts : test::slice({2, 8}, {2})) expect_laws(path, parts);
}

}  // namespace
}  // namespace kerf

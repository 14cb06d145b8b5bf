// One flat cell, in surroundings that make it so.
#include "fill/mesh/worst_cells.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/core/bytes.h"

namespace kerf {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

struct Body {
    TetMesh mesh;
    std::vector<Triangle> facets;

    explicit Body(const Vec3& apex) {
        mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, apex};
        mesh.tets = {{0, 1, 2, 3}};
    }
    void add(const std::array<Vec3, 3>& corners) {
        const auto v = count_of(mesh.vertices);
        mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
        facets.push_back({v, v + 1, v + 2});
    }
    WorstCells worst(bool is_interface = false) const {
        const std::vector<char> cut(facets.size(), is_interface);
        std::vector<std::int32_t> patch;
        for (std::size_t f = 0; f < facets.size(); ++f) patch.push_back(static_cast<std::int32_t>(f) + 5);
        return find_worst_cells(mesh, {facets, cut}, patch);
    }
};

void expect_cause(const WorstCells& worst, SharpnessCause cause, double measure, std::int32_t patch) {
    EXPECT_EQ(worst.count(), 1);
    const SharpCells& cells = worst.of(cause);
    EXPECT_EQ(cells.count, 1);
    EXPECT_LT(cells.angle_deg, WorstCells::bound_deg);
    EXPECT_NEAR(cells.measure, measure, 1e-9);
    EXPECT_EQ(cells.patch, patch);
}

TEST(WorstCells, AreInEdgesOfTheBody) {
    Body body(Vec3(0.2, 0.4, 0.02));  // its angle at the edge from 0 to 1 is that of the body
    body.facets = {{0, 2, 1}, {0, 1, 3}};
    expect_cause(body.worst(), SharpnessCause::edge, std::atan(0.02 / 0.4) * degrees, 5);
    body.facets = {{0, 1, 2}, {0, 3, 1}};  // the body is outside, and its angle is that to a full turn
    EXPECT_EQ(body.worst().of(SharpnessCause::edge).count, 0);
}

TEST(WorstCells, AreBetweenWalls) {
    Body body(Vec3(0.3, 0.3, 0.01));
    body.facets = {{0, 2, 1}};
    EXPECT_EQ(body.worst().of(SharpnessCause::walls).count, 0) << "the body is deep";
    body.add({Vec3(-2, -2, 0.01), Vec3(6, -2, 0.01), Vec3(-2, 6, 0.01)});
    EXPECT_EQ(body.worst().of(SharpnessCause::walls).count, 1);
    EXPECT_NEAR(body.worst().of(SharpnessCause::walls).measure, 0.01, 1e-9);
    EXPECT_EQ(body.worst(true).of(SharpnessCause::walls).count, 0) << "an interface is no wall";
}

TEST(WorstCells, StandOnNeedles) {
    Body body(Vec3(0.3, 0.3, 0.01));
    body.add({Vec3(0.5, -0.01, 0), Vec3(5, 5, 5), Vec3(5, 5, 6)});
    body.facets = {{0, 1, 4}};
    expect_cause(body.worst(), SharpnessCause::facet, std::atan(0.01 / 0.5) * degrees, 5);
}

TEST(WorstCells, AreAtCutsOrForNoReasonThatIsKnown) {
    Body body(Vec3(0.3, 0.3, 0.01));
    body.facets = {{0, 2, 1}};
    expect_cause(body.worst(true), SharpnessCause::cut, 0, -1);
    body.add({Vec3(5, 5, 5), Vec3(6, 5, 5), Vec3(5, 6, 5)});
    body.facets = {body.facets.back()};
    expect_cause(body.worst(), SharpnessCause::unknown, 0, -1);
}

TEST(WorstCells, AreNoneWhereAllAreGoodAndAddUp) {
    Body good(Vec3(0, 0, 1));
    good.facets = {{0, 2, 1}};
    EXPECT_EQ(good.worst().count(), 0);
    SharpCells sum{2, 3, Vec3::Zero(), 1, 7};
    sum.add({3, 1, Vec3::Ones(), 2, 8});
    sum.add({1, 2, Vec3::Zero(), 3, 9});
    EXPECT_EQ(sum.count, 6);
    EXPECT_EQ(sum.angle_deg, 1);
    EXPECT_EQ(sum.patch, 8);
    WorstCells worst;
    worst.by_cause[1] = sum;
    worst.smallest_deg = 1;
    const auto again = from_bytes<WorstCells>(to_bytes(worst));
    EXPECT_EQ(again.of(SharpnessCause::walls).count, 6);
    EXPECT_EQ(again.smallest_deg, 1);
}

}  // namespace
}  // namespace kerf

// Laws of solutions of order 2 on curved cells and of their estimated errors, on one or more ranks: a part of
// solve_ranks_test.
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "cube_of_parts.h"
#include "solve/equations/linear_system.h"
#include "solve/equations/stress.h"
#include "support/known_fields.h"

namespace kerf {
namespace {

// The body under a map, the same in all parts. Nodes on edges are images of their middles, or the middles of straight
// edges.
std::unique_ptr<FeSpace> mapped(const RunParts& mesh, Vec3 (*map)(const Vec3&), bool is_curved = true) {
    MpiRanks& all = *test::ranks_of_program->mpi;
    std::vector<Part> parts = test::parts_on(all, mesh);
    for (Part& part : parts) {
        std::vector<Vec3>& vertices = part.mesh.vertices;
        const std::vector<Vec3> before = vertices;
        for (Vec3& vertex : vertices) vertex = map(vertex);
        const auto middle = [](const std::vector<Vec3>& points, const UndirectedEdge& edge) -> Vec3 {
            return 0.5 * (points[static_cast<std::size_t>(edge[0])] + points[static_cast<std::size_t>(edge[1])]);
        };
        part.edge_nodes.edges = EdgeTable(part.mesh.tets, vertices.size());
        part.edge_nodes.global_id.resize(part.edge_nodes.edges.size());  // nobody asks for them
        part.edge_nodes.edges.for_all([&](std::int32_t, const UndirectedEdge& edge) {
            part.edge_nodes.points.push_back(is_curved ? map(middle(before, edge)) : middle(vertices, edge));
        });
    }
    return test::space_of(all, mesh, std::move(parts), 2);
}

Vec3 same(const Vec3& p) { return p; }
Vec3 bent(const Vec3& p) {
    const Vec3 s = (3 * p).array().sin();
    return p + 0.05 * Vec3(s.y(), s.z(), s.x());
}
Vec3 folded(const Vec3& p) { return p + 0.3 * Vec3((20 * p).array().sin()); }
// The cube becomes a piece of a thick sphere between four planes through its middle.
Vec3 in_sphere(const Vec3& p) { return (1 + p.x()) * Vec3(1, p.y() - 0.5, p.z() - 0.5).normalized(); }

SolverOptions exact() {
    SolverOptions options;
    options.rtol = 1e-12;
    return options;
}

// Irons, Bazeley, of cells of which every edge is curved.
TEST(CurvedSolution, PassesThePatchTest) {
    const auto of_mesh = mapped(*test::CubeOfParts::parts, bent);
    const FeSpace& space = *of_mesh;
    const Material steel{"steel", 210e3, 0.3, 0};
    static const Eigen::Matrix3d slope = (Eigen::Matrix3d() << 1, 2, -3, 0.5, -1, 4, 2, 0.25, 3).finished() * 1e-3;
    const test::KnownField linear{steel, [](const Vec3& p) -> Vec3 { return slope * p; },
                                  [](const Vec3&) -> Eigen::Matrix3d { return slope; }, test::no_force};
    const test::KnownProblem known = test::known_problem(space, linear);
    std::vector<double> u;
    EXPECT_TRUE(LinearSystem(known.problem, exact()).solve(known.forces, u).converged);
    double off = 0, wrong = 0;
    for (std::size_t n = 0; n < space.points().size(); ++n)
        off = std::max(off, (Eigen::Map<const Vec3>(&u[3 * n]) - slope * space.points()[n]).norm());
    EXPECT_LT(off, 1e-11);
    const SymmetricTensor stress = stress_of(steel, strain_of(slope));
    const StressField found = recover_stress(known.problem, u);
    for (const PartStress& part : found.parts)
        for (const auto* all : {&part.of_tet, &part.at_vertex, &part.at_edge})
            for (const SymmetricTensor& s : *all) wrong = std::max(wrong, (s - stress).norm());
    EXPECT_LT(wrong, 1e-7 * stress.norm());
    EXPECT_LT(found.norms.relative(), 1e-7);
}

TEST(CurvedSolution, RefusesFoldedCells) { EXPECT_THROW(mapped(*test::CubeOfParts::parts, folded), Error); }

struct Found {
    test::KnownErrors errors;
    double estimate = 0;  // beside the norm of the field
};

Found solve(const RunParts& run, const test::KnownField& field, Vec3 (*map)(const Vec3&), bool is_curved = true) {
    const auto of_mesh = mapped(run, map, is_curved);
    const FeSpace& space = *of_mesh;
    const test::KnownProblem known = test::known_problem(space, field);
    std::vector<double> u;
    EXPECT_TRUE(LinearSystem(known.problem, exact()).solve(known.forces, u).converged);
    const test::KnownErrors errors = test::errors_of(space, field, u);
    return {errors, recover_stress(known.problem, u).norms.error / errors.energy_of_field};
}

void expect_good_estimate(const Found& found) {
    EXPECT_GT(found.estimate / found.errors.energy, 0.8);
    EXPECT_LT(found.estimate / found.errors.energy, 1.25);
}

TEST(EstimateOfOrderTwo, IsNearTheErrorOfSines) {
    expect_good_estimate(solve(*test::CubeOfParts::sized_parts[1], test::sine, same));
}

// Lame's sphere under pressure inside. Flat facets leave an error of h^2; curved ones do not, so that what they gain
// grows as h falls. Meshes as coarse as these are too uneven for the orders themselves.
TEST(CurvedSolution, ConvergesToLame) {
    const auto found = [](std::size_t i, bool is_curved) {
        return solve(*test::CubeOfParts::sized_parts[i], test::pressed_sphere, in_sphere, is_curved);
    };
    const Found curved_0 = found(0, true), curved_1 = found(1, true), flat_0 = found(0, false),
                flat_1 = found(1, false);
    const double gain_0 = flat_0.errors.l2 / curved_0.errors.l2, gain_1 = flat_1.errors.l2 / curved_1.errors.l2;
    EXPECT_GT(gain_0, 3);
    EXPECT_GT(gain_1, 1.5 * gain_0);
    EXPECT_LT(curved_1.errors.energy, curved_0.errors.energy / 2);
    expect_good_estimate(curved_0);
    expect_good_estimate(curved_1);
}

}  // namespace
}  // namespace kerf

// Loads and supports of cases beside formulas, on one or more ranks: every test on all ranks together.
#include <cmath>

#include <fmt/format.h>

#include "cube_of_parts.h"
#include "solve/equations/elastic_problem.h"
#include "solve/equations/linear_system.h"
#include "solve/run/inside/case_report.h"

namespace kerf {
namespace {

using test::largest;

// The cube [0, 1]^3 of a material, elements of order 1 or 2.
class CaseLaws : public testing::TestWithParam<int> {
 protected:
    void SetUp() override {
        space_ = test::space_on(*test::ranks_of_program->mpi, GetParam(), *test::CubeOfParts::coarse_parts);
    }

    static ElasticCase case_of(double poisson) {
        ElasticCase wanted;
        Material material{"stuff", 1000, poisson, 2};
        material.expansion = 1e-3;
        material.yield = 40;
        wanted.materials = {{material, {}, {}, {}, ""}};
        wanted.solver.rtol = 1e-12;
        return wanted;
    }
    // One of the six: component of the normal, 0 or 1.
    static SurfaceSelection face(int component, double at) {
        SurfaceSelection where;
        std::array<double, 4> plane{};
        plane[static_cast<std::size_t>(component)] = 1;
        plane[3] = at;
        where.plane = plane;
        return where;
    }
    static Support roller(int component, double at, double displacement = 0) {
        Support support;
        support.name = fmt::format("roller {} {}", component, at);
        support.where = face(component, at);
        support.displacement[static_cast<std::size_t>(component)] = displacement;
        return support;
    }
    static Load traction(int component, double at, const Vec3& value, const std::string& of_case = "") {
        Load load;
        load.name = "pull";
        load.where = face(component, at);
        load.traction = value;
        load.load_case = of_case;
        return load;
    }
    // Holds a vertex of the cube as the field has it.
    template <class Field>
    static Support pin(const Vec3& point, const std::array<bool, 3>& components, const Field& field) {
        Support support;
        support.name = "pin";
        support.where.point = point;
        for (std::size_t c = 0; c < 3; ++c)
            if (components[c]) support.displacement[c] = field(point)[static_cast<Eigen::Index>(c)];
        return support;
    }
    // What would make a uniform stress, on all faces but those where `skip` says so.
    template <class Skip>
    static void pull_everywhere(ElasticCase& wanted, const Eigen::Matrix3d& stress, const Skip& skip) {
        for (int c = 0; c < 3; ++c)
            for (const double at : {0.0, 1.0})
                if (!skip(c, at)) wanted.loads.push_back(traction(c, at, (2 * at - 1) * stress.col(c)));
    }

    void solve(const ElasticCase& wanted) {
        problem_ = make_problem(*space_, test::CubeOfParts::coarse_parts->outline(), wanted);
        LinearSystem system(problem_, wanted.solver);
        for (std::size_t i = 0; i < problem_.cases.size(); ++i) {
            CaseSolution& solution = solutions_.emplace_back();
            EXPECT_TRUE(system.solve(problem_.cases[i].forces, solution.displacement).converged);
            if (problem_.relief.is_needed()) problem_.relief.remove_motions(problem_, solution.displacement);
            solution.stress = recover_stress(problem_, solution.displacement, i);
            report_case(problem_, solution, i, {}, reports_.emplace_back());
            EXPECT_LT(reports_.back().imbalance, 1e-9);
        }
    }
    // The largest over all nodes and ranks.
    template <class Field>
    double difference(const Field& field, std::size_t of_case = 0) const {
        double most = 0;
        for (std::int32_t n = 0; n < space_->node_count(); ++n)
            most = std::max(
                most,
                (Eigen::Map<const Vec3>(&solutions_[of_case].displacement[3 * n]) - field(space_->points()[n])).norm());
        return largest(most);
    }
    double stress_difference(const SymmetricTensor& stress) const {
        double most = 0;
        for (const PartStress& part : solutions_[0].stress.parts)
            for (const SymmetricTensor& s : part.at_vertex) most = std::max(most, (s - stress).norm());
        return largest(most);
    }
    const ForceAndMoment& reaction(std::size_t support, std::size_t of_case = 0) const {
        return reports_[of_case].reactions[support];
    }
    std::unique_ptr<FeSpace> space_;
    ElasticProblem problem_;
    std::vector<CaseSolution> solutions_;
    std::vector<CaseReport> reports_;
};

INSTANTIATE_TEST_SUITE_P(Orders, CaseLaws, testing::Values(1, 2));

TEST_P(CaseLaws, WarmBodiesGrowWithoutStressWhereNothingHoldsThem) {
    ElasticCase wanted = case_of(0.3);
    wanted.temperatures = {{20, {}, {}, ""}};
    wanted.supports = {roller(0, 0), roller(1, 0), roller(2, 0)};
    solve(wanted);
    EXPECT_LT(difference([](const Vec3& p) -> Vec3 { return 0.02 * p; }), 1e-11);
    EXPECT_LT(stress_difference(SymmetricTensor::Zero()), 1e-7);
    for (std::size_t s = 0; s < 3; ++s) EXPECT_LT(reaction(s).force.norm(), 1e-8);
}

TEST_P(CaseLaws, AWarmBarBetweenWallsIsPressed) {
    ElasticCase wanted = case_of(0.3);
    wanted.temperatures = {{15, {"stuff"}, {}, ""}, {5, {}, {}, ""}};  // they add up
    wanted.supports = {roller(0, 0), roller(0, 1), roller(1, 0), roller(2, 0)};
    solve(wanted);
    SymmetricTensor stress = SymmetricTensor::Zero();
    stress[0] = -1000 * 0.02;
    EXPECT_LT(stress_difference(stress), 1e-7);
    EXPECT_LT((reaction(0).force - Vec3(20, 0, 0)).norm(), 1e-8);
    EXPECT_LT((reaction(1).force - Vec3(-20, 0, 0)).norm(), 1e-8);
    EXPECT_NEAR(reports_[0].safety->value, 2, 1e-8);
    EXPECT_NEAR(reports_[0].norms.solution * reports_[0].norms.solution, 20 * 20 / 1000.0, 1e-9);
}

TEST_P(CaseLaws, ABarOnSpringsMovesAsFarAsTheyYield) {
    ElasticCase wanted = case_of(0);
    wanted.loads = {traction(0, 1, Vec3(6, 0, 0))};
    wanted.supports = {roller(1, 0), roller(2, 0)};
    Spring normal;
    normal.name = "ground";
    normal.where = face(0, 0);
    normal.normal = 30;
    Spring more = normal;
    more.normal.reset();
    more.stiffness = Vec3(90, 0, 0);
    wanted.springs = {normal, more};
    solve(wanted);
    EXPECT_LT(difference([](const Vec3& p) -> Vec3 { return {6 / 120.0 + 6 * p.x() / 1000, 0, 0}; }), 1e-10);
    EXPECT_LT((reaction(2).force - Vec3(-1.5, 0, 0)).norm(), 1e-9);
    EXPECT_LT((reaction(3).force - Vec3(-4.5, 0, 0)).norm(), 1e-9);
    EXPECT_LT(reaction(3).moment.norm(), 1e-8);  // about the middle of the face
}

TEST_P(CaseLaws, SpringsInAllDirectionsAreASupport) {
    ElasticCase wanted = case_of(0.3);
    wanted.loads = {traction(2, 1, Vec3(0, 0, -5))};
    Spring ground;
    ground.name = "ground";
    ground.where = face(2, 0);
    ground.stiffness = Vec3::Constant(50);
    wanted.springs = {ground};
    solve(wanted);
    EXPECT_LT((reaction(0).force - Vec3(0, 0, 5)).norm(), 1e-8);
    wanted.springs[0].stiffness = Vec3(0, 0, 50);
    EXPECT_THROW(make_problem(*space_, test::CubeOfParts::coarse_parts->outline(), wanted), Error);
}

// A linear field for which a face slides on an inclined plane. All nodes of it are held askew, some of them by two.
TEST_P(CaseLaws, AnInclinedRollerPushesAlongItsDirectionAlone) {
    ElasticCase wanted = case_of(0.3);
    Eigen::Matrix3d strain;
    strain << 2, 1, -3, 1, 4, 0.5, -3, 0.5, 1;
    strain *= 1e-3;
    const auto field = [&](const Vec3& p) -> Vec3 { return strain * p; };
    const Vec3 along = strain.col(1).cross(strain.col(2)).normalized();
    const SymmetricTensor tensor = stress_of(wanted.materials[0].material, strain_of(strain));
    Eigen::Matrix3d stress;
    stress << tensor[0], tensor[3], tensor[5], tensor[3], tensor[1], tensor[4], tensor[5], tensor[4], tensor[2];
    pull_everywhere(wanted, stress, [](int c, double at) { return c == 0 && at == 0; });
    const Vec3 at_slope = -stress.col(0);
    wanted.loads.push_back(traction(0, 0, at_slope - along.dot(at_slope) * along));
    Support slope;
    slope.name = "slope";
    slope.where = face(0, 0);
    slope.frame = Support::Frame::direction;
    slope.direction = along;
    slope.displacement[0] = 0;
    wanted.supports = {slope, pin(Vec3(0, 0, 0), {false, true, true}, field),
                       pin(Vec3(0, 1, 0), {false, false, true}, field)};
    solve(wanted);
    EXPECT_LT(difference(field), 1e-11);
    EXPECT_LT(stress_difference(tensor), 1e-7);
    EXPECT_LT((reaction(0).force - along.dot(at_slope) * along).norm(), 1e-8);
    for (const std::size_t pinned : {1U, 2U}) EXPECT_LT(reaction(pinned).force.norm(), 1e-8);
}

TEST_P(CaseLaws, TheNormalOfAFaceIsItsDirection) {
    ElasticCase wanted = case_of(0.3);
    wanted.loads = {traction(0, 1, Vec3(10, 0, 0))};
    for (int c = 0; c < 3; ++c) {
        Support& support = wanted.supports.emplace_back(roller(c, 0));
        support.frame = Support::Frame::normal;
        support.displacement = {c == 0 ? 0.5 : 0, std::nullopt, std::nullopt};  // outwards
    }
    solve(wanted);
    EXPECT_LT(difference([](const Vec3& p) -> Vec3 {
                  return {0.01 * p.x() - 0.5, -0.003 * p.y(), -0.003 * p.z()};
              }),
              1e-10);
    EXPECT_TRUE(problem_.frames.empty());
}

// What grows from an axis does not turn about it.
TEST_P(CaseLaws, WhatIsHeldAroundAnAxisGrowsFromIt) {
    ElasticCase wanted = case_of(0.3);
    const Vec3 on_axis(-0.5, -0.3, 0);
    const auto field = [&](const Vec3& p) -> Vec3 { return 1e-3 * Vec3(p.x() - on_axis.x(), p.y() - on_axis.y(), 0); };
    const Eigen::Matrix3d slope = Vec3(1e-3, 1e-3, 0).asDiagonal();
    const SymmetricTensor tensor = stress_of(wanted.materials[0].material, strain_of(slope));
    pull_everywhere(wanted, Eigen::Matrix3d(tensor.head<3>().asDiagonal()),
                    [](int c, double at) { return c == 2 && at == 0; });
    Support around;
    around.name = "around";
    around.where = face(2, 0);
    around.frame = Support::Frame::cylinder;
    around.axis = {on_axis, Vec3::UnitZ()};
    around.displacement = {std::nullopt, 0.0, 0.0};
    wanted.supports = {around};
    solve(wanted);
    EXPECT_LT(difference(field), 1e-11);
    EXPECT_LT((reaction(0).force + tensor[2] * Vec3::UnitZ()).norm(), 1e-8);
    EXPECT_LT(reaction(0).moment.norm(), 1e-8);
    wanted.supports[0].axis.point = Vec3(0, 0, 7);
    EXPECT_THROW(make_problem(*space_, test::CubeOfParts::coarse_parts->outline(), wanted), Error);
}

// Without Poisson's ratio the body is bars along x and y: u = rho omega^2 (x - x^3 / 3) / (2 E).
TEST_P(CaseLaws, ATurningBodyIsPulledOutwards) {
    ElasticCase wanted = case_of(0);
    wanted.supports = {roller(0, 0), roller(1, 0), roller(2, 0)};
    wanted.rotations = {{{Vec3(0, 0, 5), Vec3::UnitZ()}, 3, ""}};
    solve(wanted);
    const double scale = 2 * 9 / 2000.0;
    const auto of = [&](double x) { return scale * (x - x * x * x / 3); };
    EXPECT_LT(difference([&](const Vec3& p) -> Vec3 {
                  return {of(p.x()), of(p.y()), 0};
              }),
              (GetParam() == 1 ? 0.15 : 0.01) * scale);
    EXPECT_LT((reaction(0).force - Vec3(-9, 0, 0)).norm(), 1e-8);  // rho omega^2 / 2, whatever the elements
    EXPECT_LT((reports_[0].load - Vec3(9, 9, 0)).norm(), 1e-10);
}

// Pushed at one end: u = -p (x - x^2 / 2 - 1/3) / E, without momentum; and turned by a pull across.
TEST_P(CaseLaws, InertiaTakesTheLoadsOfAFreeBody) {
    ElasticCase wanted = case_of(0);
    wanted.solver.inertia_relief = true;
    wanted.load_cases = {"push", "turn"};
    wanted.loads = {traction(0, 0, Vec3(4, 0, 0), "push"), traction(0, 1, Vec3(0, 6, 0), "turn")};
    solve(wanted);
    const auto field = [](const Vec3& p) -> Vec3 {
        return {-4 / 1000.0 * (p.x() - p.x() * p.x() / 2 - 1 / 3.0), 0, 0};
    };
    EXPECT_LT(difference(field), GetParam() == 1 ? 3e-4 : 1e-11);
    for (const std::size_t of_case : {0U, 1U}) {
        EXPECT_LT(reaction(0, of_case).force.norm(), 1e-8);
        ASSERT_EQ(reports_[of_case].relieved.size(), 1U);
        EXPECT_LT((reports_[of_case].relieved[0].centre - Vec3(0.5, 0.5, 0.5)).norm(), 1e-10);
    }
    const BodyInertia &pushed = reports_[0].relieved[0], &turned = reports_[1].relieved[0];
    EXPECT_LT((pushed.acceleration - Vec3(2, 0, 0)).norm(), 1e-9);
    EXPECT_LT(pushed.angular_acceleration.norm(), 1e-9);
    EXPECT_LT((turned.acceleration - Vec3(0, 3, 0)).norm(), 1e-9);
    EXPECT_LT((turned.angular_acceleration - Vec3(0, 0, 9)).norm(), 1e-8);  // moment 3 beside mass / 6
}

// Only what the supports leave free is accelerated.
TEST_P(CaseLaws, InertiaTakesWhatSupportsLeave) {
    ElasticCase wanted = case_of(0);
    wanted.solver.inertia_relief = true;
    wanted.supports = {roller(1, 0), roller(2, 0)};
    wanted.loads = {traction(0, 0, Vec3(4, 0, 0)), traction(1, 1, Vec3(0, 5, 0))};
    solve(wanted);
    EXPECT_LT((reports_[0].relieved[0].acceleration - Vec3(2, 0, 0)).norm(), 1e-9);
    EXPECT_LT((reaction(0).force - Vec3(0, -5, 0)).norm(), 1e-8);
    EXPECT_LT(reaction(2).force.norm(), 1e-8);
    wanted.materials[0].material.density = 0;
    EXPECT_THROW(make_problem(*space_, test::CubeOfParts::coarse_parts->outline(), wanted), Error);
}

TEST_P(CaseLaws, CombinationsAreSums) {
    ElasticCase wanted = case_of(0.3);
    wanted.supports = {roller(0, 0), roller(1, 0), roller(2, 0)};
    wanted.load_cases = {"pull", "heat", "both"};
    wanted.loads = {traction(0, 1, Vec3(3, 0, 0), "pull"), traction(0, 1, Vec3(6, 0, 0), "both")};
    wanted.gravity = {{Vec3(0, 0, -2), ""}};
    wanted.temperatures = {{10, {}, {}, "heat"}, {-5, {}, {}, "both"}};
    wanted.combinations = {{"sum", {{"heat", -0.5}, {"pull", 1.5}}}};
    solve(wanted);
    const std::vector<double>&sum = solutions_[3].displacement, &both = solutions_[2].displacement;
    double most = 0, size = 0;
    for (std::size_t dof = 0; dof < sum.size(); ++dof) {
        const double wanted_here = 1.5 * solutions_[0].displacement[dof] - 0.5 * solutions_[1].displacement[dof];
        most = std::max(most, std::abs(sum[dof] - wanted_here));
        size = std::max(size, std::abs(both[dof]));
    }
    EXPECT_LT(largest(most), 1e-9 * largest(size));
    EXPECT_LT((reports_[3].reactions[0].force - (1.5 * reaction(0, 0).force - 0.5 * reaction(0, 1).force)).norm(),
              1e-8);
    EXPECT_NEAR(reaction(0, 2).force.x(), -6, 1e-8);
    EXPECT_LT((reaction(2, 1).force - Vec3(0, 0, 4)).norm(), 1e-8);  // the weight
    wanted.supports[0].displacement[0] = 0.1;
    EXPECT_THROW(make_problem(*space_, test::CubeOfParts::coarse_parts->outline(), wanted), Error);
}

}  // namespace
}  // namespace kerf

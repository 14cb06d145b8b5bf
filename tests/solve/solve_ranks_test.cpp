// Laws of the solution on one or more ranks: this program runs under mpirun, every test on all ranks together.
#include <mpi.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "cube_of_parts.h"
#include "files/part/run_parts.h"
#include "solve/equations/elastic_problem.h"
#include "solve/equations/error_sizes.h"
#include "solve/equations/inside/block_rows.h"
#include "solve/equations/inside/held_stiffness.h"
#include "solve/equations/inside/rigid_motions.h"
#include "solve/equations/linear_system.h"
#include "solve/equations/stress.h"

namespace kerf {
namespace {

using test::CubeOfParts;
using test::largest;
using test::rank;
using test::ranks;
using test::ranks_of_program;
using test::space_on;

class Solution : public testing::TestWithParam<int> {
 protected:
    void SetUp() override { space_ = space_on(*ranks_of_program->mpi, GetParam()); }

    // Holds the surface where `held` says so: all three components, or one.
    template <class Displacement>
    void hold_surface(ElasticProblem& problem, const Displacement& displacement) const {
        for (std::size_t p = 0; p < space_->parts().size(); ++p)
            for (std::size_t f = 0; f < space_->parts()[p].facets.size(); ++f)
                if (!space_->parts()[p].is_interface(f))
                    for (const std::int32_t node : space_->nodes_of_facet(p, f))
                        for (std::size_t c = 0; node >= 0 && c < 3; ++c)
                            problem.support_of[3 * static_cast<std::size_t>(node) + c] = 0;
        problem.supports = {"surface"};
        problem.places = {Vec3::Zero()};
        space_->ownership().smallest_over_ranks(std::span(problem.support_of), 3);
        for (std::int32_t n = 0; n < space_->node_count(); ++n)
            for (std::size_t c = 0; c < 3; ++c)
                if (problem.is_held(3 * n + c))
                    problem.prescribed[3 * n + c] = displacement(space_->points()[n])[static_cast<Eigen::Index>(c)];
    }
    template <class Displacement>
    double difference(const std::vector<double>& u, const Displacement& displacement) const {
        double most = 0;
        for (std::int32_t n = 0; n < space_->node_count(); ++n)
            most = std::max(most, (Eigen::Map<const Vec3>(&u[3 * n]) - displacement(space_->points()[n])).norm());
        return largest(most);
    }
    static SolverOptions exact(const std::string& preconditioner) {
        SolverOptions options;
        options.preconditioner = preconditioner;
        options.rtol = 1e-13;
        return options;
    }
    std::unique_ptr<FeSpace> space_;
    const Material steel_{"steel", 210e3, 0.3, 7.8e-9};
};

INSTANTIATE_TEST_SUITE_P(Orders, Solution, testing::Values(1, 2));

// Irons, Bazeley: a linear field at the boundary is that field inside, whatever the elements are.
TEST_P(Solution, PassesThePatchTest) {
    const Eigen::Matrix3d slope = (Eigen::Matrix3d() << 1, 2, -3, 0.5, -1, 4, 2, 0.25, 3).finished() * 1e-3;
    const auto field = [&](const Vec3& p) -> Vec3 { return slope * p + Vec3(1e-3, 0, -2e-3); };
    for (const char* preconditioner : {"multigrid", "icc"}) {
        ElasticProblem problem = make_free_problem(*space_, steel_);
        hold_surface(problem, field);
        LinearSystem system(problem, exact(preconditioner));
        EXPECT_EQ(system.unprepared_entries(), 0);
        std::vector<double> u;
        const std::vector<double> no_forces(3 * space_->node_count(), 0);
        const SolveOutcome outcome = system.solve(no_forces, u);
        EXPECT_TRUE(outcome.converged) << outcome.reason;
        EXPECT_LT(difference(u, field), 1e-10 * 5e-3);
        const SymmetricTensor stress = stress_of(steel_, strain_of(slope));
        const StressField found = recover_stress(problem, u);
        for (const PartStress& part : found.parts) {
            for (const SymmetricTensor& s : part.of_tet) EXPECT_LT((s - stress).norm(), 1e-9 * stress.norm());
            for (const SymmetricTensor& s : part.at_vertex) EXPECT_LT((s - stress).norm(), 1e-9 * stress.norm());
        }
        EXPECT_LT(found.norms.relative(), 1e-8);
        EXPECT_LT(reactions(problem, u).of(0).force.norm(), 1e-9 * stress.norm());
    }
}

// However many materials there are, also between ranks: each cell with one of its own has the stress of that, without
// an error.
TEST_P(Solution, StressesOfMaterialsDoNotMix) {
    const Eigen::Matrix3d slope = (Eigen::Matrix3d() << 1, 2, -3, 0.5, -1, 4, 2, 0.25, 3).finished() * 1e-3;
    const SymmetricTensor strain = strain_of(slope);
    std::vector<double> u(3 * space_->node_count());
    for (std::int32_t n = 0; n < space_->node_count(); ++n) Eigen::Map<Vec3>{&u[3 * n]} = slope * space_->points()[n];
    ElasticProblem problem = make_free_problem(*space_, steel_);
    problem.materials.clear();
    std::map<NodeId, std::size_t> first;  // material of a part
    for (const PartExtent& part : CubeOfParts::parts->outline().parts)
        for (std::int64_t t = 0; t < part.tets; ++t) {
            first.emplace(part.id, problem.materials.size());
            const double young = 1000 + 3 * static_cast<double>(problem.materials.size());
            problem.materials.push_back({"own", young, 0.3, 1});
        }
    ASSERT_GT(problem.materials.size(), 500);
    for (const Part& part : space_->parts()) {
        std::vector<MaterialNumber>& of_tet = problem.material_of_tet.emplace_back();
        for (std::size_t t = 0; t < part.mesh.tets.size(); ++t)
            of_tet.push_back(static_cast<MaterialNumber>(first.at(part.id) + t));
    }
    const StressField found = recover_stress(problem, u);
    EXPECT_LT(found.norms.relative(), 1e-9);
    for (std::size_t p = 0; p < found.parts.size(); ++p) {
        const std::vector<Tetrahedron>& tets = space_->parts()[p].mesh.tets;
        std::vector<SymmetricTensor> last(space_->parts()[p].mesh.vertices.size());
        for (std::size_t t = 0; t < tets.size(); ++t) {
            const SymmetricTensor stress = stress_of(problem.material(p, t), strain);
            EXPECT_LT((found.parts[p].of_tet[t] - stress).norm(), 1e-9 * stress.norm());
            for (const std::int32_t v : tets[t]) last[static_cast<std::size_t>(v)] = stress;
        }
        for (std::size_t v = 0; v < last.size(); ++v)
            EXPECT_LT((found.parts[p].at_vertex[v] - last[v]).norm(), 1e-9 * last[v].norm());
    }
}

// Conjugate gradients need a preconditioner that is symmetric and positive, for any elements, axes of nodes and ranks.
TEST_P(Solution, AMultigridIsSymmetricAndPositive) {
    ElasticProblem problem = make_free_problem(*space_, steel_);
    hold_surface(problem, [](const Vec3&) -> Vec3 { return Vec3::Zero(); });
    problem.frames = NodeFrames(problem.space->node_count());
    NodeHolds askew;
    askew.hold(Vec3(1, 2, 3).normalized(), 0, 0);
    for (std::int32_t n = 0; n < space_->node_count(); ++n)
        if (space_->row_of(n) % 3 == 0) problem.frames.set(n, askew);
    const HeldStiffness stiffness = hold_stiffness(problem, stiffness_of_rank(problem));
    const LevelMatrix<3>& matrix = stiffness.matrix;
    const auto multigrid = multigrid_for(problem, stiffness, 0);
    std::array<std::vector<double>, 2> x, m;
    for (std::size_t i = 0; i < 2; ++i) {
        for (std::size_t dof = 0; dof < matrix.size(); ++dof)
            x[i].push_back(std::sin(static_cast<double>((i + 2) * (3 * space_->first_row() + dof))));
        m[i].resize(matrix.size());
        multigrid->cycle(x[i], m[i]);
    }
    const auto dot = [&](const std::vector<double>& a, const std::vector<double>& b) {
        return dot_of_owned(space_->ranks(), matrix.owned_size(), a, b);
    };
    const double scale = std::sqrt(dot(x[0], m[0]) * dot(x[1], m[1]));
    EXPECT_GT(dot(x[0], m[0]), 0);
    EXPECT_GT(dot(x[1], m[1]), 0);
    EXPECT_NEAR(dot(x[0], m[1]), dot(x[1], m[0]), 1e-12 * scale);
}

// Whichever rank comes first: what several of them add to one row was once added as it came.
TEST_P(Solution, HasTheSameBytesEachTime) {
    const auto field = [](const Vec3& p) -> Vec3 { return 1e-3 * Vec3(p.y() * p.x(), p.z(), p.x() * p.x()); };
    for (const char* preconditioner : {"multigrid", "icc"}) {
        std::vector<double> first;
        for (int late = 0; late < ranks(); ++late) {
            ElasticProblem problem = make_free_problem(*space_, steel_);
            hold_surface(problem, field);
            if (rank() == late) std::this_thread::sleep_for(std::chrono::milliseconds(20));
            LinearSystem system(problem, exact(preconditioner));
            std::vector<double> u;
            EXPECT_TRUE(system.solve(std::vector<double>(3 * space_->node_count(), 0), u).converged);
            if (late == 0) first = u;
            EXPECT_EQ(u, first);
        }
    }
}

// PETSc is the program's, and runs on all ranks; each of two groups of them has a space and a solution of its own.
TEST_P(Solution, IsOneOnSomeOfTheRanksOfAProgramWithPetsc) {
    MPI_Comm half = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, rank() % 2, -rank(), &half);
    {
        MpiRanks some(half);
        EXPECT_THROW(PetscSession(some, "no option"), Error);
        const PetscSession session(some);
        const auto field = [](const Vec3& p) -> Vec3 { return 1e-3 * Vec3(p.y(), 2 * p.z(), p.x()); };
        space_ = space_on(some, GetParam());
        ElasticProblem problem = make_free_problem(*space_, steel_);
        hold_surface(problem, field);
        std::vector<double> u;
        const std::vector<double> no_forces(3 * space_->node_count(), 0);
        EXPECT_TRUE(LinearSystem(problem, exact("multigrid")).solve(no_forces, u).converged);
        EXPECT_LT(difference(u, field), 1e-10 * 2e-3);
        space_.reset();
    }
    MPI_Comm_free(&half);
}

// What a quadratic field wants as forces is constant: these elements have it exactly.
class SolutionOfOrderTwo : public Solution {};
INSTANTIATE_TEST_SUITE_P(Orders, SolutionOfOrderTwo, testing::Values(2));

TEST_P(SolutionOfOrderTwo, HasQuadraticFieldsExactly) {
    const auto field = [](const Vec3& p) -> Vec3 {
        return 1e-3 * Vec3(p.x() * p.x(), p.y() * p.z(), p.x() * p.z() - p.y() * p.y());
    };
    // div stress = (lambda + mu) grad(div u) + mu laplace(u); div u = (2x + z + x) / 1000
    const Vec3 density = -1e-3 * ((steel_.lambda() + steel_.mu()) * Vec3(3, 0, 1) + steel_.mu() * Vec3(2, 0, -2));
    ElasticProblem problem = make_free_problem(*space_, steel_);
    hold_surface(problem, field);
    std::vector<double> forces(3 * space_->node_count(), 0), u;
    for_all_tets(*space_, [&](std::size_t p, std::size_t t) {
        const auto volumes = space_->element(p, t).node_volumes();
        const auto nodes = space_->nodes_of(p, t);
        for (std::size_t i = 0; i < 10; ++i)
            Eigen::Map<Vec3>(&forces[3 * static_cast<std::size_t>(nodes[i])]) += volumes[i] * density;
    });
    LinearSystem system(problem, exact("multigrid"));
    EXPECT_TRUE(system.solve(forces, u).converged);
    EXPECT_LT(difference(u, field), 1e-10 * 2e-3);
}

// Rows follow from the parts alone: one rank with all parts numbers as many ranks do.
TEST_P(Solution, RowsAreTheSameForAnyRanks) {
    MpiRanks self(MPI_COMM_SELF);
    const std::unique_ptr<FeSpace> alone = space_on(self, GetParam());
    EXPECT_EQ(space_->total_rows(), alone->total_rows());
    EXPECT_EQ(static_cast<std::int64_t>(alone->owned_count()), alone->total_rows());
    const std::int32_t first = first_parts_of_ranks(CubeOfParts::parts->outline(), ranks())[rank()].value();
    for (std::size_t p = 0; p < space_->parts().size(); ++p)
        for (std::size_t t = 0; t < space_->parts()[p].mesh.tets.size(); ++t) {
            const auto here = space_->nodes_of(p, t), there = alone->nodes_of(first + p, t);
            for (std::size_t i = 0; i < static_cast<std::size_t>(element_nodes(GetParam())); ++i) {
                ASSERT_EQ(space_->row_of(here[i]), alone->row_of(there[i]));
                ASSERT_EQ(space_->points()[static_cast<std::size_t>(here[i])],
                          alone->points()[static_cast<std::size_t>(there[i])]);
            }
        }
}

TEST_P(Solution, GhostsHaveWhatOwnersHave) {
    const std::size_t nodes = space_->node_count();
    std::vector<std::int64_t> rows(nodes, -1);
    std::vector<double> counts(nodes, 1);
    for (std::int32_t n = 0; n < space_->owned_count(); ++n) rows[n] = space_->row_of(n);
    space_->ownership().from_owners(std::span(rows), 1);
    for (std::size_t n = 0; n < nodes; ++n) EXPECT_EQ(rows[n], space_->row_of(n));
    space_->ownership().sum_to_owners(std::span(counts), 1);
    double sum = 0, ghosts = static_cast<double>(nodes - space_->owned_count());
    for (std::int32_t n = 0; n < space_->owned_count(); ++n) sum += counts[n] - 1;
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, &ghosts, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_EQ(sum, ghosts);
}

double edge_sum(const SizedMesh& sizes) {
    double sum = 0;
    for (const double size : sizes.size) sum += size;
    return sum;
}

// Equal errors of all cells need all edges shorter by the same share; where there is no error, cells may be larger; and
// what is wanted does not depend on the ranks.
TEST_P(Solution, SizesFollowErrors) {
    MpiRanks self(MPI_COMM_SELF);
    const std::unique_ptr<FeSpace> alone = space_on(self, GetParam());
    SingleRank single;
    const auto sizes_of = [&](const FeSpace& space, Communicator& of_space, double aim, double from_x) {
        StressField field;
        for (const Part& part : space.parts()) {
            PartStress& stress = field.parts.emplace_back();
            for (const Tetrahedron& tet : part.mesh.tets)
                stress.error.push_back(part.mesh.vertices[static_cast<std::size_t>(tet[0])].x() < from_x ? 0 : 1);
        }
        field.norms = {std::sqrt(static_cast<double>(CubeOfParts::parts->outline().tets())) * std::sqrt(0.75), 0};
        field.norms.error = field.norms.solution / std::sqrt(3.0);  // beside the true norm: a half
        return sizes_for_error(space, {&field}, aim, of_space);
    };
    const SizedMesh same = sizes_of(*alone, single, 0.5, -1), half = sizes_of(*alone, single, 0.25, -1),
                    partly = sizes_of(*alone, single, 0.25, 0.5);
    const double expected = GetParam() == 1 ? 0.5 : std::sqrt(0.5);
    EXPECT_NEAR(edge_sum(half) / edge_sum(same), expected, 0.03);
    for (std::size_t v = 0; v < partly.vertices.size(); ++v) {
        const double x = partly.vertices[v].x();
        if (x < 0.05) {
            EXPECT_GT(partly.size[v], 1.5 * same.size[v]) << x;
        }
        if (x > 0.95) {
            EXPECT_LT(partly.size[v], same.size[v]) << x;
        }
    }
    const SizedMesh shared = sizes_of(*space_, *ranks_of_program->communicator, 0.25, 0.5);
    EXPECT_EQ(shared.vertices, partly.vertices);
    EXPECT_EQ(shared.size, partly.size);
    EXPECT_EQ(shared.tets, partly.tets);
}

TEST(Bodies, ACubeIsOne) {
    const auto space = space_on(*ranks_of_program->mpi, 1);
    EXPECT_EQ(find_bodies(*space).count, 1);
}

TEST(Supports, ThatLeaveMotionsAreRefusedWithTheirNames) {
    const auto space = space_on(*ranks_of_program->mpi, 1);
    const SpaceBodies bodies = find_bodies(*space);
    const auto refusal = [&](auto holds) -> std::string {
        ElasticProblem problem = make_free_problem(*space, {"steel", 1, 0.3, 0});
        for (std::int32_t n = 0; n < space->node_count(); ++n)
            for (std::size_t c = 0; c < 3; ++c)
                if (holds(space->points()[n], c)) problem.support_of[3 * n + c] = 0;
        try {
            require_supported(problem, bodies);
        } catch (const Error& error) {
            return error.what();
        }
        return "none";
    };
    const auto has = [](const std::string& text, const std::string& word) {
        EXPECT_NE(text.find(word), std::string::npos) << "'" << word << "' in: " << text;
    };
    double low = INFINITY;
    for (const Vec3& p : space->points()) low = std::min(low, p.z());
    MPI_Allreduce(MPI_IN_PLACE, &low, 1, MPI_DOUBLE, MPI_MIN, MPI_COMM_WORLD);
    const auto at_foot = [low](const Vec3& p) { return p.z() == low; };
    has(refusal([](const Vec3&, std::size_t) { return false; }), "not held at all");
    const std::string sliding = refusal([&](const Vec3& p, std::size_t c) { return at_foot(p) && c == 2; });
    has(sliding, "move along (");
    has(sliding, "turn about (0, 0, 1)");
    const std::string one_way = refusal([&](const Vec3& p, std::size_t c) { return at_foot(p) && c != 0; });
    has(one_way, "free to move along (1, 0, 0).");
    EXPECT_EQ(refusal([&](const Vec3& p, std::size_t) { return at_foot(p); }), "none");
}

TEST(Parts, AreSharedOutWholeAndEvenly) {
    const MeshOutline& outline = CubeOfParts::parts->outline();
    for (int count = 1; count <= 10; ++count) {
        const auto first = first_parts_of_ranks(outline, count);
        ASSERT_EQ(first.size(), static_cast<std::size_t>(count) + 1);
        EXPECT_EQ(first.front().value(), 0);
        EXPECT_EQ(first.back().value(), 7);
        for (std::size_t r = 0; r + 1 < first.size(); ++r) {
            EXPECT_LE(first[r], first[r + 1]);
            if (count <= 7) {
                EXPECT_LT(first[r], first[r + 1]) << "rank " << r << " of " << count;
            }
        }
    }
}

}  // namespace
}  // namespace kerf

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    const kerf::Ranks ranks = kerf::join_ranks(kerf::MpiUse::always);
    kerf::test::ranks_of_program = &ranks;
    const kerf::PetscSession petsc(*ranks.mpi);
    testing::AddGlobalTestEnvironment(new kerf::test::CubeOfParts);
    return RUN_ALL_TESTS();
}

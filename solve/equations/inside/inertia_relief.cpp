// Loads on a body that is free accelerate it, and the inertia of this acceleration balances them. A motion is six
// numbers, a translation and a rotation about the middle of the body (BodyMotions); the mass of the six is a 6 x 6
// matrix for each body, the integral of density times products of motions. Restricted to the free motions it turns the
// work of the loads in them into accelerations, whose inertia is added to the case as forces. The body is then fixed at
// as many displacements as it has free motions, which carry no force: one after the other, as elimination with pivots
// goes, the displacement that the motions still left move most; of those that are alike to 1e-9 the smallest row, so
// that the number of ranks does not matter. At the end the free motions are taken out of the displacements by their
// momenta.
#include "solve/equations/inside/inertia_relief.h"

#include <algorithm>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "solve/equations/elastic_problem.h"
#include "solve/equations/inside/body_forces.h"
#include "solve/equations/inside/rigid_motions.h"
#include "solve/multigrid/dense.h"

namespace kerf {

namespace {

using SixBySix = Eigen::Matrix<double, 6, 6>;

}  // namespace

InertiaRelief::InertiaRelief(ElasticProblem& problem, const SpaceBodies& bodies)
    : bodies_(bodies), motions_(free_motions(problem, bodies)) {
    for (const BodyMotions& body : motions_) is_needed_ = is_needed_ || body.free.cols() > 0;
    if (!is_needed_) return;
    measure_masses(problem);
    fix_motions(problem);
}

void InertiaRelief::measure_masses(const ElasticProblem& problem) {
    const FeSpace& space = *problem.space;
    std::vector<double> sums(36 * motions_.size(), 0);
    for_all_tets(space, [&](std::size_t p, std::size_t t) {
        const std::int32_t b = bodies_.of_node[space.nodes_of(p, t)[0]];
        if (motions_[b].free.cols() == 0) return;
        const double density = problem.material(p, t).density;
        Eigen::Map<SixBySix> sum(&sums[36 * b]);
        for_points_of(space.element(p, t), [&](const Vec3& place, double weight, const TetElement::Shapes&) {
            const auto motion = motions_[b].at(place);
            sum.noalias() += density * weight * motion.transpose() * motion;
        });
    });
    space.ranks().all_reduce(std::span(sums), Reduction::sum);
    for (std::size_t b = 0; b < motions_.size(); ++b) {
        masses_.emplace_back(Eigen::Map<const SixBySix>(&sums[36 * b]));
        if (motions_[b].free.cols() > 0 && masses_[b](0, 0) <= 0)
            throw Error(
                ErrorCode::usage,
                fmt::format("Inertia relief needs the mass of the body around ({:.6g}, {:.6g}, {:.6g}), but its "
                            "material has no density.",
                            motions_[b].middle.x(), motions_[b].middle.y(), motions_[b].middle.z()));
    }
}

std::vector<std::int64_t> InertiaRelief::next_to_fix(const ElasticProblem& problem,
                                                     const std::vector<Eigen::MatrixXd>& left) const {
    constexpr double like = 1e-9;  // of displacements as alike as this the smallest row is taken
    const FeSpace& space = *problem.space;
    std::vector<double> squares(motions_.size(), 0);
    std::vector<std::int64_t> dofs(motions_.size(), INT64_MAX);
    const auto square_of = [&](std::int32_t b, std::int32_t dof) -> double {
        const Eigen::RowVector3d axis = problem.frames.axis(dof).transpose();
        return (axis * motions_[b].at(space.points()[dof / 3]) * left[b]).squaredNorm();
    };
    const auto for_candidates = [&](auto visit) {
        for (std::int32_t dof = 0; dof < 3 * space.owned_count(); ++dof) {
            const std::int32_t b = bodies_.of_node[dof / 3];
            if (left[b].cols() > 0 && !problem.is_held(dof)) visit(b, dof, square_of(b, dof));
        }
    };
    for_candidates([&](std::int32_t b, std::int32_t, double square) { squares[b] = std::max(squares[b], square); });
    space.ranks().all_reduce(std::span(squares), Reduction::largest);
    for_candidates([&](std::int32_t b, std::int32_t dof, double square) {
        if (square >= squares[b] * (1 - like)) dofs[b] = std::min(dofs[b], 3 * space.first_row() + dof);
    });
    space.ranks().all_reduce(std::span(dofs), Reduction::smallest);
    return dofs;
}

// Fixes one displacement of each body after the other, as elimination with pivots does.
void InertiaRelief::fix_motions(ElasticProblem& problem) const {
    const FeSpace& space = *problem.space;
    const auto holder = count_of(problem.supports);
    problem.supports.emplace_back("inertia relief");
    problem.places.push_back(motions_.front().middle);
    std::vector<Eigen::MatrixXd> left;
    Eigen::Index most = 0;
    for (const BodyMotions& body : motions_) {
        left.push_back(body.free);
        most = std::max(most, body.free.cols());
    }
    for (Eigen::Index step = 0; step < most; ++step) {
        const std::vector<std::int64_t> dofs = next_to_fix(problem, left);
        std::vector<double> moved(6 * left.size(), 0);  // the motions of each body at its fixed displacement
        for (std::int32_t n = 0; n < space.node_count(); ++n) {
            const std::size_t b = bodies_.of_node[n];
            const std::int64_t c = dofs[b] - 3 * space.row_of(n);
            if (left[b].cols() == 0 || c < 0 || c > 2) continue;
            const std::size_t dof = 3 * n + c;
            problem.support_of[dof] = holder;
            if (n < space.owned_count())
                Eigen::Map<Motion>{&moved[6 * b]} =
                    motions_[b].at(space.points()[n]).transpose() * problem.frames.axis(dof);
        }
        space.ranks().all_reduce(std::span(moved), Reduction::sum);
        for (std::size_t b = 0; b < left.size(); ++b) {
            if (left[b].cols() == 0) continue;
            // The motions that leave this displacement as it is: those at right angles to the one that moves it most.
            const Eigen::MatrixXd held = left[b].transpose() * Eigen::Map<const Motion>(&moved[6 * b]);
            const Eigen::MatrixXd turned = left[b] * orthogonal_from(held);
            left[b] = turned.rightCols(turned.cols() - 1).eval();
        }
    }
}

std::vector<InertiaRelief::Motion> InertiaRelief::with_momenta(const std::vector<double>& momenta) const {
    std::vector<Motion> found;
    for (std::size_t b = 0; b < motions_.size(); ++b) {
        const Eigen::MatrixXd& free = motions_[b].free;
        found.emplace_back(Motion::Zero());
        if (free.cols() == 0) continue;
        const Eigen::MatrixXd mass = free.transpose() * masses_[b] * free;
        const Eigen::VectorXd momentum = free.transpose() * Eigen::Map<const Motion>(&momenta[6 * b]);
        found[b] = free * DenseFactors(mass).solve(momentum);
    }
    return found;
}

void InertiaRelief::balance(const ElasticProblem& problem, ProblemCase& of_case, const AddForce& add_force) const {
    const FeSpace& space = *problem.space;
    std::vector<double> loads(6 * motions_.size(), 0);
    for (std::int32_t n = 0; n < space.node_count(); ++n) {
        const std::int32_t b = bodies_.of_node[n];
        Eigen::Map<Motion>(&loads[6 * b]) +=
            motions_[b].at(space.points()[n]).transpose() * Eigen::Map<const Vec3>(&of_case.forces[3 * n]);
    }
    space.ranks().all_reduce(std::span(loads), Reduction::sum);
    const std::vector<Motion> accelerations = with_momenta(loads);
    for (std::size_t b = 0; b < motions_.size(); ++b) {
        const BodyMotions& body = motions_[b];
        if (body.free.cols() == 0) continue;
        const double total = masses_[b](0, 0);
        // The entry of the mass matrix for a turn about one axis and a move along another is a static moment.
        const Vec3 arm = Vec3(masses_[b](1, 5), masses_[b](2, 3), masses_[b](0, 4)) / total;
        BodyInertia& told = of_case.relieved.emplace_back();
        told.centre = body.middle + body.scale * arm;
        told.acceleration = body.at(told.centre) * accelerations[b];
        told.angular_acceleration = accelerations[b].tail<3>() / body.scale;
    }
    Vec3 sum = Vec3::Zero();
    for_all_tets(space, [&](std::size_t p, std::size_t t) {
        const auto nodes = space.nodes_of(p, t);
        const std::int32_t b = bodies_.of_node[nodes[0]];
        if (motions_[b].free.cols() == 0) return;
        const double density = problem.material(p, t).density;
        const NodalForces forces = body_forces(space.element(p, t), [&](const Vec3& place) -> Vec3 {
            return -density * (motions_[b].at(place) * accelerations[b]);
        });
        for (int n = 0; n < element_nodes(space.order()); ++n) {
            add_force(p, nodes[n], forces[n]);
            sum += forces[n];
        }
    });
    space.ranks().all_reduce(std::span(sum.data(), 3), Reduction::sum);
    of_case.inertia = sum;
}

void InertiaRelief::remove_motions(const ElasticProblem& problem, std::vector<double>& displacement) const {
    const FeSpace& space = *problem.space;
    std::vector<double> momenta(6 * motions_.size(), 0);
    for_all_tets(space, [&](std::size_t p, std::size_t t) {
        const auto nodes = space.nodes_of(p, t);
        const std::int32_t b = bodies_.of_node[nodes[0]];
        if (motions_[b].free.cols() == 0) return;
        const double density = problem.material(p, t).density;
        Eigen::Map<Motion> momentum(&momenta[6 * b]);
        for_points_of(space.element(p, t), [&](const Vec3& place, double weight, const TetElement::Shapes& shapes) {
            Vec3 moved = Vec3::Zero();
            for (int n = 0; n < element_nodes(space.order()); ++n)
                moved += shapes[n] * Eigen::Map<const Vec3>(&displacement[3 * nodes[n]]);
            momentum.noalias() += density * weight * motions_[b].at(place).transpose() * moved;
        });
    });
    space.ranks().all_reduce(std::span(momenta), Reduction::sum);
    const std::vector<Motion> motion = with_momenta(momenta);
    for (std::int32_t n = 0; n < space.node_count(); ++n) {
        const std::int32_t b = bodies_.of_node[n];
        Eigen::Map<Vec3>(&displacement[3 * n]) -= motions_[b].at(space.points()[n]) * motion[b];
    }
}

}  // namespace kerf

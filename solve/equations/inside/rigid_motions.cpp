// Each displacement of a node that is held, and each direction in which a spring pushes back, is a row of six numbers:
// its size in the six rigid motions of the body. The sum of the products of each row with itself is a 6 x 6 matrix for
// each body, summed over ranks, and its eigenvectors with eigenvalues up to 1e-10 of the largest are the motions that
// nothing prevents. Rotations are scaled by the size of the body, so that they compare with translations. Messages name
// motions in words, those that turn most first.
#include "solve/equations/inside/rigid_motions.h"

#include <algorithm>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "base/core/error.h"
#include "solve/multigrid/dense.h"

namespace kerf {

namespace {

using Motion = Eigen::Matrix<double, 6, 1>;
using MotionMatrix = Eigen::Matrix<double, 6, 6>;

// The held motions of bodies: sums of the products of the rows of held displacements.
class HeldMotions {
 public:
    HeldMotions(const ElasticProblem& problem, const SpaceBodies& bodies, const std::vector<BodyMotions>& motions)
        : problem_(problem), bodies_(bodies), motions_(motions), products_(36 * motions.size(), 0) {}

    std::vector<double> products() {
        const FeSpace& space = *problem_.space;
        for (std::int32_t n = 0; n < space.owned_count(); ++n)
            for (std::size_t c = 0; c < 3; ++c)
                if (problem_.is_held(3 * n + c)) add(n, problem_.frames.axis(3 * n + c));
        for (const SurfaceSprings::Facet& facet : problem_.springs.facets)
            for (const Vec3& direction : spring_directions(space, problem_.springs, facet))
                for (const std::int32_t node : space.nodes_of_facet(facet.part, facet.facet))
                    if (node >= 0) add(node, direction);
        space.ranks().all_reduce(std::span(products_), Reduction::sum);
        return std::move(products_);
    }

 private:
    void add(std::int32_t node, const Vec3& axis) {
        const std::int32_t b = bodies_.of_node[node];
        const Motion held = motions_[b].at(problem_.space->points()[node]).transpose() * axis;
        Eigen::Map<MotionMatrix>(&products_[36 * b]) += held * held.transpose();
    }

    const ElasticProblem& problem_;
    const SpaceBodies& bodies_;
    const std::vector<BodyMotions>& motions_;
    std::vector<double> products_;
};

// Returns the motions of all bodies, without free ones, which are found later.
std::vector<BodyMotions> motions_of(const FeSpace& space, const SpaceBodies& bodies) {
    std::vector<double> middles(4 * bodies.count, 0), scales(bodies.count, 0);
    for (std::int32_t n = 0; n < space.owned_count(); ++n) {
        double* sum = &middles[4 * bodies.of_node[n]];
        for (int c = 0; c < 3; ++c) sum[c] += space.points()[n][c];
        sum[3] += 1;
    }
    space.ranks().all_reduce(std::span(middles), Reduction::sum);
    std::vector<BodyMotions> motions(bodies.count);
    for (std::int32_t b = 0; b < bodies.count; ++b)
        motions[b].middle = Eigen::Map<const Vec3>(&middles[4 * b]) / middles[4 * b + 3];
    for (std::int32_t n = 0; n < space.owned_count(); ++n) {
        const std::int32_t b = bodies.of_node[n];
        scales[b] = std::max(scales[b], (space.points()[n] - motions[b].middle).norm());
    }
    space.ranks().all_reduce(std::span(scales), Reduction::largest);
    for (std::int32_t b = 0; b < bodies.count; ++b) motions[b].scale = scales[b];
    return motions;
}

// Returns the motions in words. `motions`: orthonormal columns that nothing prevents.
std::string motions_text(const Eigen::MatrixXd& motions, const Vec3& middle, double scale) {
    if (motions.cols() == 6) return "it is not held at all";
    // The motions that turn most come first.
    const Eigen::MatrixXd sorted = motions * right_singular_vectors(motions.bottomRows(3));
    std::string text;
    const auto direction = [](const Vec3& v) {
        Eigen::Index largest = 0;
        v.cwiseAbs().maxCoeff(&largest);
        const Vec3 unit = (v[largest] < 0 ? -v : v).normalized();
        const auto shown = [](double x) { return std::abs(x) < 5e-4 ? 0.0 : x; };
        return fmt::format("({:.3g}, {:.3g}, {:.3g})", shown(unit.x()), shown(unit.y()), shown(unit.z()));
    };
    for (Eigen::Index i = 0; i < sorted.cols(); ++i) {
        const Vec3 translation = sorted.col(i).head<3>(), rotation = sorted.col(i).tail<3>() / scale;
        if (!text.empty()) text += ", and to ";
        if (rotation.norm() * scale < 1e-6) {
            text += fmt::format("move along {}", direction(translation));
            continue;
        }
        const Vec3 on_axis = middle + rotation.cross(translation) / rotation.squaredNorm();
        text += fmt::format("turn about {} through ({:.6g}, {:.6g}, {:.6g})", direction(rotation), on_axis.x(),
                            on_axis.y(), on_axis.z());
    }
    return "it is free to " + text;
}

}  // namespace

Eigen::Matrix<double, 3, 6> BodyMotions::at(const Vec3& point) const {
    const Vec3 arm = (point - middle) / scale;
    Eigen::Matrix<double, 3, 6> displacement;
    displacement << 1, 0, 0, 0, arm.z(), -arm.y(), 0, 1, 0, -arm.z(), 0, arm.x(), 0, 0, 1, arm.y(), -arm.x(), 0;
    return displacement;
}

std::vector<BodyMotions> free_motions(const ElasticProblem& problem, const SpaceBodies& bodies) {
    std::vector<BodyMotions> motions = motions_of(*problem.space, bodies);
    const std::vector<double> products = HeldMotions(problem, bodies, motions).products();
    for (std::size_t b = 0; b < motions.size(); ++b) {
        const MotionMatrix product = Eigen::Map<const MotionMatrix>(&products[36 * b]);
        const SixAxes axes = symmetric_axes(product);
        const double largest = axes.values[5];
        Eigen::Index left = 0;
        while (left < 6 && axes.values[left] <= 1e-10 * largest) ++left;
        motions[b].free = axes.vectors.leftCols(left);
    }
    return motions;
}

void require_supported(const ElasticProblem& problem, const SpaceBodies& bodies) {
    for (const BodyMotions& body : free_motions(problem, bodies)) {
        if (body.free.cols() == 0) continue;
        throw Error(ErrorCode::usage,
                    fmt::format("The supports leave {} around ({:.6g}, {:.6g}, {:.6g}) free: {}. Add a [[support]] or "
                                "[[spring]] against that, or say inertia_relief = true in [solver].",
                                bodies.count == 1 ? "the body" : "a body", body.middle.x(), body.middle.y(),
                                body.middle.z(), motions_text(body.free, body.middle, body.scale)));
    }
}

}  // namespace kerf

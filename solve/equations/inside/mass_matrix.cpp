// The consistent mass is one number for each pair of nodes of an element, the same for x, y and z, in the pattern of
// the stiffness. Straight elements have formulas for it; curved ones are integrated by the 14 points of
// TetElement::rule(), with which the mass of each node is exact. Held degrees of freedom have no mass: they are dropped
// before and after a product. A single number cannot be turned into a node's own axes, so vectors are turned to x, y
// and z for the product instead, and back.
#include "solve/equations/inside/mass_matrix.h"

#include <algorithm>

namespace kerf {

// The formulas of Zienkiewicz and Taylor.
MassShares mass_shares(int order) {
    MassShares shares{};
    if (order == 1) {
        for (std::size_t a = 0; a < 4; ++a)
            for (std::size_t b = 0; b < 4; ++b) shares[a][b] = (a == b ? 2 : 1) / 20.0;
        return shares;
    }
    for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < 4; ++b) shares[a][b] = (a == b ? 6 : 1) / 420.0;
    const auto has = [](std::size_t edge, int corner) {
        return tet_edges[edge][0] == corner || tet_edges[edge][1] == corner;
    };
    for (std::size_t e = 0; e < 6; ++e) {
        for (std::size_t a = 0; a < 4; ++a) shares[a][4 + e] = shares[4 + e][a] = (has(e, a) ? -4 : -6) / 420.0;
        for (std::size_t f = 0; f < 6; ++f) {
            const bool do_meet = has(f, tet_edges[e][0]) || has(f, tet_edges[e][1]);
            shares[4 + e][4 + f] = (e == f ? 32 : do_meet ? 16 : 8) / 420.0;
        }
    }
    return shares;
}

MassShares mass_shares(const TetElement& element) {
    MassShares shares{};
    const std::size_t nodes = element.node_count();
    if (!element.is_curved()) {
        shares = mass_shares(element.order());
        for (auto& row : shares)
            for (double& share : row) share *= element.volume();
        return shares;
    }
    for (const TetPoint& at : element.rule()) {
        const double weight = element.point(at).weight;
        const TetElement::Shapes shapes = TetElement::shapes_at(element.order(), at.place);
        for (std::size_t a = 0; a < nodes; ++a)
            for (std::size_t b = 0; b < nodes; ++b) shares[a][b] += weight * shapes[a] * shapes[b];
    }
    return shares;
}

MassMatrix::MassMatrix(const ElasticProblem& problem, const SymmetricBlocks<3>& stiffness) : problem_(problem) {
    const FeSpace& space = *problem.space;
    share_.first = stiffness.first;
    share_.columns = stiffness.columns;
    share_.values.assign(share_.columns.size(), 0);
    const std::size_t nodes_each = element_nodes(space.order());
    for_all_tets(space, [&](std::size_t p, std::size_t t) {
        const double density = problem.material(p, t).density;
        const MassShares shares = mass_shares(space.element(p, t));
        const auto nodes = space.nodes_of(p, t);
        for (std::size_t a = 0; a < nodes_each; ++a) {
            const auto begin = share_.columns.begin() + share_.first[nodes[a]],
                       end = share_.columns.begin() + share_.first[nodes[a] + 1];
            for (std::size_t b = 0; b < nodes_each; ++b)
                if (nodes[b] >= nodes[a])
                    share_.values[std::lower_bound(begin, end, nodes[b]) - share_.columns.begin()] +=
                        density * shares[a][b];
        }
    });
}

void MassMatrix::multiply(std::vector<double>& x, std::vector<double>& y) const {
    const Ownership& ownership = problem_.space->ownership();
    const auto drop_held = [&](std::vector<double>& values) {
        for (std::size_t dof = 0; dof < values.size(); ++dof)
            if (problem_.is_held(dof)) values[dof] = 0;
    };
    ownership.from_owners(std::span(x), 3);
    drop_held(x);
    y.assign(x.size(), 0);
    const NodeFrames& frames = problem_.frames;
    if (frames.empty()) {
        multiply_add(x, y);
    } else {
        std::vector<double> turned = x;
        frames.from_frames(turned);
        multiply_add(turned, y);
        frames.to_frames(y);
    }
    ownership.sum_to_owners(std::span(y), 3);
    drop_held(y);
}

void MassMatrix::multiply_add(std::span<const double> x, std::span<double> y) const {
    for (std::int32_t n = 0; n < share_.row_count(); ++n) {
        const Vec3 of_row = Eigen::Map<const Vec3>(&x[3 * n]);
        Vec3 sum = share_.values[share_.first[n]] * of_row;
        for (std::int64_t i = share_.first[n] + 1; i < share_.first[n + 1]; ++i) {
            const std::int32_t m = share_.columns[i];
            sum += share_.values[i] * Eigen::Map<const Vec3>(&x[3 * m]);
            Eigen::Map<Vec3>(&y[3 * m]) += share_.values[i] * of_row;
        }
        Eigen::Map<Vec3>(&y[3 * n]) += sum;
    }
}

double MassMatrix::mean_diagonal() const {
    const FeSpace& space = *problem_.space;
    double sum = 0;
    for (std::int32_t n = 0; n < share_.row_count(); ++n) sum += share_.values[share_.first[n]];
    return space.ranks().all_reduce(sum, Reduction::sum) / space.total_rows();
}

}  // namespace kerf

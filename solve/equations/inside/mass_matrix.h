// The mass of the elements of a rank.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "solve/equations/elastic_problem.h"
#include "solve/multigrid/level_matrix.h"

namespace kerf {

/// Integrals of the products of the shape functions, for each pair of nodes.
using MassShares = std::array<std::array<double, most_element_nodes>, most_element_nodes>;
/// The shares of a tetrahedron with straight edges and a volume of 1. Exact.
MassShares mass_shares(int order);
/// The shares of any element; of curved ones by TetElement::rule(), with which the mass of each node is exact.
MassShares mass_shares(const TetElement& element);

/// The consistent mass, the same for each component: a number for each pair of nodes of an element. Held degrees of
/// freedom have none. Vectors are along the nodes' axes (ElasticProblem::frames).
class MassMatrix {
 public:
    /// Sums the mass of this rank's elements. `stiffness` says which nodes meet. O(n).
    MassMatrix(const ElasticProblem& problem, const SymmetricBlocks<3>& stiffness);

    /// Sets y = M x for owned nodes, three numbers each; held ones of x count as zero. Collective.
    void multiply(std::vector<double>& x, std::vector<double>& y) const;
    /// Returns the mean of the diagonal over the nodes of all ranks. Collective.
    double mean_diagonal() const;

 private:
    void multiply_add(std::span<const double> x, std::span<double> y) const;

    const ElasticProblem& problem_;
    SymmetricBlocks<1> share_;
};

}  // namespace kerf

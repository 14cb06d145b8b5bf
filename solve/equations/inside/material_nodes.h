// Numbers for the nodes of a space, one for each material around a node.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/core/ids.h"
#include "solve/equations/elastic_problem.h"

namespace kerf {

/// Numbers for pairs of a node and a material around it. Quantities with a value in each material at a node, as
/// stresses have, are arrays over them: the numbers of a node follow each other, ascending by material, and nodes are
/// in their order, so that owned ones come first. The owner of a node has numbers for the materials of all ranks there,
/// other ranks have numbers for those of their own cells.
class MaterialNodes {
 public:
    /// Numbers the pairs. Collective. O(n), and O(k log k) in the k cells at nodes between materials.
    explicit MaterialNodes(const ElasticProblem& problem);

    std::int32_t count() const { return count_of(material_); }
    /// Returns the first of the node's numbers; `local_node` may be FeSpace::node_count().
    std::int32_t first_of(std::int32_t local_node) const { return first_[local_node]; }
    /// Returns the numbers of the nodes of a tetrahedron of the part `p` of this rank, in its material.
    std::array<std::int32_t, most_element_nodes> of(std::size_t p, std::size_t tet) const;
    /// Returns who owns the numbers, for arrays over them that ranks share.
    const Ownership& ownership() const { return ownership_; }

 private:
    struct Pair;
    std::vector<Pair> pairs_of_cells() const;
    std::int32_t number(std::int32_t node, MaterialNumber material) const;

    const ElasticProblem& problem_;
    std::vector<std::int32_t> first_;       // first number of each local node, and the end
    std::vector<MaterialNumber> material_;  // material of each number
    Ownership ownership_;
};

}  // namespace kerf

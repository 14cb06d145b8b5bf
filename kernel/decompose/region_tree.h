// The levels of the tree above the roots of the regions.
#pragma once

#include <span>
#include <vector>

#include "decompose/decomposition.h"

namespace kerf {

/// What is known of a region before it is cut.
struct RegionMeasures {
    std::int32_t vertices = 0, facets = 0;
    double volume = 0, volume_error = 0, area = 0;
    double load = 0;  ///< of the LoadModel
};

/// Of all regions, in their order. Throws Error(input) for a region whose facets enclose no volume, or are turned
/// inwards. O(n log n), n: facets of the complex.
std::vector<RegionMeasures> measure_regions(const Complex& complex, const DecomposeOptions& options);

/// How the leaves of a tree are shared out to regions, and which nodes lead there.
///
/// A node that holds several regions is divided into the first half of them and the rest, in an order in which
/// neighbours follow each other, without a plane; nodes are numbered as those of cuts are. One that holds a single
/// region is its root. Depends on the measures and boxes of the regions alone.
class RegionTree {
 public:
    /// `parts`: leaves wanted, at least as many as regions. Each region gets one, and each further one the region that
    /// has the largest load a leaf then; of equal ones the first. O(parts log #regions).
    RegionTree(const Complex& complex, std::span<const RegionMeasures> measures, std::int32_t parts);

    /// A node of the tree: the regions numbered [first, first + regions) in the order of the tree.
    struct Node {
        NodeId id = 1;
        std::int32_t first = 0, regions = 1;
    };
    Node root() const { return {1, 0, static_cast<std::int32_t>(order_.size())}; }
    std::array<Node, 2> halves(const Node& node) const;
    RegionIndex region(const Node& root_of_region) const {
        return order_[static_cast<std::size_t>(root_of_region.first)];
    }
    std::int32_t first_leaf(const Node& node) const { return first_leaf_[static_cast<std::size_t>(node.first)]; }
    std::int32_t leaves(const Node& node) const {
        return first_leaf_[static_cast<std::size_t>(node.first + node.regions)] - first_leaf(node);
    }
    /// The node as it is told of: the sums over its regions.
    TreeNode describe(const Node& node, std::span<const RegionMeasures> measures) const;

 private:
    std::vector<RegionIndex> order_;
    std::vector<std::int32_t> first_leaf_;  // of each place in the order, and the number of all
};

}  // namespace kerf

// The levels of the tree above the roots of the regions.
#pragma once

#include <span>
#include <vector>

#include "cut/decompose/decomposition.h"

namespace kerf {

/// The measures of a region before it is cut.
struct RegionMeasures {
    std::int32_t vertices = 0, facets = 0;
    double volume = 0, volume_error = 0, area = 0;
    double load = 0;  ///< as LoadModel counts it
};

/// Returns the measures of all regions, in their order. Throws Error(input) for a region whose facets enclose no
/// volume, or are turned inwards. O(n log n) for n facets of the complex.
Array<RegionIndex, RegionMeasures> measure_regions(const Complex& complex, const DecomposeOptions& options);

/// The distribution of a tree's leaves to regions, and the nodes above the regions' roots.
///
/// A node that holds several regions is divided into the first half of them and the rest, without a plane, in an order
/// in which neighbours follow each other; nodes are numbered like those of cuts. A node that holds a single region is
/// the root of that. The tree depends on the measures and boxes of the regions alone.
class RegionTree {
 public:
    /// Shares out `parts` leaves, at least as many as there are regions. Each region gets one, and each further leaf
    /// goes to the region that then has the largest load per leaf, to the first of these if there are several. O(parts
    /// log #regions).
    RegionTree(const Complex& complex, const Array<RegionIndex, RegionMeasures>& measures, std::int32_t parts);

    /// A node of the tree: the regions numbered [first, first + regions) in the order of the tree.
    struct Node {
        NodeId id = root_node;
        std::int32_t first = 0, regions = 1;
    };
    Node root() const { return {root_node, 0, count_of(order_)}; }
    std::array<Node, 2> halves(const Node& node) const;
    RegionIndex region(const Node& root_of_region) const { return order_[root_of_region.first]; }
    std::int32_t first_leaf(const Node& node) const { return first_leaf_[node.first]; }
    std::int32_t leaves(const Node& node) const { return first_leaf_[node.first + node.regions] - first_leaf(node); }
    /// Returns the node in the form of the tree, with sums over its regions.
    TreeNode describe(const Node& node, const Array<RegionIndex, RegionMeasures>& measures) const;

 private:
    std::vector<RegionIndex> order_;
    std::vector<std::int32_t> first_leaf_;  // of each place in the order; at the end the number of all leaves
};

}  // namespace kerf

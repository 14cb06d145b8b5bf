// A hierarchy of boxes that finds those around a box without looking at all.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

namespace kerf {

/// A binary tree over boxes, split at the median of the longest side of their centres. Built in O(n log n).
class BoxTree {
 public:
    /// No box may be empty.
    explicit BoxTree(std::vector<Eigen::AlignedBox3d> boxes);

    /// The numbers of the boxes that contain `box`, borders included, ascending. O(log n) for each where few overlap.
    std::vector<std::int32_t> around(const Eigen::AlignedBox3d& box) const;

 private:
    struct Node {
        Eigen::AlignedBox3d box;    // of all below
        std::int32_t first, count;  // in order_
        std::int32_t left = 0;      // 0: a leaf; the other child follows it
    };
    void split(std::size_t node);

    std::vector<Eigen::AlignedBox3d> boxes_;
    std::vector<std::int32_t> order_;  // numbers of boxes, those of a node side by side
    std::vector<Node> nodes_;
};

}  // namespace kerf

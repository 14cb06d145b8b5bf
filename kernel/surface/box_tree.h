// A hierarchy of boxes that finds those around a box, or those that meet it, without looking at all.
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

    /// Calls visit(number) for each box that meets `box`, borders included, in an order that depends on the boxes
    /// alone.
    template <class Visit>
    void for_each_meeting(const Eigen::AlignedBox3d& box, Visit visit) const {
        const auto meets = [&](const Eigen::AlignedBox3d& other) { return other.intersects(box); };
        traverse(meets, visit);
    }

 private:
    struct Node {
        Eigen::AlignedBox3d box;    // of all below
        std::int32_t first, count;  // in order_
        std::int32_t left = 0;      // 0: a leaf; the other child follows it
    };
    void split(std::size_t node);
    // Visits the boxes for which `is_wanted` holds; it must hold for every box around one for which it does.
    template <class IsWanted, class Visit>
    void traverse(const IsWanted& is_wanted, const Visit& visit) const {
        std::vector<std::int32_t> open = {0};
        while (!open.empty()) {
            const Node& node = nodes_[open.back()];
            open.pop_back();
            if (!is_wanted(node.box)) continue;
            if (node.left > 0) {
                open.insert(open.end(), {node.left, node.left + 1});
                continue;
            }
            for (std::int32_t i = node.first; i < node.first + node.count; ++i)
                if (is_wanted(boxes_[order_[i]])) visit(order_[i]);
        }
    }

    std::vector<Eigen::AlignedBox3d> boxes_;
    std::vector<std::int32_t> order_;  // numbers of boxes, those of a node side by side
    std::vector<Node> nodes_;
};

}  // namespace kerf

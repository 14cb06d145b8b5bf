// A hierarchy of boxes that finds the boxes around a box, or those that meet it, without looking at all of them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "base/core/check.h"
#include "base/geometry/box_hierarchy.h"

namespace kerf {

/// A binary tree over boxes, split at the median of the centres along the longest side of their box. Built in O(n log
/// n) on threads.
class BoxTree {
 public:
    /// No box may be empty.
    explicit BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
        KERF_CHECK(std::none_of(boxes_.begin(), boxes_.end(), [](const Box& box) { return box.isEmpty(); }));
        std::iota(order_.begin(), order_.end(), 0);
        hierarchy_ = make_hierarchy(boxes_, order_);
    }

    /// Returns the numbers of the boxes that contain `box`, borders included, ascending. O(log n) for each if few
    /// overlap.
    std::vector<std::int32_t> around(const Box& box) const {
        std::vector<std::int32_t> found;
        visit([&](const Box& other) { return other.contains(box); }, [&](std::int32_t i) { found.push_back(i); });
        std::sort(found.begin(), found.end());
        return found;
    }

    /// Calls visit_box(number) for each box that meets `box`, borders included, in an order that depends on the boxes
    /// alone.
    template <class VisitBox>
    void for_each_meeting(const Box& box, const VisitBox& visit_box) const {
        visit([&](const Box& other) { return other.intersects(box); }, visit_box);
    }

 private:
    // Visits the boxes for which `is_wanted` holds; if it holds for a box, it must hold for every box around that.
    template <class IsWanted, class VisitBox>
    void visit(const IsWanted& is_wanted, const VisitBox& visit_box) const {
        hierarchy_.any([&](const BoxNode& node) { return is_wanted(node.box); },
                       [&](std::int32_t item) {
                           if (is_wanted(boxes_[order_[item]])) visit_box(order_[item]);
                           return false;
                       });
    }

    std::vector<Box> boxes_;
    std::vector<std::int32_t> order_;  // numbers of boxes; the boxes of a node lie side by side
    BoxHierarchy<> hierarchy_;
};

}  // namespace kerf

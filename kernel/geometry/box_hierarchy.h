// A binary tree of boxes over items that lie in an array, whatever they are.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/box.h"

namespace kerf {

/// What every node of a BoxHierarchy knows. Types that derive from it may know more of the items below.
struct BoxNode {
    Box box;                           ///< of all items below
    std::int32_t first = 0, last = 0;  ///< these items, as they lie in the array
    std::int32_t left = 0;             ///< the first child, which the other one follows; 0: a leaf

    void add(const BoxNode& other) { box.extend(other.box); }
};

/// The child that BoxHierarchy::least() looks at first where both promise the same.
enum class FirstOfEqual { left, right };

/// A binary tree over items that its owner keeps in the order of the leaves. Built in O(n log n), immutable.
template <class Node = BoxNode>
class BoxHierarchy {
 public:
    BoxHierarchy() = default;

    /// Over `count` items. `halve(first, last)` may put these items into another order and returns the first one of the
    /// right child; `node_of(item)` is a node that knows of one item alone. No item moves once it is called.
    template <class Halve, class NodeOf>
    BoxHierarchy(std::size_t count, const Halve& halve, const NodeOf& node_of) {
        add_child(0, static_cast<std::int32_t>(count));
        for (std::size_t n = 0; n < nodes_.size(); ++n) {
            const std::int32_t first = nodes_[n].first, last = nodes_[n].last;
            if (last - first <= most_of_leaf) continue;
            const std::int32_t middle = halve(first, last);
            nodes_[n].left = static_cast<std::int32_t>(nodes_.size());
            add_child(first, middle);
            add_child(middle, last);
        }
        nodes_.shrink_to_fit();
        for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node) {  // children come behind their parents
            for (std::int32_t child = node->left; node->left > 0 && child < node->left + 2; ++child)
                node->add(nodes_[child]);
            for (std::int32_t i = node->first; node->left == 0 && i < node->last; ++i) node->add(node_of(i));
        }
    }

    /// The root is the first; none where the hierarchy was not made of items.
    const std::vector<Node>& nodes() const { return nodes_; }

    /// Calls visit(item) for the items of all leaves that lie below wanted nodes only, in their order, until it returns
    /// true. Returns whether it did. `is_wanted(node)` must hold for every node above one for which it does.
    template <class IsWanted, class Visit>
    bool any(const IsWanted& is_wanted, const Visit& visit) const {
        std::array<std::int32_t, most_open> open;
        std::size_t count = 0;
        if (!nodes_.empty()) open[count++] = 0;
        while (count > 0) {
            const Node& node = nodes_[open[--count]];
            if (!is_wanted(node)) continue;
            if (node.left > 0) {
                open[count++] = node.left + 1;
                open[count++] = node.left;
                continue;
            }
            for (std::int32_t i = node.first; i < node.last; ++i)
                if (visit(i)) return true;
        }
        return false;
    }

    /// The least of of_item() and `bound`. No item below a node has less than of_node() says of it; what cannot be less
    /// than what was found is not looked at.
    template <FirstOfEqual first_of_equal = FirstOfEqual::left, class OfNode, class OfItem>
    double least(double bound, const OfNode& of_node, const OfItem& of_item) const {
        struct Open {
            std::int32_t node;
            double low;
        };
        std::array<Open, most_open> open;
        std::size_t count = 0;
        if (!nodes_.empty()) open[count++] = {0, of_node(nodes_[0])};
        while (count > 0) {
            const Open next = open[--count];
            if (next.low >= bound) continue;
            const Node& node = nodes_[next.node];
            if (node.left > 0) {
                Open near = {node.left, of_node(nodes_[node.left])};
                Open far = {node.left + 1, of_node(nodes_[node.left + 1])};
                if (first_of_equal == FirstOfEqual::left ? far.low < near.low : !(near.low < far.low))
                    std::swap(near, far);
                open[count++] = far;
                open[count++] = near;
                continue;
            }
            for (std::int32_t i = node.first; i < node.last; ++i) bound = std::min(bound, of_item(i));
        }
        return bound;
    }

 private:
    static constexpr std::int32_t most_of_leaf = 4;
    static constexpr std::size_t most_open = 128;  // one sibling a level, and two levels at least halve what is below

    void add_child(std::int32_t first, std::int32_t last) {
        nodes_.emplace_back();
        nodes_.back().first = first;
        nodes_.back().last = last;
    }

    std::vector<Node> nodes_;
};

/// Puts items into halves at the median along the longest side of the box around their centres and returns where the
/// second one begins. Where centres are level, `tie_of(item)` decides, which must differ. Expected O(n).
template <class Iterator, class CentreOf, class TieOf>
Iterator halve_by_centre(Iterator begin, Iterator end, const CentreOf& centre_of, const TieOf& tie_of) {
    Box centres;
    for (auto item = begin; item != end; ++item) centres.extend(Vec3(centre_of(*item)));
    Eigen::Index axis = 0;
    centres.sizes().maxCoeff(&axis);
    const Iterator middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end, [&](const auto& a, const auto& b) {
        const double of_a = centre_of(a)[axis], of_b = centre_of(b)[axis];
        return of_a != of_b ? of_a < of_b : tie_of(a) < tie_of(b);
    });
    return middle;
}

/// A hierarchy of these boxes. Puts `order`, which is to number all of them, into its order: its item i is the box
/// `order[i]`.
inline BoxHierarchy<> make_hierarchy(const std::vector<Box>& boxes, std::vector<std::int32_t>& order) {
    const auto centre_of = [&](std::int32_t box) { return boxes[box].center(); };
    const auto number_of = [](std::int32_t box) { return box; };
    const auto halve = [&](std::int32_t first, std::int32_t last) {
        const auto begin = order.begin();
        return static_cast<std::int32_t>(halve_by_centre(begin + first, begin + last, centre_of, number_of) - begin);
    };
    return {order.size(), halve, [&](std::int32_t item) { return BoxNode{boxes[order[item]]}; }};
}

}  // namespace kerf

// A binary tree of boxes over items of any kind that lie in an array.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/core/ids.h"
#include "base/core/threads.h"
#include "base/geometry/box.h"

namespace kerf {

/// The data of every node of a BoxHierarchy. Derived types may add more data of the items below a node.
struct BoxNode {
    Box box;                           ///< around all items below
    std::int32_t first = 0, last = 0;  ///< range of these items in the array
    std::int32_t left = 0;             ///< the first child, which the other one follows; 0: a leaf

    void add(const BoxNode& other) { box.extend(other.box); }
};

/// The child that BoxHierarchy::least() looks at first if both promise the same.
enum class FirstOfEqual { left, right };

/// A binary tree over items that its owner keeps in the order of the leaves. Built in O(n log n) on threads, with the
/// same result for any number of them; immutable.
template <class Node = BoxNode>
class BoxHierarchy {
 public:
    BoxHierarchy() = default;

    /// Builds a tree over `count` items. `halve(first, last)` may put these items into another order and returns the
    /// first one of the right child; `node_of(item)` returns a node of one item alone. No item moves once node_of() is
    /// called. Both are called from several threads, halve() for disjoint ranges at any time.
    template <class Halve, class NodeOf>
    BoxHierarchy(std::size_t count, const Halve& halve, const NodeOf& node_of) {
        add_child(0, count);
        std::vector<std::size_t> level_begin;
        for (std::size_t begin = 0; begin < nodes_.size();) {
            level_begin.push_back(begin);
            divide_level(std::exchange(begin, nodes_.size()), count, halve);
        }
        nodes_.shrink_to_fit();
        for (std::size_t end = nodes_.size(); !level_begin.empty(); level_begin.pop_back())
            gather_level(level_begin.back(), std::exchange(end, level_begin.back()), node_of);
    }

    /// All nodes, the root first; empty if there are no items.
    const std::vector<Node>& nodes() const { return nodes_; }

    /// Calls visit(item) for the items of all leaves that lie below wanted nodes only, in their order, until it returns
    /// true. Returns whether it did. If `is_wanted(node)` holds for a node, it must hold for all nodes above it.
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

    /// Returns the least of `bound` and all of_item(item). of_node(node) must be a lower bound of of_item() for all
    /// items below the node; nodes that cannot have less than the least so far are skipped.
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
    static constexpr std::size_t least_of_range = 4096;  // items that are worth a thread
    static constexpr std::size_t most_open = 128;        // one sibling a level; two levels halve the items at least

    // Divides the nodes from `begin` on; their children go behind all nodes.
    template <class Halve>
    void divide_level(std::size_t begin, std::size_t count, const Halve& halve) {
        const auto is_leaf = [&](const Node& node) { return node.last - node.first <= most_of_leaf; };
        const std::size_t end = nodes_.size();
        const std::size_t grain = 1 + least_of_range * (end - begin) / std::max(count, least_of_range);
        std::vector<std::int32_t> middle(end - begin);
        for_ranges_on_threads(end - begin, grain, [&](const IndexRange& range) {
            for (std::size_t i = range.first; i < range.last; ++i) {
                const Node& node = nodes_[begin + i];
                if (!is_leaf(node)) middle[i] = halve(node.first, node.last);
            }
        });
        for (std::size_t n = begin; n < end; ++n) {
            if (is_leaf(nodes_[n])) continue;
            const std::int32_t first = nodes_[n].first, last = nodes_[n].last;
            nodes_[n].left = count_of(nodes_);
            add_child(first, middle[n - begin]);
            add_child(middle[n - begin], last);
        }
    }
    // Gathers the data of these nodes from those of the next level, which must be complete.
    template <class NodeOf>
    void gather_level(std::size_t begin, std::size_t end, const NodeOf& node_of) {
        for_ranges_on_threads(end - begin, least_of_range, [&](const IndexRange& range) {
            for (std::size_t n = begin + range.first; n < begin + range.last; ++n) {
                Node& node = nodes_[n];
                for (std::int32_t child = node.left; node.left > 0 && child < node.left + 2; ++child)
                    node.add(nodes_[child]);
                for (std::int32_t i = node.first; node.left == 0 && i < node.last; ++i) node.add(node_of(i));
            }
        });
    }
    void add_child(std::int32_t first, std::int32_t last) {
        nodes_.emplace_back();
        nodes_.back().first = first;
        nodes_.back().last = last;
    }

    std::vector<Node> nodes_;
};

/// Puts items into halves at the median along the longest side of the box around their centres, and returns where the
/// second half begins. For equal centres tie_of(item), which must differ, decides. Expected O(n).
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

/// Makes a hierarchy of these boxes. `order`, a permutation of the boxes' numbers, is put into the order of the leaves:
/// item i is the box `order[i]`. Takes 32 bytes a box meanwhile.
inline BoxHierarchy<> make_hierarchy(const std::vector<Box>& boxes, std::vector<std::int32_t>& order) {
    struct Item {
        Vec3 centre;
        std::int32_t box;
    };
    std::vector<Item> items;
    items.reserve(order.size());
    for (const std::int32_t box : order) items.push_back({boxes[box].center(), box});
    const auto centre_of = [](const Item& item) -> const Vec3& { return item.centre; };
    const auto number_of = [](const Item& item) { return item.box; };
    const auto halve = [&](std::int32_t first, std::int32_t last) {
        const auto begin = items.begin();
        return halve_by_centre(begin + first, begin + last, centre_of, number_of) - begin;
    };
    BoxHierarchy<> hierarchy(items.size(), halve, [&](std::int32_t i) { return BoxNode{boxes[items[i].box]}; });
    for (std::size_t i = 0; i < items.size(); ++i) order[i] = items[i].box;
    return hierarchy;
}

}  // namespace kerf

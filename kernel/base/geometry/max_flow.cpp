// Two trees grow from source and sink over unsaturated arcs (Boykov and Kolmogorov 2004, boykov2004). Where they meet,
// the path is augmented; the nodes behind saturated arcs become orphans and look for a new parent that still leads to a
// terminal, or become free. When no tree can grow, the source tree is one side of a minimum cut. Notation: arc a and
// its reverse a ^ 1 are neighbours in `arcs_`; the terminals are no nodes, but a signed capacity of each node, positive
// from the source. `stamp_` is the time at which the distance of a node to its terminal was last found; each
// augmentation advances the time.
#include "base/geometry/max_flow.h"

#include <algorithm>
#include <limits>

#include "base/core/check.h"
#include "base/core/ids.h"

namespace kerf {

namespace {

constexpr std::int32_t no_parent = -1;
constexpr std::int32_t terminal_parent = -2;
constexpr std::int32_t orphan_parent = -3;

}  // namespace

MaxFlow::MaxFlow(std::int32_t node_count)
    : first_arc_(node_count, -1),
      terminal_(node_count, 0),
      tree_(node_count, Tree::free),
      parent_(node_count, no_parent),
      distance_(node_count, 0),
      stamp_(node_count, 0),
      is_active_(node_count, 0) {}

void MaxFlow::add_terminal(std::int32_t node, double from_source, double to_sink) {
    KERF_CHECK(from_source >= 0 && to_sink >= 0);
    terminal_[node] += from_source - to_sink;  // flow straight through the node does not move the cut
}

void MaxFlow::add_edge(std::int32_t a, std::int32_t b, double capacity) {
    KERF_CHECK(a != b && capacity >= 0);
    const auto arc = count_of(arcs_);
    arcs_.push_back({b, first_arc_[a], capacity});
    arcs_.push_back({a, first_arc_[b], capacity});
    first_arc_[a] = arc;
    first_arc_[b] = arc + 1;
}

void MaxFlow::activate(std::int32_t node) {
    if (is_active_[node]) return;
    is_active_[node] = 1;
    active_.push_back(node);
}

bool MaxFlow::solve(std::int64_t step_limit) {
    for (std::int32_t i = 0; i < count_of(terminal_); ++i) {
        if (terminal_[i] == 0) continue;
        tree_[i] = terminal_[i] > 0 ? Tree::source : Tree::sink;
        parent_[i] = terminal_parent;
        distance_[i] = 1;
        activate(i);
    }
    std::int32_t meeting_arc = -1;
    while (grow(meeting_arc)) {
        ++time_;
        augment(meeting_arc);
        adopt_orphans();
        if (steps_ > step_limit) return false;
    }
    return true;
}

// Grows the trees from the active nodes until they meet; the meeting arc points from the source tree to the sink tree.
bool MaxFlow::grow(std::int32_t& meeting_arc) {
    for (; active_head_ < active_.size(); ++active_head_) {
        const std::int32_t node = active_[active_head_];
        const Tree tree = tree_[node];
        if (tree != Tree::free)
            for (std::int32_t a = first_arc_[node]; a >= 0; a = arcs_[a].next) {
                ++steps_;
                if (!can_push(tree, a)) continue;
                const std::int32_t head = arcs_[a].head;
                if (tree_[head] == Tree::free) {
                    tree_[head] = tree;
                    parent_[head] = a ^ 1;
                    distance_[head] = distance_[node] + 1;
                    stamp_[head] = stamp_[node];
                    activate(head);
                } else if (tree_[head] != tree) {
                    meeting_arc = tree == Tree::source ? a : a ^ 1;
                    return true;  // the node stays active
                } else if (stamp_[head] <= stamp_[node] && distance_[head] > distance_[node] + 1) {
                    parent_[head] = a ^ 1;
                    distance_[head] = distance_[node] + 1;
                    stamp_[head] = stamp_[node];
                }
            }
        is_active_[node] = 0;
    }
    return false;
}

double MaxFlow::bottleneck_to_terminal(std::int32_t node, double flow) const {
    const bool source = tree_[node] == Tree::source;
    for (; parent_[node] != terminal_parent; node = arcs_[parent_[node]].head)
        flow = std::min(flow, arcs_[source ? parent_[node] ^ 1 : parent_[node]].residual);
    return std::min(flow, source ? terminal_[node] : -terminal_[node]);
}

void MaxFlow::push_to_terminal(std::int32_t node, double flow) {
    const bool source = tree_[node] == Tree::source;
    while (parent_[node] != terminal_parent) {
        steps_ += 2;  // the bottleneck was searched on the same path
        const std::int32_t up = parent_[node];
        const std::int32_t along = source ? up ^ 1 : up;
        const std::int32_t next = arcs_[up].head;
        arcs_[along].residual -= flow;
        arcs_[along ^ 1].residual += flow;
        if (arcs_[along].residual <= 0) make_orphan(node);
        node = next;
    }
    terminal_[node] += source ? -flow : flow;
    if (source ? terminal_[node] <= 0 : terminal_[node] >= 0) make_orphan(node);
}

void MaxFlow::augment(std::int32_t meeting_arc) {
    const std::int32_t source_node = arcs_[meeting_arc ^ 1].head, sink_node = arcs_[meeting_arc].head;
    double flow = bottleneck_to_terminal(source_node, arcs_[meeting_arc].residual);
    flow = bottleneck_to_terminal(sink_node, flow);
    arcs_[meeting_arc].residual -= flow;
    arcs_[meeting_arc ^ 1].residual += flow;
    push_to_terminal(source_node, flow);
    push_to_terminal(sink_node, flow);
}

void MaxFlow::make_orphan(std::int32_t node) {
    parent_[node] = orphan_parent;
    orphans_.push_back(node);
}

void MaxFlow::adopt_orphans() {
    for (std::size_t i = 0; i < orphans_.size(); ++i) adopt(orphans_[i]);
    orphans_.clear();
}

// Length of the path from the node to its terminal; huge if the path ends at an orphan. Marks the path with the time.
std::int32_t MaxFlow::distance_to_terminal(std::int32_t node) {
    constexpr std::int32_t infinite = std::numeric_limits<std::int32_t>::max();
    std::int32_t length = 0;
    for (std::int32_t i = node;; i = arcs_[parent_[i]].head) {
        ++steps_;
        if (stamp_[i] == time_ && parent_[i] != orphan_parent && parent_[i] != no_parent) {
            length += distance_[i];
            break;
        }
        ++length;
        if (parent_[i] == terminal_parent) {
            stamp_[i] = time_;
            distance_[i] = 1;
            break;
        }
        if (parent_[i] < 0) return infinite;
    }
    std::int32_t distance = length;
    for (std::int32_t i = node; stamp_[i] != time_; i = arcs_[parent_[i]].head) {
        stamp_[i] = time_;
        distance_[i] = distance--;
    }
    return length;
}

void MaxFlow::adopt(std::int32_t node) {
    constexpr std::int32_t infinite = std::numeric_limits<std::int32_t>::max();
    const Tree tree = tree_[node];
    std::int32_t best_arc = no_parent, best_distance = infinite;
    for (std::int32_t a = first_arc_[node]; a >= 0; a = arcs_[a].next) {
        const std::int32_t head = arcs_[a].head;
        if (tree_[head] != tree || !can_push(tree, a ^ 1) || parent_[head] == no_parent) continue;
        const std::int32_t distance = distance_to_terminal(head);
        if (distance < best_distance) {
            best_distance = distance;
            best_arc = a;
        }
    }
    if (best_arc >= 0) {
        parent_[node] = best_arc;
        distance_[node] = best_distance + 1;
        stamp_[node] = time_;
        return;
    }
    for (std::int32_t a = first_arc_[node]; a >= 0; a = arcs_[a].next) {
        const std::int32_t head = arcs_[a].head;
        if (tree_[head] != tree) continue;
        if (can_push(tree, a ^ 1)) activate(head);
        if (parent_[head] >= 0 && arcs_[parent_[head]].head == node) make_orphan(head);
    }
    tree_[node] = Tree::free;
    parent_[node] = no_parent;
}

}  // namespace kerf

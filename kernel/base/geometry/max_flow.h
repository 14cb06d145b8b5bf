// Maximum flow and minimum cut on sparse graphs.
#pragma once

#include <cstdint>
#include <vector>

namespace kerf {

/// The maximum flow by augmenting paths between two search trees (Boykov and Kolmogorov 2004, boykov2004): fast on
/// graphs with short paths between many terminals, as in a band of facets around a plane. Deterministic.
class MaxFlow {
 public:
    explicit MaxFlow(std::int32_t node_count);

    /// Adds capacity from the source to the node and from the node to the sink; both >= 0.
    void add_terminal(std::int32_t node, double from_source, double to_sink);
    /// Adds an edge between two different nodes with the same capacity >= 0 in both directions.
    void add_edge(std::int32_t a, std::int32_t b, double capacity);

    /// Returns false if more than `step_limit` arcs had to be looked at; the labels are then meaningless.
    bool solve(std::int64_t step_limit);
    /// The number of arcs that solve() has looked at.
    std::int64_t steps() const { return steps_; }
    /// After solve(): true if the node is on the sink's side of the minimum cut (free nodes count to the source).
    bool on_sink_side(std::int32_t node) const { return tree_[node] == Tree::sink; }

 private:
    enum class Tree : std::uint8_t { free, source, sink };
    struct Arc {
        std::int32_t head;
        std::int32_t next;  // next arc of the same tail
        double residual;
    };

    bool grow(std::int32_t& meeting_arc);
    void augment(std::int32_t meeting_arc);
    void adopt_orphans();
    void adopt(std::int32_t node);
    void make_orphan(std::int32_t node);
    void activate(std::int32_t node);
    std::int32_t distance_to_terminal(std::int32_t node);
    double bottleneck_to_terminal(std::int32_t node, double flow) const;
    void push_to_terminal(std::int32_t node, double flow);
    bool can_push(Tree tree, std::int32_t arc) const {
        return (tree == Tree::source ? arcs_[arc].residual : arcs_[arc ^ 1].residual) > 0;
    }

    std::vector<std::int32_t> first_arc_;
    std::vector<Arc> arcs_;         // pairs: arc a and its reverse a ^ 1
    std::vector<double> terminal_;  // residual capacity from the source (> 0) or to the sink (< 0)
    std::vector<Tree> tree_;
    std::vector<std::int32_t> parent_;    // arc from the node towards its parent, or one of the marks
    std::vector<std::int32_t> distance_;  // to the terminal, valid if the stamp is
    std::vector<std::int32_t> stamp_;
    std::vector<std::int32_t> active_;  // queue
    std::vector<char> is_active_;
    std::size_t active_head_ = 0;
    std::vector<std::int32_t> orphans_;
    std::int32_t time_ = 0;
    std::int64_t steps_ = 0;
};

}  // namespace kerf

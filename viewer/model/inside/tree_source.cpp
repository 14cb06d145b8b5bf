#include "viewer/model/inside/tree_source.h"

#include "base/core/ids.h"

namespace kerf::view {

void describe_cut(const Cut& cut, TreeRow& row) {
    row.state = cut.made() ? NodeState::divided : NodeState::waiting;
    row.cut = summary_of(cut);
    // A run triangulates the interface of a straight cut, and measures it, after it has told of the cut.
    const bool is_measured =
        cut.strategy != CutStrategy::straight || cut.quality.angle_deg < InterfaceQuality().angle_deg;
    if (!is_measured) row.cut->quality = {-1, -1, -1};
    if (cut.seconds > 0) row.seconds = cut.seconds;
}

void describe_surface(std::int64_t vertices, std::int64_t facets, const MassProperties& mass, TreeRow& row) {
    row.vertices = vertices;
    row.facets = facets;
    row.volume = mass.volume;
    row.centroid = mass.centroid;
    row.eigenvalues = mass.eigenvalues;
    row.axes = mass.axes;
}

void count_leaves(Tree& tree) {
    // Children have larger numbers than their parents, so that they are counted before.
    for (auto row = tree.rows.rbegin(); row != tree.rows.rend(); ++row) {
        if (row->leaf()) {
            row->leaves = 1;
            continue;
        }
        row->leaves = 0;
        for (const NodeId child : halves_of(row->id))
            if (const TreeRow* below = tree.find(child)) row->leaves += below->leaves;
    }
}

Tree tree_of(const Trace& trace) {
    Tree tree;
    tree.at(root_node);
    for (const NodeId root : trace.region_roots) {
        tree.at(root);
        for (NodeId node = parent_of(root); node > no_node; node = parent_of(node)) {
            TreeRow& row = tree.at(node);
            row.regions += row.state == NodeState::divided ? 1 : 0;
            row.state = NodeState::divided;
        }
    }
    for (const Cut& cut : trace.cuts) {
        describe_cut(cut, tree.at(cut.node));
        if (!cut.made()) continue;
        tree.at(child_of(cut.node, 0));
        tree.at(child_of(cut.node, 1));
    }
    for (const RegionIndex r : ids<RegionIndex>(trace.region_roots.size()))
        for (TreeRow& row : tree.rows)
            if (lies_below(row.id, trace.region_roots[r.value()])) row.region = r;
    count_leaves(tree);
    return tree;
}

Tree tree_of(const std::vector<NodeId>& parts) {
    Tree tree;
    for (const NodeId part : parts) {
        tree.at(part);
        for (NodeId node = parent_of(part); node > no_node; node = parent_of(node))
            tree.at(node).state = NodeState::divided;
    }
    count_leaves(tree);
    return tree;
}

}  // namespace kerf::view

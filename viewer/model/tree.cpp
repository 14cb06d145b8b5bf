#include "viewer/model/tree.h"

#include <algorithm>

namespace kerf::view {

namespace {

template <class Rows>
auto lower_bound(Rows& rows, NodeId id) {
    return std::partition_point(rows.begin(), rows.end(), [&](const TreeRow& row) { return row.id < id; });
}

void append_in_order(const Tree& tree, NodeId node, std::vector<const TreeRow*>& rows) {
    const TreeRow* row = tree.find(node);
    if (!row) return;
    rows.push_back(row);
    append_in_order(tree, child_of(node, 0), rows);
    append_in_order(tree, child_of(node, 1), rows);
}

}  // namespace

const char* name(NodeState state) {
    switch (state) {
        case NodeState::divided:
            return "divided";
        case NodeState::waiting:
            return "waiting";
        case NodeState::meshing:
            return "meshing";
        case NodeState::done:
            return "done";
        case NodeState::failed:
            return "failed";
    }
    return "";
}

std::string name_of_filler(const std::string& mesher, const std::string& strategy) {
    if (!strategy.empty()) return strategy;
    return mesher == "tetgen" ? "TetGen" : mesher;
}

const TreeRow* Tree::find(NodeId id) const {
    const auto row = lower_bound(rows, id);
    return row != rows.end() && row->id == id ? &*row : nullptr;
}

TreeRow* Tree::find(NodeId id) { return const_cast<TreeRow*>(static_cast<const Tree&>(*this).find(id)); }

TreeRow& Tree::at(NodeId id) {
    auto row = lower_bound(rows, id);
    if (row == rows.end() || row->id != id) {
        row = rows.insert(row, TreeRow());
        row->id = id;
    }
    return *row;
}

std::vector<NodeId> Tree::parts_below(NodeId node) const {
    std::vector<NodeId> parts;
    for (auto row = lower_bound(rows, node); row != rows.end(); ++row)
        if (row->leaf() && lies_below(row->id, node)) parts.push_back(row->id);
    return parts;
}

std::vector<const TreeRow*> Tree::in_order() const {
    std::vector<const TreeRow*> ordered;
    append_in_order(*this, root_node, ordered);
    return ordered;
}

int Tree::levels() const {
    int levels = 0;
    for (const TreeRow& row : rows) levels = std::max(levels, level_of(row.id) + 1);
    return levels;
}

}  // namespace kerf::view

#include "cut/decompose/tree_node.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/core/error.h"

#include "base/core/check.h"

namespace kerf {

std::array<NodeId, 2> children_of(NodeId node) {
    if (node.value() > std::numeric_limits<std::int32_t>::max() / 2)
        throw Error(ErrorCode::usage, fmt::format("The part of node {} would be cut once more, but the tree of cuts "
                                                  "cannot be deeper. Use fewer parts, or another --balance.",
                                                  node.value()));
    return halves_of(node);
}

TreeNode describe_node(NodeId id, std::int32_t first_leaf, std::int32_t leaves, const Surface& surface,
                       const MassProperties& mass) {
    KERF_CHECK(id >= root_node && first_leaf >= 0 && leaves >= 1);
    TreeNode node;
    node.id = id;
    node.first_leaf = first_leaf;
    node.leaves = leaves;
    node.vertices = surface.vertex_count();
    node.facets = surface.facet_count();
    node.mass = mass;
    return node;
}

void describe_cut(const Cut& cut, TreeNode& node) {
    node.cut_tried = true;
    node.cut_made = cut.made();
    static_cast<CutSummary&>(node) = summary_of(cut);
    node.interface_vertices = static_cast<std::int32_t>(cut.interface.points.size() - cut.interface.contour.size());
    node.cut_hash = cut.hash;
}

std::int32_t leaves_below(const std::array<double, 2>& load, std::int32_t leaves, const CutOptions& options) {
    KERF_CHECK(leaves >= 2);
    KERF_CHECK(load[0] >= 0 && load[1] >= 0 && load[0] + load[1] > 0);
    if (options.criterion == Criterion::equidistant) return leaves / 2;
    const auto share = static_cast<std::int32_t>(std::lround(leaves * load[0] / (load[0] + load[1])));
    return std::clamp(share, 1, leaves - 1);
}

}  // namespace kerf

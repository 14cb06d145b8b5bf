#include "run/prepare/numbering.h"

#include <algorithm>

#include "base/core/check.h"

namespace kerf {

VertexNumbering::VertexNumbering(std::int64_t input_vertices, std::span<const TreeNode> nodes)
    : offsets_{{input_node, 0}}, end_(input_vertices) {
    const auto by_number = [](const TreeNode& a, const TreeNode& b) { return a.id < b.id; };
    KERF_CHECK(input_vertices >= 0 && std::is_sorted(nodes.begin(), nodes.end(), by_number));
    for (const TreeNode& node : nodes) {
        if (!node.cut_made) continue;
        offsets_.push_back({node.id, end_});
        end_ += node.interface_vertices;
    }
}

std::int64_t VertexNumbering::offset_of(NodeId node) const {
    const auto found = std::lower_bound(offsets_.begin(), offsets_.end(), node,
                                        [](const Offset& offset, NodeId n) { return offset.node < n; });
    KERF_CHECK(found != offsets_.end() && found->node == node);
    return found->first;
}

std::vector<std::int64_t> VertexNumbering::global_ids(const std::vector<Key>& keys) const {
    std::vector<std::int64_t> ids;
    ids.reserve(keys.size());
    for (const Key key : keys) ids.push_back(global_id(key));
    return ids;
}

}  // namespace kerf

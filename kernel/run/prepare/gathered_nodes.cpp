#include "run/prepare/gathered_nodes.h"

#include <map>
#include <tuple>

#include <fmt/format.h>

namespace kerf {

namespace {

struct NodesOfRank {
    std::string host;
    std::vector<TreeNode> nodes;

    template <class Archive>
    void archive(Archive& a) {
        a(host, nodes);
    }
};

struct FirstFound {
    std::size_t rank;
    const TreeNode* node;
};

bool is_cut_alike(const TreeNode& a, const TreeNode& b) {
    const auto facts = [](const TreeNode& n) { return std::tie(n.first_leaf, n.leaves, n.cut_tried, n.cut_hash); };
    return facts(a) == facts(b);
}

// Each node once, ascending by number.
std::vector<TreeNode> merge_nodes(const std::vector<NodesOfRank>& gathered) {
    std::map<NodeId, FirstFound> found;
    std::map<NodeId, std::size_t> unlike;  // and the rank that has it otherwise
    for (std::size_t rank = 0; rank < gathered.size(); ++rank)
        for (const TreeNode& node : gathered[rank].nodes) {
            const auto [first, is_new] = found.emplace(node.id, FirstFound{rank, &node});
            if (!is_new && !is_cut_alike(*first->second.node, node)) unlike.emplace(node.id, rank);
        }
    if (!unlike.empty()) {
        const auto [node, second] = *unlike.begin();
        const std::size_t first = found.at(node).rank;
        throw Error(ErrorCode::internal,
                    fmt::format("Rank {} on {} and rank {} on {} have cut node {} of the tree differently, so that "
                                "their parts would not fit. Use hosts with the same processors, system libraries and "
                                "build of Kerf.",
                                first, gathered[first].host, second, gathered[second].host, node.value()));
    }
    std::vector<TreeNode> all;
    for (const auto& [id, first] : found) all.push_back(*first.node);
    return all;
}

}  // namespace

std::vector<TreeNode> gather_nodes(Communicator& ranks, const std::vector<TreeNode>& own, const std::string& host) {
    constexpr int root = 0;
    const std::vector<NodesOfRank> gathered = gather_items_to(ranks, root, std::vector{NodesOfRank{host, own}});
    const std::vector<TreeNode> all = in_agreement(ranks, [&] { return merge_nodes(gathered); });
    return from_bytes<std::vector<TreeNode>>(ranks.broadcast(to_bytes(all), root));
}

}  // namespace kerf

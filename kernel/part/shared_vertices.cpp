#include "part/shared_vertices.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace kerf {

SharedVertices::SharedVertices(std::vector<Held> held, std::vector<NodeId> ids)
    : held_(std::move(held)), ids_(std::move(ids)) {
    const auto key = [](const Held& h) { return std::tie(h.vertex, h.rank); };
    std::sort(held_.begin(), held_.end(), [&](const Held& a, const Held& b) { return key(a) < key(b); });
    held_.erase(std::unique(held_.begin(), held_.end(), [&](const Held& a, const Held& b) { return key(a) == key(b); }),
                held_.end());
    std::size_t kept = 0;
    for (std::size_t i = 0, j = 0; i < held_.size(); i = j) {
        while (j < held_.size() && held_[j].vertex == held_[i].vertex) ++j;
        if (j - i < 2) continue;
        for (std::size_t k = i; k < j; ++k) held_[kept++] = held_[k];
    }
    held_.resize(kept);
}

std::vector<SharedGroup> SharedVertices::groups_of(std::int32_t rank,
                                                   std::span<const std::int64_t> boundary_ids) const {
    std::map<std::vector<std::int32_t>, std::vector<std::int32_t>> vertices_of;  // by the ranks that hold them
    std::vector<std::int32_t> ranks;
    for (std::size_t v = 0; v < boundary_ids.size(); ++v) {
        const std::int64_t id = boundary_ids[v];
        auto it = std::lower_bound(held_.begin(), held_.end(), id,
                                   [](const Held& h, std::int64_t wanted) { return h.vertex < wanted; });
        ranks.clear();
        for (; it != held_.end() && it->vertex == id; ++it) ranks.push_back(it->rank);
        if (std::binary_search(ranks.begin(), ranks.end(), rank))
            vertices_of[ranks].push_back(static_cast<std::int32_t>(v));
    }
    std::vector<SharedGroup> groups;
    for (auto& [of_ranks, vertices] : vertices_of) {
        SharedGroup& group = groups.emplace_back();
        for (const std::int32_t r : of_ranks) group.parts.push_back(ids_[static_cast<std::size_t>(r)]);
        std::sort(vertices.begin(), vertices.end(), [&](std::int32_t a, std::int32_t b) {
            return boundary_ids[static_cast<std::size_t>(a)] < boundary_ids[static_cast<std::size_t>(b)];
        });
        group.vertices = std::move(vertices);
    }
    return groups;
}

}  // namespace kerf

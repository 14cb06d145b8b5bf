#include "files/part/shared_vertices.h"

#include <algorithm>
#include <map>

namespace kerf {

SharedVertices::SharedVertices(std::vector<Incidence> held, const std::vector<NodeId>& ids)
    : held_(std::move(held)), ids_(ids.begin(), ids.end()) {
    std::sort(held_.begin(), held_.end());
    held_.erase(std::unique(held_.begin(), held_.end()), held_.end());
    std::size_t kept = 0;
    for (std::size_t i = 0, j = 0; i < held_.size(); i = j) {
        while (j < held_.size() && held_[j].vertex == held_[i].vertex) ++j;
        if (j - i < 2) continue;
        for (std::size_t k = i; k < j; ++k) held_[kept++] = held_[k];
    }
    held_.resize(kept);
}

std::vector<SharedGroup> SharedVertices::groups_of(PartIndex index, std::span<const std::int64_t> boundary_ids) const {
    std::map<std::vector<PartIndex>, std::vector<std::int32_t>> vertices_of;  // by the parts that hold them
    std::vector<PartIndex> holders;
    for (std::size_t v = 0; v < boundary_ids.size(); ++v) {
        const std::int64_t id = boundary_ids[v];
        auto it = std::lower_bound(held_.begin(), held_.end(), id,
                                   [](const Incidence& h, std::int64_t wanted) { return h.vertex < wanted; });
        holders.clear();
        for (; it != held_.end() && it->vertex == id; ++it) holders.push_back(it->part);
        if (std::binary_search(holders.begin(), holders.end(), index)) vertices_of[holders].push_back(v);
    }
    std::vector<SharedGroup> groups;
    for (auto& [parts, vertices] : vertices_of) {
        SharedGroup& group = groups.emplace_back();
        for (const PartIndex holder : parts) group.parts.push_back(ids_[holder]);
        std::sort(vertices.begin(), vertices.end(),
                  [&](std::int32_t a, std::int32_t b) { return boundary_ids[a] < boundary_ids[b]; });
        group.vertices = std::move(vertices);
    }
    return groups;
}

}  // namespace kerf

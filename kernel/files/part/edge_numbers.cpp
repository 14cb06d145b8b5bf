#include "files/part/edge_numbers.h"

#include <algorithm>

namespace kerf {

namespace {

// Returns the first part of the group that is there. `ids`: the parts that are there, ascending.
NodeId owner_among(const std::vector<NodeId>& ids, const std::vector<NodeId>& group) {
    return *std::find_if(group.begin(), group.end(),
                         [&](NodeId id) { return std::binary_search(ids.begin(), ids.end(), id); });
}

std::vector<NodeId> ascending_ids(const MeshOutline& outline) {
    std::vector<NodeId> ids;
    for (const PartExtent& part : outline.parts) ids.push_back(part.id);
    std::sort(ids.begin(), ids.end());
    return ids;
}

}  // namespace

EdgeNumbers::OfPart EdgeNumbers::told_by(NodeId id, const std::vector<SharedEdgeGroup>& shared, std::int64_t edges,
                                         const MeshOutline& outline) {
    const std::vector<NodeId> ids = ascending_ids(outline);
    OfPart told;
    told.edges = told.owned = edges;
    for (const SharedEdgeGroup& group : shared) {
        if (owner_among(ids, group.parts) == id)
            told.groups.push_back({group.parts, std::ssize(group.edges)});
        else
            told.owned -= std::ssize(group.edges);
    }
    return told;
}

EdgeNumbers::EdgeNumbers(const MeshOutline& outline, const std::vector<OfPart>& told) {
    std::int64_t next = outline.vertices;
    for (const PartIndex index : outline.parts.ids()) {
        const OfPart& of_part = told[index.value()];
        std::int64_t in_part = next;
        for (const OwnedGroup& group : of_part.groups) {
            groups_.push_back({group.parts, in_part});
            in_part += group.edges;
        }
        part_ids_.push_back(outline.parts[index].id);
        first_own_.push_back(in_part);
        counts_.push_back(of_part.edges);
        next += of_part.owned;
    }
    total_ = next - outline.vertices;
    std::sort(groups_.begin(), groups_.end(), [](const Group& a, const Group& b) { return a.parts < b.parts; });
}

std::int64_t EdgeNumbers::first_of_group(const std::vector<NodeId>& parts) const {
    return std::lower_bound(groups_.begin(), groups_.end(), parts,
                            [](const Group& group, const std::vector<NodeId>& wanted) { return group.parts < wanted; })
        ->first;
}

std::vector<std::int64_t> EdgeNumbers::of(const Part& part, const EdgeTable& edges) const {
    constexpr std::int64_t unset = -1;
    std::vector<std::int64_t> numbers(edges.size(), unset);
    for (const SharedEdgeGroup& group : part.shared_edges) {
        std::int64_t next = first_of_group(group.parts);
        for (const UndirectedEdge& edge : group.edges) numbers[edges.find(undirected(edge[0], edge[1]))] = next++;
    }
    const PartIndex index(std::find(part_ids_.begin(), part_ids_.end(), part.id) - part_ids_.begin());
    std::int64_t next = first_own_[index];
    for (std::int64_t& number : numbers)
        if (number == unset) number = next++;
    return numbers;
}

EdgeNumbers number_edges(const PartSource& parts) {
    std::vector<EdgeNumbers::OfPart> told;
    for (const PartIndex index : parts.outline().parts.ids()) {
        const Part part = parts.load(index);
        told.push_back(
            EdgeNumbers::told_by(part, EdgeTable(part.mesh.tets, part.mesh.vertices.size()), parts.outline()));
    }
    return EdgeNumbers(parts.outline(), told);
}

}  // namespace kerf

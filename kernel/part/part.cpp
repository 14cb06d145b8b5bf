#include "part/part.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"

namespace kerf {

std::vector<NodeId> owners_of_vertices(const Part& part) {
    std::vector<NodeId> owner(part.mesh.vertices.size(), part.id);
    for (const SharedGroup& group : part.shared)
        for (const std::int32_t v : group.vertices) owner[static_cast<std::size_t>(v)] = group.parts.front();
    return owner;
}

std::int32_t MeshOutline::rank_of(NodeId id) const {
    const auto found =
        std::find_if(parts.begin(), parts.end(), [id](const PartExtent& extent) { return extent.id == id; });
    if (found == parts.end()) throw Error(ErrorCode::internal, fmt::format("The mesh has no part {}.", id));
    return static_cast<std::int32_t>(found - parts.begin());
}

std::int64_t MeshOutline::first_tet(std::int32_t rank) const {
    std::int64_t first = 0;
    for (std::int32_t r = 0; r < rank; ++r) first += parts[static_cast<std::size_t>(r)].tets;
    return first;
}

std::int64_t MeshOutline::tets() const { return first_tet(static_cast<std::int32_t>(parts.size())); }

std::int64_t MeshOutline::first_patch_facet(std::int32_t rank) const {
    std::int64_t first = 0;
    for (std::int32_t r = 0; r < rank; ++r) first += parts[static_cast<std::size_t>(r)].patch_facets;
    return first;
}

}  // namespace kerf

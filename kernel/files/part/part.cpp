// "The order of the tree" is the order of its leaves from left to right, and the order of parts everywhere. Node n has
// the children 2 n and 2 n + 1, so the bits of a number behind the first are the way from the root, 0 to the left.
// Shifted to the top of 32 bits, these ways compare leaves of any depth, which is all that find() needs. Sums over the
// parts before one are made anew at each call, O(K).
#include "files/part/part.h"

#include <algorithm>
#include <bit>

#include <fmt/format.h>

#include "base/core/error.h"
#include "files/part/bodies.h"
#include "files/part/region_walls.h"

namespace kerf {

Part boundary_of(const Part& part) {
    const std::ptrdiff_t boundary = part.mesh.boundary_vertex_count;
    Part surface;
    static_cast<PartBoundary&>(surface) = part;
    surface.mesh.vertices.assign(part.mesh.vertices.begin(), part.mesh.vertices.begin() + boundary);
    surface.mesh.boundary_vertex_count = part.mesh.boundary_vertex_count;
    surface.tet_at_facet.assign(part.facets.size(), -1);
    surface.global_id.assign(part.global_id.begin(), part.global_id.begin() + boundary);
    return surface;
}

RegionIndex Part::region_of(std::int32_t tet) const {
    const auto after = std::upper_bound(regions.begin(), regions.end(), tet,
                                        [](std::int32_t t, const RegionRun& run) { return t < run.first_tet; });
    return after == regions.begin() ? RegionIndex() : std::prev(after)->region;
}

std::vector<NodeId> owners_of_vertices(const Part& part) {
    std::vector<NodeId> owner(part.mesh.vertices.size(), part.id);
    for (const SharedGroup& group : part.shared)
        for (const std::int32_t v : group.vertices) owner[v] = group.parts.front();
    return owner;
}

namespace {

// Returns a number that ascends in the order of the tree among nodes of which none lies below another: the way from the
// root, a bit a step.
std::uint32_t way_from_root(NodeId id) {
    const std::uint32_t bits = id.value();
    return id > no_node ? bits << std::countl_zero(bits) : 0;
}

std::int64_t sum_before(PartIndex index, const Array<PartIndex, PartExtent>& parts, std::int64_t PartExtent::*count) {
    std::int64_t sum = 0;
    for (const PartIndex i : IdRange(PartIndex(), index)) sum += parts[i].*count;
    return sum;
}

}  // namespace

std::optional<PartIndex> MeshOutline::find(NodeId id) const {
    const auto found = std::lower_bound(
        parts.begin(), parts.end(), way_from_root(id),
        [](const PartExtent& extent, std::uint32_t wanted) { return way_from_root(extent.id) < wanted; });
    if (found == parts.end() || found->id != id) return std::nullopt;
    return PartIndex(found - parts.begin());
}

PartIndex MeshOutline::index_of(NodeId id) const {
    const std::optional<PartIndex> found = find(id);
    if (!found) throw Error(ErrorCode::internal, fmt::format("The mesh has no part {}.", id.value()));
    return *found;
}

std::int64_t MeshOutline::first_tet(PartIndex index) const { return sum_before(index, parts, &PartExtent::tets); }

std::int64_t MeshOutline::tets() const { return first_tet(PartIndex(parts.size())); }

std::int64_t MeshOutline::first_patch_facet(PartIndex index) const {
    return sum_before(index, parts, &PartExtent::patch_facets);
}

std::int64_t MeshOutline::patch_facets() const { return first_patch_facet(PartIndex(parts.size())); }

PartSource::PartSource() = default;
PartSource::~PartSource() = default;

const Bodies& PartSource::bodies() const {
    const std::lock_guard lock(finding_);
    if (!bodies_) bodies_ = std::make_unique<const Bodies>(*this);
    return *bodies_;
}

const RegionWalls& PartSource::walls() const {
    const std::lock_guard lock(finding_);
    if (!walls_) walls_ = std::make_unique<const RegionWalls>(*this);
    return *walls_;
}

}  // namespace kerf

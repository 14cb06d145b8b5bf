#include "run/run/edge_numbering.h"

#include <vector>

#include "files/part/part_indices.h"
#include "run/run/inside/range_of_rank.h"

namespace kerf {

EdgeNumbers number_edges_together(Communicator& ranks, const PartSource& parts, RunListener* listener) {
    const MeshOutline& outline = parts.outline();
    const LeafRange share = range_of_rank(static_cast<std::int32_t>(outline.parts.size()), ranks);
    const std::vector<EdgeNumbers::OfPart> own = in_agreement(ranks, [&] {
        std::vector<EdgeNumbers::OfPart> told;
        for (const PartIndex index : IdRange(PartIndex(share.first), PartIndex(share.last))) {
            tell_progress(listener, "number", told.size(), static_cast<std::size_t>(share.last - share.first));
            const Part part = parts.load(index);
            told.push_back(EdgeNumbers::told_by(part, EdgeTable(part.mesh.tets, part.mesh.vertices.size()), outline));
        }
        return told;
    });
    return EdgeNumbers(outline, gather_items(ranks, own));
}

void count_nodes(const SecondOrderParts& parts, RunReport& report) {
    report.mesh.nodes = parts.outline().nodes();
    report.mesh.curved_nodes = std::ssize(parts.curved().ids);
    std::vector<NodeId> ids;
    for (const PartReport& part : report.parts) ids.push_back(part.id);
    const PartIndices index(ids);
    for (const PartExtent& extent : parts.outline().parts)
        report.parts[static_cast<std::size_t>(index.of(extent.id).value())].mesh_nodes =
            extent.vertices + extent.edge_nodes;
}

}  // namespace kerf

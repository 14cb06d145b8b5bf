#include "run/run/edge_numbering.h"

#include <vector>

#include "base/core/ids.h"
#include "run/run/inside/range_of_rank.h"

namespace kerf {

EdgeNumbers number_edges_together(Communicator& ranks, const PartSource& parts, RunListener* listener) {
    const MeshOutline& outline = parts.outline();
    const LeafRange share = range_of_rank(count_of(outline.parts), ranks);
    const std::vector<EdgeNumbers::OfPart> own = in_agreement(ranks, [&] {
        std::vector<EdgeNumbers::OfPart> told;
        for (const PartIndex index : IdRange(PartIndex(share.first), PartIndex(share.last))) {
            tell_progress(listener, "number", told.size(), share.last - share.first);
            const Part part = parts.load(index);
            told.push_back(EdgeNumbers::told_by(part, EdgeTable(part.mesh.tets, part.mesh.vertices.size()), outline));
        }
        return told;
    });
    return EdgeNumbers(outline, gather_items(ranks, own));
}

}  // namespace kerf

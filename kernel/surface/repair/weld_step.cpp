// Only where the surface is open: elsewhere two near vertices are a thin wall, or a short edge of a fine triangulation.
#include <algorithm>

#include "surface/repair/inside/border_merger.h"
#include "surface/repair/inside/rims.h"
#include "surface/repair/repair_step.h"

namespace kerf {

void weld_step(Soup& soup, const StepRequest& request, StepReport& report) {
    std::vector<char> is_left_out;
    for (const Triangle& t : soup.facets) is_left_out.push_back(!is_ordinary(soup.vertices, t));
    const Border border(soup.vertices, soup.facets, is_left_out);
    std::vector<double> reach(soup.vertices.size(), 0.0);
    BorderMerging merging =
        merge_border(soup.vertices, soup.facets, border, std::min(request.amount, request.bound), request.bound, reach);
    const std::vector<Triangle> before = soup.facets;
    for (Triangle& t : soup.facets)
        for (std::int32_t& v : t) v = merging.representative[v];
    undo_useless(before, {}, merging, soup.facets);
    RepairAction merged{"vertex merged", "vertices merged", "apart"};
    for (const VertexPair& pair : merging.merged) {
        merged.add({soup.vertices[pair.stays], {soup.file_facets({border.facets_at(pair.gone)[0]})}, pair.apart});
        report.largest_move = std::max(report.largest_move, reach[merging.representative[pair.gone]]);
    }
    if (merged.count > 0) drop_unused_vertices(soup);
    report.actions.push_back(std::move(merged));
}

}  // namespace kerf

#include "surface/repair/inside/remaining_defects.h"

#include "surface/diagnosis/diagnosis.h"

namespace kerf {

namespace {

bool can_be_taken_out(const Defect& defect, double most_edges) {
    switch (defect.kind) {
        case DefectKind::open_edge:
            return defect.vertices.size() <= most_edges;
        case DefectKind::degenerate_facet:
        case DefectKind::duplicate_facet:
        case DefectKind::non_manifold_edge:
        case DefectKind::non_manifold_vertex:
        case DefectKind::self_intersection:
            return true;
        default:
            return false;
    }
}

}  // namespace

std::vector<RemainingDefect> find_remaining_defects(const Soup& soup, double most_edges) {
    std::vector<RemainingDefect> found;
    for (const Defect& defect : diagnose(soup).defects)
        if (defect.severity == Severity::error && !defect.facets.empty() && can_be_taken_out(defect, most_edges))
            found.push_back({defect.facets, defect.where});
    return found;
}

}  // namespace kerf

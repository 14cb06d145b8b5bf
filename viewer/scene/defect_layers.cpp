// What kerf check has found.
#include "viewer/scene/scene_build.h"

namespace kerf::view {

void SceneBuild::add_defects(const CheckedSoup* found) {
    if (!found || state_.node != 1) return;
    const CheckedSoup& checked = *found;
    const Soup& soup = checked.soup;
    const auto point = [&](std::int32_t v) { return soup.vertices[static_cast<std::size_t>(v)]; };
    std::vector<Vec3> errors, warnings;
    std::vector<std::array<Vec3, 2>> edges;
    std::vector<Triangle> facets;
    for (const Defect& defect : checked.diagnosis.defects) {
        if (defect.severity == Severity::repaired) continue;
        const bool is_error = defect.severity == Severity::error;
        (is_error ? errors : warnings).push_back(defect.where);
        if (!is_error) continue;
        const bool is_loop = defect.kind == DefectKind::open_edge;
        if (is_loop || defect.kind == DefectKind::non_manifold_edge)
            for (std::size_t i = 0; i + 1 < defect.vertices.size() + (is_loop ? 1 : 0); ++i)
                edges.push_back({point(defect.vertices[i]), point(defect.vertices[(i + 1) % defect.vertices.size()])});
        if (!is_loop)
            for (const std::int32_t f : defect.facets) facets.push_back(soup.facets[static_cast<std::size_t>(f)]);
    }
    if (!facets.empty()) {
        Layer& layer = add(LayerKind::defects, triangles(soup.vertices, facets, built_.frame), colors_.error, 1);
        layer.two_sided = true;
    }
    if (!edges.empty()) add_lines(LayerKind::defect_edges, edges, colors_.error, contour_pixels);
    if (!warnings.empty()) add_points(LayerKind::warning_places, warnings, colors_.warning, place_pixels - 2);
    if (!errors.empty()) add_points(LayerKind::defect_places, errors, colors_.error, place_pixels);
}

}  // namespace kerf::view

#include "fill/shell/inside/vertex_merging.h"

#include <algorithm>

#include "fill/improve/cell_shape.h"
#include "fill/shell/inside/vertex_star.h"

namespace kerf {

namespace {

constexpr double least_merged_angle_deg = 12;
constexpr double least_kept_edge_share = 0.7;  // share of the wanted length

void merge_if_close(EditableTets& tets, std::int32_t v, const SizeField& size) {
    VertexStar star(tets, v);
    const double kept = least_kept_edge_share * size.at(star.at());
    if (star.shortest_edge_sq() >= kept * kept) return;
    const double worst = std::max(square_from_degrees(least_merged_angle_deg), star.badness_at(star.at()));
    const auto merged =
        star.best_merged(worst, [&](const std::array<Vec3, 4>& corners) { return !is_too_large(size, corners); });
    if (!merged.cells.empty()) star.replace_by(merged);
}

}  // namespace

void merge_close_vertices(EditableTets& tets, std::int32_t first, const SizeField& size) {
    for (std::int32_t v = first; v < static_cast<std::int32_t>(tets.points().size()); ++v)
        if (tets.cell_at(v) != EditableTets::none) merge_if_close(tets, v, size);
}

}  // namespace kerf

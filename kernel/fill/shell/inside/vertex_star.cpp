#include "fill/shell/inside/vertex_star.h"

#include <algorithm>
#include <limits>

#include "base/geometry/predicates.h"
#include "fill/improve/cell_shape.h"

namespace kerf {

namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();
}

VertexStar::VertexStar(EditableTets& tets, std::int32_t vertex)
    : tets_(tets), vertex_(vertex), cells_(tets.cells_around_vertex(vertex)) {
    for (const CellId cell : cells_)
        for (const std::int32_t u : tets.vertices(cell))
            if (u != vertex) neighbours_.push_back(u);
    std::sort(neighbours_.begin(), neighbours_.end());
    neighbours_.erase(std::unique(neighbours_.begin(), neighbours_.end()), neighbours_.end());
}

double VertexStar::shortest_edge_sq() const {
    double shortest_sq = infinity;
    for (const std::int32_t u : neighbours_) shortest_sq = std::min(shortest_sq, (point(u) - at()).squaredNorm());
    return shortest_sq;
}

double VertexStar::badness_of(const std::array<Vec3, 4>& corners) const {
    const auto& [a, b, c, d] = corners;
    if (orientation(a, b, c, d) <= 0) return infinity;
    const double badness = cell_shape(a, b, c, d).badness();
    return badness < infinity ? badness : std::numeric_limits<double>::max();  // where it is flat in doubles
}

double VertexStar::badness_at(const Vec3& p) const {
    double worst = -infinity;
    for (const CellId cell : cells_) {
        std::array<Vec3, 4> corners;
        for (int i = 0; i < 4; ++i) {
            const std::int32_t v = tets_.vertices(cell)[i];
            corners[i] = v == vertex_ ? p : point(v);
        }
        worst = std::max(worst, badness_of(corners));
    }
    return worst;
}

VertexStar::Merged VertexStar::best_merged(double limit,
                                           const std::function<bool(const std::array<Vec3, 4>&)>& accepts) const {
    Merged best{limit, {}}, merged;
    for (const std::int32_t u : neighbours_) {
        merged = {-infinity, {}};
        for (const CellId cell : cells_) {
            Tetrahedron vertices = tets_.vertices(cell);
            if (index_of(vertices, u) < 4) continue;
            vertices[index_of(vertices, vertex_)] = u;
            const auto& [a, b, c, d] = vertices;
            const std::array<Vec3, 4> corners = {point(a), point(b), point(c), point(d)};
            merged.badness = std::max(merged.badness, badness_of(corners));
            if (accepts && !accepts(corners)) merged.badness = infinity;
            if (merged.badness >= best.badness) break;
            merged.cells.push_back(vertices);
        }
        if (merged.badness < best.badness) best = std::move(merged);
    }
    return best;
}

}  // namespace kerf

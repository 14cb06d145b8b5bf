#include "shell/vertex_merging.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "geometry/predicates.h"
#include "improve/cell_shape.h"

namespace kerf {

namespace {

constexpr double least_merged_angle_deg = 12;
constexpr double least_kept_edge_share = 0.7;  // of the wanted length

class VertexMerging {
 public:
    VertexMerging(Triangulation& triangulation, std::uint8_t region, const SizeField& size)
        : t_(triangulation), region_(region), size_(size) {}

    void run() {
        for (std::int32_t v = 0; v < static_cast<std::int32_t>(t_.points().size()); ++v)
            if (t_.cell_at(v) != Triangulation::none) merge_if_close(v);
    }

 private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    const Vec3& point(std::int32_t vertex) const { return t_.points()[vertex]; }

    void merge_if_close(std::int32_t v) {
        const std::vector<std::int32_t> star = t_.cells_around_vertex(v);
        if (!is_inside(v, star)) return;
        const std::vector<std::int32_t> neighbours = neighbours_of(v, star);
        double shortest_sq = infinity;
        for (const std::int32_t u : neighbours)
            shortest_sq = std::min(shortest_sq, (point(u) - point(v)).squaredNorm());
        const double kept = least_kept_edge_share * size_.at(point(v));
        if (shortest_sq >= kept * kept) return;
        double least = square_from_degrees(least_merged_angle_deg);
        for (const std::int32_t cell : star) least = std::max(least, badness_of(t_.vertices(cell)));
        std::vector<Tetrahedron> best;
        for (const std::int32_t u : neighbours) {
            std::vector<Tetrahedron> cells;
            const double badness = worst_with(u, v, star, cells);
            if (badness < least) least = badness, best = std::move(cells);
        }
        if (!best.empty()) t_.replace(star, best);
    }

    // Not on a face that stays.
    bool is_inside(std::int32_t v, const std::vector<std::int32_t>& star) const {
        return std::all_of(star.begin(), star.end(), [&](std::int32_t cell) {
            if (t_.region(cell) != region_) return false;
            for (int i = 0; i < 4; ++i)
                if (t_.vertices(cell)[i] != v && t_.is_constrained(cell_face(cell, i))) return false;
            return true;
        });
    }

    std::vector<std::int32_t> neighbours_of(std::int32_t v, const std::vector<std::int32_t>& star) const {
        std::vector<std::int32_t> neighbours;
        for (const std::int32_t cell : star)
            for (const std::int32_t u : t_.vertices(cell))
                if (u != v) neighbours.push_back(u);
        std::sort(neighbours.begin(), neighbours.end());
        neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
        return neighbours;
    }

    // The cells at u in place of those at v, and the badness of the worst; infinity if one would be too large, or not
    // positive.
    double worst_with(std::int32_t u, std::int32_t v, const std::vector<std::int32_t>& star,
                      std::vector<Tetrahedron>& cells) const {
        double worst = -infinity;
        for (const std::int32_t cell : star) {
            if (index_of(t_.vertices(cell), u) < 4) continue;
            Tetrahedron vertices = t_.vertices(cell);
            vertices[index_of(t_.vertices(cell), v)] = u;
            const auto& [a, b, c, d] = vertices;
            if (orientation(point(a), point(b), point(c), point(d)) <= 0 ||
                is_too_large(size_, {point(a), point(b), point(c), point(d)}))
                return infinity;
            worst = std::max(worst, badness_of(vertices));
            cells.push_back(vertices);
        }
        return worst;
    }

    double badness_of(const Tetrahedron& v) const {
        return cell_shape(point(v[0]), point(v[1]), point(v[2]), point(v[3])).badness();
    }

    Triangulation& t_;
    std::uint8_t region_;
    const SizeField& size_;
};

}  // namespace

void merge_close_vertices(Triangulation& triangulation, std::uint8_t region, const SizeField& size) {
    VertexMerging(triangulation, region, size).run();
}

}  // namespace kerf

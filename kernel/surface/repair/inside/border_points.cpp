// Vertices of the border divide the open edges that they are near. First each vertex takes the nearest edge that it may
// join (find_nearest()); then points are dropped that would turn pieces over, and, until nothing changes, points that
// join nothing or fold the surface. Edges and their points are judged as a whole, because two sides of a crack whose
// vertices differ everywhere divide each other: a point is of use if a piece beside it is the edge of exactly two
// facets or pieces.
#include "surface/repair/inside/border_points.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "base/core/drop_items.h"
#include "base/geometry/box_tree.h"
#include "base/geometry/closest_point.h"
#include "base/geometry/triangle.h"
#include "surface/repair/inside/border_merger.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

// One of the pieces into which points divide an open edge.
struct BorderPiece {
    UndirectedEdge ends;
    std::size_t left, right;  // its points, by numbers among all; no_point: an end of the edge
};
constexpr double near_share = 0.2;  // of an edge, the part of it that is near its end
constexpr std::size_t no_point = std::numeric_limits<std::size_t>::max();

class BorderPointSearch {
 public:
    BorderPointSearch(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets, const Border& border,
                      double tolerance, double near_end)
        : vertices_(vertices), facets_(facets), border_(border), tolerance_(tolerance), near_end_(near_end) {}

    std::vector<SidePoint> run() {
        find_nearest();
        sort_points();
        drop_turning();
        while (drop_useless() || drop_folded()) continue;
        return std::move(points_);
    }

 private:
    std::int32_t start(std::int32_t corner) const { return start_vertex(facets_, corner); }
    std::int32_t end(std::int32_t corner) const { return start_vertex(facets_, next_corner(corner)); }
    std::int32_t apex(std::int32_t corner) const { return start_vertex(facets_, next_corner(next_corner(corner))); }
    void find_nearest();
    bool may_join(std::int32_t vertex, std::int32_t corner, const Vec3& nearest, double apart) const;
    void sort_points();
    void drop_turning();
    bool turns(std::span<const SidePoint> points) const;
    std::vector<BorderPiece> pieces() const;
    std::int32_t count_facets(const UndirectedEdge& edge) const;
    bool drop_useless();
    bool drop_folded();

    const std::vector<Vec3>& vertices_;
    const std::vector<Triangle>& facets_;
    const Border& border_;
    double tolerance_, near_end_;
    std::vector<SidePoint> points_;  // points of an edge follow each other, from its start on
};

void BorderPointSearch::find_nearest() {
    const std::vector<std::int32_t>& corners = border_.corners();
    if (corners.empty()) return;
    std::vector<Box> boxes;
    for (const std::int32_t c : corners) boxes.push_back(Box(vertices_[start(c)]).extend(vertices_[end(c)]));
    const BoxTree tree(std::move(boxes));
    std::vector<std::pair<double, std::int32_t>> near;
    for (const std::int32_t v : border_.vertices()) {
        const Vec3 &p = vertices_[v], reach = Vec3::Constant(tolerance_);
        near.clear();
        tree.for_each_meeting(Box(p - reach, p + reach), [&](std::int32_t i) {
            const Vec3 nearest = closest_on_segment(p, vertices_[start(corners[i])], vertices_[end(corners[i])]);
            if ((nearest - p).norm() <= tolerance_) near.emplace_back((nearest - p).norm(), corners[i]);
        });
        std::sort(near.begin(), near.end());
        for (const auto& [apart, c] : near) {
            const Vec3 &a = vertices_[start(c)], &b = vertices_[end(c)];
            const Vec3 nearest = closest_on_segment(p, a, b);
            if (!may_join(v, c, nearest, apart)) continue;
            points_.push_back({c, (nearest - a).norm() / (b - a).norm(), v});
            break;
        }
    }
}

bool BorderPointSearch::may_join(std::int32_t vertex, std::int32_t corner, const Vec3& nearest, double apart) const {
    const std::int32_t a = start(corner), b = end(corner);
    if (vertex == a || vertex == b || vertex == apex(corner)) return false;
    if (nearest == vertices_[a] || nearest == vertices_[b]) return false;
    const double length = (vertices_[b] - vertices_[a]).norm();
    for (const std::int32_t end : {a, b})
        if (const double from_end = (nearest - vertices_[end]).norm();
            from_end < near_share * length && (vertices_[vertex] - vertices_[end]).norm() < near_end_)
            return false;
    const double limit = least_arc_ratio * apart;
    return border_.length_between(vertex, a, limit) + (nearest - vertices_[a]).norm() >= limit &&
           border_.length_between(vertex, b, limit) + (nearest - vertices_[b]).norm() >= limit;
}

void BorderPointSearch::sort_points() {
    std::sort(points_.begin(), points_.end(), [](const SidePoint& p, const SidePoint& q) {
        return std::tie(p.corner, p.along, p.vertex) < std::tie(q.corner, q.along, q.vertex);
    });
}

// Whether a piece of the facet of these points looks to another side, or has no area.
bool BorderPointSearch::turns(std::span<const SidePoint> points) const {
    const Triangle& facet = facets_[points[0].corner / 3];
    std::array<std::vector<std::int32_t>, 3> chains;
    for (const SidePoint& point : points) chains[point.corner % 3].push_back(point.vertex);
    const auto corners = [&](const Triangle& t) {
        return std::array<Vec3, 3>{vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]};
    };
    const std::vector<Triangle> all = pieces_of(facet, chains);
    return std::any_of(all.begin(), all.end(), [&](const Triangle& piece) {
        return !keeps_side(corners(facet), corners(piece)) || triangle_area(corners(piece)) == 0;
    });
}

// Of a facet that would turn over at its points, keeps those that can be added one after another without that.
void BorderPointSearch::drop_turning() {
    std::vector<char> drop(points_.size(), 0);
    for (std::size_t i = 0, j = 0; i < points_.size(); i = j) {
        while (j < points_.size() && points_[j].corner / 3 == points_[i].corner / 3) ++j;
        if (!turns(std::span(points_).subspan(i, j - i))) continue;
        std::vector<SidePoint> kept;
        for (std::size_t k = i; k < j; ++k) {
            kept.push_back(points_[k]);
            drop[k] = turns(kept);
            if (drop[k]) kept.pop_back();
        }
    }
    drop_items(points_, drop);
}

std::vector<BorderPiece> BorderPointSearch::pieces() const {
    std::vector<BorderPiece> pieces;
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const bool is_first = i == 0 || points_[i - 1].corner != points_[i].corner;
        const bool is_last = i + 1 == points_.size() || points_[i + 1].corner != points_[i].corner;
        const std::int32_t c = points_[i].corner, v = points_[i].vertex;
        if (is_first) pieces.push_back({undirected(start(c), v), no_point, i});
        pieces.push_back({undirected(v, is_last ? end(c) : points_[i + 1].vertex), i, is_last ? no_point : i + 1});
    }
    std::sort(pieces.begin(), pieces.end(), [](const BorderPiece& p, const BorderPiece& q) {
        return std::tie(p.ends, p.left, p.right) < std::tie(q.ends, q.left, q.right);
    });
    return pieces;
}

// Returns the number of facets that have an edge, without those in which the edge is divided.
std::int32_t BorderPointSearch::count_facets(const UndirectedEdge& edge) const {
    std::int32_t count = 0;
    for (const std::int32_t f : border_.facets_at(edge[0])) {
        const Triangle& t = facets_[f];
        for (std::int32_t i = 0; i < 3; ++i) {
            if (undirected(t[i], t[(i + 1) % 3]) != edge) continue;
            const std::int32_t corner = 3 * f + i;
            const auto point = std::lower_bound(points_.begin(), points_.end(), corner,
                                                [](const SidePoint& p, std::int32_t c) { return p.corner < c; });
            count += point == points_.end() || point->corner != corner;
        }
    }
    return count;
}

bool BorderPointSearch::drop_useless() {
    const std::vector<BorderPiece> all = pieces();
    std::vector<char> is_useful(points_.size(), 0), is_bad(points_.size(), 0);
    for (std::size_t i = 0, j = 0; i < all.size(); i = j) {
        while (j < all.size() && all[j].ends == all[i].ends) ++j;
        const bool is_point = all[i].ends[0] == all[i].ends[1];
        const std::int64_t facets = j - i + (is_point ? 3 : count_facets(all[i].ends));
        for (std::size_t k = i; k < j; ++k)
            for (const std::size_t point : {all[k].left, all[k].right})
                if (point != no_point) (facets > 2 ? is_bad : is_useful)[point] |= facets >= 2;
    }
    std::vector<char> drop(points_.size(), 0);
    for (std::size_t i = 0; i < points_.size(); ++i) drop[i] = !is_useful[i] || is_bad[i];
    const bool is_any = std::find(drop.begin(), drop.end(), 1) != drop.end();
    drop_items(points_, drop);
    return is_any;
}

// Facets whose pieces would have the vertices of another piece, or facet there, are not divided.
bool BorderPointSearch::drop_folded() {
    struct Face {
        Triangle sorted;
        std::size_t first, last;  // the points of its facet; none: an undivided facet
    };
    std::vector<Face> faces;
    std::vector<std::int32_t> whole;
    const auto add = [&](Triangle t, std::size_t first, std::size_t last) {
        std::sort(t.begin(), t.end());
        faces.push_back({t, first, last});
    };
    for (std::size_t i = 0, j = 0; i < points_.size(); i = j) {
        std::array<std::vector<std::int32_t>, 3> chains;
        for (; j < points_.size() && points_[j].corner / 3 == points_[i].corner / 3; ++j)
            chains[points_[j].corner % 3].push_back(points_[j].vertex);
        for (const Triangle& piece : pieces_of(facets_[points_[i].corner / 3], chains)) add(piece, i, j);
        for (std::size_t k = i; k < j; ++k) {
            const auto at = border_.facets_at(points_[k].vertex);
            whole.insert(whole.end(), at.begin(), at.end());
        }
    }
    std::sort(whole.begin(), whole.end());
    whole.erase(std::unique(whole.begin(), whole.end()), whole.end());
    for (const std::int32_t f : whole) {
        const auto point = std::lower_bound(points_.begin(), points_.end(), 3 * f,
                                            [](const SidePoint& p, std::int32_t c) { return p.corner < c; });
        if (point == points_.end() || point->corner / 3 != f) add(facets_[f], 0, 0);
    }
    std::sort(faces.begin(), faces.end(),
              [](const Face& a, const Face& b) { return std::tie(a.sorted, a.first) < std::tie(b.sorted, b.first); });
    std::vector<char> drop(points_.size(), 0);
    for (std::size_t i = 1; i < faces.size(); ++i) {
        if (faces[i].sorted != faces[i - 1].sorted) continue;
        for (const Face& face : {faces[i - 1], faces[i]})
            std::fill(drop.begin() + face.first, drop.begin() + face.last, char{1});
    }
    const bool is_any = std::find(drop.begin(), drop.end(), 1) != drop.end();
    drop_items(points_, drop);
    return is_any;
}

}  // namespace

std::vector<SidePoint> find_border_points(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                          const Border& border, double tolerance, double near_end) {
    return BorderPointSearch(vertices, facets, border, tolerance, near_end).run();
}

}  // namespace kerf

// Passes over the near facets. Each pass does the first of three things for which it finds a place: it joins vertices,
// divides edges at vertices, or divides facets at vertices; then it begins anew. The order matters, since an edge is to
// be divided at one vertex, not at two that are about to be joined. A pass divides an edge at one vertex at most, the
// nearest to its first end, and a facet at the smallest one; further ones wait for the next pass. Vertices are replaced
// in all facets, and an edge is divided in all facets that have it, near or not, so that nothing opens. Pieces of near
// facets are near. Passes are bounded, because long chains may go on for many.
#include "surface/arrange/inside/near_features.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "base/core/elements.h"
#include "base/core/ids.h"
#include "base/geometry/box_hierarchy.h"
#include "base/geometry/closest_point.h"
#include "base/geometry/union_find.h"

namespace kerf {

namespace {

constexpr int most_passes = 100;

// The vertex at which an edge is divided.
struct EdgeSplit {
    UndirectedEdge edge;
    std::int32_t vertex;
    auto operator<=>(const EdgeSplit&) const = default;
};

// Items that are found by a box near them.
class NearItems {
 public:
    explicit NearItems(const std::vector<Box>& boxes) : order_(boxes.size()) {
        for (std::int32_t i = 0; i < count_of(order_); ++i) order_[i] = i;
        hierarchy_ = make_hierarchy(boxes, order_);
    }
    template <class Visit>
    void visit(Box box, double tolerance, const Visit& visit) const {
        box.min().array() -= tolerance;
        box.max().array() += tolerance;
        hierarchy_.any([&](const BoxNode& node) { return node.box.intersects(box); },
                       [&](std::int32_t item) {
                           visit(order_[item]);
                           return false;
                       });
    }

 private:
    std::vector<std::int32_t> order_;
    BoxHierarchy<> hierarchy_;
};

class NearFeatures {
 public:
    NearFeatures(DividedFacets& divided, std::vector<char> is_near, double tolerance, std::size_t given)
        : divided_(divided), is_near_(std::move(is_near)), tolerance_(tolerance), given_(given) {
        for (std::size_t f = 0; f < is_near_.size(); ++f)
            if (is_near_[f]) divided_.changed[f] = 1;
    }

    // Joins the first kind of feature that there is. False if nothing is near any more.
    bool pass() {
        collect();
        if (join_vertices()) return true;
        const NearItems near_vertices(vertex_boxes());
        return split_edges(edges_at_vertices(near_vertices)) || split_facets(near_vertices);
    }
    double largest_move() const { return largest_move_; }

 private:
    const Vec3& at(std::int32_t vertex) const { return divided_.points.all()[vertex]; }
    Box box_of(const UndirectedEdge& edge) const {
        Box box(at(edge[0]));
        return box.extend(at(edge[1]));
    }
    std::vector<Box> vertex_boxes() const {
        std::vector<Box> boxes;
        for (const std::int32_t v : vertices_) boxes.emplace_back(at(v));
        return boxes;
    }
    void collect();
    bool join_vertices();
    std::vector<EdgeSplit> edges_at_vertices(const NearItems& near_vertices) const;
    bool split_edges(std::vector<EdgeSplit> splits);
    bool split_facets(const NearItems& near_vertices);
    void replace(std::vector<FacetPiece>& pieces, const std::vector<char>& is_divided);

    DividedFacets& divided_;
    std::vector<char> is_near_;
    const double tolerance_;
    const std::size_t given_;
    double largest_move_ = 0;
    std::vector<std::int32_t> vertices_;  // of the near facets, ascending
    std::vector<UndirectedEdge> edges_;   // of the near facets, ascending
};

void NearFeatures::collect() {
    vertices_.clear();
    edges_.clear();
    for (std::size_t f = 0; f < is_near_.size(); ++f) {
        if (!is_near_[f]) continue;
        const Triangle& t = divided_.facets[f];
        for (int i = 0; i < 3; ++i) {
            vertices_.push_back(t[i]);
            edges_.push_back(undirected(t[i], t[(i + 1) % 3]));
        }
    }
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
}

bool NearFeatures::join_vertices() {
    const std::vector<Box> boxes = vertex_boxes();
    const NearItems near_vertices(boxes);
    UnionFind joined(vertices_.size());
    for (std::int32_t i = 0; i < count_of(vertices_); ++i)
        near_vertices.visit(boxes[i], tolerance_, [&](std::int32_t j) {
            if ((at(vertices_[i]) - at(vertices_[j])).norm() <= tolerance_) joined.join(i, j);
        });
    std::vector<std::int32_t> becomes(divided_.points.all().size());
    for (std::int32_t v = 0; v < count_of(becomes); ++v) becomes[v] = v;
    bool is_any = false;
    for (std::int32_t i = 0; i < count_of(vertices_); ++i) {
        const std::int32_t v = vertices_[i], to = vertices_[joined.root(i)];
        if (v == to) continue;
        becomes[v] = to;
        is_any = true;
        if (static_cast<std::size_t>(v) < given_) largest_move_ = std::max(largest_move_, (at(v) - at(to)).norm());
    }
    if (!is_any) return false;
    std::vector<FacetPiece> pieces;
    std::vector<char> is_divided(divided_.facets.size(), 0);
    for (std::int32_t f = 0; f < count_of(divided_.facets); ++f) {
        Triangle t = divided_.facets[f];
        for (std::int32_t& v : t) v = becomes[v];
        if (t == divided_.facets[f]) continue;
        is_divided[f] = 1;
        pieces.push_back({f, t});
    }
    replace(pieces, is_divided);
    return true;
}

// Returns at most one vertex for each edge: the one nearest to its first end.
std::vector<EdgeSplit> NearFeatures::edges_at_vertices(const NearItems& near_vertices) const {
    std::vector<EdgeSplit> splits;
    for (const UndirectedEdge& edge : edges_) {
        const Vec3 &a = at(edge[0]), &b = at(edge[1]);
        std::pair<double, std::int32_t> first = {INFINITY, -1};
        near_vertices.visit(box_of(edge), tolerance_, [&](std::int32_t item) {
            const std::int32_t v = vertices_[item];
            if (v == edge[0] || v == edge[1] || (closest_on_segment(at(v), a, b) - at(v)).norm() > tolerance_) return;
            first = std::min(first, {(at(v) - a).norm(), v});
        });
        if (first.second >= 0) splits.push_back({edge, first.second});
    }
    return splits;
}

// Divides all facets at their edges: one such edge gives two pieces, three give four.
bool NearFeatures::split_edges(std::vector<EdgeSplit> splits) {
    if (splits.empty()) return false;
    std::sort(splits.begin(), splits.end());
    std::vector<char> is_end(divided_.points.all().size(), 0);
    for (const EdgeSplit& split : splits)
        for (const std::int32_t v : split.edge) is_end[v] = 1;
    std::vector<FacetPiece> pieces;
    std::vector<char> is_divided(divided_.facets.size(), 0);
    for (std::int32_t f = 0; f < count_of(divided_.facets); ++f) {
        const Triangle t = divided_.facets[f];
        if (is_end[t[0]] + is_end[t[1]] + is_end[t[2]] < 2) continue;
        std::vector<Triangle> parts = {t};
        for (int i = 0; i < 3; ++i) {
            const EdgeSplit wanted = {undirected(t[i], t[(i + 1) % 3]), -1};
            const auto split = std::lower_bound(splits.begin(), splits.end(), wanted);
            if (split == splits.end() || split->edge != wanted.edge) continue;
            for (std::size_t k = 0; k < parts.size(); ++k) {
                const auto corner = std::find(parts[k].begin(), parts[k].end(), t[i]) - parts[k].begin();
                if (corner == 3 || parts[k][(corner + 1) % 3] != t[(i + 1) % 3]) continue;
                Triangle second = parts[k];
                parts[k][(corner + 1) % 3] = second[corner] = split->vertex;
                parts.push_back(second);
                break;
            }
        }
        if (parts.size() == 1) continue;
        is_divided[f] = 1;
        for (const Triangle& part : parts) pieces.push_back({f, part});
    }
    replace(pieces, is_divided);
    return true;
}

bool NearFeatures::split_facets(const NearItems& near_vertices) {
    std::vector<FacetPiece> pieces;
    std::vector<char> is_divided(divided_.facets.size(), 0);
    for (std::int32_t f = 0; f < count_of(divided_.facets); ++f) {
        if (!is_near_[f]) continue;
        const Triangle& t = divided_.facets[f];
        const Corners p = divided_.corners(t);
        std::int32_t least = -1;
        near_vertices.visit(box_around(p), tolerance_, [&](std::int32_t item) {
            const std::int32_t v = vertices_[item];
            if (std::find(t.begin(), t.end(), v) != t.end() || (least >= 0 && least < v)) return;
            if (point_triangle_distance(at(v), p[0], p[1], p[2]) <= tolerance_) least = v;
        });
        if (least < 0) continue;
        is_divided[f] = 1;
        for (int i = 0; i < 3; ++i) pieces.push_back({f, {t[i], t[(i + 1) % 3], least}});
    }
    if (pieces.empty()) return false;
    replace(pieces, is_divided);
    return true;
}

// Puts pieces into place; they are as near as the facet that they are of.
void NearFeatures::replace(std::vector<FacetPiece>& pieces, const std::vector<char>& is_divided) {
    std::vector<char> is_near;
    std::stable_sort(pieces.begin(), pieces.end(),
                     [](const FacetPiece& a, const FacetPiece& b) { return a.facet < b.facet; });
    auto piece = pieces.begin();
    for (std::int32_t f = 0; f < count_of(is_near_); ++f) {
        if (!is_divided[f]) is_near.push_back(is_near_[f]);
        for (; piece != pieces.end() && piece->facet == f; ++piece)
            if (divided_.has_area(piece->corners)) is_near.push_back(is_near_[f]);
    }
    divided_.replace(pieces, is_divided);
    is_near_ = std::move(is_near);
}

}  // namespace

double join_near_features(DividedFacets& divided, std::vector<char> is_near, double tolerance, std::size_t given,
                          const std::function<void()>& check_cancelled) {
    NearFeatures near(divided, std::move(is_near), tolerance, given);
    for (int passes = 0; passes < most_passes && near.pass(); ++passes) check_cancelled();
    return near.largest_move();
}

}  // namespace kerf

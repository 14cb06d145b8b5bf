// Facets that share an edge must have the same points on it, though each plane of facets is divided by itself. All
// points on edges are sorted by edge and by distance from the smaller end. Each facet compares that list with its own
// points: points that it lacks lie between two vertices that follow each other on its edge, and every piece with both
// of these is divided there. A facet that was whole becomes a piece first. So an edge ends up with one chain of points
// in all of its facets, whichever of them was divided, and a surface that was closed stays closed.
#include "surface/arrange/inside/divided_facets.h"

#include <algorithm>
#include <span>

#include "base/core/elements.h"
#include "base/core/ids.h"

namespace kerf {

namespace {

bool is_before(const FacetPiece& a, const FacetPiece& b) { return a.facet < b.facet; }

// Puts points between two vertices that follow each other on an edge, in all pieces with both.
void split_between(std::int32_t from, std::int32_t to, std::span<const std::int32_t> vertices,
                   std::vector<FacetPiece>& pieces) {
    const std::size_t count = pieces.size();
    for (std::size_t k = 0; k < count; ++k)
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3;
            const bool is_along = pieces[k].corners[i] == from && pieces[k].corners[j] == to;
            if (!is_along && (pieces[k].corners[i] != to || pieces[k].corners[j] != from)) continue;
            FacetPiece rest = pieces[k];
            const int start = is_along ? i : j, end = is_along ? j : i;
            for (std::size_t n = 0; n < vertices.size(); ++n) {
                FacetPiece& part = n == 0 ? pieces[k] : pieces.emplace_back(rest);
                part.corners[end] = rest.corners[start] = vertices[n];
            }
            pieces.push_back(rest);
            break;
        }
}

// Brings the points that all facets have on an edge, ascending along it, into the pieces of one facet.
void share_points_of(std::span<const PointOnEdge> on_edge, std::int32_t facet, std::vector<FacetPiece>& pieces) {
    std::int32_t last = on_edge[0].edge[0];
    std::vector<std::int32_t> missing;
    const auto close = [&](std::int32_t next) {
        if (!missing.empty()) split_between(last, next, missing, pieces);
        missing.clear();
        last = next;
    };
    for (std::size_t i = 0; i < on_edge.size();) {
        const std::int32_t vertex = on_edge[i].vertex;
        bool has = false;
        for (; i < on_edge.size() && on_edge[i].vertex == vertex; ++i) has = has || on_edge[i].facet == facet;
        if (has)
            close(vertex);
        else
            missing.push_back(vertex);
    }
    close(on_edge[0].edge[1]);
}

}  // namespace

DistinctPoints::DistinctPoints(std::vector<Vec3> points) : points_(std::move(points)), table_(points_.size()) {
    for (std::int32_t i = 0; i < count_of(points_); ++i) table_.enter(i, hash_of_point(points_[i]), points_);
}

std::int32_t DistinctPoints::number_of(const Vec3& p) {
    const auto next = count_of(points_);
    points_.push_back(p);
    const std::int32_t number = table_.enter(next, hash_of_point(p), points_);
    if (number != next) points_.pop_back();
    return number;
}

void DividedFacets::share_points(std::vector<FacetPiece>& pieces, std::vector<char>& is_divided,
                                 std::vector<PointOnEdge>& on_edges) const {
    if (on_edges.empty()) return;
    std::sort(on_edges.begin(), on_edges.end());
    std::stable_sort(pieces.begin(), pieces.end(), is_before);
    std::vector<char> is_end(points.all().size(), 0);
    for (const PointOnEdge& point : on_edges)
        for (const std::int32_t v : point.edge) is_end[v] = 1;
    std::vector<FacetPiece> shared, own;
    auto piece = pieces.begin();
    for (std::int32_t facet = 0; facet < count_of(facets); ++facet) {
        const Triangle& t = facets[facet];
        own.clear();
        for (; piece != pieces.end() && piece->facet == facet; ++piece) own.push_back(*piece);
        for (int i = 0; i < 3; ++i) {
            if (!is_end[t[i]] || !is_end[t[(i + 1) % 3]]) continue;
            const auto of_edge = std::equal_range(
                on_edges.begin(), on_edges.end(), PointOnEdge{undirected(t[i], t[(i + 1) % 3]), 0, 0, 0},
                [](const PointOnEdge& a, const PointOnEdge& b) { return a.edge < b.edge; });
            if (of_edge.first == of_edge.second) continue;
            if (!is_divided[facet]) own.push_back({facet, t});
            is_divided[facet] = 1;
            share_points_of({of_edge.first, of_edge.second}, facet, own);
        }
        shared.insert(shared.end(), own.begin(), own.end());
    }
    pieces = std::move(shared);
}

bool DividedFacets::has_area(const Triangle& t) const {
    return !has_repeated_vertex(t) && axis_across(corners(t)) >= 0;
}

void DividedFacets::replace(std::vector<FacetPiece>& pieces, const std::vector<char>& is_divided) {
    std::stable_sort(pieces.begin(), pieces.end(), is_before);
    DividedFacets next{DistinctPoints({})};
    const auto add = [&](const Triangle& t, std::size_t of, char is_changed) {
        next.facets.push_back(t);
        next.parent.push_back(parent[of]);
        next.changed.push_back(is_changed);
    };
    auto piece = pieces.begin();
    for (std::int32_t f = 0; f < count_of(facets); ++f) {
        if (!is_divided[f]) add(facets[f], f, changed[f]);
        for (; piece != pieces.end() && piece->facet == f; ++piece)
            if (has_area(piece->corners)) add(piece->corners, f, 1);
    }
    facets = std::move(next.facets);
    parent = std::move(next.parent);
    changed = std::move(next.changed);
}

}  // namespace kerf

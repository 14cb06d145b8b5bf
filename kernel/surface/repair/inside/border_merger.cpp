// Vertices of the border are merged greedily, pair by pair in the order of their distances, of which each vertex has
// its 16 nearest. `representative` names the vertex in whose place each is, called its root; vertices with one root are
// a ring by `next_`, so that a walk around it finds all facets of the root. Each pair is judged on the facets as they
// are by then: fits_together() counts the facets that edges would have, may_move() compares normals before and after.
// Nothing is taken back here.
//
// `reach_` adds up the moves that have led to a vertex, so that a chain of mergings stays within the bound.
// undo_useless() comes later, when facets have been divided as well: it keeps only mergings by which facets share an
// edge, because others would pinch the surface at a vertex.
#include "surface/repair/inside/border_merger.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "base/core/ids.h"
#include "base/geometry/box_tree.h"
#include "base/geometry/triangle.h"
#include "base/geometry/union_find.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

constexpr std::size_t most_near_vertices = 16;  // tried for each vertex, the nearest
constexpr double least_side_cosine = 0.2;       // between the normals of a facet before and after

class BorderMerger {
 public:
    BorderMerger(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets, const Border& border,
                 double tolerance, double bound, std::vector<double>& reach)
        : vertices_(vertices), facets_(facets), border_(border), tolerance_(tolerance), bound_(bound), reach_(reach) {
        merging_.representative.resize(vertices.size());
        std::iota(merging_.representative.begin(), merging_.representative.end(), 0);
        next_ = merging_.representative;
    }

    BorderMerging run() {
        for (const VertexPair& pair : find_pairs()) try_pair(pair);
        return std::move(merging_);
    }

 private:
    struct Edge {
        std::int32_t other;                   // representative of its far end
        std::array<std::int32_t, 2> of = {};  // number of facets that have it from each of the two vertices

        bool is_good() const { return of[0] == 0 || of[1] == 0 || of[0] + of[1] == 2; }
    };

    std::int32_t root(std::int32_t v) const { return merging_.representative[v]; }
    std::vector<VertexPair> find_pairs() const;
    void try_pair(const VertexPair& pair);
    template <class Visit>
    void for_each_facet(std::int32_t root, Visit visit) const {  // all facets in the place of the root
        std::int32_t v = root;
        do {
            for (const std::int32_t f : border_.facets_at(v)) visit(f);
            v = next_[v];
        } while (v != root);
    }
    Triangle with_roots(std::int32_t f) const {
        const auto [a, b, c] = facets_[f];
        return {root(a), root(b), root(c)};
    }
    bool fits_together(std::int32_t a, std::int32_t b) const;
    bool may_move(std::int32_t from, std::int32_t to) const;
    void merge(std::int32_t gone, std::int32_t stays);

    const std::vector<Vec3>& vertices_;
    const std::vector<Triangle>& facets_;
    const Border& border_;
    double tolerance_, bound_;
    std::vector<double>& reach_;
    std::vector<std::int32_t> next_;  // the next of a ring of vertices with one root
    BorderMerging merging_;
};

// Returns the pairs to be tried, ascending by distance.
std::vector<VertexPair> BorderMerger::find_pairs() const {
    const std::vector<std::int32_t>& all = border_.vertices();
    std::vector<VertexPair> pairs;
    if (all.empty()) return pairs;
    std::vector<Box> boxes;
    for (const std::int32_t v : all) boxes.emplace_back(vertices_[v]);
    const BoxTree tree(std::move(boxes));
    std::vector<VertexPair> own;
    const auto is_nearer = [](const VertexPair& p, const VertexPair& q) {
        return std::tie(p.apart, p.stays, p.gone) < std::tie(q.apart, q.stays, q.gone);
    };
    for (const std::int32_t v : all) {
        own.clear();
        const Vec3 reach = Vec3::Constant(tolerance_);
        tree.for_each_meeting(Box(vertices_[v] - reach, vertices_[v] + reach), [&](std::int32_t i) {
            const double apart = (vertices_[all[i]] - vertices_[v]).norm();
            if (all[i] != v && apart <= tolerance_) own.push_back({std::max(v, all[i]), std::min(v, all[i]), apart});
        });
        std::sort(own.begin(), own.end(), is_nearer);
        if (own.size() > most_near_vertices) own.resize(most_near_vertices);
        pairs.insert(pairs.end(), own.begin(), own.end());
    }
    std::sort(pairs.begin(), pairs.end(), is_nearer);
    const auto is_same = [](const VertexPair& p, const VertexPair& q) {
        return p.gone == q.gone && p.stays == q.stays;
    };
    pairs.erase(std::unique(pairs.begin(), pairs.end(), is_same), pairs.end());
    return pairs;
}

void BorderMerger::try_pair(const VertexPair& pair) {
    const std::int32_t a = root(pair.stays), b = root(pair.gone);
    if (a == b) return;
    const double apart = (vertices_[a] - vertices_[b]).norm();
    if (apart > tolerance_) return;
    bool is_adjacent = false;
    for_each_facet(a, [&](std::int32_t f) {
        const Triangle t = with_roots(f);
        is_adjacent |= std::find(t.begin(), t.end(), b) != t.end();
    });
    if (is_adjacent) return;
    const double limit = least_arc_ratio * pair.apart;
    if (border_.length_between(pair.stays, pair.gone, limit) < limit) return;
    const std::int32_t low = std::min(a, b), high = std::max(a, b);
    const bool fits = fits_together(a, b);
    if (fits && may_move(high, low))
        merge(high, low);
    else if (fits && may_move(low, high))
        merge(low, high);
    else
        merging_.refused.push_back({high, low, apart});
}

// Whether no edge gets more than two facets, and no two facets get the same vertices.
bool BorderMerger::fits_together(std::int32_t a, std::int32_t b) const {
    std::vector<Edge> edges;
    std::vector<UndirectedEdge> opposite;
    const auto count = [&](std::int32_t other) -> Edge& {
        const auto found = std::find_if(edges.begin(), edges.end(), [&](const Edge& e) { return e.other == other; });
        return found != edges.end() ? *found : edges.emplace_back(Edge{other});
    };
    for (const std::int32_t end : {a, b})
        for_each_facet(end, [&](std::int32_t f) {
            UndirectedEdge ends;
            std::size_t i = 0;
            for (const std::int32_t v : with_roots(f))
                if (v != end && i < 2) ++count(ends[i++] = v).of[end == b];
            if (i == 2) opposite.push_back(undirected(ends[0], ends[1]));
        });
    std::sort(opposite.begin(), opposite.end());
    return std::all_of(edges.begin(), edges.end(), [](const Edge& e) { return e.is_good(); }) &&
           std::adjacent_find(opposite.begin(), opposite.end()) == opposite.end();
}

bool BorderMerger::may_move(std::int32_t from, std::int32_t to) const {
    if (reach_[from] + (vertices_[from] - vertices_[to]).norm() > bound_) return false;
    bool keeps = true;
    for_each_facet(from, [&](std::int32_t f) {
        std::array<Vec3, 3> before, now;
        const Triangle t = with_roots(f);
        for (std::size_t i = 0; i < 3; ++i) {
            before[i] = vertices_[facets_[f][i]];
            now[i] = vertices_[t[i] == from ? to : t[i]];
        }
        keeps &= keeps_side(before, now);
    });
    return keeps;
}

void BorderMerger::merge(std::int32_t gone, std::int32_t stays) {
    const double apart = (vertices_[gone] - vertices_[stays]).norm();
    std::int32_t v = gone;
    do {
        merging_.representative[v] = stays;
        v = next_[v];
    } while (v != gone);
    std::swap(next_[gone], next_[stays]);
    reach_[stays] = std::max(reach_[stays], reach_[gone] + apart);
    merging_.merged.push_back({gone, stays, apart});
}

// Returns the vertex of the facet that `vertex` stands for; the vertex itself where the facet was divided at it.
std::int32_t origin_of(std::int32_t vertex, const Triangle& before, const std::vector<std::int32_t>& representative) {
    for (const std::int32_t v : before)
        if (representative[v] == vertex) return v;
    return vertex;
}

}  // namespace

void undo_useless(const std::vector<Triangle>& before, const std::vector<std::int32_t>& parent, BorderMerging& merging,
                  std::vector<Triangle>& now) {
    if (merging.merged.empty()) return;
    const std::vector<std::int32_t>& representative = merging.representative;
    const auto old = [&](std::int32_t f) -> const Triangle& { return before[parent.empty() ? f : parent[f]]; };
    UnionFind used(representative.size());
    EdgeCorners(now).for_each_edge([&](std::int32_t low, std::span<const EdgeCorners::Corner> corners) {
        for (const std::int32_t end : {low, corners[0].high})
            for (const EdgeCorners::Corner& c : corners)
                used.join(origin_of(end, old(corners[0].corner / 3), representative),
                          origin_of(end, old(c.corner / 3), representative));
    });
    std::vector<char> is_undone(representative.size(), 0);
    for (std::int32_t v = 0; v < count_of(representative); ++v)
        is_undone[v] = used.root(v) != used.root(representative[v]);
    for (std::int32_t f = 0; f < count_of(now); ++f)
        for (std::int32_t& v : now[f])
            if (const std::int32_t origin = origin_of(v, old(f), representative); is_undone[origin]) v = origin;
    std::erase_if(merging.merged, [&](const VertexPair& pair) { return is_undone[pair.gone] != 0; });
}

bool keeps_side(const std::array<Vec3, 3>& before, const std::array<Vec3, 3>& now) {
    const Vec3 old_area = doubled_area_vector(before), area = doubled_area_vector(now);
    return old_area.squaredNorm() == 0 || area.dot(old_area) > least_side_cosine * area.norm() * old_area.norm();
}

BorderMerging merge_border(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets, const Border& border,
                           double tolerance, double bound, std::vector<double>& reach) {
    return BorderMerger(vertices, facets, border, tolerance, bound, reach).run();
}

}  // namespace kerf

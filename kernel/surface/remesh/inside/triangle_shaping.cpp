// First the surface is made simple, then it is given sizes, then triangles are shaped to them. Flat regions are made
// Delaunay by Lawson's flips (Lawson 1977, lawson1977); features nearer than the bound are merged, before the surface
// is divided if it has narrow strips, as a border across one may leave all of it; all that the bound does not need is
// collapsed, with a part of the tolerance only, so that room is left; then flat regions are found anew and sizes found,
// once, because sizes read from a surface that changes would chase each other. Each pass then splits, smooths,
// collapses and flips. An edge is long or short by its ratio to its wanted length. `split_ratio` and `collapse_ratio`
// are so far apart that no half of an edge that is split is collapsed again. Splits take the longest ratio first, but
// split the longest edge of its facet, and of the facet beyond, and so on (Rivara 1997, rivara1997), which makes no
// needles. Refusals are remembered with the number of the last operation: a refused element is not tried again until
// something around it has changed.
#include "surface/remesh/inside/triangle_shaping.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "base/core/ids.h"
#include "surface/remesh/inside/blocks.h"
#include "surface/remesh/inside/feature_merging.h"
#include "surface/remesh/inside/fold_sizes.h"

namespace kerf {

namespace {

using Vertex = BoundedSurface::Vertex;
using Edge = BoundedSurface::Edge;
using HalfEdge = BoundedSurface::HalfEdge;
using Facet = BoundedSurface::Facet;

// Edges over their wanted length. A half of one that is split must not be one that is collapsed.
constexpr double split_ratio = 1.35, collapse_ratio = 0.6;
constexpr double coarse_ratio = 6;                // longer edges are split before the surface is divided into blocks
constexpr double share_of_first_division = 0.85;  // of the time of all
// Facets of a block: the least that are worth one. Blocks beside borders are long and narrow, and have little border.
constexpr double least_block = 8e3, least_block_beside_borders = 2e3;
constexpr double least_move = 0.03;     // of the size at a vertex
constexpr double sine_of_good = 0.682;  // of 43 degrees: facets that need no move
constexpr double sine_of_20 = 0.342, sine_of_10 = 0.1736;
constexpr int most_simplifications = 6, passes = 3, passes_beside_borders = 2, last_passes = 1, smoothings = 2,
              flips = 4;
// Shares of the tolerance: early operations, and flatness, leave room for later ones.
constexpr double share_of_merging = 0.8, share_of_simplification = 0.4, share_of_flatness = 0.2;
// Lower bounds of the sizes that folds ask for.
constexpr double shortest_over_deviation = 1.5, shortest_over_longest = 0.005;
constexpr std::int64_t steps_between_checks = 256;

// Remembers refusals: an operation that was refused is refused again as long as nothing around has changed.
class Refusals {
 public:
    bool knows(int element, std::int64_t last_change) const {
        return element < count_of(changes_) && last_change <= changes_[element];
    }
    void note(int element, std::int64_t changes) {
        if (element >= count_of(changes_)) changes_.resize(element + 1, -1);
        changes_[element] = changes;
    }
    void clear() { changes_.clear(); }

 private:
    std::vector<std::int64_t> changes_;  // how many there had been, by element
};

class Shaping {
 public:
    /// Keeps the references; `sizes` may be null until they are known.
    Shaping(BoundedSurface& surface, const RemeshOptions& options, const FoldSizes* sizes)
        : surface_(surface), options_(options), sizes_(sizes) {}

    void merge_near_features() {
        flip_flat_edges();
        surface_.set_share(share_of_merging);
        merge_features(surface_, [this] { check_cancelled(); });
    }

    // Leaves out what the bound does not need.
    void simplify_all() {
        merge_near_features();
        surface_.set_share(share_of_simplification);
        simplify();
    }

    // Lawson's flips within flat regions.
    void flip_flat_edges() {
        std::vector<Edge> open;
        for (const auto e : mesh().edges()) open.push_back(e);
        std::reverse(open.begin(), open.end());
        legalise(open, 20 * open.size());
    }

    // Splits the edges that are longer, over their wanted length, than most(edge).
    template <class Most>
    void split_edges(const Most& most) {
        struct Entry {
            double ratio;
            Edge edge;
            bool operator<(const Entry& other) const {
                return std::pair(ratio, -edge.idx()) < std::pair(other.ratio, -other.edge.idx());
            }
        };
        std::priority_queue<Entry> open;
        const auto add = [&](Edge e) {
            if (const double r = ratio(e); r > split_ratio && r > most(e)) open.push({r, e});
        };
        for (const auto e : mesh().edges()) add(e);
        while (!open.empty()) {
            check_cancelled();
            const auto [r, wanted] = open.top();
            open.pop();
            if (ratio(wanted) != r) continue;
            const Edge e = longest_around(wanted);
            if (mesh().is_fixed(e)) continue;
            const Vertex v = split(e);
            mesh().for_each_copy(v, [&](Vertex copy) {
                for (const auto h : mesh().voh_range(copy)) {
                    add(h.edge());
                    if (!h.is_boundary()) add(h.next().edge());
                }
            });
            if (e != wanted) add(wanted);
        }
    }

    // Gives triangles the wanted sizes and a good shape.
    void shape(int most_passes) {
        for (int pass = 0; pass < most_passes; ++pass) {
            split_edges([](Edge) { return split_ratio; });
            smooth();
            collapse_short_edges();
            flip_edges();
        }
        for (int pass = 0; pass < last_passes; ++pass) {
            smooth();
            flip_edges();
            mend_needles();
        }
    }

 private:
    const SheetMesh& mesh() const { return surface_.mesh(); }

    // Cheap: called for every edge or vertex.
    void check_cancelled() {
        if (options_.check_cancelled && ++steps_ % steps_between_checks == 0) options_.check_cancelled();
    }

    double target(Edge e) const {
        const auto [a, b] = mesh().ends(e);
        return std::min(std::max(mesh().data(a).asked, mesh().data(b).asked),
                        std::min(mesh().size(a), mesh().size(b)) + options_.growth * mesh().calc_edge_length(e) / 3);
    }
    double ratio(Edge e) const { return mesh().calc_edge_length(e) / target(e); }
    bool is_alive(Edge e) const { return !mesh().status(e).deleted(); }

    void legalise(std::vector<Edge>& open, std::size_t limit) {
        for (std::size_t steps = 0; !open.empty() && steps < limit; ++steps) {
            const Edge e = open.back();
            open.pop_back();
            if (!is_alive(e) || !mesh().is_flat(e) || !surface_.make_delaunay(e)) continue;
            for (const int side : {0, 1}) {
                const HalfEdge h = mesh().halfedge_handle(e, side);
                open.push_back(mesh().edge_handle(mesh().next_halfedge_handle(h)));
                open.push_back(mesh().edge_handle(mesh().prev_halfedge_handle(h)));
            }
        }
        open.clear();
    }

    // Edges by length, shortest first.
    template <class Wanted>
    std::vector<std::pair<double, Edge>> edges_by_length(Wanted is_wanted) const {
        std::vector<std::pair<double, Edge>> edges;
        for (const auto e : mesh().edges())
            if (const double length = mesh().calc_edge_length(e); is_wanted(e, length)) edges.emplace_back(length, e);
        std::sort(edges.begin(), edges.end());
        return edges;
    }

    std::int64_t last_change_around(Edge e) const {
        const auto [a, b] = mesh().ends(e);
        return std::max(mesh().last_change(a), mesh().last_change(b));
    }

    // Collapses all edges that the bound does not need.
    void simplify() {
        const BoundedSurface::CollapseRules rules = {.good_sine = sine_of_20, .worst_share = 0.9};
        Refusals refused;
        for (int pass = 0; pass < most_simplifications; ++pass) {
            std::size_t collapsed = 0;
            for (const auto& [length, e] :
                 edges_by_length([&](Edge, double length) { return length < 0.8 * options_.longest; })) {
                check_cancelled();
                if (!is_alive(e) || refused.knows(e.idx(), last_change_around(e))) continue;
                if (surface_.collapse_either_way(e, rules))
                    ++collapsed;
                else
                    refused.note(e.idx(), surface_.changes());
            }
            flip_edges();
            if (collapsed * 100 < mesh().n_faces()) break;
        }
    }

    void collapse_short_edges() {
        const BoundedSurface::CollapseRules rules = {.good_sine = sine_of_20, .longest = split_ratio};
        for (const auto& [length, e] : edges_by_length([&](Edge e, double) { return ratio(e) < collapse_ratio; })) {
            check_cancelled();
            if (!is_alive(e) || !(ratio(e) < collapse_ratio)) continue;
            if (refused_collapses_.knows(e.idx(), last_change_around(e))) continue;
            if (!surface_.collapse_either_way(e, rules)) refused_collapses_.note(e.idx(), surface_.changes());
        }
    }

    Vertex split(Edge e) {
        const auto [a, b] = mesh().ends(e);
        WantedLength size = mesh().data(mesh().size(b) < mesh().size(a) ? b : a).wanted;
        const double half = mesh().calc_edge_length(e) / 2;
        const auto is_narrow = [&](Vertex end) { return mesh().data(end).wanted.rule >= LengthRule::features; };
        const bool is_last = half < split_ratio * size.length && !is_narrow(a) &&
                             !is_narrow(b);  // what lies between the ends has been asked at them
        size.length += options_.growth * half;
        const std::int32_t fold = mesh().data(e).fold;
        const Vertex v = surface_.split(e, 0.5);
        const double asked = sizes_->asked(mesh(), v);
        size.shorten(asked, LengthRule::asked);
        surface_.set_size(v, is_last ? size : sizes_->of_new(mesh(), v, fold, size), asked);
        mesh().for_each_copy(v, [&](Vertex copy) {
            for (const auto h : mesh().voh_range(copy))
                if (!h.is_boundary()) around_.push_back(h.next().edge());
            legalise(around_, 200);
        });
        return v;
    }

    // The end of the way over ever longer edges of facets: halves of a longest edge have no needles (Rivara 1997).
    Edge longest_around(Edge e) const {
        for (bool goes_on = true; goes_on;) {
            goes_on = false;
            const Edge start = e;
            mesh().for_each_copy(start, [&](Edge copy) {
                for (const int side : {0, 1}) {
                    const HalfEdge h = mesh().halfedge_handle(copy, side);
                    if (goes_on || mesh().is_boundary(h)) continue;
                    for (const Edge other : {mesh().edge_handle(mesh().next_halfedge_handle(h)),
                                             mesh().edge_handle(mesh().prev_halfedge_handle(h))})
                        if (mesh().calc_edge_length(other) > mesh().calc_edge_length(e) * (1 + 1e-9)) {
                            e = other;
                            goes_on = true;
                        }
                }
            });
        }
        return e;
    }

    void flip_edges() {
        for (int pass = 0; pass < flips; ++pass) {
            std::size_t flipped = 0;
            for (const auto e : mesh().edges()) {
                check_cancelled();
                if (refused_flips_.knows(e.idx(), mesh().last_change(e))) continue;
                if (surface_.flip(e))
                    ++flipped;
                else
                    refused_flips_.note(e.idx(), surface_.changes());
            }
            if (flipped * 500 < mesh().n_edges()) break;
        }
    }

    // Moves vertices towards the centres of the facets around, weighted by area over squared wanted size.
    void smooth() {
        for (int pass = 0; pass < smoothings; ++pass)
            for (const auto v : mesh().vertices()) {
                check_cancelled();
                if (!mesh().is_first_copy(v) || refused_moves_.knows(v.idx(), mesh().last_change(v))) continue;
                if (worst_around(v) > sine_of_good) continue;
                Vec3 sum = Vec3::Zero();
                double weights = 0;
                mesh().for_each_copy(v, [&](Vertex copy) {
                    for (const auto h : mesh().voh_range(copy)) {
                        if (h.is_boundary()) continue;
                        const Vec3 &b = mesh().point(h.to()), &c = mesh().point(h.next().to());
                        const Vec3 centre = (mesh().point(v) + b + c) / 3;
                        const double area = (b - mesh().point(v)).cross(c - mesh().point(v)).norm();
                        const double size = (mesh().size(v) + mesh().size(h.to()) + mesh().size(h.next().to())) / 3;
                        const double weight = area / (size * size);
                        sum += weight * centre;
                        weights += weight;
                    }
                });
                if (weights > 0 && (sum / weights - mesh().point(v)).norm() > least_move * mesh().size(v))
                    if (surface_.move(v, sum / weights, InputBound::Evidence::samples)) continue;
                refused_moves_.note(v.idx(), surface_.changes());
            }
    }

    // Returns the smallest sine of an angle of the facets around a vertex.
    double worst_around(Vertex v) const {
        double worst = 1;
        mesh().for_each_copy(v, [&](Vertex copy) {
            for (const auto f : mesh().vf_range(copy)) worst = std::min(worst, mesh().sine(f));
        });
        return worst;
    }

    // Collapses the shortest edges of facets that are still needles.
    void mend_needles() {
        const BoundedSurface::CollapseRules rules = {.good_sine = sine_of_10};
        for (const auto f : mesh().faces()) {
            if (mesh().status(f).deleted() || mesh().sine(f) > sine_of_20) continue;
            HalfEdge shortest = mesh().halfedge_handle(f);
            for (const auto h : mesh().fh_range(f))
                if (mesh().calc_edge_length(h) < mesh().calc_edge_length(shortest)) shortest = h;
            surface_.collapse_either_way(mesh().edge_handle(shortest), rules);
        }
    }

    BoundedSurface& surface_;
    const RemeshOptions& options_;
    const FoldSizes* sizes_;
    std::int64_t steps_ = 0;
    std::vector<Edge> around_;  // scratch
    Refusals refused_moves_, refused_flips_, refused_collapses_;
};

FoldSizeOptions size_options(const RemeshOptions& options) {
    return {.longest = options.longest,
            .shortest = std::max(shortest_over_deviation * options.deviation, shortest_over_longest * options.longest),
            .growth = options.growth,
            .walls = {options.edges_per_thickness, shortest_on_walls(options), options.longest},
            .wanted = options.wanted,
            .check_cancelled = CancellationCheck(options.check_cancelled)};
}

// The facets that will take the place of each, by the sizes at its corners.
std::vector<float> facets_to_come(const SheetArrays& sheets) {
    std::vector<float> counts;
    counts.reserve(sheets.corners.size());
    for (std::size_t f = 0; f < sheets.corners.size(); ++f) {
        double length = 0;
        for (const std::int32_t v : sheets.corners[f]) length += sheets.vertices[v].wanted.length / 3;
        const double area = area_normal(sheets.triangle(f)).norm() / 2;
        counts.push_back(static_cast<float>(std::max(1., area / (facet_area_per_squared_length * length * length))));
    }
    return counts;
}

// The stages of shaping on the whole surface.
class ShapingInBlocks {
 public:
    ShapingInBlocks(const InputShape& input, const RemeshOptions& options, const std::function<void(double)>& add,
                    SheetState& state)
        : input_(input), options_(options), add_(add), state_(state) {}

    void simplify() {
        if (has_narrow_strips(state_.arrays))
            change_at_once(input_, state_, [this](BoundedSurface& surface) {
                Shaping(surface, options_, nullptr).merge_near_features();
            });
        change_in_blocks([](Shaping& shaping, bool) { shaping.simplify_all(); },
                         std::vector<float>(state_.arrays.facets.size(), 1));
    }

    void shape() {
        find_regions(input_, share_of_flatness, state_);
        change_at_once(input_, state_, [this](BoundedSurface& surface) {
            Shaping(surface, options_, nullptr).flip_flat_edges();
            sizes_.emplace(surface, size_options(options_));
            Shaping(surface, options_, &*sizes_).split_edges([](Edge) { return coarse_ratio; });
        });
        change_in_blocks(
            [](Shaping& shaping, bool is_beside_borders) {
                shaping.shape(is_beside_borders ? passes_beside_borders : passes);
            },
            facets_to_come(state_.arrays));
    }

 private:
    // All facets that may change first, then those beside the borders of blocks. What is left then, where borders of
    // both meet, is in pieces that have nothing in common.
    void change_in_blocks(const std::function<void(Shaping&, bool)>& change, const std::vector<float>& weights) {
        std::vector<char> may_change;
        for (const SheetFacet& facet : state_.arrays.facets) may_change.push_back(facet.is_kept ? 0 : 1);
        const std::int32_t blocks = divide_along_curve(state_, may_change, weights, least_block, false);
        if (sizes_ && blocks > 1) split_borders();
        change_blocks(input_, state_, [&](BoundedSurface& surface) {
            change_block(surface, change, false);
            add_(share_of_first_division / blocks);
        });
        const auto change_strips = [&](BoundedSurface& surface) { change_block(surface, change, true); };
        if (const std::vector<char> chosen = facets_beside_borders(state_); has_any(chosen)) {
            divide_along_curve(state_, chosen, std::vector<float>(chosen.size(), 1), least_block_beside_borders, true);
            change_blocks(input_, state_, change_strips);
        }
        if (const std::vector<char> chosen = facets_beside_borders(state_); has_any(chosen)) {
            divide_by_components(state_, chosen, static_cast<std::int32_t>(least_block_beside_borders));
            change_blocks(input_, state_, change_strips);
        }
    }

    void change_block(BoundedSurface& surface, const std::function<void(Shaping&, bool)>& change,
                      bool is_beside_borders) const {
        Shaping shaping(surface, options_, sizes_ ? &*sizes_ : nullptr);
        change(shaping, is_beside_borders);
    }

    static bool has_any(const std::vector<char>& chosen) {
        return std::find(chosen.begin(), chosen.end(), char{1}) != chosen.end();
    }

    // What blocks have in common stays as it is while they are shaped: its edges get their lengths before.
    void split_borders() {
        change_at_once(input_, state_, [this](BoundedSurface& surface) {
            const SheetMesh& mesh = surface.mesh();
            const auto most = [&](Edge e) {
                const std::int32_t block = mesh.data(mesh.facets_at(e)[0]).block;
                bool is_border = false;
                mesh.for_each_copy(e, [&](Edge copy) {
                    for (const Facet f : mesh.facets_at(copy)) is_border |= mesh.data(f).block != block;
                });
                return is_border ? split_ratio : std::numeric_limits<double>::infinity();
            };
            Shaping(surface, options_, &*sizes_).split_edges(most);
        });
    }

    const InputShape& input_;
    const RemeshOptions& options_;
    const std::function<void(double)>& add_;
    SheetState& state_;
    std::optional<FoldSizes> sizes_;
};

}  // namespace

SheetState simplify(const InputShape& input, const std::vector<char>& kept, const RemeshOptions& options,
                    const std::function<void(double)>& add) {
    SheetState state = sheet_state(input, kept);
    change_apart_from_kept(state, [&](SheetState& near) { ShapingInBlocks(input, options, add, near).simplify(); });
    return state;
}

void shape_triangles(const InputShape& input, const RemeshOptions& options, const std::function<void(double)>& add,
                     SheetState& state) {
    change_apart_from_kept(state, [&](SheetState& near) { ShapingInBlocks(input, options, add, near).shape(); });
}

}  // namespace kerf

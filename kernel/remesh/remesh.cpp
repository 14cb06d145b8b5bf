#include "remesh/remesh.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "geometry/triangle.h"
#include "remesh/edited_surface.h"
#include "remesh/feature_merger.h"
#include "remesh/fold_sizes.h"
#include "remesh/inspection.h"
#include "surface/touching.h"

namespace kerf {

namespace {

// Edges over their wanted length. A half of one that is split must not be one that is collapsed.
constexpr double split_ratio = 1.35, collapse_ratio = 0.6;
constexpr double as_asked = 0.95;    // a size over that which is asked for, which counts as that
constexpr double least_move = 0.03;  // of the size at a vertex
constexpr double sine_of_20 = 0.342, sine_of_10 = 0.1736;
constexpr int most_simplifications = 6, passes = 4, last_passes = 2, smoothings = 2, flips = 4;
// Of the tolerance: what is left out first, and what counts as flat then, leaves room for what comes after.
constexpr double share_of_merging = 0.8, share_of_simplification = 0.4, share_of_flatness = 0.2;
// What folds and walls may ask for.
constexpr double shortest_over_deviation = 1.5, shortest_over_longest = 0.005, thinnest_over_deviation = 0.75;
// Points between those that operations compare with the input may be further off.
constexpr double used_share = 0.8;
constexpr int most_rounds = 5;
constexpr std::int64_t steps_between_polls = 256;
constexpr double smaller_tolerance = 0.25;         // of the tolerance, where the result of a round is refused
constexpr double area_per_squared_length = 0.342;  // of a facet, and of the length wanted there; measured

// What was refused is refused again as long as nothing around it has changed.
class Refusals {
 public:
    bool knows(int element, std::int64_t last_change) const {
        return element < static_cast<int>(changes_.size()) && last_change <= changes_[element];
    }
    void note(int element, std::int64_t changes) {
        if (element >= static_cast<int>(changes_.size())) changes_.resize(element + 1, -1);
        changes_[element] = changes;
    }
    void clear() { changes_.clear(); }

 private:
    std::vector<std::int64_t> changes_;  // how many there had been, by element
};

class Remesher {
 public:
    Remesher(const InputShape& input, const RemeshOptions& options)
        : options_(options), surface_(input, options.kept) {}

    void run() {
        flip_flat_edges();
        surface_.set_share(share_of_merging);
        merge_features(surface_, [this] { poll(); });
        surface_.set_share(share_of_simplification);
        simplify();
        surface_.set_share(1);
        surface_.find_regions(share_of_flatness);
        refused_flips_.clear();  // by another share and other numbers
        flip_flat_edges();
        sizes_.emplace(surface_, FoldSizeOptions{.longest = options_.longest,
                                                 .shortest = std::max(shortest_over_deviation * options_.deviation,
                                                                      shortest_over_longest * options_.longest),
                                                 .thinnest = thinnest_over_deviation * options_.deviation,
                                                 .growth = options_.growth,
                                                 .edges_per_thickness = options_.edges_per_thickness,
                                                 .wanted = options_.wanted});
        for (int pass = 0; pass < passes; ++pass) {
            split_long_edges();
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
    EditedSurface& surface() { return surface_; }

 private:
    using Edge = EditedSurface::Edge;
    using Vertex = EditedSurface::Vertex;
    using HalfEdge = EditedSurface::HalfEdge;
    const EditMesh& mesh() const { return surface_.mesh(); }

    // Cheap: called for every edge or vertex.
    void poll() {
        if (options_.poll && ++steps_ % steps_between_polls == 0) options_.poll();
    }

    double target(Edge e) const {
        const auto [a, b] = mesh().ends(e);
        return std::min(std::max(mesh().data(a).asked, mesh().data(b).asked),
                        std::min(mesh().size(a), mesh().size(b)) + options_.growth * mesh().calc_edge_length(e) / 3);
    }
    double ratio(Edge e) const { return mesh().calc_edge_length(e) / target(e); }
    bool is_alive(Edge e) const { return !mesh().status(e).deleted(); }

    // Lawson's flips within flat regions.
    void flip_flat_edges() {
        std::vector<Edge> open;
        for (const auto e : mesh().edges()) open.push_back(e);
        std::reverse(open.begin(), open.end());
        legalise(open, 20 * open.size());
    }

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

    // Leaves out what the bound does not need.
    void simplify() {
        const EditedSurface::CollapseRules rules = {.good_sine = sine_of_20, .worst_share = 0.9};
        Refusals refused;
        for (int pass = 0; pass < most_simplifications; ++pass) {
            std::size_t collapsed = 0;
            for (const auto& [length, e] :
                 edges_by_length([&](Edge, double length) { return length < 0.8 * options_.longest; })) {
                poll();
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
        const EditedSurface::CollapseRules rules = {.good_sine = sine_of_20, .longest = split_ratio};
        for (const auto& [length, e] : edges_by_length([&](Edge e, double) { return ratio(e) < collapse_ratio; })) {
            poll();
            if (!is_alive(e) || !(ratio(e) < collapse_ratio)) continue;
            if (refused_collapses_.knows(e.idx(), last_change_around(e))) continue;
            if (!surface_.collapse_either_way(e, rules)) refused_collapses_.note(e.idx(), surface_.changes());
        }
    }

    void split_long_edges() {
        struct Entry {
            double ratio;
            Edge edge;
            bool operator<(const Entry& other) const {
                return std::pair(ratio, -edge.idx()) < std::pair(other.ratio, -other.edge.idx());
            }
        };
        std::priority_queue<Entry> open;
        const auto add = [&](Edge e) {
            if (const double r = ratio(e); r > split_ratio) open.push({r, e});
        };
        for (const auto e : mesh().edges()) add(e);
        std::vector<Edge> around;
        while (!open.empty()) {
            poll();
            const auto [r, wanted] = open.top();
            open.pop();
            if (ratio(wanted) != r) continue;
            const Edge e = longest_around(wanted);
            if (mesh().is_fixed(e)) continue;
            const Vertex a = mesh().to_vertex_handle(mesh().halfedge_handle(e, 0));
            const Vertex b = mesh().to_vertex_handle(mesh().halfedge_handle(e, 1));
            WantedLength size = mesh().data(mesh().size(a) < mesh().size(b) ? a : b).wanted;
            size.length += options_.growth * mesh().calc_edge_length(e) / 2;
            const std::int32_t fold = mesh().data(e).fold;
            const Vertex v = surface_.split(e, 0.5);
            surface_.set_size(v, sizes_->of_new(v, fold, size), sizes_->asked(v));
            mesh().for_each_copy(v, [&](Vertex copy) {
                for (const auto h : mesh().voh_range(copy))
                    if (!h.is_boundary()) around.push_back(h.next().edge());
                legalise(around, 200);
                for (const auto h : mesh().voh_range(copy)) {
                    add(h.edge());
                    if (!h.is_boundary()) add(h.next().edge());
                }
            });
            if (e != wanted) add(wanted);
        }
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
                poll();
                if (refused_flips_.knows(e.idx(), mesh().last_change(e))) continue;
                if (surface_.flip(e))
                    ++flipped;
                else
                    refused_flips_.note(e.idx(), surface_.changes());
            }
            if (flipped * 500 < mesh().n_edges()) break;
        }
    }

    // Towards the centres of the facets around, weighted by what is wanted there.
    void smooth() {
        for (int pass = 0; pass < smoothings; ++pass)
            for (const auto v : mesh().vertices()) {
                poll();
                if (!mesh().is_first_copy(v) || refused_moves_.knows(v.idx(), mesh().last_change(v))) continue;
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
                    if (surface_.move(v, sum / weights)) continue;
                refused_moves_.note(v.idx(), surface_.changes());
            }
    }

    // Collapses the shortest edges of what is still a needle.
    void mend_needles() {
        const EditedSurface::CollapseRules rules = {.good_sine = sine_of_10};
        for (const auto f : mesh().faces()) {
            if (mesh().status(f).deleted() || mesh().sine(f) > sine_of_20) continue;
            HalfEdge shortest = mesh().halfedge_handle(f);
            for (const auto h : mesh().fh_range(f))
                if (mesh().calc_edge_length(h) < mesh().calc_edge_length(shortest)) shortest = h;
            surface_.collapse_either_way(mesh().edge_handle(shortest), rules);
        }
    }

    const RemeshOptions& options_;
    EditedSurface surface_;
    std::optional<FoldSizes> sizes_;
    std::int64_t steps_ = 0;
    Refusals refused_moves_, refused_flips_, refused_collapses_;
};

std::vector<InputPlace> places_on(const TriangleTree& input, const std::vector<Vec3>& vertices) {
    std::vector<InputPlace> places;
    places.reserve(vertices.size());
    for (const Vec3& p : vertices) {
        const TriangleTree::Closest closest = input.closest(p);
        places.push_back({closest.facet, closest.point});
    }
    return places;
}

// Of the area, where some corner has a smaller size than the user asks for there; by the one that has least of it.
FinerShares finer_shares(const EditMesh& mesh) {
    std::array<double, 4> finer{};
    double all = 0;
    for (const auto f : mesh.faces()) {
        const double area = area_normal(mesh.corners(f)).norm();
        all += area;
        double least = as_asked;
        LengthRule rule = LengthRule::asked;
        for (const auto v : mesh.fv_range(f))
            if (const double share = mesh.size(v) / mesh.data(v).asked; share < least) {
                least = share;
                rule = mesh.data(v).wanted.rule;
            }
        if (least < as_asked) finer[static_cast<std::size_t>(rule)] += area;
    }
    if (!(all > 0)) return {};
    const auto share = [&](LengthRule rule) { return finer[static_cast<std::size_t>(rule)] / all; };
    return {share(LengthRule::bound), share(LengthRule::features), share(LengthRule::walls)};
}

// With the numbers of vertices as their keys.
SurfaceArrays with_seams_joined(SurfaceArrays sheets) {
    SurfaceArrays joined = joined_by_key(std::move(sheets));
    for (std::size_t v = 0; v < joined.vertices.size(); ++v)
        joined.vertex_key[v] = make_key(0, static_cast<std::int32_t>(v));
    return joined;
}

Remeshed remesh_once(const Sheets& sheets, const TriangleTree& tree, const std::vector<double>& tolerance,
                     const RemeshOptions& options) {
    const InputShape input(sheets, tree, tolerance, options.feature_angle_deg, options.creases, options.walls);
    Remesher remesher(input, options);
    remesher.run();
    const EditMesh& mesh = remesher.surface().mesh();
    const RemeshReport report = {.feature_edges = mesh.feature_edges(), .finer = finer_shares(mesh)};
    return {with_seams_joined(remesher.surface().arrays()), {}, report};
}

void check_remesh_options(const RemeshOptions& options, std::size_t facets) {
    KERF_CHECK(options.kept.empty() || options.kept.size() == facets);
    KERF_CHECK(options.walls.empty() || options.walls.size() == facets);
    KERF_CHECK(options.deviation > 0 && options.longest > 0 && options.growth > 0 && options.feature_angle_deg > 0);
}

}  // namespace

double forecast_facets(const SurfaceArrays& surface, const RemeshOptions& options) {
    check_remesh_options(options, surface.facets.size());
    double facets = 0;
    for (std::size_t f = 0; f < surface.facets.size(); ++f) {
        if (!options.kept.empty() && options.kept[f] != 0) {
            ++facets;
            continue;
        }
        const Triangle& t = surface.facets[f];
        const std::vector<Vec3>& p = surface.vertices;
        double density = 0;  // sum over the samples
        int samples = 0;
        for_each_sample(p, t, [&](const Vec3& point) {
            const double edge =
                options.wanted ? std::min(options.wanted(point, surface.patch[f]), options.longest) : options.longest;
            density += 1 / (edge * edge);
            ++samples;
        });
        const double area = triangle_area(p, t);
        facets += area / area_per_squared_length * density / samples;
    }
    return facets;
}

Remeshed remesh(const SurfaceArrays& surface, const RemeshOptions& options) {
    check_remesh_options(options, surface.facets.size());
    const TriangleTree tree(surface.vertices, surface.facets);
    const Sheets sheets = take_apart(surface);
    std::vector<double> tolerance = tolerances_of_gaps(surface, tree, used_share * options.deviation, options.walls);
    for (int round = 1;; ++round) {
        Remeshed result = remesh_once(sheets, tree, tolerance, options);
        result.report.rounds = round;
        const std::vector<char> refused = inspect(surface, tree, options, result.surface, result.report);
        const auto count = std::count(refused.begin(), refused.end(), char{1});
        if (count == 0) {
            result.places = places_on(tree, result.surface.vertices);
            return result;
        }
        if (round == most_rounds) {
            const auto first = std::find(refused.begin(), refused.end(), char{1}) - refused.begin();
            const Vec3& place = surface.vertices[surface.facets[first][0]];
            throw Error(ErrorCode::input,
                        fmt::format("The surface cannot be remeshed within {:g} at {} facets, the first near ({:g}, "
                                    "{:g}, {:g}). Try another --deviation, or keep the surface as it is.",
                                    options.deviation, count, place[0], place[1], place[2]));
        }
        for (std::size_t f = 0; f < refused.size(); ++f)
            if (refused[f] != 0) tolerance[f] *= smaller_tolerance;
    }
}

}  // namespace kerf

// The contour is never edited as a path. Each defect of it is a pattern of labels and is mended by turning the labels
// of a few facets, so it consists of closed loops of surface edges at every moment.
#include "cut/cut/inside/contour.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "base/core/check.h"
#include "base/geometry/triangle.h"
#include "surface/complex/touching.h"

namespace kerf {

namespace {

constexpr int max_passes = 60;
constexpr std::size_t max_pocket = 8;    // facets between a chord and the contour
constexpr std::size_t tiny_island = 3;   // facets
constexpr std::size_t max_island = 40;   // facets, if near the plane
constexpr double island_distance = 1.5;  // in crossing edges
constexpr double ear_size = 0.5;         // largest area x distance of an ear that may turn, in crossing edges cubed

class LabelCleaner {
 public:
    LabelCleaner(const Surface& surface, const Band& band, Array<Facet, Side>& side)
        : surface_(surface), band_(band), side_(side), degree_(band.vertices.size(), 0), mark_(band.facets.size(), 0) {}

    bool turn_ears();
    bool absorb_islands();
    bool open_pinches();
    bool close_pockets();

 private:
    bool in_band(Facet facet) const { return band_.index_of[facet] >= 0; }
    std::int32_t& degree(Vertex contour_vertex) { return degree_[band_.vertex_index_of[contour_vertex]]; }
    bool on_contour_vertex(Vertex vertex) const {
        return band_.vertex_index_of[vertex] >= 0 && degree_[band_.vertex_index_of[vertex]] > 0;
    }
    void turn(Facet facet) { side_[facet] = other(side_[facet]); }
    Facet across(HalfEdge half_edge) const { return surface_.facet_of(Surface::opposite(half_edge)); }
    bool on_contour(HalfEdge half_edge) const {
        return side_[surface_.facet_of(half_edge)] != side_[across(half_edge)];
    }
    double length(HalfEdge half_edge) const {
        return (surface_.point(surface_.to_vertex(half_edge)) - surface_.point(surface_.from_vertex(half_edge))).norm();
    }
    // Price of turning a facet by its place alone: negative if it returns to its own side.
    double turning_cost(Facet facet) const;
    std::vector<std::vector<Facet>> fans_around(Vertex vertex) const;
    double fan_cost(const std::vector<Facet>& fan) const;
    std::vector<Facet> pocket_behind(HalfEdge chord);
    std::vector<Vertex> contour_vertices();

    const Surface& surface_;
    const Band& band_;
    Array<Facet, Side>& side_;
    std::vector<std::int32_t> degree_;  // contour edges per band vertex; zero outside of contour_vertices()
    std::vector<std::int32_t> mark_;    // per band facet, scratch of the floods
    std::int32_t stamp_ = 0;
};

double LabelCleaner::turning_cost(Facet facet) const {
    const auto t = surface_.corners(facet);
    const double area = triangle_area(surface_.point(t[0]), surface_.point(t[1]), surface_.point(t[2]));
    const double d = band_.facet_distance(surface_, facet);
    return side_[facet] == Side::below ? -area * d : area * d;
}

bool LabelCleaner::turn_ears() {
    bool changed = false;
    const double h = band_.edge_length;
    for (std::size_t i = 0; i < band_.facets.size(); ++i) {
        const auto& half_edges = band_.half_edges[i];
        const auto contour_sides = std::count_if(half_edges.begin(), half_edges.end(),
                                                 [&](HalfEdge half_edge) { return on_contour(half_edge); });
        // Unguarded, ears unravel whole sides of bodies with long triangles.
        if (contour_sides < 2 || turning_cost(band_.facets[i]) > ear_size * h * h * h) continue;
        turn(band_.facets[i]);
        changed = true;
    }
    return changed;
}

// An island is a component of equal labels inside of the band that touches no facet of its label beyond the band.
bool LabelCleaner::absorb_islands() {
    bool changed = false;
    const std::int32_t before = stamp_;
    std::vector<std::int32_t> island;
    for (std::int32_t seed = 0; seed < count_of(band_.facets); ++seed) {
        if (mark_[seed] > before) continue;
        mark_[seed] = ++stamp_;
        island.assign(1, seed);
        bool anchored = false, whole_shell = true;
        double far = 0;
        for (std::size_t i = 0; i < island.size(); ++i) {
            const Facet facet = band_.facets[island[i]];
            far = std::max(far, std::abs(band_.facet_distance(surface_, facet)));
            for (const HalfEdge half_edge : band_.half_edges[island[i]]) {
                const Facet neighbour = across(half_edge);
                const std::int32_t j = band_.index_of[neighbour];
                if (side_[neighbour] != side_[facet])
                    whole_shell = false;
                else if (j < 0)
                    anchored = true;
                else if (mark_[j] <= before) {
                    mark_[j] = stamp_;
                    island.push_back(j);
                }
            }
        }
        const bool small =
            island.size() <= tiny_island || (island.size() <= max_island && far < island_distance * band_.edge_length);
        if (anchored || whole_shell || !small) continue;
        for (std::int32_t i : island) turn(band_.facets[i]);
        changed = true;
    }
    return changed;
}

// Vertices on the contour, ascending by first contour edge; fills degree_, which the caller resets.
std::vector<Vertex> LabelCleaner::contour_vertices() {
    std::vector<Vertex> vertices;
    for (const SurfaceEdge& edge : contour_edges(surface_, band_, side_))
        for (const Vertex v : edge)
            if (degree(v)++ == 0) vertices.push_back(v);
    return vertices;
}

// Runs of equally labelled facets around a vertex, in rotational order.
std::vector<std::vector<Facet>> LabelCleaner::fans_around(Vertex vertex) const {
    std::vector<std::vector<Facet>> fans;
    std::vector<Facet> before;  // of the last fan, which goes on beyond the first half-edge
    for (const HalfEdge h : surface_.around(vertex)) {
        if (on_contour(h)) fans.emplace_back();
        (fans.empty() ? before : fans.back()).push_back(across(h));
    }
    if (!fans.empty()) fans.back().insert(fans.back().end(), before.begin(), before.end());
    return fans;
}

// Growth of the contour and the price of the places if the fan is turned; infinite if a facet lies beyond the band.
double LabelCleaner::fan_cost(const std::vector<Facet>& fan) const {
    const double h = band_.edge_length;
    double cost = 0;
    for (const Facet facet : fan) {
        const std::int32_t i = band_.index_of[facet];
        if (i < 0) return INFINITY;
        cost += turning_cost(facet) / (h * h);
        for (const HalfEdge half_edge : band_.half_edges[i]) {
            if (on_contour(half_edge))
                cost -= length(half_edge);
            else if (std::find(fan.begin(), fan.end(), across(half_edge)) == fan.end())
                cost += length(half_edge);
        }
    }
    return cost;
}

bool LabelCleaner::open_pinches() {
    bool changed = false;
    const std::vector<Vertex> vertices = contour_vertices();
    for (const Vertex v : vertices) {
        if (degree(v) <= 2) continue;
        const auto fans = fans_around(v);  // earlier turns may have opened this vertex too
        if (fans.size() <= 2) continue;
        std::vector<double> costs;
        for (const auto& fan : fans) costs.push_back(fan_cost(fan));
        const auto cheapest = std::min_element(costs.begin(), costs.end());
        if (std::isinf(*cheapest)) continue;
        for (const Facet facet : fans[cheapest - costs.begin()]) turn(facet);
        changed = true;
    }
    for (const Vertex v : vertices) degree(v) = 0;
    return changed;
}

// Facets of one label between the chord and the contour, on the side of the half-edge; empty if there are too many.
std::vector<Facet> LabelCleaner::pocket_behind(HalfEdge chord) {
    const Facet first = surface_.facet_of(chord);
    if (!in_band(first)) return {};
    std::vector<Facet> pocket = {first};
    mark_[band_.index_of[first]] = ++stamp_;
    for (std::size_t i = 0; i < pocket.size(); ++i)
        for (const HalfEdge half_edge : band_.half_edges[band_.index_of[pocket[i]]]) {
            if (half_edge == chord || half_edge == Surface::opposite(chord) || on_contour(half_edge)) continue;
            const Facet neighbour = across(half_edge);
            const std::int32_t j = band_.index_of[neighbour];
            if (j < 0) return {};
            if (mark_[j] == stamp_) continue;
            if (pocket.size() == max_pocket) return {};
            mark_[j] = stamp_;
            pocket.push_back(neighbour);
        }
    return pocket;
}

bool LabelCleaner::close_pockets() {
    bool changed = false;
    const std::vector<Vertex> vertices = contour_vertices();
    for (const Vertex v : vertices) {
        for (const HalfEdge half_edge : surface_.around(v)) {
            if (on_contour_vertex(surface_.to_vertex(half_edge)) && !on_contour(half_edge)) {
                std::vector<Facet> pocket = pocket_behind(half_edge);
                const std::vector<Facet> behind = pocket_behind(Surface::opposite(half_edge));
                if (pocket.empty() || (!behind.empty() && behind.size() < pocket.size())) pocket = behind;
                for (const Facet facet : pocket) turn(facet);
                changed |= !pocket.empty();
            }
        }
    }
    for (const Vertex v : vertices) degree(v) = 0;
    return changed;
}

constexpr std::int32_t repeated_start = -2;

// Per edge the one that starts where it ends, -1 where none does; repeated_start for edges that start where an earlier
// one does.
std::vector<std::int32_t> followers(const std::vector<SurfaceEdge>& edges) {
    std::vector<std::pair<Vertex, std::int32_t>> starts;
    for (std::int32_t i = 0; i < count_of(edges); ++i) starts.emplace_back(edges[i][0], i);
    std::sort(starts.begin(), starts.end());
    std::vector<std::int32_t> follower;
    for (const SurfaceEdge& edge : edges) {
        const auto found = std::lower_bound(starts.begin(), starts.end(), std::pair(edge[1], 0));
        follower.push_back(found != starts.end() && found->first == edge[1] ? found->second : -1);
    }
    for (std::size_t i = 1; i < starts.size(); ++i)
        if (starts[i].first == starts[i - 1].first) follower[starts[i].second] = repeated_start;
    return follower;
}

}  // namespace

void clean_labels(const Surface& surface, const Band& band, Array<Facet, Side>& side, ContourStages* stages) {
    KERF_CHECK(band.fits(surface) && fit(side, surface));
    LabelCleaner cleaner(surface, band, side);
    for (int pass = 0; pass < max_passes; ++pass) {
        bool changed = cleaner.turn_ears();
        changed |= cleaner.absorb_islands();
        if (stages && pass == 0) stages->closed_loops = contour_edges(surface, band, side);
        changed |= cleaner.open_pinches();
        if (stages && pass == 0) stages->multiple_paths_removed = contour_edges(surface, band, side);
        changed |= cleaner.close_pockets();
        if (!changed) return;
    }
}

std::vector<SurfaceEdge> contour_edges(const Surface& surface, const Band& band, const Array<Facet, Side>& side) {
    KERF_CHECK(band.fits(surface) && fit(side, surface));
    std::vector<SurfaceEdge> edges;
    for (std::size_t i = 0; i < band.facets.size(); ++i)
        for (const HalfEdge h : band.half_edges[i]) {
            const Facet neighbour = surface.facet_of(Surface::opposite(h));
            if (side[band.facets[i]] == side[neighbour]) continue;
            if (side[band.facets[i]] == Side::below)
                edges.push_back({surface.from_vertex(h), surface.to_vertex(h)});
            else if (band.index_of[neighbour] < 0)  // its facet below lies beyond the band and has no turn of its own
                edges.push_back({surface.to_vertex(h), surface.from_vertex(h)});
        }
    return edges;
}

ContourLoops trace_loops(const Surface& surface, const std::vector<SurfaceEdge>& edges,
                         const Array<Vertex, char>& copied) {
    KERF_CHECK(std::all_of(edges.begin(), edges.end(), [&](const SurfaceEdge& edge) {
        return surface.has_vertex(edge[0]) && surface.has_vertex(edge[1]);
    }));
    ContourLoops result;
    const std::vector<std::int32_t> follower = followers(edges);
    std::vector<char> is_traced(edges.size(), 0);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const Vertex v = edges[i][0];
        if ((!copied.empty() && copied[v]) || has_touching_edge(surface, v) || follower[i] == repeated_start)
            result.pinched.push_back(v);
    }
    if (!result.pinched.empty()) return result;
    for (std::int32_t first = 0; first < count_of(edges); ++first) {
        if (is_traced[first]) continue;
        std::vector<Vertex> loop;
        for (std::int32_t i = first; i >= 0 && !is_traced[i]; i = follower[i]) {
            loop.push_back(edges[i][0]);
            is_traced[i] = 1;
        }
        result.loops.push_back(std::move(loop));
    }
    return result;
}

}  // namespace kerf

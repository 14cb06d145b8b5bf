// A place is the part of the model on which a point must lie: the faces of some patches, or, if it is a curve, the edge
// that they share. A vertex on no border lies on the face of its patch, one between two borders of the same patches on
// their curve, and every other vertex is a corner, which stays. One call of kerf-cad projects all vertices and the
// middles of all edges.
//
// Moves are all or nothing for each vertex. All are made at once; vertices that moved too far stay, and then those of
// facets that turned too far or cross others, until there are none: so the surface ends as closed and free of
// intersections as it began. A middle between ends that do not lie on their faces is of no use, and becomes NaN.
#include "run/prepare/inside/cad_nodes.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "base/core/ids.h"
#include "base/geometry/triangle.h"
#include "files/io/file_bytes.h"
#include "files/io/run_manifest.h"
#include "run/prepare/cad_input.h"
#include "run/prepare/inside/surface_places.h"
#include "surface/complex/touching.h"
#include "surface/diagnosis/intersections.h"

namespace kerf {

namespace {

constexpr double furthest_move = 0.3;        // of the shortest edge at a vertex
constexpr double near_face = 1e-3;           // of an edge: its end lies on the face
constexpr double least_turn_of_facet = 0.5;  // cosine

// Numbers of places, in the order in which these come.
class PlaceNumbers {
 public:
    std::int32_t of(const std::vector<std::int32_t>& patches, bool is_curve) {
        CadPlace place{patches, is_curve};
        const auto [found, is_new] = numbers_.try_emplace(place, count_of(places_));
        if (is_new) places_.push_back(std::move(place));
        return found->second;
    }
    std::vector<CadPlace> take() { return std::move(places_); }

 private:
    std::map<CadPlace, std::int32_t> numbers_;
    std::vector<CadPlace> places_;
};

// The borders at a vertex.
struct Borders {
    std::int32_t count = 0;
    std::int32_t first = -1, sharp = -1;  // edges
    bool are_of_one_curve = true;
};

std::vector<Borders> borders_at_vertices(const PlacedSurface& surface) {
    std::vector<Borders> borders(surface.points.size());
    for (std::int32_t e = 0; e < count_of(surface.edges); ++e) {
        const PlacedEdge& edge = surface.edges[e];
        for (const std::int32_t v : edge.ends) {
            Borders& at = borders[v];
            if (edge.is_sharp && at.sharp < 0) at.sharp = e;
            if (!edge.is_border) continue;
            if (at.count++ == 0)
                at.first = e;
            else
                at.are_of_one_curve = at.are_of_one_curve && surface.edges[at.first].patches == edge.patches;
        }
    }
    return borders;
}

CadPoints points_of(const PlacedSurface& surface, const std::vector<std::string>& patch_names, double scale) {
    CadPoints points;
    PlaceNumbers places;
    points.patch_names = patch_names;
    const std::vector<Borders> borders = borders_at_vertices(surface);
    points.place.resize(surface.points.size(), -1);
    for (std::size_t f = 0; f < surface.facets.size(); ++f)
        for (const std::int32_t v : surface.facets[f])
            if (points.place[v] < 0 && borders[v].count == 0)
                points.place[v] = places.of({surface.patch[f]}, borders[v].sharp >= 0);
    for (std::size_t v = 0; v < surface.points.size(); ++v)
        if (borders[v].count == 2 && borders[v].are_of_one_curve)
            points.place[v] = places.of(surface.edges[borders[v].first].patches, true);
    for (const Vec3& p : surface.points) points.points.push_back(p / scale);
    for (const PlacedEdge& edge : surface.edges) {
        points.ends.push_back(edge.ends);
        points.place_of_middle.push_back(places.of(edge.patches, edge.is_sharp));
    }
    points.places = places.take();
    return points;
}

// Moves of vertices, all or nothing for each, by which the surface stays closed, free of intersections and unturned.
class SurfaceMoves {
 public:
    SurfaceMoves(const PlacedSurface& surface, std::vector<Vec3> moved)
        : surface_(surface), points_(std::move(moved)), is_moved_(points_.size(), 1) {}

    std::vector<Vec3> run() {
        keep_far_ones();
        while (keep_turned() || keep_crossing()) {
        }
        return std::move(points_);
    }

 private:
    bool stay(std::int32_t v) {
        points_[v] = surface_.points[v];
        return std::exchange(is_moved_[v], 0) != 0;
    }
    bool stay(const Triangle& facet) {
        bool any = false;
        for (const std::int32_t v : facet) any = stay(v) || any;
        return any;
    }

    void keep_far_ones() {
        std::vector<double> shortest(points_.size(), std::numeric_limits<double>::infinity());
        for (const PlacedEdge& edge : surface_.edges) {
            const double length = (surface_.points[edge.ends[0]] - surface_.points[edge.ends[1]]).norm();
            for (const std::int32_t v : edge.ends) shortest[v] = std::min(shortest[v], length);
        }
        for (std::int32_t v = 0; v < count_of(points_); ++v)
            if (!((points_[v] - surface_.points[v]).norm() <= furthest_move * shortest[v])) stay(v);
    }
    bool keep_turned() {
        bool any = false;
        for (const Triangle& facet : surface_.facets) {
            const Vec3 before = area_vector(surface_.points, facet), now = area_vector(points_, facet);
            if (!(before.dot(now) > least_turn_of_facet * before.norm() * now.norm())) any = stay(facet) || any;
        }
        return any;
    }
    bool keep_crossing() {
        bool any = false;
        for (const auto& [f, g] : find_self_intersections(points_, surface_.facets)) {
            any = stay(surface_.facets[f]) || any;
            any = stay(surface_.facets[g]) || any;
        }
        return any;
    }

    const PlacedSurface& surface_;
    std::vector<Vec3> points_;
    std::vector<char> is_moved_;
};

void set_points(Input& input, const std::vector<Vec3>& points) {
    SurfaceArrays arrays = input.complex.arrays();
    for (std::size_t v = 0; v < arrays.vertices.size(); ++v)
        arrays.vertices[v] = points[key_index(arrays.vertex_key[v])];
    const std::span<const FacetSides> sides = input.complex.all_sides();
    const std::span<const std::string> names = input.complex.region_names();
    input.complex = names.empty()
                        ? Complex(separated_surface(arrays))
                        : Complex(std::move(arrays), {sides.begin(), sides.end()}, {names.begin(), names.end()});
    measure_input(input);
}

}  // namespace

std::vector<Vec3> move_onto_cad(Input& input, const RunRequest& options) {
    const FileHash hash = digest_of(read_file(input.path));
    if (hash_text(hash) != input.file_hash) {
        input.notes.emplace_back("The edges of second order are straight: faces of one CAD file alone are known.");
        return {};
    }
    const PlacedSurface surface(input.complex.arrays());
    const InputOptions& reading = options.input_options;
    ProjectedPoints projected =
        project_on_cad_file(input.path, hash, reading.cad, points_of(surface, input.patch_names, reading.scale));
    for (std::vector<Vec3>* points : {&projected.points, &projected.middles})
        for (Vec3& p : *points) p *= reading.scale;
    const std::vector<Vec3> moved = SurfaceMoves(surface, projected.points).run();
    for (std::size_t e = 0; e < surface.edges.size(); ++e) {
        const auto& [a, b] = surface.edges[e].ends;
        const double near = near_face * (moved[a] - moved[b]).norm();
        for (const std::int32_t v : {a, b})
            if (!((moved[v] - projected.points[v]).norm() <= near))
                projected.middles[e].setConstant(std::numeric_limits<double>::quiet_NaN());
    }
    set_points(input, moved);
    return std::move(projected.middles);
}

}  // namespace kerf

// Sizes from folds, in the manner of local feature sizes (Ruppert 1995, ruppert1995). A fold is an edge across which no
// edge of the longest wanted length may be laid: a feature, or an edge so bent that a chord of its circle would leave
// the tolerance. With the angle t between the normals, the mean height w of both facets and the tolerance d, the radius
// of the circle is about w / t, and a chord of the length sqrt(8 d w / t) stays within d. Two folds at a distance ask
// for that distance, but never for less than the larger of their chords: a fold with a long chord could be left out
// anyway. Folds are segments in a TriangleTree. Walls ask for a share of the distance to the opposite sheet. Sizes are
// limited in their growth at the end by Dijkstra's algorithm, from small to large, over edges and between copies.
#include "surface/remesh/inside/fold_sizes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include <Eigen/Geometry>

#include "base/core/ids.h"
#include "base/core/threads.h"
#include "base/geometry/angles.h"
#include "base/geometry/closest_point.h"

namespace kerf {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double well_shaped_sine = 0.5;  // of 30 degrees
constexpr double straight_share = 0.2;    // of the tolerance: how far from a straight line its vertices may be

// Returns the height of the facet of a half-edge over that.
double height_over(const SheetMesh& mesh, BoundedSurface::HalfEdge h) {
    const Vec3& a = mesh.point(mesh.from_vertex_handle(h));
    const Vec3 edge = mesh.point(mesh.to_vertex_handle(h)) - a;
    return edge.cross(mesh.point(mesh.to_vertex_handle(mesh.next_halfedge_handle(h))) - a).norm() / edge.norm();
}

// Returns the longest length for edges across a fold: a chord of the circle through the facets beside it, of that
// length, stays within the tolerance. Infinite where nothing is folded, 0 at features.
double chord_over(const SheetMesh& mesh, BoundedSurface::Edge e) {
    if (mesh.data(e).is_feature) return 0;
    const double angle = mesh.is_flat(e) ? 0 : angle_of_cosine(mesh.fold_cosine(e));
    if (angle == 0) return infinite;
    const auto h = mesh.halfedge_handle(e, 0), back = mesh.halfedge_handle(e, 1);
    const double width = (height_over(mesh, h) + height_over(mesh, back)) / 2;
    const double tolerance =
        std::min(mesh.data(mesh.from_vertex_handle(h)).tolerance, mesh.data(mesh.to_vertex_handle(h)).tolerance);
    return std::sqrt(8 * tolerance * width / angle);
}

// The longest edge around a vertex if all facets there are as they should be, 0 otherwise.
double well_shaped_length(const SheetMesh& mesh, BoundedSurface::Vertex v) {
    double longest = 0;
    for (const auto out : mesh.voh_range(v)) {
        if (!out.is_boundary() && mesh.sine(out.face()) < well_shaped_sine) return 0;
        longest = std::max(longest, mesh.calc_edge_length(out));
    }
    return longest;
}

double mean_length(const SheetMesh& mesh, BoundedSurface::Vertex v) {
    double sum = 0;
    for (const auto e : mesh.ve_range(v)) sum += mesh.calc_edge_length(e);
    return sum / mesh.valence(v);
}

Vec3 vertex_normal(const SheetMesh& mesh, BoundedSurface::Vertex v) {
    Vec3 sum = Vec3::Zero();
    for (const auto h : mesh.voh_range(v))
        if (!h.is_boundary())
            sum += (mesh.point(h.to()) - mesh.point(v)).cross(mesh.point(h.next().to()) - mesh.point(v));
    return sum.normalized();
}

// Returns the rule of a fold, or of two that are near each other; features have no chord.
LengthRule rule_of(double chord, double other_chord) {
    return chord > 0 || other_chord > 0 ? LengthRule::bound : LengthRule::features;
}

// Dijkstra's way from small to large.
void limit_growth(const SheetMesh& mesh, double growth, std::vector<WantedLength>& sizes) {
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    for (const auto v : mesh.vertices()) open.push({sizes[v.idx()].length, v.idx()});
    while (!open.empty()) {
        const auto [size, number] = open.top();
        open.pop();
        if (size > sizes[number].length) continue;
        const BoundedSurface::Vertex v(number);
        const auto limit = [&, size = size, number = number](BoundedSurface::Vertex w) {
            const double most = size + growth * (mesh.point(v) - mesh.point(w)).norm();
            if (most >= sizes[w.idx()].length) return;
            sizes[w.idx()] = {most, sizes[number].rule};
            open.push({most, w.idx()});
        };
        for (const auto w : mesh.vv_range(v)) limit(w);
        mesh.for_each_copy(v, limit);
    }
}

}  // namespace

FoldSizes::FoldSizes(BoundedSurface& surface, const FoldSizeOptions& options)
    : input_(surface.input()), options_(options) {
    find_folds(surface);
    const SheetMesh& mesh = surface.mesh();
    std::vector<WantedLength> sizes(mesh.n_vertices(), {options.longest, LengthRule::asked});
    for (const auto e : mesh.edges())
        if (const std::int32_t fold = mesh.data(e).fold; fold >= 0)
            for (const auto v : {e.v0(), e.v1()})
                sizes[v.idx()].shorten(std::max({chord_[fold], straight_length(mesh, e), options.shortest}),
                                       rule_of(chord_[fold], 0));
    constexpr std::size_t grain = 1 << 10;
    for_ranges_on_threads(sizes.size(), grain, [&](const IndexRange& range) {
        options.check_cancelled();
        for (std::size_t i = range.first; i < range.last; ++i) {
            const BoundedSurface::Vertex v(static_cast<int>(i));
            if (mesh.status(v).deleted()) continue;
            double own_chord = infinite;
            for (const auto e : mesh.ve_range(v))
                if (const std::int32_t fold = mesh.data(e).fold; fold >= 0)
                    own_chord = std::min(own_chord, chord_[fold]);
            WantedLength& size = sizes[i];
            size = at(mesh, v, own_chord, size);
            size.length =
                mesh.data(v).is_fixed ? mean_length(mesh, v) : std::max(size.length, well_shaped_length(mesh, v));
            if (!mesh.data(v).is_fixed) size.shorten(asked(mesh, v), LengthRule::asked);
        }
    });
    limit_growth(mesh, options.growth, sizes);
    for (const auto v : mesh.vertices()) surface.set_size(v, sizes[v.idx()], asked(mesh, v));
}

double FoldSizes::asked(const SheetMesh& mesh, BoundedSurface::Vertex v) const {
    double least = options_.longest;
    if (!options_.wanted) return least;
    mesh.for_each_copy(v, [&](BoundedSurface::Vertex copy) {
        std::int32_t last = -1;
        for (const auto f : mesh.vf_range(copy)) {
            const std::int32_t patch = mesh.data(f).patch;
            if (patch != std::exchange(last, patch)) least = std::min(least, options_.wanted(mesh.point(v), patch));
        }
    });
    return least;
}

void FoldSizes::find_folds(BoundedSurface& surface) {
    std::vector<Triangle> segments;
    for (const auto e : surface.mesh().edges()) {
        const double chord = chord_over(surface.mesh(), e);
        if (chord >= options_.longest) continue;
        const auto number = count_of(segments);
        surface.set_fold(e, number);
        chord_.push_back(chord);
        for (const auto v : {e.v0(), e.v1()}) ends_.push_back(surface.mesh().point(v));
        segments.push_back({2 * number, 2 * number + 1, 2 * number + 1});
    }
    if (!segments.empty()) folds_.emplace(ends_, segments);
}

// Returns the length of an edge with those that go on from its ends as features in the same direction.
double FoldSizes::straight_length(const SheetMesh& mesh, BoundedSurface::Edge e) const {
    double length = mesh.calc_edge_length(e);
    if (!mesh.data(e).is_feature) return length;
    for (const int side : {0, 1}) {
        auto h = mesh.halfedge_handle(e, side);
        const Vec3& start = mesh.point(mesh.from_vertex_handle(h));
        while (length < options_.longest) {
            const BoundedSurface::Vertex end = mesh.to_vertex_handle(h);
            if (mesh.feature_count(end) != 2) break;
            auto next = mesh.next_halfedge_handle(h);
            while (!mesh.data(mesh.edge_handle(next)).is_feature)
                next = mesh.next_halfedge_handle(mesh.opposite_halfedge_handle(next));
            const Vec3& beyond = mesh.point(mesh.to_vertex_handle(next));
            const Vec3 middle = closest_on_segment(mesh.point(end), start, beyond);
            if ((middle - mesh.point(end)).norm() > straight_share * mesh.data(end).tolerance || middle == start ||
                middle == beyond)
                break;
            length += mesh.calc_edge_length(next);
            h = next;
        }
    }
    return length;
}

WantedLength FoldSizes::of_new(const SheetMesh& mesh, BoundedSurface::Vertex v, std::int32_t fold,
                               WantedLength grown) const {
    grown.shorten(options_.longest, LengthRule::asked);
    return at(mesh, v, fold >= 0 ? chord_[fold] : infinite, grown);
}

// Folds that come close ask for small triangles between them only if neither can be left out at that length.
WantedLength FoldSizes::at(const SheetMesh& mesh, BoundedSurface::Vertex v, double own_chord,
                           const WantedLength& grown) const {
    const Vec3& p = mesh.point(v);
    WantedLength size = grown;
    if (folds_ && own_chord < grown.length)
        folds_->any_within(p, grown.length, [&](std::int32_t fold, double squared) {
            // those that end at p, and that on which it lies, are its own
            if (squared > 1e-12 * options_.longest * options_.longest)
                size.shorten(std::max({own_chord, chord_[fold], std::sqrt(squared)}), rule_of(own_chord, chord_[fold]));
            return false;
        });
    size.length = std::max(size.length, options_.shortest);
    if (options_.walls.per_thickness > 0) size.shorten(at_wall(mesh, v, size.length), LengthRule::walls);
    if (grown.length <= size.length) size = grown;
    size.shorten(asked(mesh, v), LengthRule::asked);
    return size;
}

// The way inwards to a sheet that faces the other way. From a wall it goes both ways, and to sheets that face any way:
// its own is nearer than they are, by the tolerance.
double FoldSizes::at_wall(const SheetMesh& mesh, BoundedSurface::Vertex v, double limit) const {
    const bool is_wall = mesh.data(*mesh.cvf_begin(v)).is_wall;
    const double nearest = is_wall ? 2 * mesh.data(v).tolerance : 1e-6 * options_.longest;
    const auto thickness = [&](const Vec3& inwards) {
        const auto faces_away = [&](std::int32_t facet) {
            const double cosine = input_.normal(facet).dot(inwards);
            return (input_.is_wall(facet) ? std::abs(cosine) : cosine) > 0.5;
        };
        return input_.tree().first_hit(mesh.point(v), inwards, nearest, limit * options_.walls.per_thickness,
                                       faces_away);
    };
    const Vec3 inwards = -vertex_normal(mesh, v);
    double least = thickness(inwards);
    if (is_wall) least = std::min(least, thickness(-inwards));
    return options_.walls.of(least);
}

}  // namespace kerf

// First each edge of the surface is divided, once for all of its facets: the number of wanted lengths along it is the
// integral of 1 / size, by steps that are halved until the size hardly varies within one, and its pieces are cut at
// equal shares of that integral. Of several fields the finest of the facets at the edge counts. Then each facet is
// triangulated in its plane with these points as its outline, as interfaces are (cut/cut/planar_triangulation.h).
//
// Because a facet depends on its outline and the field alone, nothing has to be agreed with its neighbours. Where
// rounding leaves the outline no inside, the facet is divided without regard to coordinates, by halving the side with
// most points. Numbers of points on an edge go from its smaller end to the other.
#include "run/prepare/inside/facet_division.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "base/core/number_text.h"
#include "base/geometry/triangle.h"
#include "cut/cut/planar_triangulation.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

constexpr double largest_stride = 0.5;           // of sizes along an edge, in sizes
constexpr double area_per_squared_length = 0.5;  // of a piece, and of the length wanted there; measured

// Ends of steps along an edge as shares of it, with the number of wanted lengths up to each.
struct EdgeLengths {
    std::vector<double> share, lengths;
};

// Halves the stretch until the size in its middle is that of all of it.
void add_steps(const Vec3& a, const Vec3& b, const SizeField& wanted, double from, double to, EdgeLengths& steps) {
    const double middle = (from + to) / 2, length = (to - from) * (b - a).norm();
    const double size = wanted.at(a + middle * (b - a));
    if (!wanted.is_constant() && length > largest_stride * (size - wanted.growth() * length / 2) && to - from > 1e-6) {
        add_steps(a, b, wanted, from, middle, steps);
        add_steps(a, b, wanted, middle, to, steps);
        return;
    }
    steps.share.push_back(to);
    steps.lengths.push_back((steps.lengths.empty() ? 0 : steps.lengths.back()) + length / size);
}

EdgeLengths lengths_along(const Vec3& a, const Vec3& b, const SizeField& wanted) {
    EdgeLengths steps;
    add_steps(a, b, wanted, 0, 1, steps);
    return steps;
}

double pieces_of(const EdgeLengths& steps) { return std::max(1.0, std::round(steps.lengths.back())); }

// Shares of the edge between which each piece has the same number of wanted lengths.
std::vector<double> shares_of_pieces(const EdgeLengths& steps) {
    const double pieces = pieces_of(steps);
    if (pieces > most_facets)
        throw Error(ErrorCode::memory, fmt::format("An edge of the surface would be divided into {} pieces. Use a "
                                                   "larger size, or --surface keep.",
                                                   short_number(pieces)));
    std::vector<double> shares;
    std::size_t step = 0;
    for (double piece = 1; piece < pieces; ++piece) {
        const double wanted = steps.lengths.back() * piece / pieces;
        while (step + 1 < steps.lengths.size() && steps.lengths[step] < wanted) ++step;
        const double from = step > 0 ? steps.share[step - 1] : 0, before = step > 0 ? steps.lengths[step - 1] : 0;
        shares.push_back(std::lerp(from, steps.share[step],
                                   std::clamp((wanted - before) / (steps.lengths[step] - before), 0.0, 1.0)));
    }
    return shares;
}

// Triangles of a polygon that is a triangle with points on its sides, whatever their coordinates: the side with most
// points is halved. `sides`: from each corner up to the next one, without it.
void halve_sides(const std::array<std::vector<std::int32_t>, 3>& sides, std::vector<Triangle>& triangles) {
    const auto longest =
        std::max_element(sides.begin(), sides.end(), [](const auto& s, const auto& t) { return s.size() < t.size(); });
    if (longest->size() == 1) {
        triangles.push_back({sides[0][0], sides[1][0], sides[2][0]});
        return;
    }
    const auto i = longest - sides.begin();
    const auto middle = longest->begin() + longest->size() / 2;
    const auto &next = sides[(i + 1) % 3], &last = sides[(i + 2) % 3];
    halve_sides({std::vector<std::int32_t>(longest->begin(), middle), {*middle}, last}, triangles);
    halve_sides({std::vector<std::int32_t>(middle, longest->end()), next, {last[0]}}, triangles);
}

class FacetDivider {
 public:
    FacetDivider(const SurfaceArrays& surface, const FacetSizes& wanted)
        : before_(surface), wanted_(wanted), edge_of_corner_(3 * surface.facets.size()) {
        result_.surface.vertices = surface.vertices;
    }

    void divide_edges(const CancellationCheck& check_cancelled);
    void divide_facets(const CancellationCheck& check_cancelled);
    DividedSurface result() &&;

 private:
    std::vector<std::int32_t> side(std::int32_t corner) const;
    void divide_facet(std::int32_t facet);
    std::vector<Triangle> triangles_of(std::int32_t facet, const std::vector<std::int32_t>& outline);

    const SurfaceArrays& before_;
    const FacetSizes& wanted_;
    std::vector<std::int32_t> edge_of_corner_;    // 3 #F
    std::vector<std::int32_t> first_point_ = {};  // of each edge, from its smaller end to the other, and one more
    DividedSurface result_;
};

void FacetDivider::divide_edges(const CancellationCheck& check_cancelled) {
    std::vector<Vec3>& points = result_.surface.vertices;
    const EdgeCorners edges(before_.facets);
    edges.for_each_edge([&](std::int32_t low, const auto& corners) {
        const Vec3 a = before_.vertices[low], b = before_.vertices[corners.front().high];
        std::int32_t finest = wanted_.field_of(corners.front().corner / 3);
        for (const EdgeCorners::Corner& c : corners) {
            edge_of_corner_[c.corner] = count_of(first_point_);
            finest = std::min(finest, wanted_.field_of(c.corner / 3));
        }
        first_point_.push_back(count_of(points));
        check_cancelled.at(first_point_.size());
        for (const double share : shares_of_pieces(lengths_along(a, b, wanted_.field(finest))))
            points.push_back(a + share * (b - a));
    });
    first_point_.push_back(count_of(points));
}

// Vertices on the edge of a corner, from the corner's own up to the next one, without it.
std::vector<std::int32_t> FacetDivider::side(std::int32_t corner) const {
    const std::int32_t edge = edge_of_corner_[corner];
    const std::int32_t from = start_vertex(before_.facets, corner);
    std::vector<std::int32_t> points(first_point_[edge + 1] - first_point_[edge]);
    std::iota(points.begin(), points.end(), first_point_[edge]);
    if (from > start_vertex(before_.facets, next_corner(corner))) std::reverse(points.begin(), points.end());
    points.insert(points.begin(), from);
    return points;
}

// Empty where rounding leaves the outline no inside.
std::vector<Triangle> FacetDivider::triangles_of(std::int32_t facet, const std::vector<std::int32_t>& outline) {
    std::vector<Vec3>& points = result_.surface.vertices;
    const auto& [a, b, c] = before_.facets[facet];
    const Vec3 origin = points[a], along = points[b] - origin, to_third = points[c] - origin;
    const Vec3 x = along.normalized(), y = along.cross(to_third).cross(along).normalized();
    if (!x.allFinite() || !y.allFinite()) return {};
    PlanarRegion region;
    const std::int32_t first = count_of(points), sides = count_of(outline);
    for (std::int32_t i = 0; i < sides; ++i) {
        const Vec3 p = points[outline[i]] - origin;
        region.contour.emplace_back(p.dot(x), p.dot(y));
        region.edges.push_back({i, (i + 1) % sides});
    }
    region.max_edge = [&](const Vec2& p) { return wanted_.of(facet).at(origin + p.x() * x + p.y() * y); };
    PlanarTriangulation planar = triangulate(region);
    if (planar.refusal != Refusal::none) return {};
    for (std::size_t i = sides; i < planar.points.size(); ++i)
        points.emplace_back(origin + planar.points[i].x() * x + planar.points[i].y() * y);
    for (Triangle& t : planar.triangles)
        for (std::int32_t& v : t) v = v < sides ? outline[v] : first + v - sides;
    return std::move(planar.triangles);
}

void FacetDivider::divide_facet(std::int32_t facet) {
    const std::int32_t corner = 3 * facet;
    const std::array sides = {side(corner), side(corner + 1), side(corner + 2)};
    std::vector<std::int32_t> outline;
    for (const auto& s : sides) outline.insert(outline.end(), s.begin(), s.end());
    std::vector<Triangle> triangles;
    if (outline.size() == 3)
        triangles = {before_.facets[facet]};
    else
        triangles = triangles_of(facet, outline);
    if (triangles.empty()) halve_sides(sides, triangles);
    SurfaceArrays& after = result_.surface;
    result_.kept += triangles.size() == 1;
    after.facets.insert(after.facets.end(), triangles.begin(), triangles.end());
    after.patch.resize(after.facets.size(), before_.patch[facet]);
    result_.facet_before.resize(after.facets.size(), facet);
    if (std::ssize(after.facets) > most_facets)
        throw Error(ErrorCode::memory, fmt::format("The surface would be divided into more than {} facets. Use a "
                                                   "larger size, or --surface keep.",
                                                   grouped(most_facets)));
}

void FacetDivider::divide_facets(const CancellationCheck& check_cancelled) {
    for (std::int32_t f = 0; f < count_of(before_.facets); ++f) {
        check_cancelled.at(f);
        divide_facet(f);
    }
}

DividedSurface FacetDivider::result() && {
    SurfaceArrays& after = result_.surface;
    after.vertex_key.resize(after.vertices.size());
    after.facet_key.resize(after.facets.size());
    std::iota(after.vertex_key.begin(), after.vertex_key.end(), make_key(input_node, 0));
    std::iota(after.facet_key.begin(), after.facet_key.end(), make_key(input_node, 0));
    return std::move(result_);
}

}  // namespace

bool FacetSizes::is_empty() const {
    return std::all_of(fields_.begin(), fields_.end(), [](const SizeField& field) { return field.is_empty(); });
}

bool has_facets_to_divide(const Complex& complex, const FacetSizes& all) {
    if (all.is_empty()) return false;
    for (std::int32_t f = 0; f < complex.facet_count(); ++f) {
        const Triangle t = complex.vertices(f);
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 &a = complex.point(t[i]), &b = complex.point(t[(i + 1) % 3]);
            if (pieces_of(lengths_along(a, b, all.of(f))) > 1) return true;
        }
    }
    return false;
}

double forecast_divided_facets(const SurfaceArrays& surface, const FacetSizes& all) {
    double facets = 0;
    for (std::size_t f = 0; f < surface.facets.size(); ++f) {
        const Triangle& t = surface.facets[f];
        const SizeField& wanted = all.of(f);
        const Vec3 centroid = (surface.vertices[t[0]] + surface.vertices[t[1]] + surface.vertices[t[2]]) / 3;
        double density = std::pow(wanted.at(centroid), -2);
        for (const std::int32_t v : t) density += std::pow(wanted.at((centroid + surface.vertices[v]) / 2), -2);
        facets += std::max(1.0, triangle_area(surface.vertices, t) / area_per_squared_length * density / 4);
    }
    return facets;
}

DividedSurface divide_facets(const SurfaceArrays& surface, const FacetSizes& wanted,
                             const CancellationCheck& check_cancelled) {
    FacetDivider divider(surface, wanted);
    divider.divide_edges(check_cancelled);
    divider.divide_facets(check_cancelled);
    return std::move(divider).result();
}

}  // namespace kerf

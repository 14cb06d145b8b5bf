// Facets of a surface that its Delaunay triangulation lacks, those of them that are not recovered, and why: what is
// around them. tests/bench/recovery.py runs it.
//
//     recovery_causes SURFACE [FILE.obj]   one line of JSON; where facets are lost, the surface with them as a patch
//
// Causes, the first one that applies, of at most 300 facets of each kind:
//
//     cospherical   a sphere through the corners has no vertex inside, within rounding
//     needle        its smallest angle is below 5 degrees
//     fold          less than 30 degrees between it and a neighbour, on either side
//     thin wall     another sheet, of a facet without a common vertex, is nearer than its shortest edge, behind it
//     narrow gap    the same before it
//     sheet itself  the angles opposite to one of its edges are above 180 degrees: the surface itself is not Delaunay
//     other         none of these
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Geometry>

#include "base/geometry/angles.h"
#include "base/geometry/triangle.h"
#include "bench/bench.h"
#include "files/io/obj_writer.h"
#include "fill/delaunay/delaunay.h"
#include "fill/delaunay/enclosing_faces.h"
#include "fill/shell/inside/face_recovery.h"
#include "run/prepare/input.h"
#include "surface/soup/triangle_tree.h"

namespace kerf {

namespace {

constexpr double rounding = 1e-9, needle_deg = 5, fold_deg = 30;
constexpr std::size_t most_explained = 300, most_named = 100;

std::array<Vec3, 3> corners_of(const SurfaceArrays& surface, std::int32_t facet) {
    const Triangle& t = surface.facets[facet];
    return {surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]};
}

// Edge i is opposite to corner i.
std::array<double, 3> edge_lengths(const std::array<Vec3, 3>& p) {
    return {(p[2] - p[1]).norm(), (p[0] - p[2]).norm(), (p[1] - p[0]).norm()};
}

// The centres of spheres through the corners lie on a line. How long the piece of it is whose spheres have no vertex
// inside, over the radius of the circumcircle; negative: how far from each other the spheres are that just have none on
// one side.
double room_for_centres(const SurfaceArrays& surface, std::int32_t facet) {
    const auto [a, b, c] = corners_of(surface, facet);
    const Vec3 ab = b - a, ac = c - a, normal = ab.cross(ac);
    const Vec3 to_centre =
        (ac.squaredNorm() * normal.cross(ab) + ab.squaredNorm() * ac.cross(normal)) / (2 * normal.squaredNorm());
    const Vec3 centre = a + to_centre, up = normal.normalized();
    const double squared_radius = to_centre.squaredNorm();
    double low = -std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
        if (std::ranges::count(surface.facets[facet], static_cast<std::int32_t>(v)) > 0) continue;
        const Vec3 p = surface.vertices[v] - centre;
        const double height = p.dot(up), outside = p.squaredNorm() - squared_radius;
        if (height > 0) high = std::min(high, outside / (2 * height));
        if (height < 0) low = std::max(low, outside / (2 * height));
        if (height == 0 && outside < 0) return -std::numeric_limits<double>::infinity();
    }
    return (high - low) / std::sqrt(squared_radius);
}

class Causes {
 public:
    explicit Causes(const Surface& surface)
        : surface_(surface), arrays_(surface.arrays()), tree_(arrays_.vertices, arrays_.facets) {}

    const char* cause(std::int32_t facet) const {
        const std::array<Vec3, 3> corners = corners_of(arrays_, facet);
        if (room_for_centres(arrays_, facet) > -rounding) return "cospherical";
        if (smallest_angle_degrees(corners) < needle_deg) return "needle";
        if (is_beside_fold(facet)) return "fold";
        if (const std::optional<Vec3> other = near_sheet(facet)) {
            const bool is_behind = (*other - corners[0]).dot(doubled_area_vector(corners)) < 0;
            return is_behind ? "thin wall" : "narrow gap";
        }
        return has_wrong_edge(facet) ? "sheet itself" : "other";
    }

 private:
    // Whether is_so(a, b, p, q) for one of the edges a-b between the facet, whose other corner is p, and its neighbour.
    template <class IsSo>
    bool any_edge(std::int32_t facet, IsSo is_so) const {
        const auto end = [&](HalfEdge h) { return surface_.point(surface_.to_vertex(h)); };
        return std::ranges::any_of(surface_.half_edges(Facet(facet)), [&](HalfEdge h) {
            const HalfEdge back = Surface::opposite(h);
            return is_so(end(back), end(h), end(surface_.next(h)), end(surface_.next(back)));
        });
    }

    bool is_beside_fold(std::int32_t facet) const {
        return any_edge(facet, [](const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q) {
            return dihedral_degrees(a, b, p, q) < fold_deg;
        });
    }

    bool has_wrong_edge(std::int32_t facet) const {
        return any_edge(facet, [](const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q) {
            return angle_degrees(p, a, b) + angle_degrees(q, a, b) > 180;
        });
    }

    // A point of another sheet, which lies rather across than along, that is nearer than the shortest edge.
    std::optional<Vec3> near_sheet(std::int32_t facet) const {
        const std::array<Vec3, 3> p = corners_of(arrays_, facet);
        const double limit = std::ranges::min(edge_lengths(p));
        const Vec3 normal = doubled_area_vector(p).normalized();
        const auto touches = [&](std::int32_t other) {
            return std::ranges::any_of(arrays_.facets[other], [&](std::int32_t v) {
                return std::ranges::count(arrays_.facets[facet], v) > 0;
            });
        };
        std::optional<Vec3> found;
        for (const Vec3& sample : {Vec3((p[0] + p[1] + p[2]) / 3), p[0], p[1], p[2]}) {
            tree_.any_within(sample, limit, [&](std::int32_t other, double) {
                if (touches(other)) return false;
                const auto [a, b, c] = tree_.corners(other);
                const Vec3 point = closest_point(sample, a, b, c), offset = point - sample;
                if (std::abs(offset.dot(normal)) < 0.5 * offset.norm()) return false;
                found = point;
                return true;
            });
            if (found) break;
        }
        return found;
    }

    const Surface& surface_;
    SurfaceArrays arrays_;
    TriangleTree tree_;
};

std::vector<std::int32_t> absent(const std::vector<CellFace>& faces) {
    std::vector<std::int32_t> facets;
    for (std::size_t f = 0; f < faces.size(); ++f)
        if (faces[f] == SpatialTriangulation::none) facets.push_back(static_cast<std::int32_t>(f));
    return facets;
}

// Evenly many of all.
std::string causes_json(const Causes& causes, const std::vector<std::int32_t>& facets) {
    std::map<std::string, int> counts;
    const std::size_t explained = std::min(facets.size(), most_explained);
    for (std::size_t i = 0; i < explained; ++i) ++counts[causes.cause(facets[i * facets.size() / explained])];
    std::vector<std::string> items;
    for (const auto& [cause, count] : counts) items.push_back(fmt::format(R"("{}": {})", cause, count));
    const std::span<const std::int32_t> named(facets.data(), std::min(facets.size(), most_named));
    return fmt::format(R"({{"count": {}, "causes": {{{}}}, "first": [{}]}})", facets.size(), fmt::join(items, ", "),
                       fmt::join(named, ", "));
}

void write_lost(const std::string& path, const SurfaceArrays& surface, const std::vector<std::int32_t>& lost) {
    std::vector<std::int32_t> patch(surface.facets.size(), 0);
    for (const std::int32_t facet : lost) patch[facet] = 1;
    write_obj(path, surface.vertices, surface.facets, patch, {"there", "lost"});
}

int run(const std::vector<std::string>& words) {
    if (words.empty() || words.size() > 2) return 2;
    const Surface surface = read_input(words[0]).complex.take_only_region();
    const SurfaceArrays arrays = surface.arrays();
    const Causes causes(surface);
    SpatialTriangulation triangulation = delaunay(arrays.vertices).triangulation;
    const std::vector<std::int32_t> missing = absent(find_faces(triangulation, arrays.facets));
    const std::vector<std::int32_t> lost = recover_faces(triangulation, arrays.facets).lost;
    fmt::print(R"({{"facets": {}, "missing": {}, "lost": {}}})"
               "\n",
               arrays.facets.size(), causes_json(causes, missing), causes_json(causes, lost));
    if (words.size() == 2 && !lost.empty()) write_lost(words[1], arrays, lost);
    return 0;
}

}  // namespace

}  // namespace kerf

int main(int argc, char** argv) { return kerf::bench::run_by_words(argc, argv, kerf::run); }

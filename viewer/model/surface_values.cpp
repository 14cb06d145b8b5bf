// The deviation of a facet is the largest distance from the other surface of ten points of it, on a grid that divides
// its edges into three; it is a lower bound of the one-sided Hausdorff distance. Distances come from a tree of the
// triangles of the other surface, and a point that lies within the largest distance found so far is passed over without
// its exact distance. For feature edges the sides of all facets of the input are sorted by their two vertices, and
// successive ones with the same vertices are compared by the cosine between normals. The angle is that of the remesher,
// so that the lines drawn are those that remeshing keeps. A surface as its file has it may have coordinates that are
// not finite; their facets get NaN.
#include "viewer/model/surface_values.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "surface/soup/triangle_tree.h"

namespace kerf::view {

namespace {

constexpr int pieces_of_edge = 3;          // of a facet's edges, for its samples
constexpr double feature_cosine = 0.8660;  // 30 degrees, as the remesher has it

double farthest_sample(const std::array<Vec3, 3>& corners, const TriangleTree& tree) {
    const auto is_there = [](std::int32_t, double) { return true; };
    double farthest = 0;
    for (int i = 0; i <= pieces_of_edge; ++i)
        for (int j = 0; i + j <= pieces_of_edge; ++j) {
            const Vec3 p =
                (i * corners[0] + j * corners[1] + (pieces_of_edge - i - j) * corners[2]) / double{pieces_of_edge};
            if (!tree.any_within(p, farthest, is_there)) farthest = std::sqrt(tree.closest(p).squared_distance);
        }
    return farthest;
}

std::array<Vec3, 3> corners_of(const NodeSurface& surface, std::size_t facet) {
    const Triangle& t = surface.facets[facet];
    return {surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]};
}

// Files may have coordinates that are no numbers.
bool is_finite(const NodeSurface& surface, const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [&](std::int32_t v) { return surface.vertices[v].allFinite(); });
}

// An edge of one facet of the input.
struct Side {
    std::int32_t low, high;  // vertices
    std::size_t facet;

    bool is_beside(const Side& other) const { return low == other.low && high == other.high; }
};

std::vector<Side> sides_of_input(const NodeSurface& surface) {
    std::vector<Side> sides;
    for (std::size_t f = 0; f < surface.facets.size(); ++f) {
        if (surface.is_interface(f)) continue;
        const Triangle& t = surface.facets[f];
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
            sides.push_back({low, high, f});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return std::tie(a.low, a.high, a.facet) < std::tie(b.low, b.high, b.facet);
    });
    return sides;
}

bool is_feature(const NodeSurface& surface, std::size_t f, std::size_t g) {
    if (!surface.patch.empty() && surface.patch[f] != surface.patch[g]) return true;
    const auto normal = [&](std::size_t facet) {
        const std::array<Vec3, 3> p = corners_of(surface, facet);
        return Vec3((p[1] - p[0]).cross(p[2] - p[0]));
    };
    const Vec3 a = normal(f), b = normal(g);
    return a.dot(b) < feature_cosine * a.norm() * b.norm();
}

}  // namespace

const char* why_without_values(const Document& document, ColorBy color) {
    const SizeOptions& sizes = document.options.sizes;
    if (color == ColorBy::deviation && !document.remeshed && !document.unrepaired)
        return "The surface was neither remeshed nor repaired, so that it deviates nowhere. --surface remesh and "
               "--repair "
               "do that.";
    if (color == ColorBy::region && document.region_names.size() < 2) return "The body has no regions to tell apart.";
    if (color == ColorBy::size && !sizes.depends_on_place() && sizes.max_volume == 0 && sizes.size.number() == 0)
        return "No size is asked for: --size and its like do that.";
    if (is_of_solution(color) && !document.solution)
        return "There is no solution: open the folder that kerf solve has written.";
    return nullptr;
}

std::vector<float> distances_of_facets(const NodeSurface& surface, const NodeSurface& other) {
    std::vector<Triangle> facets = other.facets;
    std::erase_if(facets, [&](const Triangle& t) { return !is_finite(other, t); });
    std::vector<float> distances(surface.facets.size(), std::nanf(""));
    if (facets.empty()) return distances;
    const TriangleTree tree(other.vertices, facets);
    for (std::size_t f = 0; f < distances.size(); ++f)
        if (!surface.is_interface(f) && is_finite(surface, surface.facets[f]))
            distances[f] = static_cast<float>(farthest_sample(corners_of(surface, f), tree));
    return distances;
}

std::vector<float> lengths_at_vertices(const NodeSurface& surface, const SizeField& field) {
    std::vector<float> lengths;
    lengths.reserve(surface.vertices.size());
    for (const Vec3& p : surface.vertices) {
        const double length = field.at(p);
        lengths.push_back(std::isfinite(length) ? static_cast<float>(length) : std::nanf(""));
    }
    return lengths;
}

std::vector<std::array<Vec3, 2>> feature_edges(const NodeSurface& surface) {
    const std::vector<Side> sides = sides_of_input(surface);
    std::vector<std::array<Vec3, 2>> edges;
    for (std::size_t i = 0; i + 1 < sides.size(); ++i)
        if (sides[i].is_beside(sides[i + 1]) && is_feature(surface, sides[i].facet, sides[i + 1].facet))
            edges.push_back({surface.vertices[sides[i].low], surface.vertices[sides[i].high]});
    return edges;
}

}  // namespace kerf::view

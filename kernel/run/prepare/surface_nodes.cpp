// Nodes of edges come from a CAD model (run/prepare/inside/cad_nodes.h), where there is one, or else from the triangles
// that a remeshed surface was made of. In that case the middle of an edge goes to the closest point of the facets of
// the same patch in the file; if the edge is sharp or a border, to the closest of the edges of the file between the
// same patches, which a tree of triangles holds as needles without area. Only nodes off the middle by more than
// rounding are kept, and none off it by more than a tenth of the edge: such an edge is too long for the curve that it
// stands for.
#include "run/prepare/surface_nodes.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/core/ids.h"
#include "base/core/number_text.h"
#include "run/prepare/inside/cad_nodes.h"
#include "run/prepare/inside/surface_places.h"
#include "surface/soup/triangle_tree.h"

namespace kerf {

namespace {

constexpr double straight_within = 1e-10;  // of an edge: rounding
constexpr double furthest_node = 0.1;      // of an edge, from its middle: an arc of 45 degrees

// The facets of the file, by patch, and its features, by the patches that they bound.
class FileSurface {
 public:
    explicit FileSurface(const SurfaceArrays& arrays) : surface_(arrays) {
        std::map<std::int32_t, std::vector<Triangle>> facets;
        for (std::size_t f = 0; f < surface_.facets.size(); ++f)
            facets[surface_.patch[f]].push_back(surface_.facets[f]);
        for (const auto& [patch, triangles] : facets) faces_.try_emplace(patch, surface_.points, triangles);
        std::map<std::vector<std::int32_t>, std::vector<UndirectedEdge>> features;
        for (const PlacedEdge& edge : surface_.edges)
            if (edge.is_sharp) features[edge.patches].push_back(edge.ends);
        for (const auto& [patches, edges] : features) add_lines(patches, edges);
    }

    /// Returns the nearest point of the face or feature that the edge of another surface stands for; nothing if the
    /// file has none.
    std::optional<Vec3> nearest(const Vec3& p, const PlacedEdge& edge) const {
        if (edge.is_sharp) {
            const auto lines = lines_.find(edge.patches);
            if (lines == lines_.end()) return {};
            return lines->second.closest(p).point;
        }
        const auto face = faces_.find(edge.patches.front());
        if (face == faces_.end()) return {};
        return face->second.closest(p).point;
    }

 private:
    // An edge is a needle of a triangle.
    void add_lines(const std::vector<std::int32_t>& patches, const std::vector<UndirectedEdge>& edges) {
        std::vector<Vec3> points;
        std::vector<Triangle> needles;
        for (const auto& [a, b] : edges) {
            const auto first = count_of(points);
            points.insert(points.end(),
                          {surface_.points[a], surface_.points[b], (surface_.points[a] + surface_.points[b]) / 2});
            needles.push_back({first, first + 1, first + 2});
        }
        lines_.try_emplace(patches, points, needles);
    }

    PlacedSurface surface_;
    std::map<std::int32_t, TriangleTree> faces_;
    std::map<std::vector<std::int32_t>, TriangleTree> lines_;
};

}  // namespace

const Vec3* SurfaceNodes::find(const UndirectedEdge& edge) const {
    const auto found = std::lower_bound(edges.begin(), edges.end(), edge);
    return found != edges.end() && *found == edge ? &points[found - edges.begin()] : nullptr;
}

SurfaceArrays surface_behind(const Input& input, const RunRequest& options) {
    return options.has_curved_edges() && !input.is_cad ? input.complex.arrays() : SurfaceArrays();
}

SurfaceNodes make_surface_nodes(Input& input, const SurfaceArrays& behind, const RunRequest& options) {
    SurfaceNodes nodes;
    if (!options.has_curved_edges()) return nodes;
    std::vector<Vec3> points;
    if (input.is_cad) points = move_onto_cad(input, options);
    const PlacedSurface surface(input.complex.arrays());
    nodes.surface_edges = std::ssize(surface.edges);
    std::optional<FileSurface> file;
    if (!input.is_cad && input.remeshed && !input.remeshed->only_divided && !behind.facets.empty())
        file.emplace(behind);
    if (!file && points.empty()) return nodes;
    std::int64_t far = 0;
    for (std::size_t e = 0; e < surface.edges.size(); ++e) {
        const auto& [a, b] = surface.edges[e].ends;
        const Vec3 middle = 0.5 * (surface.points[a] + surface.points[b]);
        const double length = (surface.points[a] - surface.points[b]).norm();
        const std::optional<Vec3> node = file ? file->nearest(middle, surface.edges[e]) : points[e];
        const double off = node ? (*node - middle).norm() : 0;
        if (off <= straight_within * length) continue;
        if (!(off <= furthest_node * length)) {
            ++far;
            continue;
        }
        nodes.edges.push_back(surface.edges[e].ends);
        nodes.points.push_back(*node);
    }
    if (far > 0)
        input.notes.push_back(
            fmt::format("{} of {} edges of the surface stay straight, since they are too long for what "
                        "they stand for. A smaller --deviation or --size makes them shorter.",
                        grouped(far), grouped(nodes.surface_edges)));
    return nodes;
}

}  // namespace kerf

// Corners go to corners first, along the shortest edges between features; then a corner goes to the foot of its height
// on the feature across its facet, which is split there. A foot that nothing could be moved to is collapsed again.
#include "surface/remesh/inside/feature_merging.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/core/ids.h"
#include "base/geometry/closest_point.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

using Vertex = BoundedSurface::Vertex;
using Edge = BoundedSurface::Edge;
using HalfEdge = BoundedSurface::HalfEdge;
using Facet = BoundedSurface::Facet;

constexpr int most_merging_passes = 4;
// Triangles around may become as bad as 10 degrees.
constexpr BoundedSurface::CollapseRules merging_rules = {.good_sine = 0.1736, .merges_features = true};

bool is_on_feature(const SheetMesh& mesh, Vertex v) { return mesh.feature_count(v) >= 2; }

// Edges between features, shortest first.
std::vector<std::pair<double, Edge>> short_edges(const SheetMesh& mesh) {
    std::vector<std::pair<double, Edge>> edges;
    for (const auto e : mesh.edges()) {
        const auto [a, b] = mesh.ends(e);
        const double length = mesh.calc_edge_length(e);
        if (length <= std::min(mesh.data(a).tolerance, mesh.data(b).tolerance) && is_on_feature(mesh, a) &&
            is_on_feature(mesh, b))
            edges.emplace_back(length, e);
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

// A corner on a feature that is near the feature on the other side of its facet goes there.
bool merge_across(BoundedSurface& surface, Facet f) {
    const SheetMesh& mesh = surface.mesh();
    for (const HalfEdge h : mesh.fh_range(f)) {
        const Edge e = mesh.edge_handle(h);
        if (!mesh.data(e).is_feature || mesh.is_fixed(e)) continue;
        const Vertex a = mesh.from_vertex_handle(h), b = mesh.to_vertex_handle(h);
        const Vertex apex = mesh.to_vertex_handle(mesh.next_halfedge_handle(h));
        const double tolerance = mesh.data(apex).tolerance;
        const Vec3 along = mesh.point(b) - mesh.point(a), up = mesh.point(apex) - mesh.point(a);
        const double t = along.dot(up) / along.squaredNorm(), least = tolerance / along.norm();
        if (!(t > least && t < 1 - least) || (up - t * along).norm() > tolerance) continue;
        if (!is_on_feature(mesh, apex)) continue;
        const Vertex foot = surface.split(e, mesh.ends(e)[0] == a ? t : 1 - t);
        if (surface.collapse(mesh.find_halfedge(apex, foot), merging_rules) ||
            surface.collapse(mesh.find_halfedge(foot, apex), merging_rules))
            return true;
        surface.collapse(mesh.find_halfedge(foot, t < 0.5 ? a : b), {.good_sine = 0});
        return false;
    }
    return false;
}

}  // namespace

void merge_features(BoundedSurface& surface, const std::function<void()>& check_cancelled) {
    const SheetMesh& mesh = surface.mesh();
    for (int pass = 0; pass < most_merging_passes; ++pass) {
        std::size_t merged = 0;
        for (const auto& [length, e] : short_edges(mesh)) {
            check_cancelled();
            if (!mesh.status(e).deleted() && surface.collapse_either_way(e, merging_rules)) ++merged;
        }
        const std::vector<BoundedSurface::Facet> facets(mesh.faces_begin(), mesh.faces_end());  // more come
        for (const BoundedSurface::Facet f : facets) {
            check_cancelled();
            if (!mesh.status(f).deleted() && merge_across(surface, f)) ++merged;
        }
        if (merged == 0) break;
    }
}

bool has_narrow_strips(const SheetArrays& sheets) {
    std::vector<char> is_on_feature(sheets.points.size(), 0);
    for (std::int32_t corner = 0; corner < count_of(sheets.edges); ++corner)
        if (sheets.edges[corner].is_feature)
            for (const std::int32_t at : {corner, next_corner(corner)})
                is_on_feature[start_vertex(sheets.corners, at)] = 1;
    for (std::int32_t corner = 0; corner < count_of(sheets.edges); ++corner) {
        const std::int32_t next = next_corner(corner), last = next_corner(next);
        const std::int32_t apex = start_vertex(sheets.corners, last);
        if (!sheets.edges[corner].is_feature || is_on_feature[apex] == 0) continue;
        if (sheets.edges[next].is_feature || sheets.edges[last].is_feature) continue;  // they meet at a corner
        const Vec3 &a = sheets.points[start_vertex(sheets.corners, corner)],
                   &b = sheets.points[start_vertex(sheets.corners, next)], &p = sheets.points[apex];
        const double tolerance = sheets.vertices[apex].tolerance;
        if ((closest_on_segment(p, a, b) - p).squaredNorm() <= tolerance * tolerance) return true;
    }
    return false;
}

}  // namespace kerf

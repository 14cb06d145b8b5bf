// Queries of the mesh and its bookkeeping of copies. A place is the list of a vertex's copies, one for each fan of
// facets from seam to seam; a seam is the list of the edges that are one edge in all sheets. Elements without copies
// have the number -1 and no list. arrays() collects garbage, which renumbers all vertices, edges and facets; the
// numbers of places and seams stay, and their lists are filled anew. `changed` is the count of operations at the last
// change around a vertex or in a facet, by which callers skip what was refused before.
#include "surface/remesh/inside/sheet_mesh.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "base/core/ids.h"
#include "surface/remesh/remesh.h"

namespace kerf {

// The smallest angle lies opposite to the shortest edge.
double smallest_sine(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double ab = (b - a).squaredNorm(), bc = (c - b).squaredNorm(), ca = (a - c).squaredNorm();
    const double shortest = std::min({ab, bc, ca});
    const double product = shortest == ab ? bc * ca : shortest == bc ? ab * ca : ab * bc;
    return product > 0 ? (b - a).cross(c - a).norm() / std::sqrt(product) : 0;
}

Vec3 area_normal(const SheetMesh::Corners& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }

void SheetMesh::make_copies(std::vector<VertexHandle> vertices) {
    for (const VertexHandle v : vertices) data(v).place = count_of(places_);
    places_.push_back(std::move(vertices));
}

void SheetMesh::make_seam(std::vector<EdgeHandle> edges) {
    for (const EdgeHandle e : edges) data(e).seam = count_of(seams_);
    seams_.push_back(std::move(edges));
}

void SheetMesh::list_copies(HalfedgeHandle h, std::vector<HalfedgeHandle>& list) const {
    list.clear();
    const std::int32_t start = data(from_vertex_handle(h)).place;
    for_each_copy(edge_handle(h), [&](EdgeHandle e) {
        const HalfedgeHandle first = halfedge_handle(e, 0);
        const bool is_along = e == edge_handle(h) ? first == h : data(from_vertex_handle(first)).place == start;
        list.push_back(is_along ? first : opposite_halfedge_handle(first));
    });
}

bool SheetMesh::are_joined(VertexHandle v, VertexHandle w) const {
    bool is_found = false;
    for_each_copy(v, [&](VertexHandle a) {
        for_each_copy(w, [&](VertexHandle b) { is_found |= find_halfedge(a, b).is_valid(); });
    });
    return is_found;
}

SheetMesh::Corners SheetMesh::corners(FaceHandle f) const {
    const HalfedgeHandle h = halfedge_handle(f), next = next_halfedge_handle(h);
    return {point(from_vertex_handle(h)), point(to_vertex_handle(h)), point(to_vertex_handle(next))};
}

double SheetMesh::sine(FaceHandle f) const {
    const auto [a, b, c] = corners(f);
    return smallest_sine(a, b, c);
}

int SheetMesh::feature_count(VertexHandle v) const {
    int count = 0;
    for (const auto e : ve_range(v)) count += data(e).is_feature ? 1 : 0;
    return count;
}

bool SheetMesh::has_one_patch(VertexHandle v) const {
    const std::int32_t patch = data(*cvf_begin(v)).patch;
    return std::all_of(cvf_begin(v), cvf_end(v), [&](FaceHandle f) { return data(f).patch == patch; });
}

bool SheetMesh::is_fixed(EdgeHandle e) const {
    bool is_found = false;
    for_each_copy(e, [&](EdgeHandle copy) {
        const auto [f, g] = facets_at(copy);
        is_found |= data(f).is_kept || data(g).is_kept;
    });
    return is_found;
}

bool SheetMesh::is_flat(EdgeHandle e) const {
    const auto [f, g] = facets_at(e);
    return data(f).region >= 0 && data(f).region == data(g).region && !data(e).is_feature;
}

bool SheetMesh::is_inside_region(VertexHandle v) const {
    std::int32_t region = -1;
    for (const auto f : vf_range(v)) {
        if (data(f).region < 0 || (region >= 0 && data(f).region != region)) return false;
        region = data(f).region;
    }
    return feature_count(v) == 0;
}

double SheetMesh::fold_cosine(EdgeHandle e) const {
    const auto [f, g] = facets_at(e);
    const Vec3 a = area_normal(corners(f)), b = area_normal(corners(g));
    const double norms = a.norm() * b.norm();
    return norms > 0 ? a.dot(b) / norms : 1;
}

std::int64_t SheetMesh::last_change(VertexHandle v) const {
    std::int64_t last = 0;
    for_each_copy(v, [&](VertexHandle copy) { last = std::max(last, data(copy).changed); });
    return last;
}

std::int64_t SheetMesh::last_change(EdgeHandle e) const {
    const auto [f, g] = facets_at(e);
    return std::max(data(f).changed, data(g).changed);
}

void SheetMesh::note_change(FaceHandle f, std::int64_t operation) {
    data(f).changed = operation;
    for (const auto v : fv_range(f)) data(v).changed = operation;
}

std::int64_t SheetMesh::feature_edges() const {
    return std::count_if(edges_begin(), edges_end(),
                         [&](const auto& e) { return !status(e).deleted() && data(e).is_feature && is_first_copy(e); });
}

SurfaceArrays SheetMesh::arrays() {
    garbage_collection();
    for (auto& place : places_) place.clear();
    for (auto& seam : seams_) seam.clear();
    for (const auto e : edges())
        if (data(e).seam >= 0) seams_[data(e).seam].push_back(e);
    SurfaceArrays result;
    for (const auto v : vertices()) {
        if (has_copies(v)) places_[data(v).place].push_back(v);
        result.vertices.push_back(point(v));
        result.vertex_key.push_back(
            make_key(input_node, has_copies(v) ? places_[data(v).place].front().idx() : v.idx()));
    }
    for (const auto f : faces()) {
        const HalfedgeHandle h = halfedge_handle(f), next = next_halfedge_handle(h);
        result.facets.push_back({from_vertex_handle(h).idx(), to_vertex_handle(h).idx(), to_vertex_handle(next).idx()});
        result.facet_key.push_back(make_key(input_node, f.idx()));
        result.patch.push_back(data(f).patch);
    }
    return result;
}

}  // namespace kerf

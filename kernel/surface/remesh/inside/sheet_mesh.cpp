// Queries of the mesh and its bookkeeping of copies. A place is the list of a vertex's copies, one for each fan of
// facets from seam to seam; a seam is the list of the edges that are one edge in all sheets. Elements without copies
// have the number -1 and no list. `changed` is the count of operations at the last
// change around a vertex or in a facet, by which callers skip what was refused before.
#include "surface/remesh/inside/sheet_mesh.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "base/core/ids.h"
#include "surface/remesh/remesh.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

// The smallest angle lies opposite to the shortest edge.
double smallest_sine(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double ab = (b - a).squaredNorm(), bc = (c - b).squaredNorm(), ca = (a - c).squaredNorm();
    const double shortest = std::min({ab, bc, ca});
    const double product = shortest == ab ? bc * ca : shortest == bc ? ab * ca : ab * bc;
    return product > 0 ? std::sqrt((b - a).cross(c - a).squaredNorm() / product) : 0;
}

Vec3 area_normal(const SheetMesh::Corners& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }

SheetMesh::SheetMesh(const SheetPiece& piece) {
    const SheetArrays& arrays = piece.arrays;
    connect(piece);
    places_.resize(piece.places);
    for (std::int32_t v = 0; v < count_of(arrays.points); ++v) {
        const VertexHandle vertex(v);
        set_point(vertex, arrays.points[v]);
        data(vertex) = arrays.vertices[v];
        if (has_copies(vertex)) places_[data(vertex).place].push_back(vertex);
    }
    seams_.resize(piece.seams);
    sines_.reserve(arrays.corners.size());
    for (std::int32_t f = 0; f < count_of(arrays.corners); ++f) {
        data(FaceHandle(f)) = arrays.facets[f];
        sines_.push_back(sine_of(FaceHandle(f)));
    }
    for (std::int32_t f = 0; f < count_of(arrays.corners); ++f) {
        HalfedgeHandle h = halfedge_handle(FaceHandle(f));
        for (int i = 0; i < 3; ++i, h = next_halfedge_handle(h)) {
            const EdgeHandle e = edge_handle(h);
            data(e) = arrays.edges[3 * f + i];
            if (const std::int32_t seam = data(e).seam; seam >= 0 && halfedge_handle(e, 0) == h)
                seams_[seam].push_back(e);
        }
    }
}

// With the partners of corners known, the connectivity is written directly. The first of two corners has half-edge 0.
void SheetMesh::connect(const SheetPiece& piece) {
    const std::vector<Triangle>& corners = piece.arrays.corners;
    const std::vector<std::int32_t>& partner = piece.partner;
    std::vector<std::int32_t> half_edge(partner.size());
    std::int32_t count = 0;
    for (std::int32_t c = 0; c < count_of(partner); ++c) {
        const bool is_first = partner[c] < 0 || partner[c] > c;
        half_edge[c] = is_first ? 2 * count++ : half_edge[partner[c]] + 1;
    }
    resize(piece.arrays.points.size(), count, corners.size());
    for (std::int32_t c = 0; c < count_of(partner); ++c) {
        const HalfedgeHandle h(half_edge[c]);
        const std::int32_t next = next_corner(c);
        const VertexHandle from(start_vertex(corners, c));
        set_next_halfedge_handle(h, HalfedgeHandle(half_edge[next]));
        set_vertex_handle(h, VertexHandle(start_vertex(corners, next)));
        set_face_handle(h, FaceHandle(c / 3));
        set_halfedge_handle(from, h);
        if (c % 3 == 0) set_halfedge_handle(FaceHandle(c / 3), h);
        if (partner[c] < 0) set_vertex_handle(opposite_halfedge_handle(h), from);
    }
    for (std::int32_t c = 0; c < count_of(partner); ++c) {
        if (partner[c] >= 0) continue;
        const HalfedgeHandle border = opposite_halfedge_handle(HalfedgeHandle(half_edge[c]));
        HalfedgeHandle out = HalfedgeHandle(half_edge[c]);  // the next one begins where the facet's half-edge does
        do out = opposite_halfedge_handle(prev_halfedge_handle(out));
        while (!is_boundary(out));
        set_next_halfedge_handle(border, out);
        set_halfedge_handle(from_vertex_handle(out), out);
    }
}

SheetArrays SheetMesh::arrays() const {
    SheetArrays result;
    result.points.reserve(n_vertices());
    result.vertices.reserve(n_vertices());
    result.corners.reserve(n_faces());
    result.facets.reserve(n_faces());
    result.edges.reserve(3 * n_faces());
    std::vector<std::int32_t> number(n_vertices(), -1);
    for (const auto v : vertices()) {
        number[v.idx()] = count_of(result.points);
        result.points.push_back(point(v));
        result.vertices.push_back(data(v));
    }
    for (const auto f : faces()) {
        Triangle& t = result.corners.emplace_back();
        result.facets.push_back(data(f));
        HalfedgeHandle h = halfedge_handle(f);
        for (int i = 0; i < 3; ++i, h = next_halfedge_handle(h)) {
            t[i] = number[from_vertex_handle(h).idx()];
            result.edges.push_back(data(edge_handle(h)));
        }
    }
    return result;
}

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

double SheetMesh::sine_of(FaceHandle f) const {
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
        is_found |= data(copy).is_border || data(f).is_kept || data(g).is_kept;
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
    if (f.idx() >= count_of(sines_)) sines_.resize(f.idx() + 1);
    sines_[f.idx()] = sine_of(f);
    data(f).changed = operation;
    for (const auto v : fv_range(f)) data(v).changed = operation;
}

}  // namespace kerf

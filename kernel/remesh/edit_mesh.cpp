#include "remesh/edit_mesh.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "remesh/remesh.h"

namespace kerf {

// It lies opposite to the shortest edge.
double smallest_sine(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double ab = (b - a).squaredNorm(), bc = (c - b).squaredNorm(), ca = (a - c).squaredNorm();
    const double shortest = std::min({ab, bc, ca});
    const double product = shortest == ab ? bc * ca : shortest == bc ? ab * ca : ab * bc;
    return product > 0 ? (b - a).cross(c - a).norm() / std::sqrt(product) : 0;
}

Vec3 area_normal(const EditMesh::Corners& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }

EditMesh::Corners EditMesh::corners(FaceHandle f) const {
    const HalfedgeHandle h = halfedge_handle(f), next = next_halfedge_handle(h);
    return {point(from_vertex_handle(h)), point(to_vertex_handle(h)), point(to_vertex_handle(next))};
}

double EditMesh::sine(FaceHandle f) const {
    const auto [a, b, c] = corners(f);
    return smallest_sine(a, b, c);
}

int EditMesh::feature_count(VertexHandle v) const {
    int count = 0;
    for (const auto e : ve_range(v)) count += data(e).is_feature ? 1 : 0;
    return count;
}

bool EditMesh::has_one_patch(VertexHandle v) const {
    const std::int32_t patch = data(*cvf_begin(v)).patch;
    return std::all_of(cvf_begin(v), cvf_end(v), [&](FaceHandle f) { return data(f).patch == patch; });
}

bool EditMesh::is_flat(EdgeHandle e) const {
    const auto [f, g] = facets_at(e);
    return data(f).region >= 0 && data(f).region == data(g).region && !data(e).is_feature;
}

bool EditMesh::is_inside_region(VertexHandle v) const {
    std::int32_t region = -1;
    for (const auto f : vf_range(v)) {
        if (data(f).region < 0 || (region >= 0 && data(f).region != region)) return false;
        region = data(f).region;
    }
    return feature_count(v) == 0;
}

double EditMesh::fold_cosine(EdgeHandle e) const {
    const auto [f, g] = facets_at(e);
    const Vec3 a = area_normal(corners(f)), b = area_normal(corners(g));
    const double norms = a.norm() * b.norm();
    return norms > 0 ? a.dot(b) / norms : 1;
}

std::int64_t EditMesh::last_change(EdgeHandle e) const {
    const auto [f, g] = facets_at(e);
    return std::max(data(f).changed, data(g).changed);
}

void EditMesh::note_change(FaceHandle f, std::int64_t operation) {
    data(f).changed = operation;
    for (const auto v : fv_range(f)) data(v).changed = operation;
}

std::int64_t EditMesh::feature_edges() const {
    return std::count_if(edges_begin(), edges_end(),
                         [&](const auto& e) { return !status(e).deleted() && data(e).is_feature; });
}

SurfaceArrays EditMesh::arrays() {
    garbage_collection();
    SurfaceArrays result;
    for (const auto v : vertices()) {
        result.vertices.push_back(point(v));
        result.vertex_key.push_back(make_key(0, v.idx()));
    }
    for (const auto f : faces()) {
        const HalfedgeHandle h = halfedge_handle(f), next = next_halfedge_handle(h);
        result.facets.push_back({from_vertex_handle(h).idx(), to_vertex_handle(h).idx(), to_vertex_handle(next).idx()});
        result.facet_key.push_back(make_key(0, f.idx()));
        result.patch.push_back(data(f).patch);
    }
    return result;
}

}  // namespace kerf

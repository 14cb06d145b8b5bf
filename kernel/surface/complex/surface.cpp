// Corner 3 f + i, the edge of facet f from its vertex i to the next, becomes a half-edge. Two corners at one edge are
// partners if they are the only ones there and run in opposite directions; all else is a manifold defect, found by
// manifold_defects.h. Partners get the half-edge numbers 2 e and 2 e + 1, so that the opposite of h is h ^ 1, and edges
// ascend by their first corners: numbers depend on the arrays alone, not on threads. OpenMesh's connectivity is written
// directly, because its add_face() would search for edges that are known.
#include "surface/complex/surface.h"

#include <numeric>
#include <utility>

#include "base/core/elements.h"
#include "base/core/error.h"
#include "base/core/threads.h"
#include "surface/complex/manifold_defects.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

const char* name(ManifoldDefect::Kind kind) {
    constexpr std::array names = {"an open edge", "an edge with facets of opposite orientation", "a non-manifold edge",
                                  "a non-manifold vertex"};
    return names[static_cast<std::size_t>(kind)];
}

// The numbers of the half-edges of corners: of two partners the first one has an even number, and these ascend.
std::vector<std::int32_t> number_half_edges(std::vector<std::int32_t> partner) {
    constexpr std::size_t grain = std::size_t{1} << 17;
    const auto is_first = [&](std::size_t c) { return partner[c] > static_cast<std::int32_t>(c); };
    std::vector<std::int32_t> edges = values_of_ranges(partner.size(), grain, [&](const IndexRange& range) {
        std::int32_t count = 0;
        for (std::size_t c = range.first; c < range.last; ++c) count += is_first(c);
        return count;
    });
    std::exclusive_scan(edges.begin(), edges.end(), edges.begin(), 0);
    std::vector<std::int32_t>& number = partner;  // a corner is not looked at again once its half-edge is numbered
    for_ranges_on_threads(partner.size(), grain, [&](const IndexRange& range) {
        std::int32_t edge = edges[range.first / grain];
        for (std::size_t c = range.first; c < range.last; ++c)
            if (is_first(c)) number[c] = ~(2 * edge++);  // below 0: is no partner
    });
    for_ranges_on_threads(partner.size(), grain, [&](const IndexRange& range) {
        for (std::size_t c = range.first; c < range.last; ++c)
            if (partner[c] >= 0) number[c] = ~number[partner[c]] ^ 1;
    });
    for_ranges_on_threads(partner.size(), grain, [&](const IndexRange& range) {
        for (std::size_t c = range.first; c < range.last; ++c) number[c] = number[c] < 0 ? ~number[c] : number[c];
    });
    return partner;
}

// OpenMesh's own add_face searches for existing edges; with the partners known the connectivity is written directly.
std::shared_ptr<const HalfEdgeMesh> build_half_edges(const std::vector<Vec3>& vertices,
                                                     const std::vector<Triangle>& facets,
                                                     std::vector<std::int32_t> partner) {
    using Mesh = HalfEdgeMesh;
    constexpr std::size_t grain = std::size_t{1} << 16;
    const auto shared = std::make_shared<Mesh>();
    Mesh& mesh = *shared;
    mesh.resize(vertices.size(), partner.size() / 2, facets.size());
    for_ranges_on_threads(vertices.size(), grain, [&](const IndexRange& range) {
        for (std::size_t v = range.first; v < range.last; ++v)
            mesh.set_point(Mesh::VertexHandle(static_cast<int>(v)), vertices[v]);
    });
    const std::vector<std::int32_t> half_edge = number_half_edges(std::move(partner));
    for_ranges_on_threads(facets.size(), grain, [&](const IndexRange& range) {
        for (std::size_t f = range.first; f < range.last; ++f) {
            const Mesh::FaceHandle facet(static_cast<int>(f));
            for (std::size_t i = 0; i < 3; ++i) {
                const Mesh::HalfedgeHandle h(half_edge[3 * f + i]), next(half_edge[3 * f + (i + 1) % 3]);
                mesh.set_face_handle(h, facet);
                mesh.set_next_halfedge_handle(h, next);
                mesh.set_vertex_handle(h, Mesh::VertexHandle(facets[f][(i + 1) % 3]));
            }
            mesh.set_halfedge_handle(facet, Mesh::HalfedgeHandle(half_edge[3 * f]));
        }
    });
    for (std::size_t f = 0; f < facets.size(); ++f)  // facets share vertices: the last one of each counts
        for (std::size_t i = 0; i < 3; ++i)
            mesh.set_halfedge_handle(Mesh::VertexHandle(facets[f][i]), Mesh::HalfedgeHandle(half_edge[3 * f + i]));
    return shared;
}

ManifoldDefect first_defect(std::vector<ManifoldDefect>& defects, const std::vector<Vec3>& vertices) {
    ManifoldDefect& first = defects.front();
    first.where = vertices[first.vertices.front()];
    return std::move(first);
}

// Whether the partners that are known are each other's, over the same edge in opposite directions.
bool are_partners(const std::vector<Triangle>& facets, const std::vector<std::int32_t>& partner) {
    const auto corners = static_cast<std::int32_t>(3 * facets.size());
    if (partner.size() != 3 * facets.size()) return false;
    for (std::int32_t c = 0; c < corners; ++c) {
        const std::int32_t other = partner[c];
        if (other == -1) continue;
        if (other < 0 || other >= corners || partner[other] != c) return false;
        if (start_vertex(facets, c) != start_vertex(facets, next_corner(other))) return false;
    }
    return true;
}

}  // namespace

bool is_well_formed(const SurfaceArrays& arrays) {
    return arrays.vertex_key.size() == arrays.vertices.size() && arrays.facet_key.size() == arrays.facets.size() &&
           arrays.patch.size() == arrays.facets.size() && are_in_range(arrays.facets, arrays.vertices.size()) &&
           have_distinct_corners(arrays.facets);
}

Surface::Surface() : mesh_(std::make_shared<const HalfEdgeMesh>()) {}

Surface::Surface(Paired, SurfaceArrays&& arrays, std::vector<std::int32_t> partner)
    : mesh_(build_half_edges(arrays.vertices, arrays.facets, std::move(partner))),
      points_(mesh_->points()),
      vertex_key_(std::move(arrays.vertex_key)),
      facet_key_(std::move(arrays.facet_key)),
      patch_(std::move(arrays.patch)) {}

std::variant<Surface, ManifoldDefect> Surface::build(SurfaceArrays arrays) {
    KERF_CHECK(is_well_formed(arrays));
    CornerPairing pairing = pair_all_corners(arrays.vertices.size(), arrays.facets, edge_partners(arrays.facets));
    if (!pairing.defects.empty()) return first_defect(pairing.defects, arrays.vertices);
    return Surface(Paired(), std::move(arrays), std::move(pairing.partner));
}

std::variant<Surface, ManifoldDefect> Surface::build(SurfaceArrays arrays, std::vector<std::int32_t> partner) {
    KERF_CHECK(is_well_formed(arrays));
    KERF_CHECK(are_partners(arrays.facets, partner));
    CornerPairing pairing = pair_open_corners(arrays.vertices.size(), arrays.facets, std::move(partner));
    if (!pairing.defects.empty()) return first_defect(pairing.defects, arrays.vertices);
    return Surface(Paired(), std::move(arrays), std::move(pairing.partner));
}

Surface::Surface(SurfaceArrays arrays) {
    auto built = build(std::move(arrays));
    if (const auto* defect = std::get_if<ManifoldDefect>(&built)) {
        const Vec3& p = defect->where;
        throw Error(ErrorCode::internal, std::string("The surface has ") + name(defect->kind) + " at vertex " +
                                             std::to_string(defect->vertices.front()) + " (" + std::to_string(p.x()) +
                                             ", " + std::to_string(p.y()) + ", " + std::to_string(p.z()) + ").");
    }
    *this = std::move(std::get<Surface>(built));
}

HalfEdge Surface::find_half_edge(Vertex from, Vertex to) const {
    for (const HalfEdge h : around(from))
        if (to_vertex(h) == to) return h;
    return HalfEdge::none();
}

SurfaceArrays Surface::arrays() const {
    SurfaceArrays arrays;
    arrays.vertices.reserve(vertex_count());
    for (const Vertex v : vertices()) arrays.vertices.push_back(point(v));
    arrays.facets.reserve(facet_count());
    for (const Facet f : facets()) arrays.facets.push_back(triangle(f));
    arrays.vertex_key = vertex_key_;
    arrays.facet_key = facet_key_;
    arrays.patch = patch_;
    return arrays;
}

Components find_shells(const Surface& surface) {
    UnionFind facets(surface.facet_count());
    for (const Edge e : surface.edges()) {
        const HalfEdge h = Surface::first_half_edge(e);
        facets.join(surface.facet_of(h).value(), surface.facet_of(Surface::opposite(h)).value());
    }
    return facets.take();
}

}  // namespace kerf

// Half-edges from facets: those at one edge are partners (edge_corners.h), if they are two and opposite.
#include "surface/surface.h"

#include <algorithm>
#include <span>
#include <utility>

#include "core/elements.h"
#include "core/error.h"
#include "surface/edge_corners.h"

namespace kerf {

namespace {

ManifoldDefect edge_defect(ManifoldDefect::Kind kind, std::int32_t low, std::span<const EdgeCorners::Corner> corners) {
    ManifoldDefect defect{kind, {low, corners[0].high}, {}};
    for (const EdgeCorners::Corner& c : corners) defect.facets.push_back(c.corner / 3);
    return defect;
}

enum class VertexCheck : char {
    none,
    fan,   // the facets around the vertex have to be one fan
    open,  // an edge without partner ends here, which is a defect of its own; see is_pinched()
};

// Facets around a vertex that are joined over proper edges form one fan at a manifold vertex.
void find_vertex_defects(const std::vector<Triangle>& facets, const std::vector<std::int32_t>& partner,
                         const std::vector<VertexCheck>& check, std::vector<ManifoldDefect>& defects) {
    const std::size_t vertex_count = check.size();
    std::vector<std::int32_t> degree(vertex_count, 0), fan_size(vertex_count, 0);
    for (std::size_t c = 0; c < partner.size(); ++c) {
        const std::int32_t v = facets[c / 3][c % 3];
        if (check[v] != VertexCheck::fan || degree[v]++ > 0) continue;
        auto turn = static_cast<std::int32_t>(c);
        do {
            ++fan_size[v];
            turn = next_corner(partner[turn]);
        } while (turn != static_cast<std::int32_t>(c));
    }
    std::vector<std::int32_t> slot(vertex_count, -1);
    const std::size_t first_new = defects.size();
    for (std::size_t v = 0; v < vertex_count; ++v)
        if (fan_size[v] != degree[v]) {
            slot[v] = static_cast<std::int32_t>(defects.size());
            defects.push_back({ManifoldDefect::Kind::non_manifold_vertex, {static_cast<std::int32_t>(v)}, {}});
        }
    if (defects.size() == first_new) return;
    for (std::size_t f = 0; f < facets.size(); ++f)
        for (std::int32_t v : facets[f])
            if (slot[v] >= 0) defects[slot[v]].facets.push_back(static_cast<std::int32_t>(f));
}

// True if one of the fans at a vertex has neither gap nor defect towards the others: whatever closes or parts those,
// the surface is pinched here. Fans with a gap may be parts of one fan with several gaps. `around`: the vertex's
// facets.
bool is_pinched(const std::vector<Triangle>& facets, std::int32_t vertex, std::span<const std::int32_t> around) {
    std::vector<std::pair<std::int32_t, std::int32_t>> spokes;  // far end, place in `around`
    for (std::size_t i = 0; i < around.size(); ++i)
        for (std::int32_t v : facets[around[i]])
            if (v != vertex) spokes.emplace_back(v, static_cast<std::int32_t>(i));
    std::sort(spokes.begin(), spokes.end());
    UnionFind fans(around.size());
    std::vector<std::int32_t> at_gap;
    for (std::size_t i = 0, j = 0; i < spokes.size(); i = j) {
        while (j < spokes.size() && spokes[j].first == spokes[i].first) fans.join(spokes[j++].second, spokes[i].second);
        if (j == i + 1) at_gap.push_back(spokes[i].second);
    }
    std::vector<char> has_gap(around.size(), 0);
    for (const std::int32_t i : at_gap) has_gap[fans.root(i)] = 1;
    std::size_t whole = 0;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(around.size()); ++i)
        whole += fans.root(i) == i && !has_gap[i];
    return whole + (at_gap.empty() ? 0 : 1) > 1;
}

void find_pinched_vertices(const std::vector<Triangle>& facets, const std::vector<VertexCheck>& check,
                           std::vector<ManifoldDefect>& defects) {
    std::vector<std::pair<std::int32_t, std::int32_t>> at;  // vertex, facet
    for (std::size_t f = 0; f < facets.size(); ++f)
        for (std::int32_t v : facets[f])
            if (check[v] == VertexCheck::open) at.emplace_back(v, static_cast<std::int32_t>(f));
    std::sort(at.begin(), at.end());
    for (std::size_t i = 0, j = 0; i < at.size(); i = j) {
        std::vector<std::int32_t> around;
        for (; j < at.size() && at[j].first == at[i].first; ++j) around.push_back(at[j].second);
        if (is_pinched(facets, at[i].first, around))
            defects.push_back({ManifoldDefect::Kind::non_manifold_vertex, {at[i].first}, std::move(around)});
    }
}

struct Pairing {
    std::vector<std::int32_t> partner;  // opposite corner per corner, -1 at a defect
    std::vector<ManifoldDefect> defects;
};

// Pairs the corners that have no partner yet, and looks for defects at them.
Pairing pair_corners(std::size_t vertex_count, const std::vector<Triangle>& facets, std::vector<std::int32_t> known) {
    std::vector<VertexCheck> check(vertex_count, VertexCheck::none);
    for (std::size_t c = 0; c < known.size(); ++c)
        if (known[c] < 0) check[facets[c / 3][c % 3]] = check[facets[c / 3][(c + 1) % 3]] = VertexCheck::fan;
    Pairing pairing{std::move(known), {}};
    const auto note_defect = [&](ManifoldDefect::Kind kind, std::int32_t low,
                                 std::span<const EdgeCorners::Corner> corners) {
        pairing.defects.push_back(edge_defect(kind, low, corners));
        check[low] = check[corners[0].high] = VertexCheck::open;
    };
    const EdgeCorners edges(facets, pairing.partner);
    edges.for_each_edge([&](std::int32_t low, std::span<const EdgeCorners::Corner> corners) {
        using Kind = ManifoldDefect::Kind;
        if (corners.size() != 2) {
            note_defect(corners.size() == 1 ? Kind::open_edge : Kind::non_manifold_edge, low, corners);
        } else if (start_vertex(facets, corners[0].corner) == start_vertex(facets, corners[1].corner)) {
            note_defect(Kind::edge_orientation, low, corners);
        } else {
            pairing.partner[corners[0].corner] = corners[1].corner;
            pairing.partner[corners[1].corner] = corners[0].corner;
        }
    });
    find_vertex_defects(facets, pairing.partner, check, pairing.defects);
    if (!pairing.defects.empty()) find_pinched_vertices(facets, check, pairing.defects);
    return pairing;
}

Pairing pair_corners(std::size_t vertex_count, const std::vector<Triangle>& facets) {
    return pair_corners(vertex_count, facets, std::vector<std::int32_t>(3 * facets.size(), -1));
}

const char* name(ManifoldDefect::Kind kind) {
    constexpr std::array names = {"an open edge", "an edge with facets of opposite orientation", "a non-manifold edge",
                                  "a non-manifold vertex"};
    return names[static_cast<std::size_t>(kind)];
}

// OpenMesh's own add_face searches for existing edges; with the partners known the connectivity is written directly.
std::shared_ptr<const HalfEdgeMesh> build_half_edges(const std::vector<Vec3>& vertices,
                                                     const std::vector<Triangle>& facets,
                                                     std::vector<std::int32_t> partner) {
    using Mesh = HalfEdgeMesh;
    const auto shared = std::make_shared<Mesh>();
    Mesh& mesh = *shared;
    mesh.resize(vertices.size(), partner.size() / 2, facets.size());
    for (std::size_t v = 0; v < vertices.size(); ++v)
        mesh.set_point(Mesh::VertexHandle(static_cast<int>(v)), vertices[v]);
    std::vector<std::int32_t>& half_edge = partner;  // a corner is not looked at again once its half-edge is numbered
    std::int32_t edges = 0;
    for (std::size_t c = 0; c < partner.size(); ++c)
        half_edge[c] =
            partner[c] < static_cast<std::int32_t>(c) ? Surface::opposite(half_edge[partner[c]]) : 2 * edges++;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const Mesh::FaceHandle facet(static_cast<int>(f));
        for (std::size_t i = 0; i < 3; ++i) {
            const Mesh::HalfedgeHandle h(half_edge[3 * f + i]), next(half_edge[3 * f + (i + 1) % 3]);
            mesh.set_face_handle(h, facet);
            mesh.set_next_halfedge_handle(h, next);
            mesh.set_vertex_handle(h, Mesh::VertexHandle(facets[f][(i + 1) % 3]));
            mesh.set_halfedge_handle(Mesh::VertexHandle(facets[f][i]), h);
        }
        mesh.set_halfedge_handle(facet, Mesh::HalfedgeHandle(half_edge[3 * f]));
    }
    return shared;
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

std::vector<ManifoldDefect> find_manifold_defects(std::size_t vertex_count, const std::vector<Triangle>& facets) {
    KERF_CHECK(are_in_range(facets, vertex_count) && have_distinct_corners(facets));
    std::vector<ManifoldDefect> defects = pair_corners(vertex_count, facets).defects;
    std::stable_sort(defects.begin(), defects.end(),
                     [](const auto& a, const auto& b) { return a.vertices < b.vertices; });
    return defects;
}

Surface::Surface() : mesh_(std::make_shared<const HalfEdgeMesh>()) {}

Surface::Surface(Paired, SurfaceArrays&& arrays, std::vector<std::int32_t> partner)
    : mesh_(build_half_edges(arrays.vertices, arrays.facets, std::move(partner))),
      points_(mesh_->points()),
      vertex_key_(std::move(arrays.vertex_key)),
      facet_key_(std::move(arrays.facet_key)),
      patch_(std::move(arrays.patch)) {}

std::variant<Surface, ManifoldDefect> Surface::build(SurfaceArrays arrays) {
    std::vector<std::int32_t> none_known(3 * arrays.facets.size(), -1);
    return build(std::move(arrays), std::move(none_known));
}

std::variant<Surface, ManifoldDefect> Surface::build(SurfaceArrays arrays, std::vector<std::int32_t> partner) {
    KERF_CHECK(is_well_formed(arrays));
    KERF_CHECK(are_partners(arrays.facets, partner));
    Pairing pairing = pair_corners(arrays.vertices.size(), arrays.facets, std::move(partner));
    if (!pairing.defects.empty()) {
        ManifoldDefect& first = pairing.defects.front();
        first.where = arrays.vertices[first.vertices.front()];
        return std::move(first);
    }
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

std::int32_t Surface::find_half_edge(std::int32_t from, std::int32_t to) const {
    for (const auto h : around(from))
        if (h.to().idx() == to) return h.idx();
    return -1;
}

SurfaceArrays Surface::arrays() const {
    SurfaceArrays arrays;
    arrays.vertices.reserve(vertex_count());
    for (std::int32_t v = 0; v < vertex_count(); ++v) arrays.vertices.push_back(point(v));
    arrays.facets.reserve(facet_count());
    for (std::int32_t f = 0; f < facet_count(); ++f) arrays.facets.push_back(vertices(f));
    arrays.vertex_key = vertex_key_;
    arrays.facet_key = facet_key_;
    arrays.patch = patch_;
    return arrays;
}

Components find_shells(const Surface& surface) {
    UnionFind facets(static_cast<std::size_t>(surface.facet_count()));
    for (std::int32_t h = 0; h < 3 * surface.facet_count(); h += 2)
        facets.join(surface.facet_of(h), surface.facet_of(Surface::opposite(h)));
    return facets.take();
}

}  // namespace kerf

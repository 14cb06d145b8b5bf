// Only the facets along the contour get new neighbours: two corners that meet at an edge of the parent are partners in
// the half that has both.
#include "cut/cut/split.h"

#include <algorithm>
#include <utility>

#include "base/core/check.h"
#include "base/core/elements.h"
#include "base/core/threads.h"
#include "cut/cut/inside/band.h"

namespace kerf {

namespace {

// Numbers in the half of the parent's vertices, given in the order in which they are met.
class HalfBuilder {
 public:
    explicit HalfBuilder(const Surface& surface)
        : surface_(surface), number_(surface.vertex_count(), -1), corner_at_(surface.edge_count(), -1) {}

    void reserve(std::size_t facets) {
        partner_.reserve(3 * facets);
        half_.facets.reserve(facets);
        half_.facet_key.reserve(facets);
        half_.patch.reserve(facets);
        half_.vertices.reserve(facets / 2 + 2);
        half_.vertex_key.reserve(facets / 2 + 2);
    }
    std::int32_t vertex(Vertex parent_vertex) {
        std::int32_t& number = number_[parent_vertex];
        if (number < 0) number = add_point(surface_.point(parent_vertex), surface_.vertex_key(parent_vertex));
        return number;
    }
    std::int32_t add_point(const Vec3& point, Key key) {
        half_.vertices.push_back(point);
        half_.vertex_key.push_back(key);
        return count_of(half_.vertices) - 1;
    }
    void add_parent_facet(Facet facet) {
        const auto t = surface_.corners(facet);
        for (const HalfEdge half_edge : surface_.half_edges(facet)) join(Surface::edge_of(half_edge));
        push_facet({vertex(t[0]), vertex(t[1]), vertex(t[2])}, surface_.facet_key(facet), surface_.patch(facet));
    }
    void add_interface_facet(const Triangle& facet, Key key) {
        partner_.insert(partner_.end(), 3, -1);
        push_facet(facet, key, -1);
    }
    Half take() { return {std::move(half_), std::move(partner_)}; }

 private:
    void push_facet(const Triangle& facet, Key key, std::int32_t patch) {
        half_.facets.push_back(facet);
        half_.facet_key.push_back(key);
        half_.patch.push_back(patch);
    }
    // Adds a corner at an edge of the parent, the partner of the corner that came there before.
    void join(Edge edge) {
        const std::int32_t corner = count_of(partner_);
        const std::int32_t earlier = std::exchange(corner_at_[edge], corner);
        partner_.push_back(earlier);
        if (earlier >= 0) partner_[earlier] = corner;
    }

    const Surface& surface_;
    Array<Vertex, std::int32_t> number_;   // per vertex of the parent
    Array<Edge, std::int32_t> corner_at_;  // per edge of the parent
    SurfaceArrays half_;
    std::vector<std::int32_t> partner_;
};

Half build_half(const Surface& surface, const Array<Facet, Side>& sides, Side side, const Interface& interface,
                NodeId node) {
    HalfBuilder half(surface);
    half.reserve(std::count(sides.begin(), sides.end(), side) + interface.triangles.size());
    for (const Facet f : surface.facets())
        if (sides[f] == side) half.add_parent_facet(f);
    std::vector<std::int32_t> number;
    for (const Vertex v : interface.contour) number.push_back(half.vertex(v));
    const std::int32_t contour_count = count_of(number);
    for (std::int32_t i = contour_count; i < count_of(interface.points); ++i)
        number.push_back(half.add_point(interface.points[i], make_key(node, i - contour_count)));
    for (std::int32_t i = 0; i < count_of(interface.triangles); ++i) {
        Triangle t = {number[interface.triangles[i][0]], number[interface.triangles[i][1]],
                      number[interface.triangles[i][2]]};
        if (side == Side::above) std::swap(t[1], t[2]);
        half.add_interface_facet(t, make_key(node, i));
    }
    return half.take();
}

}  // namespace

std::array<Half, 2> split(const Surface& surface, const Array<Facet, Side>& side, const Interface& interface,
                          NodeId node) {
    KERF_CHECK(fit(side, surface) && node >= root_node);
    KERF_CHECK(interface.contour.size() <= interface.points.size());
    KERF_CHECK(are_in_range(interface.triangles, interface.points.size()));
    std::array<Half, 2> halves;
    for_each_on_threads(2, [&](std::size_t i) {
        halves[i] = build_half(surface, side, i == 0 ? Side::below : Side::above, interface, node);
    });
    return halves;
}

}  // namespace kerf

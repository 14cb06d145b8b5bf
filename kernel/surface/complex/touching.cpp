// The two facets of an ordinary edge are partners. At an edge of more facets these are sorted around it
// (radial_order.h), and two that follow each other with the body between them are partners. Fans are the cycles of
// partners around a vertex. All else follows from partners, without coordinates.
#include "surface/complex/touching.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "surface/soup/edge_corners.h"
#include "surface/soup/radial_order.h"

namespace kerf {

namespace {

constexpr std::size_t bits_per_key = 64;  // more would be slower than to sort

[[noreturn]] void refuse_edge(const SurfaceArrays& surface, std::int32_t low, std::int32_t high, const char* reason) {
    const Vec3& p = surface.vertices[low];
    throw Error(ErrorCode::internal, fmt::format("The facets at the edge of vertices {} and {} ({}, {}, {}) {}.", low,
                                                 high, p.x(), p.y(), p.z(), reason));
}

// Calls join(corner, corner) for the two sides of each wedge of the body at an edge.
template <class Join>
void for_each_wedge(const SurfaceArrays& surface, std::int32_t low, std::span<const EdgeCorners::Corner> corners,
                    Join join) {
    const auto refuse = [&](const char* reason) { refuse_edge(surface, low, corners[0].high, reason); };
    const auto [order, defect] = radial_order(surface.vertices, surface.facets, low, corners);
    if (defect != RadialDefect::none) refuse(defect == RadialDefect::no_area ? "have no area" : "lie on one another");
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::int32_t c = order[i], d = order[(i + 1) % order.size()];
        const bool has_body_ahead = has_back_ahead(surface.facets, low, c);
        if (has_body_ahead == has_back_ahead(surface.facets, low, d)) refuse("do not close");
        if (has_body_ahead) join(c, d);
    }
}

struct WedgePairs {
    std::vector<std::int32_t> partner;  // per corner
    bool has_shared_edge = false;       // of more than two facets
};

WedgePairs pair_by_wedges(const SurfaceArrays& surface) {
    WedgePairs pairs{std::vector<std::int32_t>(3 * surface.facets.size(), -1), false};
    const auto join = [&](std::int32_t c, std::int32_t d) {
        pairs.partner[c] = d;
        pairs.partner[d] = c;
    };
    const EdgeCorners edges(surface.facets);
    edges.for_each_edge([&](std::int32_t low, std::span<const EdgeCorners::Corner> corners) {
        if (corners.size() > 2) {
            pairs.has_shared_edge = true;
            for_each_wedge(surface, low, corners, join);
            return;
        }
        if (corners.size() == 1 ||
            start_vertex(surface.facets, corners[0].corner) == start_vertex(surface.facets, corners[1].corner))
            refuse_edge(surface, low, corners[0].high, "do not close");
        join(corners[0].corner, corners[1].corner);
    });
    return pairs;
}

// Calls visit(corner) for the corners of a fan at their common start.
template <class Visit>
void for_each_in_fan(const std::vector<std::int32_t>& partner, std::int32_t first, Visit visit) {
    std::int32_t corner = first;
    do {
        visit(corner);
        corner = next_corner(partner[corner]);
    } while (corner != first);
}

// The first corner of every fan but the first one of each vertex, ordered by vertex.
std::vector<std::int32_t> find_further_fans(const SurfaceArrays& surface, const std::vector<std::int32_t>& partner) {
    std::vector<char> is_seen(partner.size(), 0), has_fan(surface.vertices.size(), 0);
    std::vector<std::int32_t> further;
    for (std::int32_t first = 0; first < count_of(partner); ++first) {
        if (is_seen[first]) continue;
        for_each_in_fan(partner, first, [&](std::int32_t corner) { is_seen[corner] = 1; });
        if (std::exchange(has_fan[start_vertex(surface.facets, first)], char{1})) further.push_back(first);
    }
    std::stable_sort(further.begin(), further.end(), [&](std::int32_t c, std::int32_t d) {
        return start_vertex(surface.facets, c) < start_vertex(surface.facets, d);
    });
    return further;
}

// The keys of one node of the tree, in a row of bits.
struct KeyRow {
    NodeId node;
    std::size_t size = 0, first = 0;
};

KeyRow& row_of(std::vector<KeyRow>& rows, NodeId node) {
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const KeyRow& row) { return row.node == node; });
    return found != rows.end() ? *found : rows.emplace_back(KeyRow{node});
}

std::vector<Key> repeated_sorted_keys(const Surface& surface) {
    std::vector<Key> keys, repeated;
    for (const Vertex v : surface.vertices()) keys.push_back(surface.vertex_key(v));
    std::sort(keys.begin(), keys.end());
    for (std::size_t i = 1; i < keys.size(); ++i)
        if (keys[i] == keys[i - 1]) repeated.push_back(keys[i]);
    return repeated;
}

// Returns the keys that several vertices have, ascending, perhaps several times each.
std::vector<Key> repeated_keys(const Surface& surface) {
    std::vector<KeyRow> rows;
    for (const Vertex v : surface.vertices()) {
        const Key key = surface.vertex_key(v);
        KeyRow& row = row_of(rows, key_node(key));
        row.size = std::max(row.size, std::size_t{static_cast<std::uint32_t>(key_index(key))} + 1);
    }
    std::size_t bits = 0;
    for (KeyRow& row : rows) row.first = std::exchange(bits, bits + row.size);
    if (bits > bits_per_key * static_cast<std::size_t>(surface.vertex_count())) return repeated_sorted_keys(surface);
    std::vector<bool> is_seen(bits, false);
    std::vector<Key> repeated;
    for (const Vertex v : surface.vertices()) {
        const Key key = surface.vertex_key(v);
        auto bit = is_seen[row_of(rows, key_node(key)).first + static_cast<std::uint32_t>(key_index(key))];
        if (bit) repeated.push_back(key);
        bit = true;
    }
    std::sort(repeated.begin(), repeated.end());
    return repeated;
}

}  // namespace

SeparatedSurface separate_touching(SurfaceArrays arrays) {
    KERF_CHECK(is_well_formed(arrays));
    WedgePairs pairs = pair_by_wedges(arrays);
    const std::vector<std::int32_t> fans = find_further_fans(arrays, pairs.partner);
    SeparatedSurface separated{std::move(arrays), std::move(pairs.partner), {}};
    if (fans.empty() && !pairs.has_shared_edge) return separated;
    SurfaceArrays& surface = separated.arrays;
    separated.original.resize(surface.vertices.size());
    std::iota(separated.original.begin(), separated.original.end(), 0);
    for (const std::int32_t first : fans) {
        const std::int32_t vertex = start_vertex(surface.facets, first);
        const auto copy = count_of(surface.vertices);
        for_each_in_fan(separated.partner, first,
                        [&](std::int32_t corner) { surface.facets[corner / 3][corner % 3] = copy; });
        surface.vertices.push_back(Vec3(surface.vertices[vertex]));
        surface.vertex_key.push_back(Key{surface.vertex_key[vertex]});
        separated.original.push_back(vertex);
    }
    return separated;
}

Surface to_surface(SeparatedSurface separated) {
    auto built = Surface::build(std::move(separated.arrays), std::move(separated.partner));
    if (const auto* defect = std::get_if<ManifoldDefect>(&built))
        throw Error(ErrorCode::internal, fmt::format("The surface that was taken apart has a defect at vertex {}.",
                                                     defect->vertices.front()));
    return std::move(std::get<Surface>(built));
}

Surface separated_surface(const SurfaceArrays& arrays) {
    auto built = Surface::build(SurfaceArrays(arrays));
    if (auto* surface = std::get_if<Surface>(&built)) return std::move(*surface);
    return to_surface(separate_touching(arrays));
}

SurfaceArrays joined_by_key(SurfaceArrays arrays) {
    KERF_CHECK(is_well_formed(arrays));
    const std::size_t count = arrays.vertices.size();
    std::vector<std::int32_t> order(count), number(count);
    std::iota(order.begin(), order.end(), 0);
    const std::vector<Key>& key = arrays.vertex_key;
    std::sort(order.begin(), order.end(),
              [&](std::int32_t v, std::int32_t w) { return key[v] != key[w] ? key[v] < key[w] : v < w; });
    bool all_differ = true;
    for (std::size_t i = 0; i < count; ++i) {  // the first vertex of each key
        const bool is_first = i == 0 || key[order[i]] != key[order[i - 1]];
        number[order[i]] = is_first ? order[i] : number[order[i - 1]];
        all_differ &= is_first;
    }
    if (all_differ) return arrays;
    std::int32_t kept = 0;
    for (std::int32_t v = 0; v < count_of(number); ++v) {
        if (number[v] != v) {
            number[v] = number[number[v]];  // the first one has its number already
            continue;
        }
        arrays.vertices[kept] = arrays.vertices[v];
        arrays.vertex_key[kept] = arrays.vertex_key[v];
        number[v] = kept++;
    }
    arrays.vertices.resize(kept);
    arrays.vertex_key.resize(kept);
    for (Triangle& t : arrays.facets)
        for (std::int32_t& v : t) v = number[v];
    return arrays;
}

Array<Vertex, char> copied_vertices(const Surface& surface) {
    const std::vector<Key> repeated = repeated_keys(surface);
    if (repeated.empty()) return {};
    Array<Vertex, char> is_copied(surface.vertex_count(), 0);
    for (const Vertex v : surface.vertices())
        is_copied[v] = std::binary_search(repeated.begin(), repeated.end(), surface.vertex_key(v));
    return is_copied;
}

bool has_touching_edge(const Surface& surface, Vertex vertex) {
    std::vector<Key> ends;
    for (const HalfEdge h : surface.around(vertex)) ends.push_back(surface.vertex_key(surface.to_vertex(h)));
    std::sort(ends.begin(), ends.end());
    return std::adjacent_find(ends.begin(), ends.end()) != ends.end();
}

}  // namespace kerf

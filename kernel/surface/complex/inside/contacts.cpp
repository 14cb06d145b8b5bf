#include "surface/complex/inside/contacts.h"

#include <algorithm>

#include "base/geometry/union_find.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

std::array<Key, 2> edge_of(Key a, Key b) { return {std::min(a, b), std::max(a, b)}; }

template <class T>
void sort_unique(std::vector<T>& items) {
    std::sort(items.begin(), items.end());
    items.erase(std::unique(items.begin(), items.end()), items.end());
}

// The corner of a facet at its vertex where this corner, an edge, ends.
std::int32_t corner_at_end(std::int32_t corner) { return next_corner(corner); }

}  // namespace

bool Contacts::has(Key vertex) const { return std::binary_search(vertices.begin(), vertices.end(), vertex); }
bool Contacts::has(Key a, Key b) const { return std::binary_search(edges.begin(), edges.end(), edge_of(a, b)); }

Contacts find_contacts(const std::vector<Triangle>& outer, std::span<const Key> key) {
    Contacts contacts;
    UnionFind fans(3 * outer.size());  // of corners at their vertices
    EdgeCorners(outer).for_each_edge([&](std::int32_t low, std::span<const EdgeCorners::Corner> corners) {
        if (corners.size() > 2) {
            const Key a = key[low], b = key[corners.front().high];
            contacts.edges.push_back(edge_of(a, b));
            contacts.vertices.insert(contacts.vertices.end(), {a, b});
        } else if (corners.size() == 2) {
            const std::int32_t c = corners[0].corner, d = corners[1].corner;
            const bool same_start = start_vertex(outer, c) == start_vertex(outer, d);
            fans.join(c, same_start ? d : corner_at_end(d));
            fans.join(corner_at_end(c), same_start ? corner_at_end(d) : d);
        }
    });
    std::vector<std::int32_t> fan_of_vertex(key.size(), -1);
    for (std::int32_t corner = 0; corner < 3 * static_cast<std::int32_t>(outer.size()); ++corner) {
        std::int32_t& fan = fan_of_vertex[start_vertex(outer, corner)];
        const std::int32_t own = fans.root(corner);
        if (fan < 0) fan = own;
        if (fan != own) contacts.vertices.push_back(key[start_vertex(outer, corner)]);
    }
    sort_unique(contacts.vertices);
    sort_unique(contacts.edges);
    return contacts;
}

}  // namespace kerf

// Each part lists its interface edges, an entry for each part beyond a triangle at the edge, sorted by edge. One
// neighbour at an edge means that the two alone hold it there, and both know that without a message. With two or more,
// or at a contact, where nobody is seen beyond a triangle, the part tells all holders that it knows; a part's holders
// are those that it meets and those that others have told. The holders of an edge are sorted by their places in the
// tree, and edges with equal holders make a group, so that all parts of a group list its edges in the same order: by
// global numbers.
#include "files/part/shared_edges.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace kerf {

namespace {

constexpr NodeId any_part = NodeId::none();

// An edge of an interface with the part on the other side of one of its two triangles, or an edge of a contact.
struct InterfaceEdge {
    std::array<std::int64_t, 2> edge;  // global numbers
    NodeId neighbour;                  // any_part: at a contact, where any part may be
    UndirectedEdge corners;            // vertices of the part, in the order of the global numbers

    auto key() const { return std::tie(edge, neighbour); }
};

InterfaceEdge interface_edge(const Part& part, std::int32_t a, std::int32_t b, NodeId neighbour) {
    std::int64_t id_a = part.global_id[a], id_b = part.global_id[b];
    if (id_b < id_a) {
        std::swap(a, b);
        std::swap(id_a, id_b);
    }
    return {{id_a, id_b}, neighbour, {a, b}};
}

// Returns the edges of interfaces and contacts, ascending by edge, then neighbour; each pair once.
std::vector<InterfaceEdge> interface_edges(const Part& part) {
    std::vector<InterfaceEdge> edges;
    for (std::size_t f = 0; f < part.facets.size(); ++f)
        if (part.is_interface(f))
            for (std::size_t corner = 0; corner < 3; ++corner)
                edges.push_back(
                    interface_edge(part, part.facets[f][corner], part.facets[f][(corner + 1) % 3], part.neighbour[f]));
    for (const auto& [a, b] : part.contact_edges) edges.push_back(interface_edge(part, a, b, any_part));
    const auto less = [](const InterfaceEdge& a, const InterfaceEdge& b) { return a.key() < b.key(); };
    const auto same = [](const InterfaceEdge& a, const InterfaceEdge& b) { return a.key() == b.key(); };
    std::sort(edges.begin(), edges.end(), less);
    edges.erase(std::unique(edges.begin(), edges.end(), same), edges.end());
    return edges;
}

// Calls take(begin, end) with the range of each edge.
template <class Take>
void for_each_edge(const std::vector<InterfaceEdge>& edges, Take take) {
    for (auto begin = edges.begin(), end = begin; begin != edges.end(); begin = end) {
        end = std::find_if(begin, edges.end(), [&](const InterfaceEdge& other) { return other.edge != begin->edge; });
        take(begin, end);
    }
}

}  // namespace

std::vector<SharedEdges::Incidence> SharedEdges::incidences_of(const Part& part) {
    std::vector<Incidence> told;
    for_each_edge(interface_edges(part), [&](auto begin, auto end) {
        const bool is_contact = begin->neighbour == any_part;  // the smallest of all
        if (end - begin < 2 && !is_contact) return;
        told.push_back({begin->edge, part.id});
        for (auto met = begin; met != end; ++met)
            if (met->neighbour != any_part) told.push_back({met->edge, met->neighbour});
    });
    return told;
}

SharedEdges::SharedEdges(std::vector<Incidence> told, const std::vector<NodeId>& ids)
    : incidences_(std::move(told)), ids_(ids.begin(), ids.end()), index_(ids) {
    std::sort(incidences_.begin(), incidences_.end());
    incidences_.erase(std::unique(incidences_.begin(), incidences_.end()), incidences_.end());
}

std::vector<SharedEdgeGroup> SharedEdges::groups_of(const Part& part) const {
    std::map<std::vector<PartIndex>, std::vector<UndirectedEdge>> edges_of;  // by the parts that hold them
    std::vector<PartIndex> holders;
    for_each_edge(interface_edges(part), [&](auto begin, auto end) {
        holders.assign(1, index_.of(part.id));
        for (auto met = begin; met != end; ++met)
            if (met->neighbour != any_part) holders.push_back(index_.of(met->neighbour));
        auto told = std::lower_bound(incidences_.begin(), incidences_.end(), begin->edge,
                                     [](const Incidence& held, const auto& wanted) { return held.edge < wanted; });
        for (; told != incidences_.end() && told->edge == begin->edge; ++told) holders.push_back(index_.of(told->part));
        std::sort(holders.begin(), holders.end());
        holders.erase(std::unique(holders.begin(), holders.end()), holders.end());
        if (holders.size() < 2) return;  // nothing touches the part here
        edges_of[holders].push_back(begin->corners);
    });
    std::vector<SharedEdgeGroup> groups;
    for (auto& [parts, edges] : edges_of) {
        SharedEdgeGroup& group = groups.emplace_back();
        for (const PartIndex holder : parts) group.parts.push_back(ids_[holder]);
        group.edges = std::move(edges);
    }
    return groups;
}

}  // namespace kerf

// A piece is a run of leaves in the order of the tree, all below one node, whose number it takes: so the pieces are
// leaves of a smaller tree, and "the order of the tree" and "the first part owns" hold for them unchanged. Triangles
// between two leaves of a piece are dropped; a vertex or an edge that several leaves hold is kept once, found by its
// global number among those that any leaf shares. Groups of shared vertices are groups of holders, with leaves replaced
// by pieces and merged where two become equal; groups that have one piece left are inside and vanish. Vertices of the
// remaining facets are numbered first, because a part has its boundary first. The counts of an outline need every part
// once: a shared vertex counts in the first leaf of the piece that has it.
#include "files/part/joined_parts.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "base/core/check.h"
#include "base/core/error.h"

namespace kerf {

namespace {

void divide(const std::vector<NodeId>& leaves, PieceOfTree node, std::int32_t pieces,
            std::vector<PieceOfTree>& divided) {
    if (pieces == 1) return divided.push_back(node);
    const std::int32_t count = node.last - node.first;
    const auto begin = leaves.begin() + node.first, end = leaves.begin() + node.last;
    const auto middle =
        std::partition_point(begin, end, [&](NodeId leaf) { return lies_below(leaf, child_of(node.id, 0)); });
    const std::int32_t on_left = middle - begin, on_right = count - on_left;
    const std::int32_t fair = std::lround(static_cast<double>(pieces) * on_left / count);
    const std::int32_t left = std::clamp(fair, std::max(1, pieces - on_right), std::min(on_left, pieces - 1));
    divide(leaves, {child_of(node.id, 0), node.first, node.first + on_left}, left, divided);
    divide(leaves, {child_of(node.id, 1), node.first + on_left, node.last}, pieces - left, divided);
}

// The vertices of a piece. Of a vertex that several of its parts have, the first stands for all.
class PieceVertices {
 public:
    PieceVertices(const std::vector<Part>& parts) : parts_(parts) {
        for (std::size_t p = 0; p < parts.size(); ++p) {
            place_.emplace_back(parts[p].mesh.vertices.size(), -1);
            for (const SharedGroup& group : parts[p].shared)
                for (const std::int32_t v : group.vertices) shared_.push_back({parts[p].global_id[v], -1});
        }
        std::sort(shared_.begin(), shared_.end());
        shared_.erase(std::unique(shared_.begin(), shared_.end()), shared_.end());
        for (const Part& part : parts) mark_shared(part);
    }

    /// Returns the number of vertex v of part p in the piece, which it gets when it is first asked for.
    std::int32_t operator()(std::size_t p, std::int32_t v, Part& piece) {
        const std::int32_t i = v;
        std::int32_t& place = place_[p][i];
        if (place >= 0) return place;
        const std::int64_t id = parts_[p].global_id[i];
        std::int32_t* const of_shared = is_shared_[p][i] ? &find(id)->second : nullptr;
        if (of_shared && *of_shared >= 0) return place = *of_shared;
        place = std::ssize(piece.mesh.vertices);
        if (of_shared) *of_shared = place;
        piece.mesh.vertices.push_back(parts_[p].mesh.vertices[i]);
        piece.global_id.push_back(id);
        return place;
    }

 private:
    using Shared = std::pair<std::int64_t, std::int32_t>;  // global number, place in the piece

    void mark_shared(const Part& part) {
        std::vector<char>& marks = is_shared_.emplace_back(part.mesh.vertices.size(), 0);
        for (const SharedGroup& group : part.shared)
            for (const std::int32_t v : group.vertices) marks[v] = 1;
    }
    std::vector<Shared>::iterator find(std::int64_t id) {
        return std::lower_bound(shared_.begin(), shared_.end(), id,
                                [](const Shared& s, std::int64_t wanted) { return s.first < wanted; });
    }

    const std::vector<Part>& parts_;
    std::vector<std::vector<std::int32_t>> place_;
    std::vector<std::vector<char>> is_shared_;
    std::vector<Shared> shared_;  // ascending
};

// Returns the triangles of the part that bound the piece, too.
std::vector<std::size_t> facets_of_piece(const Part& part, const std::vector<NodeId>& piece_of_neighbour,
                                         NodeId piece) {
    std::vector<std::size_t> facets;
    for (std::size_t f = 0; f < part.facets.size(); ++f)
        if (!part.is_interface(f) || piece_of_neighbour[f] != piece) facets.push_back(f);
    return facets;
}

// Gives the piece, whose tetrahedra are there, the nodes on its edges, as its parts have them; nodes of an edge of
// several parts are the same. Returns for each part the numbers of its edges in the piece.
template <class VertexInPiece>
std::vector<std::vector<std::int32_t>> join_edge_nodes(const std::vector<Part>& parts, const VertexInPiece& vertex,
                                                       Part& piece) {
    EdgeNodes& nodes = piece.edge_nodes;
    nodes.edges = EdgeTable(piece.mesh.tets, piece.mesh.vertices.size());
    nodes.points.resize(nodes.edges.size());
    nodes.global_id.resize(nodes.edges.size());
    std::vector<std::vector<std::int32_t>> edges_of_parts;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const EdgeNodes& own = parts[p].edge_nodes;
        std::vector<std::int32_t>& edges = edges_of_parts.emplace_back();
        own.edges.for_all([&](std::int64_t e, const UndirectedEdge& edge) {
            const std::int32_t to = nodes.edges.find(undirected(vertex(p, edge[0]), vertex(p, edge[1])));
            nodes.points[to] = own.points[e];
            nodes.global_id[to] = own.global_id[e];
            edges.push_back(to);
        });
    }
    return edges_of_parts;
}

// Returns the k-th values of the parts: at cells one part behind the other, at points in the order of node(p, n). A
// node that several parts have gets the values of the first one: at walls between materials, stresses differ.
template <class NodeInPiece>
PartValues join_values(const std::vector<Part>& parts, std::size_t k, const NodeInPiece& node) {
    PartValues joined = parts.front().values[k];
    const std::size_t width = joined.components;
    std::visit(
        [&](auto& numbers) {
            using Numbers = std::decay_t<decltype(numbers)>;
            numbers.clear();
            const auto own_of = [&](const Part& part) -> const Numbers& {
                return std::get<Numbers>(part.values[k].numbers);
            };
            if (joined.of == PartValues::Of::tets) {
                for (const Part& part : parts) numbers.insert(numbers.end(), own_of(part).begin(), own_of(part).end());
                return;
            }
            for (std::size_t p = parts.size(); p-- > 0;)  // so that the first one has the last word
                for (std::int64_t n = 0; n < parts[p].node_count(); ++n) {
                    const std::size_t to = width * node(p, n);
                    if (numbers.size() < to + width) numbers.resize(to + width);
                    std::copy_n(own_of(parts[p]).begin() + width * n, width, numbers.begin() + to);
                }
        },
        joined.numbers);
    return joined;
}

}  // namespace

std::vector<PieceOfTree> divide_leaves(const std::vector<NodeId>& leaves, std::int32_t pieces) {
    const std::int32_t count = std::ssize(leaves);
    KERF_CHECK(pieces >= 1 && pieces <= count);
    std::vector<PieceOfTree> divided;
    divide(leaves, {root_node, 0, count}, pieces, divided);
    return divided;
}

JoinedParts::JoinedParts(const PartSource& parts, std::int32_t pieces, std::int64_t most) : parts_(parts) {
    const MeshOutline& whole = parts.outline();
    const std::int32_t count = std::ssize(whole.parts);
    if (pieces < 1 || pieces > count)
        throw Error(ErrorCode::usage,
                    fmt::format("--into is {}, but {} parts can be joined into 1 to {} pieces.", pieces, count, count));
    std::vector<NodeId> leaves;
    for (const PartExtent& part : whole.parts) leaves.push_back(part.id);
    pieces_ = divide_leaves(leaves, pieces);
    for (const PieceOfTree& piece : pieces_)
        for (std::int32_t r = piece.first; r < piece.last; ++r) piece_of_leaf_.emplace_back(leaves[r], piece.id);
    std::sort(piece_of_leaf_.begin(), piece_of_leaf_.end());
    const auto require_numbers = [&](const PieceOfTree& piece, std::int64_t number, const char* what) {
        if (number > most)
            throw Error(
                ErrorCode::usage,
                fmt::format("--into {} makes a piece of {} {} of parts {} to {}, but a piece has {} at most. Ask "
                            "for more pieces.",
                            pieces, number, what, leaves[piece.first].value(), leaves[piece.last - 1].value(), most));
    };
    for (const PieceOfTree& piece : pieces_) {
        std::int64_t tets = 0;
        for (std::int32_t r = piece.first; r < piece.last; ++r) tets += whole.parts[r].tets;
        require_numbers(piece, tets, "tetrahedra");
    }
    outline_ = whole;
    outline_.parts.clear();
    for (const PieceOfTree& piece : pieces_) {
        PartExtent& extent = outline_.parts.emplace_back();
        extent.id = piece.id;
        for (std::int32_t r = piece.first; r < piece.last; ++r) {
            const Part part = parts.load(PartIndex(r));
            extent.tets += part.tet_count();
            extent.vertices += part.vertex_count();
            const std::vector<NodeId> beside = pieces_of(part.neighbour);
            for (std::size_t f = 0; f < part.facets.size(); ++f)
                (is_listed_triangle(part.patch[f], piece.id, beside[f]) ? extent.patch_facets
                                                                        : extent.interface_facets) +=
                    !part.is_interface(f) || beside[f] != piece.id;
            extent.edge_nodes += std::ssize(part.edge_nodes.global_id);
            // A vertex counts in the first part of the piece that has it, and so does an edge.
            const auto is_counted = [&](const std::vector<NodeId>& holders) {
                const std::vector<NodeId> held_by = pieces_of(holders);
                return holders[std::find(held_by.begin(), held_by.end(), piece.id) - held_by.begin()] == part.id;
            };
            for (const SharedGroup& group : part.shared)
                if (!is_counted(group.parts)) extent.vertices -= std::ssize(group.vertices);
            if (whole.order == 1) continue;
            for (const SharedEdgeGroup& group : part.shared_edges)
                if (!is_counted(group.parts)) extent.edge_nodes -= std::ssize(group.edges);
        }
        require_numbers(piece, extent.vertices + extent.edge_nodes, whole.order == 1 ? "vertices" : "nodes");
        require_numbers(piece, extent.patch_facets + extent.interface_facets, "triangles");
    }
}

// Returns the piece of each leaf, -1 where there is no leaf.
std::vector<NodeId> JoinedParts::pieces_of(const std::vector<NodeId>& leaves) const {
    std::vector<NodeId> pieces;
    pieces.reserve(leaves.size());
    for (const NodeId leaf : leaves) {
        const auto found = std::lower_bound(piece_of_leaf_.begin(), piece_of_leaf_.end(), leaf,
                                            [](const auto& entry, NodeId wanted) { return entry.first < wanted; });
        pieces.push_back(leaf.is_valid() ? found->second : NodeId::none());
    }
    return pieces;
}

// Returns the groups that a piece shares with others, by the pieces that hold them: items ascending by id(item), each
// once.
template <class Group, class Item, class InPiece, class IdOf>
std::vector<Group> JoinedParts::join_groups(const std::vector<Part>& parts, std::vector<Group> PartBoundary::*groups,
                                            std::vector<Item> Group::*items, const InPiece& in_piece,
                                            const IdOf& id) const {
    std::map<std::vector<PartIndex>, std::vector<Item>> items_of;
    for (std::size_t p = 0; p < parts.size(); ++p)
        for (const Group& group : parts[p].*groups) {
            const std::vector<PartIndex> holders = indices_of(group.parts);
            if (holders.size() < 2) continue;
            for (const Item& item : group.*items) items_of[holders].push_back(in_piece(p, item));
        }
    std::vector<Group> joined;
    for (auto& [holders, found] : items_of) {
        std::sort(found.begin(), found.end(), [&](const Item& a, const Item& b) { return id(a) < id(b); });
        found.erase(std::unique(found.begin(), found.end()), found.end());
        joined.push_back({ids_of(holders), std::move(found)});
    }
    return joined;
}

Part JoinedParts::load(PartIndex index) const {
    const PieceOfTree& range = pieces_[index.value()];
    std::vector<Part> parts;
    for (std::int32_t r = range.first; r < range.last; ++r) parts.push_back(parts_.load(PartIndex(r)));
    Part piece;
    piece.id = range.id;
    piece.patch_names = outline_.patch_names;
    piece.region_names = outline_.region_names;
    PieceVertices vertex_in_piece(parts);
    std::int32_t first_tet = 0;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const Part& part = parts[p];
        const std::vector<NodeId> beside = pieces_of(part.neighbour);
        for (const std::size_t f : facets_of_piece(part, beside, range.id)) {
            Triangle& facet = piece.facets.emplace_back(part.facets[f]);
            for (std::int32_t& v : facet) v = vertex_in_piece(p, v, piece);
            piece.patch.push_back(part.patch[f]);
            piece.facet.push_back(part.facet[f]);
            piece.neighbour.push_back(beside[f]);
            piece.tet_at_facet.push_back(part.tet_at_facet[f] < 0 ? -1 : first_tet + part.tet_at_facet[f]);
        }
        for (const RegionRun& run : part.regions)
            if (piece.regions.empty() || piece.regions.back().region != run.region)
                piece.regions.push_back({first_tet + run.first_tet, run.region});
        first_tet += part.tet_count();
    }
    piece.mesh.boundary_vertex_count = std::ssize(piece.mesh.vertices);
    for (std::size_t p = 0; p < parts.size(); ++p)
        for (Tetrahedron tet : parts[p].mesh.tets) {
            for (std::int32_t& v : tet) v = vertex_in_piece(p, v, piece);
            piece.mesh.tets.push_back(tet);
        }
    piece.shared = join_groups(
        parts, &Part::shared, &SharedGroup::vertices,
        [&](std::size_t p, std::int32_t v) { return vertex_in_piece(p, v, piece); },
        [&](std::int32_t v) { return piece.global_id[v]; });
    piece.shared_edges = join_groups(
        parts, &Part::shared_edges, &SharedEdgeGroup::edges,
        [&](std::size_t p, const UndirectedEdge& edge) {
            const std::int32_t first = vertex_in_piece(p, edge[0], piece);
            return UndirectedEdge{first, vertex_in_piece(p, edge[1], piece)};
        },
        [&](const UndirectedEdge& edge) { return std::pair(piece.global_id[edge[0]], piece.global_id[edge[1]]); });
    const auto vertex = [&](std::size_t p, std::int32_t v) { return vertex_in_piece(p, v, piece); };
    std::vector<std::vector<std::int32_t>> edges_of_parts;
    if (outline_.order == 2) edges_of_parts = join_edge_nodes(parts, vertex, piece);
    const auto node = [&](std::size_t p, std::int64_t n) -> std::int64_t {
        const std::int64_t on_edge = n - parts[p].first_edge_node();
        return on_edge < 0 ? vertex(p, n) : piece.first_edge_node() + edges_of_parts[p][on_edge];
    };
    for (std::size_t k = 0; k < outline_.values.size(); ++k) piece.values.push_back(join_values(parts, k, node));
    return piece;
}

// Returns the pieces that the leaves lie in, in the order of the tree, each once.
std::vector<PartIndex> JoinedParts::indices_of(const std::vector<NodeId>& leaves) const {
    std::vector<PartIndex> indices;
    for (const NodeId holder : pieces_of(leaves)) indices.push_back(outline_.index_of(holder));
    indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
    return indices;
}

std::vector<NodeId> JoinedParts::ids_of(const std::vector<PartIndex>& indices) const {
    std::vector<NodeId> ids;
    for (const PartIndex index : indices) ids.push_back(outline_.parts[index].id);
    return ids;
}

}  // namespace kerf

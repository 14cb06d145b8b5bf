// Nodes are numbered without comparing coordinates. Part::shared and Part::shared_edges list the vertices and edges
// that a part has in common with others, by the set of its holders and in an order that is the same for all of them;
// the first holder owns them. Each part counts its own nodes, a sum over the ranks gives the first row of each part,
// and owners tell the rows to the other holders by lists that both sides have in the same order (`PairedNodes`). Rows
// that another rank owns are ghosts here, ascending by row (Ownership::of_numbers()). Notation: a row is the number of
// a node over all ranks, a local node its number on this rank; a part's nodes are its vertices, then its edges; `owned`
// and `held` are pairs of parts (owner, holder) in which this rank has the owner or the holder.
#include "solve/space/fe_space.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/number_text.h"
#include "fill/mesh/edge_table.h"

namespace kerf {

namespace {

constexpr std::int32_t unset = -1;

// The nodes of a part: its vertices, then its edges.
struct NumberedPart {
    PartIndex index;                 // in the outline
    std::optional<EdgeTable> edges;  // for order 2, of a part without nodes on its edges
    std::vector<PartIndex> owner;    // of each node
    std::vector<std::int64_t> row;   // of each node

    const EdgeTable& edges_of(const Part& part) const { return edges ? *edges : part.edge_nodes.edges; }
};

// Nodes that two parts of the outline share, by (owner, holder): numbers in one of them, in an order that is the same
// for both.
using PairedNodes = std::map<std::array<PartIndex, 2>, std::vector<std::int32_t>>;

class FeNumbering {
 public:
    FeNumbering(const MpiRanks& ranks, const MeshOutline& outline, const std::vector<PartIndex>& first_parts,
                const std::vector<Part>& parts, int order);

    // Returns the nodes of this rank's parts with their rows. Collective.
    std::vector<NumberedPart> number();
    // The first row of each part of the outline, and the number of all.
    const Array<PartIndex, std::int64_t>& part_rows() const { return part_rows_; }

 private:
    PartIndex first_part() const { return first_parts_[rank_]; }
    int rank_of_part(PartIndex index) const {
        return std::upper_bound(first_parts_.begin(), first_parts_.end(), index) - first_parts_.begin() - 1;
    }
    NumberedPart& part_at(std::vector<NumberedPart>& numbered, PartIndex index) const {
        return numbered[index.value() - first_part().value()];
    }
    void find_shared_nodes(std::size_t p, NumberedPart& numbered);
    void add_group(PartIndex own, const std::vector<NodeId>& holders, const std::vector<std::int32_t>& nodes,
                   NumberedPart& numbered);
    void count_rows(const std::vector<NumberedPart>& numbered);
    void tell_holders(std::vector<NumberedPart>& numbered) const;
    // Groups pairs by the rank of the other part, without this rank.
    std::map<int, std::vector<PairedNodes::const_iterator>> by_rank(const PairedNodes& pairs, bool of_holder) const;

    const MpiRanks& ranks_;
    const std::vector<PartIndex>& first_parts_;
    const std::vector<Part>& parts_;
    int order_, rank_;
    std::map<NodeId, PartIndex> indices_;
    PairedNodes owned_, held_;  // of this rank's parts as owners, and as holders
    Array<PartIndex, std::int64_t> part_rows_;
};

FeNumbering::FeNumbering(const MpiRanks& ranks, const MeshOutline& outline, const std::vector<PartIndex>& first_parts,
                         const std::vector<Part>& parts, int order)
    : ranks_(ranks), first_parts_(first_parts), parts_(parts), order_(order), rank_(ranks.rank()) {
    for (const PartIndex index : outline.parts.ids()) indices_[outline.parts[index].id] = index;
    part_rows_.resize(outline.parts.size() + 1);
}

// Adds nodes of the part `own` that all the holders have, and the first of them owns.
void FeNumbering::add_group(PartIndex own, const std::vector<NodeId>& holders, const std::vector<std::int32_t>& nodes,
                            NumberedPart& numbered) {
    const PartIndex owner = indices_.at(holders.front());
    for (const std::int32_t n : nodes) numbered.owner[n] = owner;
    for (const NodeId id : holders) {
        const PartIndex holder = indices_.at(id);
        if (holder == owner || (own != owner && own != holder)) continue;
        std::vector<std::int32_t>& list = (own == owner ? owned_ : held_)[{owner, holder}];
        list.insert(list.end(), nodes.begin(), nodes.end());
    }
}

void FeNumbering::find_shared_nodes(std::size_t p, NumberedPart& numbered) {
    for (const SharedGroup& group : parts_[p].shared) add_group(numbered.index, group.parts, group.vertices, numbered);
    if (order_ == 1) return;
    const std::int32_t first_edge = std::ssize(parts_[p].mesh.vertices);
    for (const SharedEdgeGroup& group : parts_[p].shared_edges) {
        std::vector<std::int32_t> nodes;
        for (const UndirectedEdge& edge : group.edges)
            nodes.push_back(first_edge + numbered.edges_of(parts_[p]).find(undirected(edge[0], edge[1])));
        add_group(numbered.index, group.parts, nodes, numbered);
    }
}

std::vector<NumberedPart> FeNumbering::number() {
    std::vector<NumberedPart> all(parts_.size());
    for (std::size_t p = 0; p < parts_.size(); ++p) {
        NumberedPart& numbered = all[p];
        numbered.index = PartIndex(first_part().value() + p);
        std::size_t nodes = parts_[p].mesh.vertices.size();
        if (order_ == 2) {
            if (parts_[p].order() == 1) numbered.edges.emplace(parts_[p].mesh.tets, nodes);
            nodes += numbered.edges_of(parts_[p]).size();
        }
        numbered.owner.assign(nodes, numbered.index);
        numbered.row.assign(nodes, unset);
        find_shared_nodes(p, numbered);
    }
    count_rows(all);
    for (NumberedPart& numbered : all) {
        std::int64_t next = part_rows_[numbered.index];
        for (std::size_t n = 0; n < numbered.row.size(); ++n)
            if (numbered.owner[n] == numbered.index) numbered.row[n] = next++;
    }
    tell_holders(all);
    return all;
}

void FeNumbering::count_rows(const std::vector<NumberedPart>& numbered) {
    for (const NumberedPart& part : numbered)
        part_rows_[part.index.value() + 1] = std::count(part.owner.begin(), part.owner.end(), part.index);
    ranks_.all_reduce(std::span(part_rows_.begin(), part_rows_.end()), Reduction::sum);
    std::partial_sum(part_rows_.begin(), part_rows_.end(), part_rows_.begin());
    if (3 * part_rows_.back() > std::numeric_limits<std::int32_t>::max())
        throw Error(ErrorCode::usage,
                    fmt::format("The mesh has {} nodes, of which three equations each are more than PETSc numbers "
                                "by 32 bits. Use a coarser mesh{}.",
                                grouped(part_rows_.back()), order_ == 2 ? ", or order 1" : ""));
}

std::map<int, std::vector<PairedNodes::const_iterator>> FeNumbering::by_rank(const PairedNodes& pairs,
                                                                             bool of_holder) const {
    std::map<int, std::vector<PairedNodes::const_iterator>> grouped_pairs;
    for (auto it = pairs.begin(); it != pairs.end(); ++it)
        if (const int rank = rank_of_part(it->first[of_holder ? 1 : 0]); rank != rank_)
            grouped_pairs[rank].push_back(it);
    return grouped_pairs;
}

// Sets the rows of nodes that other parts own: those of parts of this rank are looked up, the others are received.
void FeNumbering::tell_holders(std::vector<NumberedPart>& numbered) const {
    const auto row_at = [&](PartIndex index, std::int32_t node) -> std::int64_t& {
        return part_at(numbered, index).row[node];
    };
    for (const auto& [pair, nodes] : held_) {
        if (rank_of_part(pair[0]) != rank_) continue;
        const std::vector<std::int32_t>& of_owner = owned_.at(pair);
        for (std::size_t i = 0; i < nodes.size(); ++i) row_at(pair[1], nodes[i]) = row_at(pair[0], of_owner[i]);
    }
    const auto sent = by_rank(owned_, true), awaited = by_rank(held_, false);
    std::vector<RankValues<std::int64_t>> out, in;
    for (const auto& [rank, pairs] : awaited) {
        std::size_t count = 0;
        for (const auto& pair : pairs) count += pair->second.size();
        in.push_back({rank, std::vector<std::int64_t>(count)});
    }
    for (const auto& [rank, pairs] : sent) {
        std::vector<std::int64_t>& rows = out.emplace_back(RankValues<std::int64_t>{rank, {}}).values;
        for (const auto& pair : pairs)
            for (const std::int32_t n : pair->second) rows.push_back(row_at(pair->first[0], n));
    }
    ranks_.exchange(out, in);
    auto told = in.begin();
    for (const auto& [rank, pairs] : awaited) {
        auto row = told++->values.begin();
        for (const auto& pair : pairs)
            for (const std::int32_t n : pair->second) row_at(pair->first[1], n) = *row++;
    }
}

UndirectedEdge edge_of(const Tetrahedron& tet, std::size_t e) {
    return undirected(tet[tet_edges[e][0]], tet[tet_edges[e][1]]);
}

// Returns for each tetrahedron the numbers of its edges, in the order of tet_edges.
std::vector<std::array<std::int32_t, 6>> numbers_at_edges(const std::vector<Tetrahedron>& tets, const EdgeTable& edges,
                                                          const std::vector<std::int32_t>& of_edge) {
    std::vector<std::array<std::int32_t, 6>> numbers(tets.size());
    for (std::size_t t = 0; t < tets.size(); ++t)
        for (std::size_t e = 0; e < 6; ++e) numbers[t][e] = of_edge[edges.find(edge_of(tets[t], e))];
    return numbers;
}

}  // namespace

std::vector<PartIndex> first_parts_of_ranks(const MeshOutline& outline, int ranks) {
    std::vector<PartIndex> first(ranks + 1);
    const std::int32_t parts = std::ssize(outline.parts);
    const double total = outline.tets();
    std::int32_t next = 0;
    double before = 0;  // tetrahedra of the parts before `next`
    for (int r = 0; r < ranks; ++r) {
        first[r] = PartIndex(next);
        const std::int32_t others = ranks - 1 - r;  // each gets a part while there are some
        while (next < parts) {
            const double tets = outline.parts[next].tets;
            const bool is_first = next == first[r].value();
            const bool fits = before + 0.5 * tets <= total * (r + 1) / ranks && parts - next > others;
            if (!is_first && others > 0 && !fits) break;
            before += tets;
            ++next;
        }
    }
    first.back() = PartIndex(parts);
    return first;
}

FeSpace::FeSpace(MpiRanks& ranks, const MeshOutline& outline, const std::vector<PartIndex>& first_parts,
                 std::vector<Part> parts, int order)
    : ranks_(&ranks),
      order_(order),
      region_count_(std::max<std::size_t>(1, outline.region_names.size())),
      parts_(std::move(parts)),
      nodes_(parts_.size()) {
    FeNumbering numbering(ranks, outline, first_parts, parts_, order);
    std::vector<NumberedPart> numbered = numbering.number();

    std::vector<std::int64_t> rank_rows;  // rank r has those from the r-th of these on
    for (const PartIndex first : first_parts) rank_rows.push_back(numbering.part_rows()[first]);
    const int rank = ranks.rank();
    first_row_ = rank_rows[rank];
    owned_ = rank_rows[rank + 1] - first_row_;
    total_rows_ = rank_rows.back();

    const auto is_owned = [&](std::int64_t row) { return row >= first_row_ && row < first_row_ + owned_; };
    for (const NumberedPart& part : numbered)
        for (const std::int64_t row : part.row)
            if (!is_owned(row)) ghost_rows_.push_back(row);
    std::sort(ghost_rows_.begin(), ghost_rows_.end());
    ghost_rows_.erase(std::unique(ghost_rows_.begin(), ghost_rows_.end()), ghost_rows_.end());
    ownership_ = Ownership::of_numbers(ranks, rank_rows, ghost_rows_);

    points_.assign(owned_ + ghost_rows_.size(), Vec3::Zero());
    const auto local = [&](std::int64_t row) -> std::int32_t {
        if (is_owned(row)) return row - first_row_;
        return owned_ + (std::lower_bound(ghost_rows_.begin(), ghost_rows_.end(), row) - ghost_rows_.begin());
    };
    for (std::size_t p = 0; p < parts_.size(); ++p) {
        const TetMesh& mesh = parts_[p].mesh;
        NumberedPart& part = numbered[p];
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
            nodes_[p].of_vertex.push_back(local(part.row[v]));
            points_[nodes_[p].of_vertex[v]] = mesh.vertices[v];
        }
        if (order == 2) {
            const EdgeTable& edges = part.edges_of(parts_[p]);
            std::vector<std::int32_t> of_edge(edges.size());
            edges.for_all([&](std::int32_t e, const UndirectedEdge& edge) {
                of_edge[e] = local(part.row[mesh.vertices.size() + e]);
                points_[of_edge[e]] = parts_[p].order() == 2
                                          ? parts_[p].edge_nodes.points[e]
                                          : Vec3(0.5 * (mesh.vertices[edge[0]] + mesh.vertices[edge[1]]));
            });
            nodes_[p].of_tet_edge = numbers_at_edges(mesh.tets, edges, of_edge);
            nodes_[p].of_edge = std::move(of_edge);
        }
        part = {};
    }
    if (order == 2) refuse_folded_cells();
}

std::array<std::int32_t, most_element_nodes> FeSpace::nodes_of(std::size_t p, std::size_t tet) const {
    std::array<std::int32_t, most_element_nodes> nodes;
    nodes.fill(unset);
    for (std::size_t i = 0; i < 4; ++i) nodes[i] = nodes_[p].of_vertex[parts_[p].mesh.tets[tet][i]];
    if (order_ == 2) std::copy_n(nodes_[p].of_tet_edge[tet].begin(), 6, nodes.begin() + 4);
    return nodes;
}

std::array<std::int32_t, 6> FeSpace::nodes_of_facet(std::size_t p, std::size_t facet) const {
    std::array<std::int32_t, 6> nodes;
    nodes.fill(unset);
    const Triangle& triangle = parts_[p].facets[facet];
    for (std::size_t i = 0; i < 3; ++i) nodes[i] = nodes_[p].of_vertex[triangle[i]];
    if (order_ == 1) return nodes;
    const std::int32_t tet = parts_[p].tet_at_facet[facet];
    const Tetrahedron& corners = parts_[p].mesh.tets[tet];
    for (std::size_t e = 0; e < 3; ++e) {
        const UndirectedEdge wanted = undirected(triangle[triangle_edges[e][0]], triangle[triangle_edges[e][1]]);
        for (std::size_t i = 0; i < 6; ++i)
            if (edge_of(corners, i) == wanted) nodes[3 + e] = nodes_[p].of_tet_edge[tet][i];
    }
    return nodes;
}

TetElement FeSpace::element(std::size_t p, std::size_t tet) const {
    if (order_ == 2) {
        const auto nodes = nodes_of(p, tet);
        TetElement::Nodes points;
        for (std::size_t i = 0; i < points.size(); ++i) points[i] = points_[nodes[i]];
        return TetElement(points);
    }
    const TetMesh& mesh = parts_[p].mesh;
    std::array<Vec3, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) corners[i] = mesh.vertices[mesh.tets[tet][i]];
    return {corners, order_};
}

FacetElement FeSpace::facet_element(std::size_t p, std::size_t facet) const {
    const auto nodes = nodes_of_facet(p, facet);
    FacetElement::Nodes points;
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = nodes[i] >= 0 ? points_[nodes[i]] : Vec3::Zero();
    if (order_ == 1) return {{points[0], points[1], points[2]}, order_};
    return FacetElement(points);
}

// Refuses cells without a positive determinant: meshes of Kerf are proven to have none, files of others may have any.
void FeSpace::refuse_folded_cells() const {
    std::int64_t folded = 0;
    for_all_tets(*this, [&](std::size_t p, std::size_t t) {
        const TetElement element = this->element(p, t);
        if (!element.is_curved()) return;
        double least = INFINITY;
        for (const TetPoint& at : element.rule()) least = std::min(least, element.stretch_at(at.place));
        for (int n = 0; n < most_element_nodes; ++n)
            least = std::min(least, element.stretch_at(TetElement::place_of_node(n)));
        if (!(least > 0)) ++folded;
    });
    folded = ranks_->all_reduce(folded, Reduction::sum);
    if (folded > 0)
        throw Error(ErrorCode::usage,
                    fmt::format("{} curved cells of the mesh are folded: they have no stiffness. Solve "
                                "with --order 1, or mesh again with --curve straight.",
                                folded));
}

}  // namespace kerf

// A piece is a connected component of one part, a body one of the whole mesh. The pieces of a part follow from its
// surface: where that is connected, as most are, the cells are one piece and are not read; where it has several
// components, these may be several pieces or the voids of one, and the cells decide. Pieces of different parts are
// joined by the vertices that they have on interfaces and walls, which have equal global numbers and lie beside each
// other after a sort. A body is numbered by the smallest facet of the input on its pieces, which no cut changes.
#include "files/part/bodies.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/geometry/union_find.h"

namespace kerf {

namespace {

// Returns the pieces of a part: its vertices 0, 1, ..., `count` - 1 by the cells that connect them.
template <class Cell>
Components pieces_of(std::size_t count, const std::vector<Cell>& cells) {
    UnionFind sets(count);
    for (const Cell& cell : cells)
        for (std::size_t i = 1; i < cell.size(); ++i) sets.join(cell[0], cell[i]);
    return sets.take();
}

std::int32_t piece_at(const Components& pieces, std::int32_t vertex) { return pieces.of[vertex]; }

// The pieces of all parts, which interfaces join to bodies.
class AllPieces {
 public:
    /// Adds the pieces of the next part, and how many tetrahedra each has.
    void add(const Part& part, const Components& pieces, const std::vector<std::int64_t>& tets) {
        const std::int32_t first = std::ssize(tets_);
        tets_.insert(tets_.end(), tets.begin(), tets.end());
        first_facets_.resize(tets_.size(), std::numeric_limits<std::int32_t>::max());
        std::vector<bool> is_held(part.mesh.boundary_vertex_count, false);
        for (std::size_t f = 0; f < part.facets.size(); ++f) {
            const std::int32_t piece = first + piece_at(pieces, part.facets[f][0]);
            if (part.is_of_input(f)) {
                std::int32_t& of_piece = first_facets_[piece];
                of_piece = std::min(of_piece, part.facet[f]);
            }
            if (!part.is_interface(f)) continue;
            for (const std::int32_t v : part.facets[f]) {
                if (is_held[v]) continue;
                is_held[v] = true;
                held_.emplace_back(part.global_id[v], piece);
            }
        }
    }

    /// Returns the body of each piece, and the number of tetrahedra of each body.
    std::pair<std::vector<std::int32_t>, std::vector<std::int64_t>> bodies() {
        UnionFind sets(tets_.size());
        std::sort(held_.begin(), held_.end());
        for (std::size_t i = 1; i < held_.size(); ++i)
            if (held_[i].first == held_[i - 1].first) sets.join(held_[i - 1].second, held_[i].second);
        const Components found = sets.take();
        const std::int32_t count = found.count;
        std::vector<std::pair<std::int32_t, std::int32_t>> order(count);  // first facet, number as found
        for (std::int32_t b = 0; b < count; ++b) order[b] = {std::numeric_limits<std::int32_t>::max(), b};
        for (std::size_t piece = 0; piece < tets_.size(); ++piece) {
            std::int32_t& first = order[found.of[piece]].first;
            first = std::min(first, first_facets_[piece]);
        }
        std::sort(order.begin(), order.end());
        std::vector<std::int32_t> number(count);
        for (std::int32_t b = 0; b < count; ++b) number[order[b].second] = b;
        std::vector<std::int32_t> of_pieces(tets_.size());
        std::vector<std::int64_t> sizes(count, 0);
        for (std::size_t piece = 0; piece < tets_.size(); ++piece) {
            of_pieces[piece] = number[found.of[piece]];
            sizes[of_pieces[piece]] += tets_[piece];
        }
        return {std::move(of_pieces), std::move(sizes)};
    }

 private:
    std::vector<std::int64_t> tets_;                           // of each piece
    std::vector<std::int32_t> first_facets_;                   // of the input; the largest number: none
    std::vector<std::pair<std::int64_t, std::int32_t>> held_;  // global number of a vertex on an interface, piece
};

}  // namespace

Bodies::Bodies(const PartSource& parts) {
    AllPieces all;
    boundary_sizes_.resize(parts.outline().patch_names.size());
    const Array<PartIndex, PartExtent>& extents = parts.outline().parts;
    for (const PartIndex index : extents.ids()) {
        Part part = parts.load_only(index, PartContent::surface);
        Components pieces = pieces_of(part.mesh.boundary_vertex_count, part.facets);
        for (std::size_t f = 0; f < part.facets.size(); ++f)
            if (part.is_on_outer_boundary(f) && part.patch[f] >= 0) ++boundary_sizes_.at(part.patch[f]);
        std::vector<std::int64_t> tets = {extents[index].tets};
        if (pieces.count > 1) {  // several bodies, or voids
            part = parts.load_only(index, PartContent::cells);
            pieces = pieces_of(part.global_id.size(), part.mesh.tets);
            tets.assign(pieces.count, 0);
            for (const Tetrahedron& tet : part.mesh.tets) ++tets[piece_at(pieces, tet[0])];
        }
        all.add(part, pieces, tets);
        of_pieces_.emplace_back(tets.size());
    }
    auto [of_pieces, sizes] = all.bodies();
    auto next = of_pieces.begin();
    for (std::vector<std::int32_t>& of_part : of_pieces_)
        for (std::int32_t& body : of_part) body = *next++;
    sizes_ = std::move(sizes);
}

std::vector<std::int32_t> Bodies::of_tets(PartIndex index, const Part& part) const {
    const std::vector<std::int32_t>& bodies = of_pieces_[index];
    std::vector<std::int32_t> of_tets(part.mesh.tets.size(), bodies.front());
    if (std::all_of(bodies.begin(), bodies.end(), [&](std::int32_t body) { return body == bodies.front(); }))
        return of_tets;
    const Components pieces = pieces_of(part.global_id.size(), part.mesh.tets);
    for (std::size_t t = 0; t < of_tets.size(); ++t) of_tets[t] = bodies[piece_at(pieces, part.mesh.tets[t][0])];
    return of_tets;
}

}  // namespace kerf

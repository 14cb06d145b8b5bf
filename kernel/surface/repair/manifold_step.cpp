// First sheets go that bound nothing. Then each fan of facets at a vertex gets a vertex of its own, and moves a little
// into itself, so that the fans are apart: equal coordinates would be welded again. Where both ends of an edge have one
// fan, the pairs of its facets get middles of their own. Where facets are to be divided at crossings by a later step,
// places are opened only behind that, because bodies that touch would come apart by a crack; the borders of openings
// are an exception, since openings are filled before. Where the outside is what will be meshed, its wedges are parted
// in place of those of the body.
//
// Two kinds of components matter: a "piece" hangs together over edges of any number of facets, a "sheet" only over
// edges of two. In each piece with edges of more than two, sheets with an open edge are fins. If such edges are left
// then, the rest divides space into cells (surface/regions/cells.h): a facet with the same cell on both
// sides is a membrane, a facet between two bounded cells may be a wall. A void that touches the surface around it has
// such facets, too, but only edges of an even number of facets: it is no cell of material, so that facets are walls
// only if those that hang together have an edge of an odd number. Facets of a kind are taken out only if the rest is
// closed and has more area than they; else the surface is made of them.
#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include "base/core/drop_items.h"
#include "base/core/ids.h"
#include "base/geometry/triangle.h"
#include "base/geometry/union_find.h"
#include "surface/regions/cells.h"
#include "surface/repair/inside/rims.h"
#include "surface/repair/inside/touching_fans.h"
#include "surface/repair/repair_step.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

// Facets of loose sheets, each list ascending.
struct LooseSheets {
    std::vector<std::int32_t> fins;       // facets of sheets with a free rim
    std::vector<std::int32_t> membranes;  // facets with the same cell on both sides
    std::vector<std::int32_t> walls;      // facets between two bounded cells of material
};

// Finds the loose sheets of all pieces. In each piece fins are found first, then, among the rest, membranes and, if
// `with_walls`, walls; of a kind all, or none where the rest of the piece would not be closed or would have less than
// half of the area. Decided by exact signs.
class SheetSearch {
 public:
    SheetSearch(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets, bool with_walls)
        : vertices_(vertices), facets_(facets), with_walls_(with_walls), rims_(find_rims(facets)) {}

    LooseSheets find() {
        const bool is_any = std::any_of(rims_.pieces.begin(), rims_.pieces.end(),
                                        [](const RimPiece& piece) { return piece.edges_of_many > 0; });
        if (!is_any) return {};
        find_sheets();
        const auto pieces = rims_.facets_of_pieces();
        for (std::size_t p = 0; p < pieces.size(); ++p) {
            if (rims_.pieces[p].edges_of_many > 0) search(pieces[p]);
        }
        for (std::vector<std::int32_t>* all : {&found_.fins, &found_.membranes, &found_.walls})
            std::sort(all->begin(), all->end());
        return std::move(found_);
    }

 private:
    void find_sheets() {
        const std::vector<std::int32_t> partner = edge_partners(facets_);
        UnionFind sets(facets_.size());
        for (std::size_t c = 0; c < partner.size(); ++c)
            if (partner[c] >= 0) sets.join(c / 3, partner[c] / 3);
        sheets_ = sets.take();
        has_free_rim_.assign(sheets_.count, 0);
        for (std::size_t c = 0; c < rims_.is_open.size(); ++c)
            if (rims_.is_open[c]) has_free_rim_[sheets_.of[c / 3]] = 1;
    }
    void search(std::vector<std::int32_t> piece) {
        leave_out(piece, found_.fins, [&](std::size_t i) { return has_free_rim_[sheets_.of[piece[i]]] != 0; });
        const CompactFacets compact = make_compact(vertices_, facets_of(piece));
        if (!has_edge_of_many(compact.facets)) return;
        const auto cells = find_cells(compact.vertices, compact.facets);
        if (!cells) return;
        std::vector<CellSides> sides = cells->sides;
        const std::vector<char> dropped =
            leave_out(piece, found_.membranes, [&](std::size_t i) { return sides[i].front == sides[i].back; });
        drop_items(sides, dropped);
        if (!with_walls_) return;
        const std::vector<char> is_wall = find_walls(piece, sides);
        leave_out(piece, found_.walls, [&](std::size_t i) { return is_wall[i] != 0; });
    }
    // Returns the facets between bounded cells, as far as those that hang together have an edge of an odd number of
    // facets. A void that touches the surface around it has edges of even numbers alone: it is no cell of material.
    std::vector<char> find_walls(const std::vector<std::int32_t>& piece, const std::vector<CellSides>& sides) const {
        UnionFind sets(piece.size());
        std::vector<char> has_odd(piece.size(), 0), is_wall(piece.size(), 0);
        const auto is_candidate = [&](const EdgeCorners::Corner& c) { return sides[c.corner / 3].is_wall(); };
        const EdgeCorners edges(facets_of(piece));
        edges.for_each_edge([&](std::int32_t, std::span<const EdgeCorners::Corner> corners) {
            const auto first = std::find_if(corners.begin(), corners.end(), is_candidate);
            for (auto c = first; c != corners.end(); ++c)
                if (is_candidate(*c)) sets.join(first->corner / 3, c->corner / 3);
            if (first != corners.end()) has_odd[first->corner / 3] |= corners.size() % 2;
        });
        for (std::int32_t i = 0; i < count_of(piece); ++i) has_odd[sets.root(i)] |= has_odd[i];
        for (std::int32_t i = 0; i < count_of(piece); ++i) is_wall[i] = sides[i].is_wall() && has_odd[sets.root(i)];
        return is_wall;
    }
    std::vector<Triangle> facets_of(const std::vector<std::int32_t>& numbers) const {
        std::vector<Triangle> facets;
        for (const std::int32_t f : numbers) facets.push_back(facets_[f]);
        return facets;
    }
    // Takes facets out of the piece, if the rest is closed and larger. Returns which were taken out.
    template <class IsOut>
    std::vector<char> leave_out(std::vector<std::int32_t>& piece, std::vector<std::int32_t>& out, IsOut is_out) {
        std::vector<char> dropped(piece.size(), 0);
        double area_out = 0, area_left = 0;
        for (std::size_t i = 0; i < piece.size(); ++i) {
            dropped[i] = is_out(i);
            (dropped[i] ? area_out : area_left) += area_vector(vertices_, facets_[piece[i]]).norm();
        }
        std::vector<std::int32_t> left = piece;
        drop_items(left, dropped);
        const Rims rims = find_rims(facets_of(left));
        const bool is_good = area_left > area_out && std::all_of(rims.pieces.begin(), rims.pieces.end(),
                                                                 [](const RimPiece& p) { return p.is_closed(); });
        if (area_out == 0 || !is_good) return std::vector<char>(piece.size(), 0);
        for (std::size_t i = 0; i < piece.size(); ++i)
            if (dropped[i]) out.push_back(piece[i]);
        piece = std::move(left);
        return dropped;
    }

    const std::vector<Vec3>& vertices_;
    const std::vector<Triangle>& facets_;
    bool with_walls_;
    Rims rims_;
    Components sheets_;
    std::vector<char> has_free_rim_;  // per sheet
    LooseSheets found_;
};

class ManifoldOpening {
 public:
    ManifoldOpening(Soup& soup, const StepRequest& request, StepReport& report)
        : soup_(soup), request_(request), report_(report) {}

    void run() {
        if (has_walls(soup_, request_)) return;
        drop_loose();
        request_.check_cancelled();
        if (request_.outside_is_meshed) turn_all();
        FanSeparation separation = separate_fans(soup_, request_.bound, request_.is_divided_later);
        if (request_.outside_is_meshed) turn_all();
        report_.largest_move = std::max(report_.largest_move, separation.largest_move);
        for (RepairAction& action : separation.actions) report_.actions.push_back(std::move(action));
    }

 private:
    // Of turned facets those at an edge are a pair between which the outside lies: they come apart into it.
    void turn_all() {
        for (Triangle& t : soup_.facets) std::swap(t[1], t[2]);
    }
    void drop_loose() {
        const bool with_walls = request_.bodies != BodyRepair::regions;
        const LooseSheets loose = SheetSearch(soup_.vertices, soup_.facets, with_walls).find();
        if (loose.fins.empty() && loose.membranes.empty() && loose.walls.empty()) return;
        std::vector<char> drop(soup_.facets.size(), 0);
        RepairAction membranes{"facet with the same material on both sides removed",
                               "facets with the same material on both sides removed"},
            walls{"facet of a wall between bodies removed", "facets of walls between bodies removed"};
        membranes.is_loss = walls.is_loss = true;
        mark(loose.fins, {"facet of a fin removed", "facets of fins removed"}, drop);
        mark(loose.membranes, std::move(membranes), drop);
        mark(loose.walls, std::move(walls), drop);
        drop_facets(soup_, drop);
        drop_unused_vertices(soup_);
    }
    void mark(const std::vector<std::int32_t>& facets, RepairAction action, std::vector<char>& drop) {
        for (const std::int32_t f : facets) {
            action.add({soup_.vertices[soup_.facets[f][0]], soup_.file_facets({f})});
            drop[f] = 1;
        }
        report_.actions.push_back(std::move(action));
    }

    Soup& soup_;
    const StepRequest& request_;
    StepReport& report_;
};

}  // namespace

void manifold_step(Soup& soup, const StepRequest& request, StepReport& report) {
    if (has_ordinary_facets(soup))
        ManifoldOpening(soup, request, report).run();
    else
        refuse_odd_facets(report);
}

}  // namespace kerf

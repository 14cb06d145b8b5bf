// A block is a run of facets along Morton's curve through the centres of facets. What it has in common with facets
// outside stays as it is: edges, vertices, and all copies of a vertex, if a facet at one of them is outside. In a
// block, a vertex of the border has a copy for each of its fans, since half-edges know one fan only; copies of it have
// one place. Blocks number places and seams for themselves; joined, new ones get numbers behind those that there are.
// The lists of points (SheetState::next_point) belong to facets, so that blocks change entries of their own.
#include "surface/remesh/inside/blocks.h"

#include <algorithm>
#include <bit>
#include <utility>

#include <Eigen/Geometry>

#include "base/core/ids.h"
#include "base/core/threads.h"
#include "base/geometry/box.h"
#include "base/geometry/morton_order.h"
#include "base/geometry/union_find.h"
#include "surface/remesh/inside/sheets.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

// The surface has so many blocks, and more where each would have more facets than `most_block`: large blocks leave
// processors without work. Small surfaces have fewer, a power of two, lest one is left when all others are done.
constexpr double blocks_of_surface = 16, most_block = 2e4;
constexpr int rings_beside_borders = 2;
// All vertices of facets that may change have all their facets.
constexpr int rings_beside_changes = 1;
constexpr double share_of_most = 0.5;  // of the facets

// How often places and seams occur in the whole surface, by corners.
struct Occurrences {
    std::vector<std::int32_t> of_vertex, of_place, of_seam;

    explicit Occurrences(const SheetState& state)
        : of_vertex(state.arrays.points.size(), 0), of_place(state.places, 0), of_seam(state.seams, 0) {
        const SheetArrays& all = state.arrays;
        for (const Triangle& t : all.corners)
            for (const std::int32_t v : t)
                ++(all.vertices[v].place < 0 ? of_vertex[v] : of_place[all.vertices[v].place]);
        for (const SheetEdge& e : all.edges)
            if (e.seam >= 0) ++of_seam[e.seam];
    }
};

// Borders of blocks lie in planes across the axes: those of two divisions shall cross.
Eigen::Matrix3d turned_axes() { return Eigen::Quaterniond(0.8, 0.25, 0.4, 0.35).normalized().toRotationMatrix(); }

// Sorted numbers, each once.
class Numbering {
 public:
    void add(std::int32_t number) { numbers_.push_back(number); }
    void finish() {
        std::sort(numbers_.begin(), numbers_.end());
        numbers_.erase(std::unique(numbers_.begin(), numbers_.end()), numbers_.end());
    }
    std::int32_t of(std::int32_t number) const {
        return static_cast<std::int32_t>(std::lower_bound(numbers_.begin(), numbers_.end(), number) - numbers_.begin());
    }
    std::int32_t operator[](std::int32_t i) const { return numbers_[i]; }
    std::int32_t count() const { return count_of(numbers_); }

 private:
    std::vector<std::int32_t> numbers_;
};

// The facets of a block as a piece of their own.
struct Block {
    SheetPiece piece;
    std::vector<std::int32_t> seam_before;  // of the piece's seams: the number in the whole
    SheetArrays result;
    std::int32_t places = 0, seams = 0;  // of the result
};

Block extract(const SheetState& state, const Occurrences& in_whole, const std::vector<std::int32_t>& facets) {
    const SheetArrays& all = state.arrays;
    Block block;
    SheetArrays& own = block.piece.arrays;
    Numbering vertices, places, seams;
    for (const std::int32_t f : facets) {
        for (const std::int32_t v : all.corners[f]) {
            vertices.add(v);
            if (all.vertices[v].place >= 0) places.add(all.vertices[v].place);
        }
        for (std::int32_t corner = 3 * f; corner < 3 * f + 3; ++corner)
            if (all.edges[corner].seam >= 0) seams.add(all.edges[corner].seam);
    }
    vertices.finish();
    places.finish();
    seams.finish();

    std::vector<std::int32_t> at_vertex(vertices.count(), 0), at_place(places.count(), 0), at_seam(seams.count(), 0);
    for (const std::int32_t f : facets) {
        Triangle& t = own.corners.emplace_back();
        for (int i = 0; i < 3; ++i) {
            const std::int32_t v = all.corners[f][i], place = all.vertices[v].place;
            t[i] = vertices.of(v);
            ++(place < 0 ? at_vertex[t[i]] : at_place[places.of(place)]);
            const SheetEdge& edge = own.edges.emplace_back(all.edges[3 * f + i]);
            if (edge.seam >= 0) ++at_seam[seams.of(edge.seam)];
        }
        own.facets.push_back(all.facets[f]);
    }
    block.piece.partner = edge_partners(own.corners);
    const std::vector<std::int32_t> original = separate_fans(vertices.count(), block.piece.partner, own.corners);

    std::vector<std::int32_t> own_place(vertices.count(), -1);  // of vertices with several fans
    block.piece.places = places.count();
    for (std::int32_t v = vertices.count(); v < count_of(original); ++v)
        if (std::int32_t& place = own_place[original[v]]; place < 0) place = block.piece.places++;
    for (const std::int32_t i : original) {
        const std::int32_t v = vertices[i];
        own.points.push_back(all.points[v]);
        SheetVertex& data = own.vertices.emplace_back(all.vertices[v]);
        const std::int32_t place = data.place;
        data.whole = v;
        data.changed = 0;
        data.place = place < 0 ? own_place[i] : places.of(place);
        data.is_border =
            place < 0 ? at_vertex[i] < in_whole.of_vertex[v] : at_place[data.place] < in_whole.of_place[place];
    }
    for (std::int32_t corner = 0; corner < count_of(own.edges); ++corner) {
        SheetEdge& edge = own.edges[corner];
        edge.is_border = edge.seam < 0 && block.piece.partner[corner] < 0;
        if (edge.seam < 0) continue;
        const std::int32_t seam = edge.seam;
        edge.seam = seams.of(seam);
        edge.is_border = at_seam[edge.seam] < in_whole.of_seam[seam];
    }
    for (SheetFacet& facet : own.facets) facet.changed = 0;
    block.piece.seams = seams.count();
    for (std::int32_t i = 0; i < seams.count(); ++i) block.seam_before.push_back(seams[i]);
    return block;
}

// Puts blocks into the state, behind the facets that are in none.
class Joining {
 public:
    Joining(SheetState& state, const std::vector<std::vector<std::int32_t>>& facets_of_blocks)
        : state_(state), before_(std::move(state.arrays)) {
        vertex_.resize(before_.points.size(), -1);
        std::vector<char> is_in_block(before_.corners.size(), 0);
        for (const std::vector<std::int32_t>& facets : facets_of_blocks)
            for (const std::int32_t f : facets) is_in_block[f] = 1;
        for (std::int32_t f = 0; f < count_of(before_.corners); ++f) {
            if (is_in_block[f] != 0) continue;
            Triangle& t = now().corners.emplace_back();
            for (int i = 0; i < 3; ++i) t[i] = stays(before_.corners[f][i]);
            now().facets.push_back(before_.facets[f]);
            for (int i = 0; i < 3; ++i) now().edges.push_back(before_.edges[3 * f + i]);
        }
    }

    void add(const Block& block) {
        const SheetArrays& own = block.result;
        std::vector<std::int32_t> number;
        for (std::size_t v = 0; v < own.points.size(); ++v) {
            const SheetVertex& data = own.vertices[v];
            if (data.is_border) {
                number.push_back(stays(data.whole));
                continue;
            }
            number.push_back(count_of(now().points));
            now().points.push_back(own.points[v]);
            SheetVertex& added = now().vertices.emplace_back(data);
            if (added.place >= 0) added.place += state_.places;
        }
        for (std::size_t f = 0; f < own.corners.size(); ++f) {
            Triangle& t = now().corners.emplace_back();
            for (int i = 0; i < 3; ++i) t[i] = number[own.corners[f][i]];
            now().facets.push_back(own.facets[f]);
            for (std::size_t c = 3 * f; c < 3 * f + 3; ++c) {
                SheetEdge& edge = now().edges.emplace_back(own.edges[c]);
                if (edge.seam >= 0)
                    edge.seam = edge.is_border ? block.seam_before[edge.seam] : edge.seam + state_.seams;
                edge.is_border = false;
            }
        }
        state_.places += block.places;
        state_.seams += block.seams;
    }

 private:
    SheetArrays& now() { return state_.arrays; }
    std::int32_t stays(std::int32_t v) {
        if (vertex_[v] < 0) {
            vertex_[v] = count_of(now().points);
            now().points.push_back(before_.points[v]);
            now().vertices.push_back(before_.vertices[v]);
        }
        return vertex_[v];
    }

    SheetState& state_;
    SheetArrays before_;
    std::vector<std::int32_t> vertex_;  // of those before: the number now, -1: none
};

std::vector<std::vector<std::int32_t>> facets_of_blocks(const SheetState& state) {
    std::vector<std::vector<std::int32_t>> blocks;
    for (std::int32_t f = 0; f < count_of(state.arrays.facets); ++f) {
        const std::int32_t block = state.arrays.facets[f].block;
        if (block < 0) continue;
        if (block >= count_of(blocks)) blocks.resize(block + 1);
        blocks[block].push_back(f);
    }
    return blocks;
}

// Marks the facets at vertices (by the first of their copies) that are near, and all within some rings.
std::vector<char> facets_in_rings(const SheetArrays& all, const std::vector<std::int32_t>& place,
                                  std::vector<char> is_near, int rings) {
    std::vector<char> chosen(all.corners.size(), 0);
    for (int ring = 0; ring < rings; ++ring) {
        for (std::size_t f = 0; f < chosen.size(); ++f) {
            const Triangle& t = all.corners[f];
            if (is_near[place[t[0]]] != 0 || is_near[place[t[1]]] != 0 || is_near[place[t[2]]] != 0) chosen[f] = 1;
        }
        for (std::size_t f = 0; f < chosen.size(); ++f)
            if (chosen[f] != 0)
                for (const std::int32_t v : all.corners[f]) is_near[place[v]] = 1;
    }
    return chosen;
}

}  // namespace

void change_apart_from_kept(SheetState& state, const std::function<void(SheetState& near)>& work) {
    const SheetArrays& all = state.arrays;
    const auto kept =
        std::count_if(all.facets.begin(), all.facets.end(), [](const SheetFacet& facet) { return facet.is_kept; });
    if (static_cast<double>(kept) <= share_of_most * static_cast<double>(all.facets.size())) return work(state);
    const std::vector<std::int32_t> place = first_copies(all);
    std::vector<char> is_near(all.points.size(), 0);
    for (std::size_t f = 0; f < all.facets.size(); ++f)
        if (!all.facets[f].is_kept)
            for (const std::int32_t v : all.corners[f]) is_near[place[v]] = 1;
    const std::vector<char> chosen = facets_in_rings(all, place, std::move(is_near), rings_beside_changes);
    std::vector<std::int32_t> facets;
    for (std::int32_t f = 0; f < count_of(chosen); ++f)
        if (chosen[f] != 0) facets.push_back(f);

    Block block = extract(state, Occurrences(state), facets);
    SheetState near = {std::move(block.piece.arrays), block.piece.places, block.piece.seams, std::move(state.planes),
                       std::move(state.next_point)};
    work(near);
    state.planes = std::move(near.planes);
    state.next_point = std::move(near.next_point);
    block.result = std::move(near.arrays);
    block.places = near.places;
    block.seams = near.seams;
    Joining(state, {facets}).add(block);
}

void change_at_once(const InputShape& input, SheetState& state, const std::function<void(BoundedSurface&)>& work) {
    BoundedSurface surface(InputBound(input, state),
                           {state.arrays, edge_partners(state.arrays.corners), state.places, state.seams});
    work(surface);
    state.arrays = surface.mesh().arrays();
    state.places = surface.mesh().place_count();
    state.seams = surface.mesh().seam_count();
}

std::int32_t divide_along_curve(SheetState& state, const std::vector<char>& chosen, const std::vector<float>& weights,
                                double least, bool is_turned) {
    SheetArrays& all = state.arrays;
    double sum = 0;
    std::vector<std::int32_t> facets;
    for (std::int32_t f = 0; f < count_of(all.corners); ++f) {
        all.facets[f].block = -1;
        if (chosen[f] == 0) continue;
        facets.push_back(f);
        sum += weights[f];
    }
    if (facets.empty()) return 0;
    const auto few =
        std::bit_floor(static_cast<std::uint32_t>(std::clamp(std::round(sum / least), 1., blocks_of_surface)));
    const auto count =
        std::max(static_cast<std::int32_t>(few), static_cast<std::int32_t>(std::round(sum / most_block)));
    const Eigen::Matrix3d turn = is_turned ? turned_axes() : Eigen::Matrix3d::Identity();
    Eigen::AlignedBox3d box;
    for (const Vec3& p : all.points) box.extend(turn * p);
    const double side = box.sizes().maxCoeff();
    const auto place = [&](std::size_t i) {
        const auto [a, b, c] = all.triangle(facets[i]);
        const Vec3 p = (turn * ((a + b + c) / 3) - box.min()) / side;
        return std::array<float, 3>{static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
    };
    double before = 0;
    for (const std::int32_t i : morton_order(facets.size(), place)) {
        const std::int32_t f = facets[i];
        all.facets[f].block = std::min(count - 1, static_cast<std::int32_t>(before / sum * count));
        before += weights[f];
    }
    return count;
}

std::int32_t divide_by_components(SheetState& state, const std::vector<char>& chosen, std::int32_t wanted) {
    SheetArrays& all = state.arrays;
    const std::vector<std::int32_t> place = first_copies(all);
    UnionFind joined(all.points.size());
    for (std::size_t f = 0; f < chosen.size(); ++f)
        if (const Triangle& t = all.corners[f]; chosen[f] != 0)
            for (const int i : {1, 2}) joined.join(place[t[0]], place[t[i]]);
    std::vector<std::int32_t> size(all.points.size(), 0), block(all.points.size(), -1);  // by the root of a component
    for (std::size_t f = 0; f < chosen.size(); ++f)
        if (chosen[f] != 0) ++size[joined.root(place[all.corners[f][0]])];
    std::int32_t blocks = 0, room = 0;
    for (std::size_t f = 0; f < chosen.size(); ++f) {
        all.facets[f].block = -1;
        if (chosen[f] == 0) continue;
        const std::int32_t root = joined.root(place[all.corners[f][0]]);
        if (block[root] < 0) {
            if (room <= 0) {
                ++blocks;
                room = wanted;
            }
            block[root] = blocks - 1;
            room -= size[root];
        }
        all.facets[f].block = block[root];
    }
    return blocks;
}

void change_blocks(const InputShape& input, SheetState& state, const std::function<void(BoundedSurface&)>& work) {
    const std::vector<std::vector<std::int32_t>> facets = facets_of_blocks(state);
    std::vector<Block> blocks(facets.size());
    {
        const Occurrences in_whole(state);
        for_each_on_threads(facets.size(), [&](std::size_t i) {
            Block& block = blocks[i] = extract(state, in_whole, facets[i]);
            BoundedSurface surface(InputBound(input, state), std::exchange(block.piece, {}));
            work(surface);
            block.result = surface.mesh().arrays();
            block.places = surface.mesh().place_count();
            block.seams = surface.mesh().seam_count();
        });
    }
    Joining joining(state, facets);
    for (Block& block : blocks) {
        joining.add(block);
        block = {};
    }
}

std::vector<char> facets_beside_borders(const SheetState& state) {
    const SheetArrays& all = state.arrays;
    const std::vector<std::int32_t> place = first_copies(all);
    constexpr std::int32_t none = -1, several = -2;
    std::vector<std::int32_t> block(all.points.size(), none);
    for (std::size_t f = 0; f < all.corners.size(); ++f) {
        const std::int32_t of_facet = all.facets[f].block;
        if (of_facet < 0) continue;
        for (const std::int32_t v : all.corners[f]) {
            std::int32_t& at = block[place[v]];
            at = at == none || at == of_facet ? of_facet : several;
        }
    }
    std::vector<char> is_near(all.points.size(), 0);
    for (std::size_t v = 0; v < block.size(); ++v) is_near[v] = block[v] == several ? 1 : 0;
    std::vector<char> chosen = facets_in_rings(all, place, std::move(is_near), rings_beside_borders);
    for (std::size_t f = 0; f < chosen.size(); ++f)
        if (all.facets[f].is_kept) chosen[f] = 0;
    return chosen;
}

}  // namespace kerf

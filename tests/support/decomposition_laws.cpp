// The corners of faces are vertex keys.
#include "support/decomposition_laws.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "base/core/error.h"
#include "cut/decompose/straight_division.h"
#include "support/face.h"
#include "surface/complex/mass_properties.h"
#include "surface/complex/touching.h"
#include "surface/diagnosis/facet_cover.h"
#include "surface/diagnosis/intersections.h"

namespace kerf::test {

namespace {

constexpr double volume_rel_tolerance = 1e-12;

Face face_of(const SurfaceArrays& surface, std::size_t facet) {
    const Triangle& t = surface.facets[facet];
    return rotated({surface.vertex_key[t[0]], surface.vertex_key[t[1]], surface.vertex_key[t[2]]});
}

std::array<Vec3, 3> corners_of(const SurfaceArrays& surface, std::size_t facet) {
    const Triangle& t = surface.facets[facet];
    return {surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]};
}

// Whether it is closed and each fan has vertices of its own; without edges that touch each other unless it `may_touch`.
bool is_separated(const SurfaceArrays& surface, bool may_touch) {
    try {
        const SeparatedSurface separated = separate_touching(surface);
        return separated.arrays.vertices.size() == surface.vertices.size() && (may_touch || !separated.touches());
    } catch (const Error&) {
        return false;
    }
}

class DecompositionLaws {
 public:
    DecompositionLaws(const Decomposition& whole, const SurfaceArrays& input) : whole_(whole), input_(input) {}

    std::string broken() {
        check_tree();
        check_leaves();
        check_vertices();
        check_input_facets();
        check_interfaces();
        return text_;
    }

 private:
    void add(std::int64_t count, const char* law) {
        if (count) text_ += std::to_string(count) + " " + law + "; ";
    }
    void check_tree();
    void check_leaves();
    void check_vertices();
    void check_input_facets();
    void check_interfaces();

    const Decomposition& whole_;
    const SurfaceArrays& input_;
    std::string text_;
};

void DecompositionLaws::check_tree() {
    std::int64_t misplaced = 0;
    std::int32_t next = 0;
    for (const Leaf& leaf : whole_.leaves) {
        misplaced += leaf.first_leaf != next;
        next += leaf.leaves;
    }
    add(misplaced, "leaves out of the order of the tree");
    add(whole_.nodes.empty() || whole_.nodes.front().leaves != next, "tree whose leaves are not those of its root");
}

void DecompositionLaws::check_leaves() {
    const bool may_touch = separate_touching(input_).touches();
    std::int64_t open = 0, crossed = 0, wrong = 0;
    double sum = 0;
    for (const Leaf& leaf : whole_.leaves) {
        const auto& [vertices, facets, vertex_key, facet_key, patch] = leaf.surface;
        open += !is_separated(leaf.surface, may_touch);
        const SurfaceArrays joined = joined_by_key(leaf.surface);
        crossed += !find_self_intersections(joined.vertices, joined.facets, 1).empty();
        const double volume = enclosed_volume(vertices, facets);
        wrong += !(volume > 0) || std::abs(volume - leaf.volume) > volume_rel_tolerance * volume;
        sum += volume;
    }
    const double volume = enclosed_volume(input_.vertices, input_.facets);
    add(open, "leaves that are no closed 2-manifold");
    add(crossed, "leaves that intersect themselves");
    add(wrong, "leaves that do not enclose the volume that they name");
    add(!(std::abs(sum - volume) <= volume_rel_tolerance * volume), "sum of volumes that is not the enclosed one");
}

void DecompositionLaws::check_vertices() {
    std::map<Key, Vec3> points;
    std::int64_t moved = 0, gaps = 0;
    for (std::size_t v = 0; v < input_.vertices.size(); ++v) points.emplace(input_.vertex_key[v], input_.vertices[v]);
    for (const Leaf& leaf : whole_.leaves)
        for (std::size_t v = 0; v < leaf.surface.vertices.size(); ++v) {
            const Vec3& p = leaf.surface.vertices[v];
            moved += !same_bits(points.emplace(leaf.surface.vertex_key[v], p).first->second, p);
        }
    std::map<NodeId, std::int32_t> expected = {{input_node, count_of(input_.vertices)}};
    for (const TreeNode& node : whole_.nodes)
        if (node.interface_vertices > 0) expected[node.id] = node.interface_vertices;
    std::map<NodeId, std::int32_t> found;  // the keys of a node ascend in the map
    for (const auto& [key, point] : points) gaps += key_index(key) != found[key_node(key)]++;
    add(moved, "vertices with the same key at different places");
    add(gaps, "gaps in the vertex keys of a node");
    add(found != expected, "tree that does not count the vertices of its cuts");
}

void DecompositionLaws::check_input_facets() {
    struct Piece {
        Face face;
        std::array<Vec3, 3> corners;
    };
    std::vector<std::vector<Piece>> pieces(input_.facets.size());
    std::int64_t foreign = 0, missing = 0, divided = 0;
    for (const Leaf& leaf : whole_.leaves)
        for (std::size_t f = 0; f < leaf.surface.facets.size(); ++f) {
            if (key_node(leaf.surface.facet_key[f]) != input_node) continue;
            const auto facet = static_cast<std::size_t>(key_index(leaf.surface.facet_key[f]));
            if (facet >= pieces.size() || leaf.surface.patch[f] != input_.patch[facet])
                ++foreign;
            else
                pieces[facet].push_back({face_of(leaf.surface, f), corners_of(leaf.surface, f)});
        }
    for (std::size_t f = 0; f < pieces.size(); ++f) {
        if (pieces[f].size() == 1) {
            missing += pieces[f].front().face != face_of(input_, f);
            continue;
        }
        std::vector<std::array<Vec3, 3>> corners;
        for (const Piece& piece : pieces[f]) corners.push_back(piece.corners);
        missing += !covers(corners_of(input_, f), corners);
        ++divided;
    }
    add(foreign, "facets of leaves without a facet of the input");
    add(missing, "facets of the input that are not once in the leaves");
    add(divided != static_cast<std::int64_t>(whole_.divided_facets.size()), "wrong list of divided facets");
}

void DecompositionLaws::check_interfaces() {
    struct Side {
        Face face;
        NodeId leaf;
        bool operator<(const Side& o) const { return face < o.face; }
    };
    std::vector<Side> sides;
    for (const Leaf& leaf : whole_.leaves)
        for (std::size_t f = 0; f < leaf.surface.facets.size(); ++f)
            if (key_node(leaf.surface.facet_key[f]) != input_node) sides.push_back({face_of(leaf.surface, f), leaf.id});
    std::sort(sides.begin(), sides.end());
    std::int64_t unmatched = 0, doubled = 0;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const Side back = {turned(sides[i].face), no_node};
        const auto it = std::lower_bound(sides.begin(), sides.end(), back);
        unmatched += it == sides.end() || it->face != back.face || it->leaf == sides[i].leaf;
        doubled += i > 0 && sides[i].face == sides[i - 1].face;
    }
    add(unmatched, "interface faces without their other side");
    add(doubled, "interface faces that are there twice");
}

}  // namespace

Decomposition decompose_whole(const Surface& surface, const DecomposeOptions& options, CutListener* listener) {
    const LeafRange all = {0, options.parts};
    Decomposition whole = decompose(surface, options, all, listener);
    const bool finished =
        std::all_of(whole.leaves.begin(), whole.leaves.end(), [](const Leaf& leaf) { return leaf.leaves == 1; });
    if (finished || options.facets == FacetPolicy::keep) return whole;
    return divide_straight(std::move(whole), options, all, listener);
}

std::string broken_laws(const Decomposition& whole, const SurfaceArrays& input) {
    return DecompositionLaws(whole, input).broken();
}

}  // namespace kerf::test

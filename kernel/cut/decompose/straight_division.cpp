// Straight cuts start when all contours of edges are found, because a straight cut through one part splits facets of
// its neighbours' interfaces, too. All parts are then in one FaceComplex, which is divided depth first, the half below
// before the half above. When the turn of a part comes, cuts of others may have split its facets, so it is read from
// the complex then and no sooner. The caps are triangulated after the last cut (cap_triangulation.h), and only then are
// keys assigned.
#include "cut/decompose/straight_division.h"

#include <algorithm>
#include <map>

#include "base/core/check.h"
#include "base/core/error.h"
#include "base/core/stopwatch.h"
#include "cut/decompose/cap_quality.h"
#include "cut/decompose/cap_triangulation.h"
#include "cut/decompose/inside/face_complex.h"
#include "surface/complex/touching.h"

namespace kerf {

namespace {

class StraightDivision {
 public:
    StraightDivision(Decomposition whole, const DecomposeOptions& options, CutListener* listener)
        : options_(options), listener_(listener), complex_(whole.leaves), has_contacts_(!whole.contacts.empty()) {
        for (TreeNode& node : whole.nodes) nodes_.emplace(node.id, node);
        for (const Leaf& leaf : whole.leaves) regions_.emplace(leaf.id, leaf.region);
    }

    void divide(NodeId id) { divide(id, complex_.part(id)); }
    void finish_interfaces();
    Decomposition take(LeafRange range);

 private:
    // `part` as below.
    void add_child(NodeId id, std::int32_t first_leaf, std::int32_t leaves, const FaceComplex::Part& part);
    RegionIndex region_of(NodeId leaf) const;
    // `part` is that of the complex, as it is now.
    void divide(NodeId id, const FaceComplex::Part& part);
    bool cut(TreeNode& node, const FaceComplex::Part& part);
    double load(NodeId id, const SurfaceArrays& part) const;

    const DecomposeOptions& options_;
    CutListener* listener_;
    FaceComplex complex_;
    bool has_contacts_;
    std::map<NodeId, TreeNode> nodes_;
    std::map<NodeId, RegionIndex> regions_;  // of the leaves before
    std::vector<NodeId> leaves_;             // in the order of the tree
};

double StraightDivision::load(NodeId id, const SurfaceArrays& part) const {
    const LoadModel model = options_.cut_in(region_of(id)).bisected_load();
    return model.load(static_cast<double>(part.vertices.size()), static_cast<double>(part.facets.size()),
                      model.volume_of(part, enclosed_volume(part.vertices, part.facets)));
}

void StraightDivision::add_child(NodeId id, std::int32_t first_leaf, std::int32_t leaves,
                                 const FaceComplex::Part& part) {
    const Surface surface = separated_surface(part.arrays);
    TreeNode node = describe_node(id, first_leaf, leaves, surface, mass_properties(surface));
    node.region = region_of(id);
    nodes_.emplace(id, std::move(node));
    divide(id, part);
}

bool StraightDivision::cut(TreeNode& node, const FaceComplex::Part& part) {
    const Stopwatch stopwatch;
    std::vector<CutTry> tries;
    const Surface surface = separated_surface(part.arrays);
    std::optional<StraightCut> made =
        cut_straight(surface, node.id, fraction_below(node.leaves), options_.cut_in(region_of(node.id)).of(surface),
                     tries, part.untested);
    node.cut_tried = true;
    if (!made) {
        node.tries += count_of(tries);
        return false;
    }
    complex_.divide(node.id, part, *made);
    made->cut.tries = std::move(tries);
    made->cut.seconds = stopwatch.seconds();
    const std::int32_t tries_by_edges = node.tries;
    const double seconds_by_edges = node.seconds;
    describe_cut(made->cut, node);
    node.tries += tries_by_edges;
    node.seconds += seconds_by_edges;
    if (listener_ && listener_->wants_cuts()) {
        made->cut.side = made->split.side;
        made->cut.split_parent = made->split.arrays;
        listener_->on_cut(made->parent, made->cut);
    }
    return true;
}

void StraightDivision::divide(NodeId id, const FaceComplex::Part& part) {
    if (listener_ && listener_->cancelled()) throw Error(ErrorCode::cancelled, "The run was cancelled.");
    TreeNode& node = nodes_.at(id);
    if (node.leaves == 1 || !cut(node, part)) {
        leaves_.push_back(id);
        return;
    }
    const auto [lower, upper] = children_of(id);
    const FaceComplex::Part below = complex_.part(lower);
    const std::int32_t leaves =
        leaves_below({load(lower, below.arrays), load(upper, complex_.part(upper).arrays)}, node.leaves, options_.cut);
    add_to_cut_hash(node, std::span(&leaves, 1));
    add_child(lower, node.first_leaf, leaves, below);
    add_child(upper, node.first_leaf + leaves, node.leaves - leaves, complex_.part(upper));
}

void StraightDivision::finish_interfaces() {
    triangulate_caps(complex_, [&](NodeId cut, const Vec3& place) {
        return options_.region_sizes.empty() ? options_.cut.max_interface_edge(place)
                                             : options_.cut_in(region_of(cut)).max_interface_edge(place);
    });
    for (const auto& [id, vertices] : complex_.assign_keys()) nodes_.at(id).interface_vertices = vertices;
    for (const auto& [id, cap] : measure_caps(complex_)) {
        nodes_.at(id).interface_faces = cap.faces;
        nodes_.at(id).quality = cap.quality;
    }
    std::map<NodeId, std::vector<Vec3>> corners;
    for (const ComplexFace& face : complex_.faces())
        if (face.cap != no_node)
            for (const std::int32_t v : face.corners) corners[face.cap].push_back(complex_.point(v));
    for (const auto& [id, points] : corners) add_to_cut_hash(nodes_.at(id), std::span<const Vec3>(points));
}

// Returns the region of the leaf of `whole` from which this leaf was divided.
RegionIndex StraightDivision::region_of(NodeId leaf) const {
    auto found = regions_.find(leaf);
    while (found == regions_.end()) found = regions_.find(leaf = parent_of(leaf));
    return found->second;
}

Decomposition StraightDivision::take(LeafRange range) {
    Decomposition result;
    for (const auto& [id, node] : nodes_) result.nodes.push_back(node);
    for (const NodeId id : leaves_) {
        const TreeNode& node = nodes_.at(id);
        if (!range.contains(node.first_leaf)) continue;
        result.leaves.push_back({id, node.first_leaf, node.leaves, 0, region_of(id), complex_.part(id).arrays});
        Leaf& leaf = result.leaves.back();
        leaf.volume = enclosed_volume(leaf.surface.vertices, leaf.surface.facets);
    }
    result.divided_facets = complex_.divided_facets();
    for (DividedFacet& facet : result.divided_facets) facet.region = region_of(facet.part);
    if (has_contacts_) result.contacts = complex_.find_contacts();
    std::sort(result.divided_facets.begin(), result.divided_facets.end(),
              [](const DividedFacet& a, const DividedFacet& b) { return a.facet < b.facet; });
    return result;
}

}  // namespace

Decomposition divide_straight(Decomposition whole, const DecomposeOptions& options, LeafRange range,
                              CutListener* listener) {
    KERF_CHECK(!whole.nodes.empty() && !whole.leaves.empty());
    std::vector<NodeId> leaves;
    for (const Leaf& leaf : whole.leaves) leaves.push_back(leaf.id);
    StraightDivision division(std::move(whole), options, listener);
    for (const NodeId leaf : leaves) division.divide(leaf);
    division.finish_interfaces();
    return division.take(range);
}

}  // namespace kerf

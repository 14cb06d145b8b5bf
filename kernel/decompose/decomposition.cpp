#include "decompose/decomposition.h"

namespace kerf {

namespace {

class Decomposer {
 public:
    Decomposer(const DecomposeOptions& options, LeafRange range, CutListener* listener)
        : options_(options), range_(range), listener_(listener) {}

    void descend(Surface surface, NodeId id, std::int32_t first_leaf, std::int32_t leaves);
    Decomposition take() { return std::move(result_); }

 private:
    void keep_whole(const Surface& surface, const TreeNode& node);
    std::array<double, 2> loads(const std::array<Surface, 2>& halves) const;

    const DecomposeOptions& options_;
    LeafRange range_;
    CutListener* listener_;
    Decomposition result_;
};

void Decomposer::keep_whole(const Surface& surface, const TreeNode& node) {
    if (range_.contains(node.first_leaf))
        result_.leaves.push_back({node.id, node.first_leaf, node.leaves, node.mass.volume, surface.arrays()});
}

std::array<double, 2> Decomposer::loads(const std::array<Surface, 2>& halves) const {
    const LoadModel model = options_.cut.bisected_load();
    return {model.load(halves[0], enclosed_volume(halves[0])), model.load(halves[1], enclosed_volume(halves[1]))};
}

void Decomposer::descend(Surface surface, NodeId id, std::int32_t first_leaf, std::int32_t leaves) {
    const MassProperties mass = mass_properties(surface);
    const std::size_t index = result_.nodes.size();
    result_.nodes.push_back(describe_node(id, first_leaf, leaves, surface, mass));
    const bool by_edges = options_.cut.contour != ContourMethod::straight;
    if (leaves == 1 || surface.facet_count() < 2 * min_facets_per_part || !by_edges) {
        keep_whole(surface, result_.nodes[index]);
        return;
    }
    Bisection bisection = bisect(surface, mass, id, fraction_below(leaves), options_.cut, listener_ != nullptr);
    if (listener_) listener_->on_cut(surface, bisection.cut);
    describe_cut(bisection.cut, result_.nodes[index]);
    if (!bisection.cut.made()) {
        keep_whole(surface, result_.nodes[index]);
        return;
    }
    surface = Surface();  // the halves hold all that is needed below
    const std::int32_t below = leaves_below(loads(bisection.halves), leaves, options_.cut);
    if (range_.meets(first_leaf, below)) descend(std::move(bisection.halves[0]), 2 * id, first_leaf, below);
    if (range_.meets(first_leaf + below, leaves - below))
        descend(std::move(bisection.halves[1]), 2 * id + 1, first_leaf + below, leaves - below);
}

}  // namespace

Decomposition decompose(Surface surface, const DecomposeOptions& options, LeafRange range, CutListener* listener) {
    Decomposer decomposer(options, range, listener);
    decomposer.descend(std::move(surface), 1, 0, options.parts);
    return decomposer.take();
}

}  // namespace kerf

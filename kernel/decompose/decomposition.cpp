#include "decompose/decomposition.h"

#include <algorithm>
#include <cmath>

namespace kerf {

namespace {

TreeNode describe(NodeId id, std::int32_t first_leaf, std::int32_t leaves, const Surface& surface,
                  const MassProperties& mass) {
    TreeNode node;
    node.id = id;
    node.first_leaf = first_leaf;
    node.leaves = leaves;
    node.vertices = surface.vertex_count();
    node.facets = surface.facet_count();
    node.mass = mass;
    return node;
}

void describe_cut(const Cut& cut, TreeNode& node) {
    node.cut_tried = true;
    node.cut_made = cut.made();
    node.plane = cut.plane;
    node.method = cut.method;
    node.rung = cut.rung;
    node.tries = static_cast<std::int32_t>(cut.tries.size());
    node.loops = static_cast<std::int32_t>(cut.loops.size());
    node.contour_edges = cut.contour_edges;
    node.contour_length = cut.contour_length;
    node.max_deviation = cut.max_deviation;
    node.section_area = cut.section_area;
    node.interface_area = cut.interface_area;
    node.interface_faces = static_cast<std::int32_t>(cut.interface.triangles.size());
    node.interface_vertices = static_cast<std::int32_t>(cut.interface.points.size() - cut.interface.contour.size());
    node.quality = cut.quality;
    node.seconds = cut.seconds;
}

class Decomposer {
 public:
    Decomposer(const DecomposeOptions& options, LeafRange range, CutListener* listener)
        : options_(options), range_(range), listener_(listener) {}

    void descend(Surface surface, NodeId id, std::int32_t first_leaf, std::int32_t leaves);
    Decomposition take() { return std::move(result_); }

 private:
    void keep_whole(const Surface& surface, const TreeNode& node);
    std::int32_t leaves_below(const std::array<Surface, 2>& halves, std::int32_t leaves) const;

    const DecomposeOptions& options_;
    LeafRange range_;
    CutListener* listener_;
    Decomposition result_;
};

void Decomposer::keep_whole(const Surface& surface, const TreeNode& node) {
    if (node.first_leaf >= range_.first && node.first_leaf < range_.last)
        result_.leaves.push_back({node.id, node.mass.volume, surface.arrays()});
}

// Leaves in proportion to the load that the halves really have; equidistant cuts have no load.
std::int32_t Decomposer::leaves_below(const std::array<Surface, 2>& halves, std::int32_t leaves) const {
    if (options_.cut.criterion == Criterion::equidistant) return leaves / 2;
    const LoadModel model = options_.cut.bisected_load();
    std::array<double, 2> load;
    for (int i = 0; i < 2; ++i) load[i] = model.load(halves[i], enclosed_volume(halves[i]));
    const auto share = static_cast<std::int32_t>(std::lround(leaves * load[0] / (load[0] + load[1])));
    return std::clamp(share, 1, leaves - 1);
}

void Decomposer::descend(Surface surface, NodeId id, std::int32_t first_leaf, std::int32_t leaves) {
    const MassProperties mass = mass_properties(surface);
    const std::size_t index = result_.nodes.size();
    result_.nodes.push_back(describe(id, first_leaf, leaves, surface, mass));
    if (leaves == 1 || surface.facet_count() < 2 * min_facets_per_part) {
        keep_whole(surface, result_.nodes[index]);
        return;
    }
    const double fraction = static_cast<double>(leaves / 2) / leaves;
    Bisection bisection = bisect(surface, mass, id, fraction, options_.cut, listener_ != nullptr);
    if (listener_) listener_->on_cut(surface, bisection.cut);
    describe_cut(bisection.cut, result_.nodes[index]);
    if (!bisection.cut.made()) {
        keep_whole(surface, result_.nodes[index]);
        return;
    }
    surface = Surface();  // the halves hold all that is needed below
    const std::int32_t below = leaves_below(bisection.halves, leaves);
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

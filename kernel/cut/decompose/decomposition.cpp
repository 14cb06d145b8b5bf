// The recursion. A node is cut at the share of the load that its leaves demand (cut/cut/bisect.h), and its halves are
// descended, on two threads where some are free. The halves of a cut are independent, so each branch of the tree is a
// value of its own, which its parent appends in the order of the tree, whichever thread has finished first: results do
// not depend on threads. With `others` set, a half that belongs to another range is handed over instead of descended;
// without, all nodes that lead to leaves of the range are cut here. Nodes without a valid cut become leaves that want
// more than one part, for straight_division.h.
#include "cut/decompose/decomposition.h"

#include <mutex>

#include "base/core/check.h"
#include "base/core/error.h"
#include "base/core/threads.h"
#include "cut/decompose/inside/region_tree.h"

namespace kerf {

namespace {

// The regions of a complex, and the tree above their roots.
struct Regions {
    const Complex& complex;
    Array<RegionIndex, RegionMeasures> measures;
    RegionTree tree;
};

class Decomposer {
 public:
    // With `others` null, all nodes above leaves of the range are cut here, whichever range they belong to.
    Decomposer(const DecomposeOptions& options, LeafRange range, OtherRanges* others, CutListener* listener)
        : options_(options),
          range_(range),
          others_(others),
          listener_(listener),
          records_(listener && listener->wants_cuts()) {
        options_.cut.check_cancelled = CancellationCheck([this] { end_if_cancelled(); });
    }

    Decomposition descend(Surface surface, const Branch& branch);
    Decomposition descend(const Regions& regions, const RegionTree::Node& node);

 private:
    using Halves = std::array<Surface, 2>;

    void end_if_cancelled() const {
        if (listener_ && listener_->cancelled()) throw Error(ErrorCode::cancelled, "The run was cancelled.");
    }
    void keep_whole(const Surface& surface, Decomposition& result) const;
    static std::array<double, 2> loads(const Halves& halves, const LoadModel& model);
    void tell_listener(const Surface& surface, const Cut& cut);
    bool is_own(const Branch& branch) const {
        return others_ ? range_.contains(branch.first_leaf) : range_.meets(branch.first_leaf, branch.leaves);
    }
    void descend_halves(Halves halves, const std::array<Branch, 2>& branches, Decomposition& result);
    // Appends descend_half(i) of both halves, if they are wanted.
    template <class DescendHalf>
    void descend_both(const std::array<bool, 2>& wanted, Decomposition& result, const DescendHalf& descend_half);

    DecomposeOptions options_;
    LeafRange range_;
    OtherRanges* others_;
    CutListener* listener_;
    bool records_;
    std::mutex listener_mutex_;
};

void append(Decomposition& result, Decomposition branch) {
    result.nodes.insert(result.nodes.end(), branch.nodes.begin(), branch.nodes.end());
    std::move(branch.leaves.begin(), branch.leaves.end(), std::back_inserter(result.leaves));
}

// The last node of the result becomes a leaf.
void Decomposer::keep_whole(const Surface& surface, Decomposition& result) const {
    const TreeNode& node = result.nodes.back();
    if (range_.contains(node.first_leaf))
        result.leaves.push_back(
            {node.id, node.first_leaf, node.leaves, node.mass.volume, node.region, surface.arrays()});
    if (others_ && node.leaves > 1) others_->are_one_part({node.first_leaf, node.first_leaf + node.leaves});
}

std::array<double, 2> Decomposer::loads(const Halves& halves, const LoadModel& model) {
    const auto load = [&](const Surface& half) {
        double volume = model.needs_volume() ? enclosed_volume(half) : 0;
        if (model.depends_on_place()) volume = model.volume_of(half.arrays(), volume);
        return model.load(half.vertex_count(), half.facet_count(), volume);
    };
    return {load(halves[0]), load(halves[1])};
}

void Decomposer::tell_listener(const Surface& surface, const Cut& cut) {
    if (!records_) return;
    const std::lock_guard lock(listener_mutex_);
    listener_->on_cut(surface, cut);
}

Decomposition Decomposer::descend(Surface surface, const Branch& branch) {
    end_if_cancelled();
    const auto [id, first_leaf, leaves, region] = branch;
    const MassProperties mass = mass_properties(surface);
    Decomposition result;
    TreeNode& node = result.nodes.emplace_back(describe_node(id, first_leaf, leaves, surface, mass));
    node.region = region;
    const bool by_edges = options_.cut.contour != ContourMethod::straight;
    if (leaves == 1 || surface.facet_count() < 2 * min_facets_per_part || !by_edges) {
        keep_whole(surface, result);
        return result;
    }
    const auto [lower_id, upper_id] = children_of(id);
    const CutOptions of_region = options_.cut_in(region), cut = of_region.of(surface);
    const CutPlace place = choose_place(surface, mass, leaves, cut);
    Bisection bisection = bisect(surface, mass, id, place, cut, records_);
    tell_listener(surface, bisection.cut);
    describe_cut(bisection.cut, node);
    if (!bisection.cut.made()) {
        keep_whole(surface, result);
        return result;
    }
    surface = Surface();  // the halves hold all that is needed below
    const std::int32_t below =
        leaves == 2 ? 1 : leaves_below(loads(bisection.halves, of_region.bisected_load()), leaves, cut);
    add_to_cut_hash(node, std::span(&below, 1));
    const Branch lower{lower_id, first_leaf, below, region},
        upper{upper_id, first_leaf + below, leaves - below, region};
    descend_halves(std::move(bisection.halves), {lower, upper}, result);
    return result;
}

// Halves for other ranges are handed over first, because others wait for them.
void Decomposer::descend_halves(Halves halves, const std::array<Branch, 2>& branches, Decomposition& result) {
    const std::array<bool, 2> own = {is_own(branches[0]), is_own(branches[1])};
    for (const std::size_t i : {0, 1}) {
        if (own[i]) continue;
        Surface half = std::exchange(halves[i], {});
        if (others_) others_->take(branches[i], std::move(half));
    }
    descend_both(own, result, [&](std::size_t i) { return descend(std::exchange(halves[i], {}), branches[i]); });
}

template <class DescendHalf>
void Decomposer::descend_both(const std::array<bool, 2>& wanted, Decomposition& result,
                              const DescendHalf& descend_half) {
    std::array<Decomposition, 2> below;
    const auto descend_wanted = [&](std::size_t i) {
        if (wanted[i]) below[i] = descend_half(i);
    };
    if (options_.threads > 1 && wanted[0] && wanted[1])
        for_each_on_threads(2, descend_wanted);
    else
        for (const std::size_t i : {0, 1}) descend_wanted(i);
    for (Decomposition& half : below) append(result, std::move(half));
}

Decomposition Decomposer::descend(const Regions& regions, const RegionTree::Node& node) {
    const RegionTree& tree = regions.tree;
    if (node.regions == 1) {
        const Branch branch{node.id, tree.first_leaf(node), tree.leaves(node), tree.region(node)};
        return is_own(branch) ? descend(regions.complex.surface_of(branch.region), branch) : Decomposition();
    }
    Decomposition result;
    result.nodes.push_back(tree.describe(node, regions.measures));
    const std::array<RegionTree::Node, 2> halves = tree.halves(node);
    const auto wanted = [&](std::size_t i) { return range_.meets(tree.first_leaf(halves[i]), tree.leaves(halves[i])); };
    descend_both({wanted(0), wanted(1)}, result, [&](std::size_t i) { return descend(regions, halves[i]); });
    return result;
}

Decomposition cut_regions(const Complex& complex, const DecomposeOptions& options, LeafRange range, OtherRanges* others,
                          CutListener* listener) {
    KERF_CHECK(options.parts >= complex.region_count() && options.threads >= 1);
    Array<RegionIndex, RegionMeasures> measures = measure_regions(complex, options);
    const RegionTree tree(complex, measures, options.parts);
    const Regions regions{complex, std::move(measures), tree};
    Decomposition result = Decomposer(options, range, others, listener).descend(regions, tree.root());
    result.contacts = complex.find_contacts();
    return result;
}

}  // namespace

CutOptions DecomposeOptions::cut_in(RegionIndex region) const {
    CutOptions options = cut;
    if (!region_sizes.empty()) options.size = region_sizes.of(region, cut.size);
    return options;
}

Decomposition decompose(Surface surface, const DecomposeOptions& options, LeafRange range, CutListener* listener) {
    KERF_CHECK(surface.facet_count() > 0);
    KERF_CHECK(options.parts >= 1 && options.threads >= 1);
    return Decomposer(options, range, nullptr, listener).descend(std::move(surface), {root_node, 0, options.parts, {}});
}

Decomposition decompose(const Complex& complex, const DecomposeOptions& options, LeafRange range,
                        CutListener* listener) {
    if (complex.region_count() == 1) return decompose(complex.surface_of(RegionIndex(0)), options, range, listener);
    return cut_regions(complex, options, range, nullptr, listener);
}

Decomposition decompose_branch(Surface surface, const Branch& branch, const DecomposeOptions& options, LeafRange range,
                               OtherRanges& others, CutListener* listener) {
    KERF_CHECK(surface.facet_count() > 0 && options.threads >= 1);
    KERF_CHECK(range.contains(branch.first_leaf));
    return Decomposer(options, range, &others, listener).descend(std::move(surface), branch);
}

Decomposition decompose_regions(const Complex& complex, const DecomposeOptions& options, LeafRange range,
                                OtherRanges& others, CutListener* listener) {
    KERF_CHECK(complex.region_count() > 1);
    return cut_regions(complex, options, range, &others, listener);
}

}  // namespace kerf

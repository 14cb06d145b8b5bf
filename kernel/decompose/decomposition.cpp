// The halves of a cut are independent, so each branch of the tree is a value of its own, which its parent appends in
// the order of the tree, whichever thread has finished first.
#include "decompose/decomposition.h"

#include <future>
#include <mutex>

#include "core/check.h"
#include "core/error.h"
#include "decompose/region_tree.h"

namespace kerf {

namespace {

// A node and all below it.
struct Branch {
    NodeId id = 1;
    std::int32_t first_leaf = 0, leaves = 1;
    RegionIndex region;
};

// Several of them, and the tree above their roots.
struct Regions {
    const Complex& complex;
    std::vector<RegionMeasures> measures;
    RegionTree tree;
};

class Decomposer {
 public:
    Decomposer(const DecomposeOptions& options, LeafRange range, CutListener* listener)
        : options_(options), range_(range), listener_(listener), records_(listener && listener->wants_cuts()) {
        options_.cut.check_cancelled = CancellationCheck([this] { end_if_cancelled(); });
    }

    Decomposition descend(Surface surface, const Branch& branch, std::int32_t threads);
    Decomposition descend(const Regions& regions, const RegionTree::Node& node, std::int32_t threads);

 private:
    using Halves = std::array<Surface, 2>;

    void end_if_cancelled() const {
        if (listener_ && listener_->cancelled()) throw Error(ErrorCode::cancelled, "The run was cancelled.");
    }
    void keep_whole(const Surface& surface, Decomposition& result) const;
    static std::array<double, 2> loads(const Halves& halves, const LoadModel& model);
    void tell_listener(const Surface& surface, const Cut& cut);
    void descend_halves(Halves halves, const std::array<Branch, 2>& branches, std::int32_t threads,
                        Decomposition& result);
    // Calls descend_half(i, threads) for both halves, if they have leaves in the range, on two threads if there are.
    template <class DescendHalf>
    void descend_both(const std::array<bool, 2>& wanted, std::int32_t threads, Decomposition& result,
                      DescendHalf descend_half);

    DecomposeOptions options_;
    LeafRange range_;
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
        result.leaves.push_back({node.id, node.first_leaf, node.leaves, node.mass.volume, {}, surface.arrays()});
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

Decomposition Decomposer::descend(Surface surface, const Branch& branch, std::int32_t threads) {
    end_if_cancelled();
    const auto [id, first_leaf, leaves, region] = branch;
    const MassProperties mass = mass_properties(surface);
    Decomposition result;
    TreeNode& node = result.nodes.emplace_back(describe_node(id, first_leaf, leaves, surface, mass));
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
    descend_halves(std::move(bisection.halves), {lower, upper}, threads, result);
    return result;
}

void Decomposer::descend_halves(Halves halves, const std::array<Branch, 2>& branches, std::int32_t threads,
                                Decomposition& result) {
    const auto wanted = [&](std::size_t i) { return range_.meets(branches[i].first_leaf, branches[i].leaves); };
    descend_both({wanted(0), wanted(1)}, threads, result, [&](std::size_t i, std::int32_t own_threads) {
        return descend(std::exchange(halves[i], {}), branches[i], own_threads);
    });
}

template <class DescendHalf>
void Decomposer::descend_both(const std::array<bool, 2>& wanted, std::int32_t threads, Decomposition& result,
                              DescendHalf descend_half) {
    if (threads > 1 && wanted[0] && wanted[1]) {
        std::future<Decomposition> below = std::async(std::launch::async, descend_half, 0, threads / 2);
        Decomposition above = descend_half(1, threads - threads / 2);
        append(result, below.get());
        append(result, std::move(above));
    } else {
        for (const std::size_t i : {0, 1})
            if (wanted[i]) append(result, descend_half(i, threads));
    }
}

Decomposition Decomposer::descend(const Regions& regions, const RegionTree::Node& node, std::int32_t threads) {
    const RegionTree& tree = regions.tree;
    if (node.regions == 1) {
        Decomposition branch = descend(regions.complex.surface_of(tree.region(node)),
                                       {node.id, tree.first_leaf(node), tree.leaves(node), tree.region(node)}, threads);
        for (Leaf& leaf : branch.leaves) leaf.region = tree.region(node);
        for (TreeNode& below : branch.nodes) below.region = tree.region(node);
        return branch;
    }
    Decomposition result;
    result.nodes.push_back(tree.describe(node, regions.measures));
    const std::array<RegionTree::Node, 2> halves = tree.halves(node);
    const auto wanted = [&](std::size_t i) { return range_.meets(tree.first_leaf(halves[i]), tree.leaves(halves[i])); };
    descend_both({wanted(0), wanted(1)}, threads, result,
                 [&](std::size_t i, std::int32_t own_threads) { return descend(regions, halves[i], own_threads); });
    return result;
}

}  // namespace

CutOptions DecomposeOptions::cut_in(RegionIndex region) const {
    CutOptions options = cut;
    if (!region_sizes.empty()) options.size = options.load.size = region_sizes.of(region, cut.size);
    return options;
}

Decomposition decompose(Surface surface, const DecomposeOptions& options, LeafRange range, CutListener* listener) {
    KERF_CHECK(surface.facet_count() > 0);
    KERF_CHECK(options.parts >= 1 && options.threads >= 1);
    return Decomposer(options, range, listener).descend(std::move(surface), {1, 0, options.parts, {}}, options.threads);
}

Decomposition decompose(const Complex& complex, const DecomposeOptions& options, LeafRange range,
                        CutListener* listener) {
    if (complex.region_count() == 1) return decompose(complex.surface_of(RegionIndex(0)), options, range, listener);
    KERF_CHECK(options.parts >= complex.region_count() && options.threads >= 1);
    std::vector<RegionMeasures> measures = measure_regions(complex, options);
    const RegionTree tree(complex, measures, options.parts);
    const Regions regions{complex, std::move(measures), tree};
    Decomposition result = Decomposer(options, range, listener).descend(regions, tree.root(), options.threads);
    result.contacts = complex.find_contacts();
    return result;
}

}  // namespace kerf

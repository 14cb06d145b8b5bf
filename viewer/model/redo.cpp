#include "viewer/model/redo.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "cut/bisect.h"
#include "cut/place.h"
#include "cut/straight.h"
#include "run/size_reader.h"
#include "viewer/model/tree_source.h"

namespace kerf::view {

namespace {

struct MadeCut {
    Cut cut;
    std::vector<TreeRow> halves;
};

TreeRow row_of(NodeId id, const Surface& surface) {
    TreeRow row;
    row.id = id;
    describe_surface(surface.vertex_count(), surface.facet_count(), mass_properties(surface), row);
    return row;
}

// As the run divides what no contour of edges divides; its interface is not triangulated finely.
bool cut_straight(const Surface& surface, NodeId node, const CutPlace& place, const CutOptions& options,
                  MadeCut& made) {
    std::vector<CutTry> tries;
    std::optional<StraightCut> straight = kerf::cut_straight(surface, node, place.fraction, options, tries);
    made.cut.tries.insert(made.cut.tries.end(), tries.begin(), tries.end());
    if (!straight) return false;
    tries = std::move(made.cut.tries);
    made.cut = std::move(straight->cut);
    made.cut.tries = std::move(tries);
    made.cut.place = place;
    made.cut.side = straight->split.side;
    made.cut.split_parent = straight->split.arrays;
    return true;
}

MadeCut make_cut(const Surface& surface, NodeId node, const CutPlace& place, const DecomposeOptions& options) {
    MadeCut made;
    made.cut.node = node;
    made.cut.place = place;
    if (options.cut.contour != ContourMethod::straight) {
        Bisection bisection = bisect(surface, mass_properties(surface), node, place, options.cut, true);
        made.cut = std::move(bisection.cut);
        if (made.cut.made()) {
            for (const int i : {0, 1}) made.halves.push_back(row_of(2 * node + i, bisection.halves[i]));
            return made;
        }
    }
    if (options.facets == FacetPolicy::split) cut_straight(surface, node, place, options.cut, made);
    return made;
}

}  // namespace

RedoneCut redo_cut(Replayer& replayer, NodeId node, RunOptions options) {
    options.resolve(1);
    const Trace& old = *replayer.trace();
    if (options.sizes.depends_on_place())
        options.use_sizes(read_size_field(options.sizes, old.surface, old.patch_names));
    const Cut* before = old.find(node);
    RedoneCut redone;
    if (before) redone.before = std::make_shared<const Cut>(*before);
    const std::shared_ptr<const Surface> surface = replayer.uncut_surface(node);
    options.decompose.cut = options.decompose.cut.of(*surface);
    const CutOptions& cut_options = options.decompose.cut;
    const CutPlace place = before ? before->place : choose_place(*surface, mass_properties(*surface), 2, cut_options);
    MadeCut made = make_cut(*surface, node, place, options.decompose);
    redone.rows.push_back(row_of(node, *surface));
    describe_cut(made.cut, redone.rows.front());
    redone.rows.front().leaves = made.cut.made() ? 2 : 1;
    made.cut.seconds = 0;  // as in every trace

    const auto trace = std::make_shared<Trace>(old);
    std::erase_if(trace->cuts, [&](const Cut& cut) { return lies_below(cut.node, node); });
    const auto position =
        std::partition_point(trace->cuts.begin(), trace->cuts.end(), [&](const Cut& cut) { return cut.node < node; });
    const bool is_made = trace->cuts.insert(position, std::move(made.cut))->made();
    redone.replayer = std::make_shared<Replayer>(replayer, trace, node);

    if (is_made && made.halves.empty())  // of a straight cut the kernel gives no halves
        for (const NodeId half : {2 * node, 2 * node + 1})
            made.halves.push_back(row_of(half, *redone.replayer->surface(half)));
    redone.rows.insert(redone.rows.end(), made.halves.begin(), made.halves.end());
    return redone;
}

}  // namespace kerf::view

#include "kerf/cut_tree.h"

#include <algorithm>
#include <utility>

#include "base/core/host_name.h"
#include "base/parallel/processors.h"
#include "kerf/inside/run_request.h"
#include "kerf/progress_listener.h"
#include "run/prepare/gathered_nodes.h"
#include "run/run/cut_stage.h"
#include "run/run/plan.h"
#include "run/run/prepare_stage.h"

namespace kerf {

namespace {

std::vector<EdgeEnds> segments_of(const Surface& parent, const std::vector<SurfaceEdge>& edges) {
    std::vector<EdgeEnds> segments;
    segments.reserve(edges.size());
    for (const auto& [from, to] : edges) segments.push_back({parent.point(from), parent.point(to)});
    return segments;
}

RecordedCut record(const Surface& parent, const Cut& cut) {
    RecordedCut record;
    for (const CutTry& each : cut.tries) {
        RecordedTry& kept = record.tries.emplace_back(RecordedTry{each, segments_of(parent, each.contour)});
        kept.what.contour.clear();
    }
    for (const std::vector<Vertex>& loop : cut.loops) {
        std::vector<Vec3>& points = record.contour.emplace_back();
        for (const Vertex vertex : loop) points.push_back(parent.point(vertex));
    }
    record.stages = {segments_of(parent, cut.stages.crossed_edges),
                     segments_of(parent, cut.stages.hanging_edges_removed),
                     segments_of(parent, cut.stages.closed_loops),
                     segments_of(parent, cut.stages.multiple_paths_removed), segments_of(parent, cut.stages.smoothed)};
    return record;
}

// Keeps every cut, while the surface that it divides is at hand.
class CutRecorder : public ProgressListener {
 public:
    using ProgressListener::ProgressListener;
    bool wants_cuts() const override { return true; }
    void on_cut(const Surface& parent, const Cut& cut) override {
        RecordedCut& kept = cuts_[cut.node];
        std::vector<RecordedTry> tries = std::move(kept.tries);  // of edges, where a straight cut follows
        kept = record(parent, cut);
        kept.tries.insert(kept.tries.begin(), tries.begin(), tries.end());
    }
    std::map<NodeId, RecordedCut> take_cuts() { return std::move(cuts_); }

 private:
    std::map<NodeId, RecordedCut> cuts_;
};

}  // namespace

CutTree cut_to_tree(const ClosedSurface& surface, const MeshOptions& options) {
    SingleRank alone;
    CutRecorder recorder(options.progress, options.is_cancelled);
    refuse_options_of_surface(options.others);
    RunRequest request = run_options(surface.input().path, options, "");
    request.volume = false;
    const auto processors = static_cast<int>(std::max<std::size_t>(1, allowed_processors().size()));
    auto [plan, input] = plan_run(request, processors, alone, &recorder, surface.input());
    Decomposition cut = cut_surface(alone, input, plan, &recorder);
    CutTree tree;
    tree.nodes = gather_nodes(alone, cut.nodes, host_name());
    PreparedParts prepared = prepare_parts(alone, input, tree.nodes, std::move(cut), plan);
    if (prepared.missing_input_facets + prepared.unmatched_interface_facets > 0)
        throw Error(ErrorCode::verification, "A law of the parts does not hold.");
    for (OwnPart& part : prepared.own) tree.parts.push_back(std::move(part.job));
    tree.cuts = recorder.take_cuts();
    tree.patch_names = input.patch_names;
    tree.region_names.assign(input.complex.region_names().begin(), input.complex.region_names().end());
    return tree;
}

}  // namespace kerf

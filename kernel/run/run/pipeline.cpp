// One function, run(), has the order of all stages; each is a function from values to values, called by every rank: the
// report goes through them and gets what each of them tells. The first rank reads the input and decides all, in the
// plan; the surface becomes the jobs of the parts (run/run/inside/surface_stage.h), and these become meshes and their
// files (run/run/inside/mesh_stage.h), all in a folder that is kept from the beginning and moved to its place at the
// end (run/run/inside/result_folder.h). A transient run, that of a mesh in memory, has the same order.
#include "run/run/pipeline.h"

#include <utility>

#include "base/core/thread_limit.h"
#include "run/report/totals.h"
#include "run/run/inside/mesh_stage.h"
#include "run/run/inside/result_folder.h"
#include "run/run/inside/run_context.h"
#include "run/run/inside/surface_stage.h"

namespace kerf {

namespace {

RunReport report_of_plan(const RunContext& run, Input input) {
    RunReport report;
    report.mesh.quality = PartQuality(input.diagonal);
    report.input = std::move(input);
    report.request = run.plan.request();
    report.size = run.plan.size;
    report.ranks = run.ranks.size();
    report.found_size = run.plan.found_size;
    report.seconds.read = run.longest(run.whole);
    return report;
}

}  // namespace

RunReport run(const RunRequest& request, int cores_of_rank, Communicator& ranks, RunListener* listener,
              std::optional<Input> surface) {
    const Stopwatch whole;
    const ThreadLimitGuard limit;  // the plan sets one
    PlannedRun planned = plan_run(request, cores_of_rank, ranks, listener, std::move(surface));
    const RunContext run{planned.plan, ranks, listener, whole};
    const RunRequest& wanted = run.plan.request();
    RunReport report = report_of_plan(run, std::move(planned.input));
    const std::optional<Surface> whole_surface = surface_for_reference(run, report.input);
    std::optional<RunFolder> folder;  // none for a dry run
    try {
        if (!wanted.dry_run) keep_folder(run, report.input, folder.emplace(open_folder(run, report.input)));
        CutParts cut = cut_into_parts(run, std::move(report));
        report = std::move(cut.report);
        if (wanted.dry_run) {
            announce_parts(run, report);
            return report;
        }
        std::optional<VolumeStage> volume;
        if (wanted.volume) volume.emplace(ranks, *folder, planned.plan, report.input.diagonal, listener);
        report =
            hand_over_parts(run, *folder, std::move(report), std::move(cut.prepared.own), volume ? &*volume : nullptr);
        announce_parts(run, report);
        if (volume)
            report = mesh_parts(run, *folder, std::move(report), *volume, cut.prepared.surface_vertices, whole_surface);
        else
            join_surfaces(run, *folder, report);
        add_up_parts(report);
        return finish_run(run, folder, std::move(report));
    } catch (const Error& error) {
        throw with_way_to_go_on(wanted, folder, error);
    }
}

}  // namespace kerf

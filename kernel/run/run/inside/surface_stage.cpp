// Each node of the tree is cut by one rank, which passes halves on; the ranks talk to match interfaces and to share
// vertices (run/run/cut_stage.h, run/run/prepare_stage.h). A rank that has written the job of a part forgets its
// surface: from there on, parts travel as files, from the rank that cut them to the worker that takes them.
#include "run/run/inside/surface_stage.h"

#include <algorithm>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "base/core/host_name.h"
#include "base/parallel/process_memory.h"
#include "files/io/stl_writer.h"
#include "files/io/text_file.h"
#include "files/part/joined_surfaces.h"
#include "files/part/part_store.h"
#include "files/part/vtu_writer.h"
#include "run/prepare/gathered_nodes.h"
#include "run/run/cut_stage.h"
#include "run/run/inside/forecast.h"
#include "run/run/inside/result_folder.h"

namespace kerf {

CutParts cut_into_parts(const RunContext& run, RunReport report) {
    Decomposition own = run.timed(report.seconds.decompose,
                                  [&] { return cut_surface(run.ranks, report.input, run.plan, run.listener); });
    report.cut.split_facets = std::ssize(own.divided_facets);
    PreparedParts prepared = run.timed(report.seconds.prepare, [&] {
        report.cut.nodes = gather_nodes(run.ranks, own.nodes, host_name());
        return prepare_parts(run.ranks, report.input, report.cut.nodes, std::move(own), run.plan);
    });
    report.verification.unmatched_interface_faces = prepared.unmatched_interface_facets;
    report.verification.input_faces_missing = prepared.missing_input_facets;
    report.parts = gather_reports(run.ranks, prepared.own);
    return {std::move(report), std::move(prepared)};
}

RunReport hand_over_parts(const RunContext& run, RunFolder& folder, RunReport report, std::vector<OwnPart> own,
                          VolumeStage* volume) {
    const RunRequest& request = run.plan.request();
    const Stopwatch stopwatch;
    const std::size_t finished_before = clear_folder(run, report.input, folder, report.parts);
    in_agreement(run.ranks, [&] {
        for (std::size_t i = 0; i < own.size(); ++i) {
            tell_progress(run.listener, "prepare", i, own.size());
            PartReport& part = own[i].report;
            const PartJob job = std::exchange(own[i].job, {});
            folder.make_room({job.part});
            if (!request.transient)
                part.surface_hash = write_part_surface(folder.part_surface_file(job.part), part_of_job(job));
            if (request.outputs.stl)
                write_stl(folder.part_stl_file(job.part), job.surface.vertices, job.surface.facets);
            if (volume) volume->hand_over(job, part);
        }
    });
    report.parts = gather_reports(run.ranks, own);
    const std::size_t resumed =
        std::count_if(report.parts.begin(), report.parts.end(), std::mem_fn(&PartReport::resumed));
    if (run.is_root() && resumed < finished_before)
        report.input.notes.push_back(fmt::format("{} parts of an interrupted run were no longer of use and are removed",
                                                 finished_before - resumed));
    report.seconds.prepare += run.longest(stopwatch);
    return report;
}

void announce_parts(const RunContext& run, const RunReport& report) {
    const RunRequest& request = run.plan.request();
    const Input& input = report.input;
    // The seconds of reading tell how fast the machine is, unless CAD was imported or the surface remeshed in them.
    const bool shows_pace = !input.is_cad && !input.remeshed;
    const double pace = shows_pace ? pace_of_reading(report.seconds.read, input.facets) : 1;
    in_agreement(run.ranks, [&] {
        if (run.listener && run.is_root() && request.volume)
            run.listener->on_parts(
                report.parts, (report.found_size ? plan_text(*report.found_size) : "") +
                                  (request.dry_run ? plan_text(run.whole.seconds(), own_peak_rss_bytes()) : "") +
                                  plan_text(report.parts, run.plan.mesher(), run.ranks.size() * request.workers.count,
                                            request.dry_run, pace));
    });
}

void join_surfaces(const RunContext& run, const RunFolder& folder, const RunReport& report) {
    in_agreement(run.ranks, [&] {
        if (!run.is_root()) return;
        std::vector<std::string> names, paths;
        for (const PartReport& part : report.parts) {
            names.push_back("parts/" + part_surface_file_name(part.id));
            paths.push_back(folder.part_surface_file(part.id));
        }
        const std::span<const std::string> regions = report.input.complex.region_names();
        write_text_file(folder.file("surfaces.pvtu"), surfaces_pvtu_text(names, regions));
        write_joined_surfaces(folder.file("surfaces.vtu"), paths, report.input.patch_names, regions);
    });
}

}  // namespace kerf

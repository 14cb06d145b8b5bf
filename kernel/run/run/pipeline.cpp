// One function, run(), has the order of all stages; each is a function from values to values, called by every rank. The
// first rank reads the input, and each node of the tree is cut by one rank, which passes halves on. The ranks talk to
// match interfaces, to share the parts out, to number the vertices, and to report. Parts and meshes travel as files:
// from the rank that cut them to the worker that takes them, and from there to their place; a rank that has written the
// job of a part forgets its surface.
//
// The folder of a run lies beside its final place until finish() moves it there. It is kept from the beginning, so that
// after an error or a kill the next run into it finds finished parts. The store of a part goes as soon as its files are
// there, if no format asks for the part again: the disk never holds both, and a run that continues makes the store of
// the file of vtu again (restore_stored_part()). A transient run, that of a mesh in memory, has the same order, but a
// temporary folder without journal, surfaces and hashes, and gives its store to the listener instead of writing
// formats.
#include "run/run/pipeline.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/core/host_name.h"
#include "base/core/stopwatch.h"
#include "base/core/thread_limit.h"
#include "base/parallel/process_memory.h"
#include "files/io/output_file.h"
#include "files/io/stl_writer.h"
#include "files/io/text_file.h"
#include "files/part/curved_nodes_file.h"
#include "files/part/joined_surfaces.h"
#include "files/part/part_store.h"
#include "files/part/second_order_parts.h"
#include "files/part/vtu_writer.h"
#include "run/prepare/gathered_nodes.h"
#include "run/report/totals.h"
#include "run/request/saved_run.h"
#include "run/run/cut_stage.h"
#include "run/run/edge_numbering.h"
#include "run/run/inside/curve_stage.h"
#include "run/run/inside/forecast.h"
#include "run/run/inside/reference.h"
#include "run/run/inside/run_files.h"
#include "run/run/inside/volume_stage.h"
#include "run/run/inside/write_stage.h"
#include "run/run/plan.h"
#include "run/run/prepare_stage.h"
#include "run/run/shared_folder.h"

namespace kerf {

namespace {

// Returns the longest of the seconds of all ranks.
double longest(Communicator& ranks, double seconds) {
    double most = 0;
    for (double s : all_gather(ranks, seconds)) most = std::max(most, s);
    return most;
}

// Returns the result of a stage, and adds its wall clock, the longest over the ranks.
template <class Stage>
auto timed(Communicator& ranks, double& seconds, Stage stage) {
    double own = 0;
    auto value = timed(own, std::move(stage));
    seconds += longest(ranks, own);
    return value;
}

// The values that all stages use.
struct RunContext {
    const RunOptions& options;
    Communicator& ranks;
    Input& input;
    RunListener* listener;
    const std::optional<FoundSize>& found_size;
    const SurfaceNodes& surface_nodes;

    bool is_root() const { return ranks.rank() == 0; }
};

// Saves the options: a run that is continued by the name of its folder has nothing else to go by.
void save(const RunContext& run, const RunFolder& folder) {
    std::error_code ignored;
    if (run.options.sizes.background)
        std::filesystem::remove(folder.saved_run_file(), ignored);
    else
        save_run(folder.saved_run_file(), run.options, run.input.file_hash);
}

RunFolder open_folder(const RunContext& run) {
    return open_together(run.ranks, [&] {
        if (run.options.transient) return RunFolder::create_transient(run.options.output);
        return RunFolder::create(run.options.output, [&](const std::string& saved) {
            return run.options.volume && is_same_run(saved, run.options, run.input.file_hash);
        });
    });
}

// Makes the run one that can be continued by the name of its folder from the beginning on, however it ends.
void keep_folder(const RunContext& run, RunFolder& folder) {
    in_agreement(run.ranks, [&] {
        if (!run.is_root() || !run.options.volume || run.options.transient) return;
        if (folder.finished_parts() == 0) save(run, folder);  // else the options are those of the finished parts, until
        folder.keep();                                        // this run knows its own
    });
}

// Tells the listener of the parts and the forecast before they are meshed.
void announce_parts(const RunContext& run, const std::vector<PartReport>& parts, double read_seconds,
                    const Stopwatch& whole) {
    // The seconds of reading tell how fast the machine is, unless CAD was imported or the surface remeshed in them.
    const bool shows_pace = !run.input.is_cad && !run.input.remeshed;
    const double pace = shows_pace ? pace_of_reading(read_seconds, static_cast<double>(run.input.facets)) : 1;
    in_agreement(run.ranks, [&] {
        if (run.listener && run.is_root() && run.options.volume)
            run.listener->on_parts(parts,
                                   (run.found_size ? plan_text(*run.found_size) : "") +
                                       (run.options.dry_run ? plan_text(whole.seconds(), own_peak_rss_bytes()) : "") +
                                       plan_text(parts, run.options, run.ranks.size(), run.options.dry_run, pace));
    });
}

// Keeps only the files of the folder that this run can use, and returns how many parts an interrupted one had finished.
std::size_t clear_folder(const RunContext& run, RunFolder& folder, const std::vector<PartReport>& parts) {
    return in_agreement(run.ranks, [&] {
        if (!run.is_root() || run.options.transient) return std::size_t{0};
        const std::size_t finished = folder.finished_parts();
        std::vector<int> leaves;
        if (run.options.volume)
            for (const PartReport& part : parts) leaves.push_back(part.id);
        folder.keep_only(leaves);
        if (run.options.volume) save(run, folder);
        return finished;
    });
}

// Moves the surfaces of this rank's parts out of its memory: their jobs are written in files for the stage that meshes,
// if there is one. Returns the reports of all parts, with the numbers that are known by then.
std::vector<PartReport> hand_over_parts(const RunContext& run, RunFolder& folder, std::vector<PartReport> parts,
                                        std::vector<OwnPart> own, VolumeStage* volume) {
    const std::size_t finished_before = clear_folder(run, folder, parts);
    in_agreement(run.ranks, [&] {
        for (std::size_t i = 0; i < own.size(); ++i) {
            tell_progress(run.listener, "prepare", i, own.size());
            PartReport& report = own[i].report;
            const PartJob job = std::exchange(own[i].job, {});
            folder.make_room({job.part});
            if (!run.options.transient)
                report.surface_hash = write_part_surface(folder.part_surface_file(job.part), part_of_job(job));
            if (run.options.stl) write_stl(folder.part_stl_file(job.part), job.surface.vertices, job.surface.facets);
            if (volume) volume->hand_over(job, report);
        }
    });
    parts = gather_reports(run.ranks, own);
    const auto resumed =
        static_cast<std::size_t>(std::count_if(parts.begin(), parts.end(), std::mem_fn(&PartReport::resumed)));
    if (run.is_root() && resumed < finished_before)
        run.input.notes.push_back(fmt::format("{} parts of an interrupted run were no longer of use and are removed",
                                              finished_before - resumed));
    return parts;
}

// Writes all surfaces as one file: the whole that a run without meshes has to show.
void join_surfaces(const RunContext& run, const RunFolder& folder, const std::vector<PartReport>& parts) {
    in_agreement(run.ranks, [&] {
        if (!run.is_root()) return;
        std::vector<std::string> names, paths;
        for (const PartReport& part : parts) {
            names.push_back("parts/" + part_surface_file_name(part.id));
            paths.push_back(folder.part_surface_file(part.id));
        }
        const std::span<const std::string> regions = run.input.complex.region_names();
        write_text_file(folder.file("surfaces.pvtu"), surfaces_pvtu_text(names, regions));
        write_joined_surfaces(folder.file("surfaces.vtu"), paths, run.input.patch_names, regions);
    });
}

// The parts that were meshed, as they lie in the folder, with the numbers of all vertices: those inside of parts come
// after those of the surfaces.
StoredParts number_parts(const RunContext& run, const RunFolder& folder, const std::vector<PartReport>& parts,
                         std::int64_t surface_vertices) {
    MeshOutline outline;
    std::vector<StoredParts::Place> places;
    outline.patch_names = run.input.patch_names;
    const std::span<const std::string> regions = run.input.complex.region_names();
    outline.region_names.assign(regions.begin(), regions.end());
    std::int64_t next = surface_vertices;
    for (const PartReport& part : parts) {
        if (part.result.code == 0) {
            const std::int64_t unlisted = part.interface_facets + part.walls_of_others;
            outline.parts.push_back(
                {part.id, part.result.vertices, part.result.tets, part.surface_facets - unlisted, unlisted});
            places.push_back({folder.stored_part_file(part.id), next, part.result.file_hash});
        }
        next += part.result.interior_vertices;
    }
    outline.vertices = next;
    outline.is_whole = outline.parts.size() == parts.size();
    return {std::move(outline), places};
}

// The whole surface, taken on the root rank before it is cut; none if no reference is wanted.
std::optional<Surface> surface_for_reference(const RunContext& run) {
    if (!run.options.reference || !run.is_root()) return std::nullopt;
    if (run.input.complex.region_count() > 1)
        throw Error(ErrorCode::usage, fmt::format("--reference meshes the whole in one piece, but {} has {} regions. "
                                                  "Leave it out.",
                                                  run.input.path, run.input.complex.region_count()));
    return run.input.complex.surface_of(RegionIndex(0));
}

std::optional<Reference> mesh_reference(const RunContext& run, const RunFolder& folder, const RunReport& report,
                                        const std::optional<Surface>& whole) {
    return in_agreement(run.ranks, [&]() -> std::optional<Reference> {
        if (!whole) return std::nullopt;
        PartOutcome outcome = mesh_in_one_piece(folder, *whole, run.input.diagonal, run.options,
                                                [&] { tell_progress(run.listener, "reference", 0, 1); });
        return compare_with_whole(folder, report, std::move(outcome));
    });
}

// The parts with a node on each edge, if that is asked for.
std::unique_ptr<const SecondOrderParts> with_second_order(const RunContext& run, const StoredParts& parts,
                                                          RunReport& report) {
    if (run.options.order != 2) return {};
    EdgeNumbers numbers = number_edges_together(run.ranks, parts, run.listener);
    CurvedNodes curved;
    if (run.options.has_curved_edges()) {
        CurvedMesh mesh = curve_parts(run.ranks, parts, numbers, run.surface_nodes, run.listener);
        curved = std::move(mesh.nodes);
        report.curve = mesh.report;
    }
    auto of_order_2 = std::make_unique<const SecondOrderParts>(parts, std::move(numbers), std::move(curved));
    count_nodes(*of_order_2, report);
    return of_order_2;
}

bool has_vtu(const std::vector<const Format*>& formats) {
    return std::find(formats.begin(), formats.end(), &find_format("vtu")) != formats.end();
}

// Writes all formats; of a mesh with parts missing, which no solver can read, only vtu, so that people can look at it.
std::vector<RunFile> write_formats(const RunContext& run, const RunFolder& folder, const StoredParts& stored,
                                   const SecondOrderParts* of_order_2, const std::vector<PartReport>& reports) {
    std::vector<const Format*> formats = parse_formats(run.options.formats);
    if (failure_code(reports) != 0) formats = {&find_format("vtu")};
    // The store of a part goes as soon as its file of vtu is there, which holds as much: the disk needs no room for
    // both.
    const bool stores_go =
        stored.outline().is_whole &&
        std::all_of(formats.begin(), formats.end(), [](const Format* f) { return f->asks_for_one_part; });
    const FormatOptions options{.fields = parse_cell_fields(run.options.fields),
                                .patch_types = parse_patch_types(run.options.patch_types),
                                .split_regions = run.options.split_regions};
    const WriteTarget target{.folder = folder.partial_path(), .options = options};
    in_agreement(run.ranks, [&] {
        if (run.is_root() && of_order_2 && !has_vtu(formats))  // vtu has all nodes
            write_curved_nodes(curved_nodes_file(folder.partial_path()), of_order_2->curved());
    });
    const PartSource& parts = of_order_2 ? static_cast<const PartSource&>(*of_order_2) : stored;
    return write_parts(run.ranks, parts, places_in_run_folder(formats), target, run.options.workers, run.listener,
                       [&](PartIndex part) {
                           if (stores_go) stored.remove(part);
                       });
}

// Writes the parts as files, or gives them to the listener of a transient run.
std::vector<RunFile> pass_on_meshes(const RunContext& run, const RunFolder& folder, const StoredParts& parts,
                                    const SecondOrderParts* of_order_2, const std::vector<PartReport>& reports) {
    if (!run.options.transient) return write_formats(run, folder, parts, of_order_2, reports);
    in_agreement(run.ranks, [&] {
        if (run.listener && parts.outline().is_whole) run.listener->on_meshes(parts, of_order_2);
    });
    return {};
}

// Files of vtu hold all that those of the store do; a run with failed parts is continued from the latter.
void remove_stored_parts(const RunContext& run, const RunFolder& folder, int exit_code) {
    if (!has_vtu(parse_formats(run.options.formats)) || exit_code != 0) return;
    remove_run_files(folder.partial_path(), [](const std::string& file) { return is_stored_part(file); });
}

// Sum of the peaks of the ranks, each with that of the largest worker for each of its workers.
std::int64_t peak_memory(const RunContext& run, const std::vector<PartReport>& parts) {
    std::int64_t largest_worker = 0, sum = 0;
    for (const PartReport& part : parts) largest_worker = std::max(largest_worker, part.result.peak_rss_bytes);
    for (const std::int64_t bytes : all_gather(run.ranks, own_peak_rss_bytes()))
        sum += bytes + run.options.workers * largest_worker;
    return sum;
}

// The folder gets its place, with the report of the run in it; that of a transient run has none.
void finish(const RunContext& run, std::optional<RunFolder>& folder, RunReport& report, const Stopwatch& whole) {
    report.peak_rss_bytes = peak_memory(run, report.parts);
    if (run.options.transient) {
        report.seconds.wall = longest(run.ranks, whole.seconds());
        in_agreement(run.ranks, [&] {
            if (run.is_root() && !run.options.report_file.empty())
                write_output_file(run.options.report_file, to_json(report));
        });
        return;
    }
    report.folder.files = timed(run.ranks, report.seconds.hash, [&] {
        in_agreement(run.ranks, [&] {
            if (run.is_root() && run.options.volume) remove_stored_parts(run, *folder, report.exit_code);
        });
        return list_run_files(
            run.ranks, *folder, report.parts, std::move(report.folder.files),
            [&](std::size_t done, std::size_t total) { tell_progress(run.listener, "hash", done, total); });
    });
    if (!run.is_root()) folder.reset();  // nobody uses it when it moves
    report.seconds.wall = longest(run.ranks, whole.seconds());
    in_agreement(run.ranks, [&] {
        if (!run.is_root()) return;
        const std::string json = to_json(report);
        write_text_file(folder->file("report.json"), json);
        report.folder.path = folder->commit(report.exit_code == 0);
        report.folder.kept_valid_run = report.folder.path != folder->final_path();
        if (!run.options.report_file.empty()) write_output_file(run.options.report_file, json);
    });
}

// Says how to go on: always where the user has stopped the run, else if a part is finished.
Error with_way_to_go_on(const RunOptions& options, std::optional<RunFolder>& folder, const Error& error) {
    if (!folder || !options.volume || options.transient) return error;
    std::size_t finished = 0;
    try {
        finished = folder->finished_parts();
    } catch (const Error&) {  // it cannot be read
        return error;
    }
    if (finished == 0 && error.code() != ErrorCode::cancelled) {
        folder->discard();
        return error;
    }
    const bool are_all = finished >= static_cast<std::size_t>(options.decompose.parts);
    const std::string again = options.sizes.background ? "the same call into " : "kerf mesh --resume ";
    return {error.code(),
            fmt::format("{} {}{} parts are finished; {}{} {}.", error.what(), are_all ? "All " : "", finished, again,
                        options.output, are_all ? "writes the files that are missing" : "does the others"),
            error.elements()};
}

RunReport empty_report(const RunContext& run) {
    RunReport report;
    report.input = &run.input;
    report.options = run.options;
    report.ranks = run.ranks.size();
    report.found_size = run.found_size;
    report.mesh.quality = PartQuality(run.input.diagonal);
    return report;
}

}  // namespace

RunReport run(const RunOptions& request, int cores_of_rank, Communicator& ranks, Input& input, RunListener* listener) {
    const Stopwatch whole;
    const ThreadLimitGuard limit;  // the plan sets one
    const RunPlan plan = plan_run(request, cores_of_rank, ranks, input, listener);
    const RunOptions& options = plan.options;
    const RunContext run{options, ranks, input, listener, plan.found_size, plan.surface_nodes};
    RunReport report = empty_report(run);
    StageSeconds& seconds = report.seconds;
    seconds.read = longest(ranks, whole.seconds());
    const std::optional<Surface> whole_surface = surface_for_reference(run);
    std::optional<RunFolder> folder;  // none for a dry run
    try {
        if (!options.dry_run) keep_folder(run, folder.emplace(open_folder(run)));
        Decomposition own =
            timed(ranks, seconds.decompose, [&] { return cut_surface(ranks, input, options, listener); });
        report.cut.split_facets = static_cast<std::int64_t>(own.divided_facets.size());
        PreparedParts prepared = timed(ranks, seconds.prepare, [&] {
            report.cut.nodes = gather_nodes(ranks, own.nodes, host_name());
            return prepare_parts(ranks, input, report.cut.nodes, std::move(own), options);
        });
        report.verification.unmatched_interface_faces = prepared.unmatched_interface_facets;
        report.verification.input_faces_missing = prepared.missing_input_facets;
        report.parts = gather_reports(ranks, prepared.own);
        if (options.dry_run) {
            announce_parts(run, report.parts, seconds.read, whole);
            return report;
        }
        std::optional<VolumeStage> volume;
        if (options.volume) volume.emplace(ranks, *folder, plan, input.diagonal, listener);
        report.parts = timed(ranks, seconds.prepare, [&] {
            return hand_over_parts(run, *folder, report.parts, std::move(prepared.own), volume ? &*volume : nullptr);
        });
        announce_parts(run, report.parts, seconds.read, whole);
        if (volume) {
            MeshedParts meshed = timed(ranks, seconds.mesh, [&] { return volume->mesh(report.parts); });
            report.parts = std::move(meshed.parts);
            report.mesh.quality = std::move(meshed.quality);
            report.mesh.improvement = std::move(meshed.improvement);
            const StoredParts stored = number_parts(run, *folder, report.parts, prepared.surface_vertices);
            report.mesh.vertices = stored.outline().vertices;
            report.reference = mesh_reference(run, *folder, report, whole_surface);
            const auto of_order_2 = timed(ranks, seconds.curve, [&] { return with_second_order(run, stored, report); });
            report.folder.files = timed(ranks, seconds.write, [&] {
                return pass_on_meshes(run, *folder, stored, of_order_2.get(), report.parts);
            });
        } else {
            join_surfaces(run, *folder, report.parts);
        }
        add_up_parts(report);
        finish(run, folder, report, whole);
        return report;
    } catch (const Error& error) {
        throw with_way_to_go_on(options, folder, error);
    }
}

}  // namespace kerf

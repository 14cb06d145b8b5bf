// Every rank reads the input and descends its own branches of the tree. The ranks talk to bring both sides of the
// interfaces together, to share the parts out, to number the vertices, and to report. Surfaces and meshes travel as
// files only: a part goes from the rank that cut it to the worker that takes it, and from there to its place.
#include "run/pipeline.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/host_name.h"
#include "core/stopwatch.h"
#include "decompose/straight_division.h"
#include "io/output_file.h"
#include "io/run_folder.h"
#include "io/stl_writer.h"
#include "io/text_file.h"
#include "part/joined_surfaces.h"
#include "part/part_store.h"
#include "part/vtu_writer.h"
#include "run/forecast.h"
#include "run/gathered_nodes.h"
#include "run/prepare_stage.h"
#include "run/process_memory.h"
#include "run/range_of_rank.h"
#include "run/reference.h"
#include "run/remeshing.h"
#include "run/run_files.h"
#include "run/saved_run.h"
#include "run/size_reader.h"
#include "run/totals.h"
#include "run/trace.h"
#include "run/volume_stage.h"
#include "run/write_stage.h"

namespace kerf {

namespace {

// Wall clock of a stage, the longest over the ranks.
double longest(Communicator& ranks, double seconds) {
    double most = 0;
    for (double s : all_gather(ranks, seconds)) most = std::max(most, s);
    return most;
}

RunFolder open_run_folder(const RunOptions& options, const std::string& input_hash, Communicator& ranks) {
    std::optional<RunFolder> folder;
    const std::string partial = in_agreement(ranks, [&] {
        if (ranks.rank() != 0) return std::string();
        folder.emplace(RunFolder::create(options.output, [&](const std::string& saved) {
            return options.volume && is_same_run(saved, options, input_hash);
        }));
        return folder->partial_path();
    });
    const std::string shared = all_gather(ranks, partial).front();
    in_agreement(ranks, [&] {
        if (!folder) folder.emplace(RunFolder::join(shared));
    });
    return std::move(*folder);
}

// Fewer facets leave no contour of edges; fewer than a tetrahedron has make no part.
std::int64_t least_facets(const DecomposeOptions& options) {
    return options.facets == FacetPolicy::keep ? min_facets_per_part : 4;
}

// K as given, if the surface allows it; else that of a run into the same folder that was interrupted, perhaps on
// another machine; else as it follows from the surface, its sized volume, the machine and its memory.
std::int32_t part_count(const Input& input, const RunOptions& options, double volume, int ranks) {
    const auto most =
        static_cast<std::int32_t>(std::max<std::int64_t>(1, input.facets / least_facets(options.decompose)));
    const std::int32_t wanted = options.decompose.parts;
    if (wanted == 0) {
        const std::int32_t interrupted = options.dry_run ? 0 : interrupted_part_count(options.output, input.file_hash);
        if (interrupted > 0 && interrupted <= most) return interrupted;
        return std::max(choose_parts(options, static_cast<double>(input.facets), volume, ranks, most),
                        std::min(options.least_parts, most));
    }
    if (wanted > most)
        throw Error(ErrorCode::usage, fmt::format("{} has {} facets, too few for {} parts. Use -n {} or fewer, or a "
                                                  "finer surface.",
                                                  input.path, input.facets, wanted, most));
    return wanted;
}

// Sizes that depend on the place are those of the surface as it is now.
void use_sizes_on(const Input& input, RunOptions& options) {
    if (options.sizes.depends_on_place())
        options.use_sizes(read_size_field(options.sizes, input.surface.arrays(), input.patch_names));
}

double sized_volume_of(const Input& input, const RunOptions& options) {
    const SurfaceArrays surface = options.mesher.size.is_constant() ? SurfaceArrays() : input.surface.arrays();
    return sized_volume(options.mesher.size, surface.vertices, surface.facets, input.volume);
}

// Remeshing takes longer than to see that its result could not be filled.
void check_budget_before_remeshing(const Input& input, RunOptions options, int ranks) {
    if (options.dry_run || !is_remeshed(input, options)) return;
    options.sizes.growth = 0;  // from edges that are to change
    use_sizes_on(input, options);
    const double volume = sized_volume_of(input, options), facets = forecast_remeshed_facets(input, options);
    if (options.decompose.parts == 0)
        options.decompose.parts =
            choose_parts(options, facets, volume, ranks, std::numeric_limits<std::int32_t>::max());
    check_budget(options, facets, volume, Facets::follow_size);
}

// One rank's share of the run.
class Run {
 public:
    Run(RunOptions options, std::string worker_hash, Communicator& ranks, Input& input, double read_seconds,
        RunListener* listener)
        : ranks_(ranks),
          worker_hash_(std::move(worker_hash)),
          input_(input),
          read_seconds_(read_seconds),
          listener_(listener) {
        report_.options = std::move(options);
        report_.quality = PartQuality(input.diagonal);
        report_.ranks = ranks.size();
        report_.input = &input;
        if (report_.options.reference && is_root()) whole_ = input.surface;
    }

    void open_folder();
    Decomposition decompose_surface();
    void join_interfaces(Decomposition own);
    void announce_parts();
    void hand_over_parts();
    void join_surfaces();
    void mesh_parts();
    void mesh_reference();
    void write_formats();
    RunReport finish(const Stopwatch& whole);
    const RunReport& report() const { return report_; }
    Error with_way_to_go_on(const Error& error);

 private:
    bool is_root() const { return ranks_.rank() == 0; }
    void progress(const char* stage, std::size_t done, std::size_t total) {
        if (!listener_) return;
        if (listener_->cancelled()) throw Error(ErrorCode::cancelled, "The run was cancelled.");
        listener_->on_progress(stage, done, total);
    }
    void save() const { save_run(folder_->saved_run_file(), report_.options, input_.file_hash); }
    Decomposition divide_unfinished(Decomposition own, CutListener* cuts);
    StoredParts number_parts();
    void remove_stored_parts();

    Communicator& ranks_;
    std::string worker_hash_;
    Input& input_;
    double read_seconds_;
    RunListener* listener_;
    std::optional<RunFolder> folder_;  // none for a dry run
    RunReport report_;
    std::vector<OwnPart> own_parts_;
    std::optional<VolumeStage> volume_;
    std::optional<Surface> whole_;  // for the reference, on the root rank
    std::int64_t surface_vertices_ = 0;
};

// From the beginning on the run can be continued by the name of its folder, however it ends.
void Run::open_folder() {
    folder_.emplace(open_run_folder(report_.options, input_.file_hash, ranks_));
    in_agreement(ranks_, [&] {
        if (!is_root() || !report_.options.volume) return;
        if (folder_->finished_parts() == 0) save();  // else the options are those of the finished parts, until
        folder_->keep();                             // this run knows its own
    });
}

Decomposition Run::decompose_surface() {
    const Stopwatch stopwatch;
    DecomposeOptions options = report_.options.decompose;
    const LeafRange range = range_of_rank(options.parts, ranks_);
    CutListener* cuts = listener_;
    std::optional<TraceRecorder> trace;
    // A forecast counts the triangles of fine interfaces without making them.
    if (report_.options.dry_run && report_.options.trace_file.empty()) options.cut.size = SizeField();
    if (!report_.options.trace_file.empty()) cuts = &trace.emplace(report_.options, input_, cuts);
    Decomposition own = in_agreement(ranks_, [&] {
        progress("decompose", 0, 1);
        return decompose(std::move(input_.surface), options, range, cuts);
    });
    if (options.facets == FacetPolicy::split) own = divide_unfinished(std::move(own), cuts);
    report_.split_facets = static_cast<std::int64_t>(own.divided_facets.size());
    report_.seconds.decompose = longest(ranks_, stopwatch.seconds());
    if (trace) trace->write(report_.options.trace_file, ranks_, own, range);  // a run that fails later has one, too
    return own;
}

// Parts without a contour of edges need all others beside them, because split facets may be theirs too.
Decomposition Run::divide_unfinished(Decomposition own, CutListener* cuts) {
    const auto is_unfinished = [](const Leaf& leaf) { return leaf.leaves > 1; };
    const bool any_own = std::any_of(own.leaves.begin(), own.leaves.end(), is_unfinished);
    const std::vector<char> ranks = all_gather(ranks_, static_cast<char>(any_own));
    if (std::none_of(ranks.begin(), ranks.end(), [](char any) { return any; })) return own;
    Decomposition whole;
    whole.nodes = gather_nodes(ranks_, own.nodes, host_name());
    for (std::vector<Leaf>& leaves : all_gather(ranks_, own.leaves))
        std::move(leaves.begin(), leaves.end(), std::back_inserter(whole.leaves));
    const DecomposeOptions& options = report_.options.decompose;
    return in_agreement(
        ranks_, [&] { return divide_straight(std::move(whole), options, range_of_rank(options.parts, ranks_), cuts); });
}

void Run::join_interfaces(Decomposition own) {
    const Stopwatch stopwatch;
    report_.nodes = gather_nodes(ranks_, own.nodes, host_name());
    PreparedParts prepared =
        prepare_parts(ranks_, input_, report_.nodes, std::move(own), report_.options.decompose.cut);
    report_.verification.unmatched_interface_faces = prepared.unmatched_interface_facets;
    report_.verification.input_faces_missing = prepared.missing_input_facets;
    surface_vertices_ = prepared.surface_vertices;
    own_parts_ = std::move(prepared.own);
    report_.parts = gather_reports(ranks_, own_parts_);
    report_.seconds.prepare = longest(ranks_, stopwatch.seconds());
}

// What is ahead.
void Run::announce_parts() {
    const RunOptions& options = report_.options;
    // Where reading was reading alone, it has shown how fast the machine is.
    const bool shows_pace = !input_.is_cad && !input_.remeshed;
    const double pace = shows_pace ? pace_of_reading(read_seconds_, static_cast<double>(input_.facets)) : 1;
    in_agreement(ranks_, [&] {
        if (listener_ && is_root() && options.volume)
            listener_->on_parts(report_.parts, plan_text(report_.parts, options, ranks_.size(), options.dry_run, pace));
    });
}

// Surfaces leave the memory of the rank: what remains to be done is written in files.
void Run::hand_over_parts() {
    const Stopwatch stopwatch;
    const bool volume = report_.options.volume;
    std::size_t finished_before = 0;
    in_agreement(ranks_, [&] {
        if (!is_root()) return;
        finished_before = folder_->finished_parts();
        std::vector<int> leaves;
        for (const PartReport& part : report_.parts) leaves.push_back(part.id);
        folder_->keep_only(volume ? leaves : std::vector<int>());
        if (volume) save();
    });
    if (volume) volume_.emplace(ranks_, *folder_, report_.options, worker_hash_, input_.diagonal, listener_);
    in_agreement(ranks_, [&] {
        for (std::size_t i = 0; i < own_parts_.size(); ++i) {
            progress("prepare", i, own_parts_.size());
            PartReport& report = own_parts_[i].report;
            const PartJob job = std::exchange(own_parts_[i].job, {});
            report.surface_hash = write_part_surface(folder_->part_surface_file(job.part), part_of_job(job));
            if (report_.options.stl)
                write_stl(folder_->part_stl_file(job.part), job.surface.vertices, job.surface.facets);
            if (volume) volume_->hand_over(job, report);
        }
    });
    report_.parts = gather_reports(ranks_, own_parts_);
    const auto resumed = static_cast<std::size_t>(
        std::count_if(report_.parts.begin(), report_.parts.end(), std::mem_fn(&PartReport::resumed)));
    if (is_root() && resumed < finished_before)
        input_.notes.push_back(fmt::format("{} parts of an interrupted run were no longer of use and are removed",
                                           finished_before - resumed));
    report_.seconds.prepare += longest(ranks_, stopwatch.seconds());
}

// What a run without meshes has to show as a whole.
void Run::join_surfaces() {
    in_agreement(ranks_, [&] {
        if (!is_root()) return;
        std::vector<std::string> names, paths;
        for (const PartReport& part : report_.parts) {
            names.push_back("parts/" + part_surface_file_name(part.id));
            paths.push_back(folder_->part_surface_file(part.id));
        }
        write_text_file(folder_->file("surfaces.pvtu"), surfaces_pvtu_text(names));
        write_joined_surfaces(folder_->file("surfaces.vtu"), paths);
    });
}

void Run::mesh_parts() {
    const Stopwatch stopwatch;
    volume_->mesh(report_.parts, report_.quality, report_.improvement);
    report_.seconds.mesh = longest(ranks_, stopwatch.seconds());
}

void Run::mesh_reference() {
    if (!report_.options.reference) return;
    in_agreement(ranks_, [&] {
        if (!is_root()) return;
        PartOutcome whole = mesh_in_one_piece(*folder_, *whole_, input_.diagonal, report_.options,
                                              [&] { progress("reference", 0, 1); });
        report_.reference = compare_with_whole(*folder_, report_, number_parts().outline().vertices, std::move(whole));
    });
}

// What ends a run says how to continue it. A run that the user has stopped can always be continued; of another one
// nothing is left if no part is finished.
Error Run::with_way_to_go_on(const Error& error) {
    if (!folder_ || !report_.options.volume) return error;
    std::size_t finished = 0;
    try {
        finished = folder_->finished_parts();
    } catch (const Error&) {  // it cannot be read
        return error;
    }
    if (finished == 0 && error.code() != ErrorCode::cancelled) {
        folder_->discard();
        return error;
    }
    const bool are_all = finished >= static_cast<std::size_t>(report_.options.decompose.parts);
    return {error.code(), fmt::format("{} {}{} parts are finished; kerf mesh --resume {} {}.", error.what(),
                                      are_all ? "All " : "", finished, report_.options.output,
                                      are_all ? "writes the files that are missing" : "does the others")};
}

// The parts that were meshed, as they lie in the folder, with the numbers of all vertices.
StoredParts Run::number_parts() {
    MeshOutline outline;
    std::vector<StoredParts::Place> places;
    outline.patch_names = input_.patch_names;
    std::int64_t next = surface_vertices_;
    for (const PartReport& part : report_.parts) {
        if (part.result.code == 0) {
            outline.parts.push_back({part.id, part.result.vertices, part.result.tets,
                                     part.surface_facets - part.interface_facets, part.interface_facets});
            places.push_back({folder_->stored_part_file(part.id), next, part.result.file_hash});
        }
        next += part.result.interior_vertices;
    }
    report_.vertices = outline.vertices = next;
    outline.is_whole = outline.parts.size() == report_.parts.size();
    return {std::move(outline), std::move(places)};
}

// Solvers cannot read a mesh with parts missing, people can look at it.
void Run::write_formats() {
    const Stopwatch stopwatch;
    const StoredParts parts = number_parts();
    std::vector<const Format*> formats = parse_formats(report_.options.formats);
    if (failure_code(report_.parts) != 0) formats = {&find_format("vtu")};
    // The store of a part goes as soon as its file of vtu is there, which holds as much: the disk needs no room for
    // both.
    const bool is_whole = parts.outline().is_whole;
    const bool stores_go =
        is_whole && std::all_of(formats.begin(), formats.end(), [](const Format* f) { return f->asks_for_one_part; });
    const FormatOptions options{.fields = parse_cell_fields(report_.options.fields),
                                .patch_types = parse_patch_types(report_.options.patch_types)};
    const WriteTarget target{.folder = folder_->partial_path(), .options = options};
    report_.files = write_parts(ranks_, parts, places_in_run_folder(formats), target, report_.options.workers,
                                listener_, [&](std::int32_t rank) {
                                    if (stores_go) parts.remove(rank);
                                });
    report_.seconds.write = longest(ranks_, stopwatch.seconds());
}

// Files of vtu hold all that those of the store do; a run with failed parts is continued from the latter.
void Run::remove_stored_parts() {
    const std::vector<const Format*> formats = parse_formats(report_.options.formats);
    const bool has_vtu = std::find(formats.begin(), formats.end(), &find_format("vtu")) != formats.end();
    if (!has_vtu || report_.exit_code != 0) return;
    remove_run_files(folder_->partial_path(), [](const std::string& file) { return is_stored_part(file); });
}

RunReport Run::finish(const Stopwatch& whole) {
    const Stopwatch stopwatch;
    add_up_parts(report_);
    std::int64_t largest_worker = 0;
    for (const PartReport& part : report_.parts) largest_worker = std::max(largest_worker, part.result.peak_rss_bytes);
    for (const std::int64_t bytes : all_gather(ranks_, own_peak_rss_bytes()))
        report_.peak_rss_bytes += bytes + report_.options.workers * largest_worker;
    report_.seconds.read = read_seconds_;
    in_agreement(ranks_, [&] {
        if (is_root() && report_.options.volume) remove_stored_parts();
    });
    report_.files = list_run_files(ranks_, *folder_, report_.parts, std::move(report_.files),
                                   [&](std::size_t done, std::size_t total) { progress("hash", done, total); });
    report_.seconds.hash = longest(ranks_, stopwatch.seconds());
    if (!is_root()) folder_.reset();  // nobody uses it when it moves
    report_.seconds.wall = longest(ranks_, whole.seconds());
    in_agreement(ranks_, [&] {
        if (!is_root()) return;
        const std::string json = to_json(report_);
        write_text_file(folder_->file("report.json"), json);
        report_.folder = folder_->commit(report_.exit_code == 0);
        report_.kept_valid_run = report_.folder != folder_->final_path();
        if (!report_.options.report_file.empty()) write_output_file(report_.options.report_file, json);
    });
    return std::move(report_);
}

}  // namespace

RunReport run(RunOptions options, int cores_of_rank, Communicator& ranks, Input& input, RunListener* listener) {
    const Stopwatch whole;
    // Hosts may differ, but the defaults of K and workers must not.
    for (const int cores : all_gather(ranks, cores_of_rank)) cores_of_rank = std::min(cores_of_rank, cores);
    const std::vector<std::string> hosts = all_gather(ranks, host_name());
    const auto ranks_here = static_cast<int>(std::count(hosts.begin(), hosts.end(), host_name()));
    std::string worker_hash;
    in_agreement(ranks, [&] {
        options.resolve(cores_of_rank);
        const bool meshes = options.volume && !options.dry_run;
        if (meshes) worker_hash = describe_file("", options.worker_program).hash;
        if (listener) listener->on_progress("read", 0, 1);
        input = read_input(options.input, options.input_options);
        refuse_changed_input(options, input.file_hash);
        options.input_options.weld_tolerance = input.weld_tolerance;
        options.resolve_lengths(input.diagonal);
        if (ranks.rank() == 0) check_budget_before_remeshing(input, options, ranks.size());
    });
    in_agreement(ranks, [&] {
        input = remesh_where_asked(std::move(input), options, listener, ranks_here);
        use_sizes_on(input, options);
        require_patches(parse_patch_types(options.patch_types), input.patch_names);
        if (ranks.rank() != 0) return;
        const double volume = sized_volume_of(input, options);
        options.decompose.parts = part_count(input, options, volume, ranks.size());
        if (!options.dry_run) check_budget(options, static_cast<double>(input.facets), volume);
    });
    options.decompose.parts = all_gather(ranks, options.decompose.parts).front();
    const double read_seconds = longest(ranks, whole.seconds());
    const bool volume = options.volume, dry_run = options.dry_run;
    Run run(std::move(options), std::move(worker_hash), ranks, input, read_seconds, listener);
    try {
        if (!dry_run) run.open_folder();
        run.join_interfaces(run.decompose_surface());
        if (dry_run) {
            run.announce_parts();
            return run.report();
        }
        run.hand_over_parts();
        run.announce_parts();
        if (volume) {
            run.mesh_parts();
            run.mesh_reference();
            run.write_formats();
        } else {
            run.join_surfaces();
        }
        return run.finish(whole);
    } catch (const Error& error) {
        throw run.with_way_to_go_on(error);
    }
}

}  // namespace kerf

// Every rank reads the input and descends its own branches of the tree. The ranks talk to bring both sides of the
// interfaces together, to share the parts out, to number the vertices, and to report. Surfaces and meshes travel as
// files only: a part goes from the rank that cut it to the worker that takes it, and from there to its place.
#include "run/pipeline.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "core/host_name.h"
#include "decompose/straight_division.h"
#include "io/folder_files.h"
#include "io/output_file.h"
#include "io/run_folder.h"
#include "io/stl_writer.h"
#include "io/text_file.h"
#include "part/part_store.h"
#include "part/shared_edges.h"
#include "part/vtu_writer.h"
#include "quality/quality_sheet.h"
#include "quality/quality_text.h"
#include "run/forecast.h"
#include "run/gathered_nodes.h"
#include "run/input_cover.h"
#include "run/interface_match.h"
#include "run/mesh_hash.h"
#include "run/numbering.h"
#include "run/peak_memory.h"
#include "run/range_of_rank.h"
#include "run/saved_run.h"
#include "run/trace.h"
#include "run/volume_stage.h"
#include "run/write_stage.h"

namespace kerf {

namespace {

class Stopwatch {
 public:
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

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

// A part that this rank has cut: what is known of it, and what is to be done.
struct OwnPart {
    PartReport report;
    PartJob job;
};

// What is known of a part before it is meshed.
PartReport describe_part(const PartJob& job, double volume, int rank, const LoadModel& model) {
    PartReport part;
    part.id = job.part;
    part.rank = rank;
    part.surface_volume = volume;
    part.surface_vertices = static_cast<std::int64_t>(job.surface.vertices.size());
    part.surface_facets = static_cast<std::int64_t>(job.surface.facets.size());
    for (std::size_t f = 0; f < job.neighbour.size(); ++f) {
        if (job.neighbour[f] < 0) continue;
        ++part.interface_facets;
        const Triangle& t = job.surface.facets[f];
        const std::vector<Vec3>& p = job.surface.vertices;
        part.interface_area += (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm() / 2;
        part.neighbours.push_back(job.neighbour[f]);
    }
    part.load = model.load(static_cast<double>(part.surface_vertices), static_cast<double>(part.surface_facets),
                           part.surface_volume);
    std::sort(part.neighbours.begin(), part.neighbours.end());
    part.neighbours.erase(std::unique(part.neighbours.begin(), part.neighbours.end()), part.neighbours.end());
    return part;
}

std::int32_t rank_of_leaf(const std::vector<NodeId>& leaves, NodeId leaf) {
    return static_cast<std::int32_t>(std::find(leaves.begin(), leaves.end(), leaf) - leaves.begin());
}

// Fewer facets leave no contour of edges; fewer than a tetrahedron has make no part.
std::int64_t least_facets(const DecomposeOptions& options) {
    return options.facets == FacetPolicy::keep ? min_facets_per_part : 4;
}

// K as given, if the surface allows it; else that of a run into the same folder that was interrupted, perhaps on
// another machine; else as it follows from the surface, the machine and its memory.
std::int32_t part_count(const Input& input, const RunOptions& options, int ranks) {
    const auto most =
        static_cast<std::int32_t>(std::max<std::int64_t>(1, input.facets / least_facets(options.decompose)));
    const std::int32_t wanted = options.decompose.parts;
    if (wanted == 0) {
        const std::int32_t interrupted = options.dry_run ? 0 : interrupted_part_count(options.output, input.file_hash);
        if (interrupted > 0 && interrupted <= most) return interrupted;
        return choose_parts(options, static_cast<double>(input.facets), input.volume, ranks, most);
    }
    if (wanted > most)
        throw Error(ErrorCode::usage, fmt::format("{} has {} facets, too few for {} parts. Use -n {} or fewer, or a "
                                                  "finer surface.",
                                                  input.path, input.facets, wanted, most));
    return wanted;
}

// 0 if every part was meshed; `memory` if all that failed ran out of it, else `subdomain`.
int failure_code(const std::vector<PartReport>& parts) {
    int code = 0;
    for (const PartReport& part : parts) {
        if (part.result.code == 0) continue;
        const bool memory = part.result.code == static_cast<int>(ErrorCode::memory);
        if (!memory) return static_cast<int>(ErrorCode::subdomain);
        code = part.result.code;
    }
    return code;
}

// One rank's share of the run.
class Run {
 public:
    Run(RunOptions options, std::string worker_hash, Communicator& ranks, Input& input, RunListener* listener)
        : ranks_(ranks), worker_hash_(std::move(worker_hash)), input_(input), listener_(listener) {
        report_.options = std::move(options);
        report_.quality = PartQuality(input.diagonal);
        report_.ranks = ranks.size();
        report_.input = &input;
        if (report_.options.reference && is_root()) whole_ = input.surface;
    }

    void open_folder();
    void decompose_surface();
    void divide_unfinished(CutListener* cuts);
    void join_interfaces();
    void find_shared_edges(const std::vector<NodeId>& leaves);
    void gather_parts();
    void announce_parts();
    void hand_over_parts();
    void mesh_parts();
    void mesh_reference();
    void write_formats();
    RunReport finish(const Stopwatch& whole, double read_seconds);
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
    StoredParts number_parts();
    Reference compare_with_whole(PartOutcome whole);
    void verify();
    void measure_workers();
    void remove_stored_parts();
    void describe_other_files();

    Communicator& ranks_;
    std::string worker_hash_;
    Input& input_;
    RunListener* listener_;
    std::optional<RunFolder> folder_;  // none for a dry run
    RunReport report_;
    Decomposition own_;
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

void Run::decompose_surface() {
    const Stopwatch stopwatch;
    DecomposeOptions options = report_.options.decompose;
    const LeafRange range = range_of_rank(options.parts, ranks_);
    CutListener* cuts = listener_;
    std::optional<TraceRecorder> trace;
    // A forecast counts the triangles of fine interfaces without making them.
    if (report_.options.dry_run && report_.options.trace_file.empty()) options.cut.max_volume = 0;
    if (!report_.options.trace_file.empty()) cuts = &trace.emplace(report_.options, input_, cuts);
    own_ = in_agreement(ranks_, [&] {
        progress("decompose", 0, 1);
        return decompose(std::move(input_.surface), options, range, cuts);
    });
    if (options.facets == FacetPolicy::split) divide_unfinished(cuts);
    report_.split_facets = static_cast<std::int64_t>(own_.divided_facets.size());
    report_.seconds.decompose = longest(ranks_, stopwatch.seconds());
    if (trace) trace->write(report_.options.trace_file, ranks_, own_, range);  // a run that fails later has one, too
}

// Parts without a contour of edges need all others beside them, because split facets may be theirs too.
void Run::divide_unfinished(CutListener* cuts) {
    const auto is_unfinished = [](const Leaf& leaf) { return leaf.leaves > 1; };
    const bool own = std::any_of(own_.leaves.begin(), own_.leaves.end(), is_unfinished);
    const std::vector<char> ranks = all_gather(ranks_, static_cast<char>(own));
    if (std::none_of(ranks.begin(), ranks.end(), [](char any) { return any; })) return;
    Decomposition whole;
    whole.nodes = gather_nodes(ranks_, own_.nodes, host_name());
    for (std::vector<Leaf>& leaves : all_gather(ranks_, own_.leaves))
        std::move(leaves.begin(), leaves.end(), std::back_inserter(whole.leaves));
    const DecomposeOptions& options = report_.options.decompose;
    own_ = in_agreement(
        ranks_, [&] { return divide_straight(std::move(whole), options, range_of_rank(options.parts, ranks_), cuts); });
}

void Run::join_interfaces() {
    const Stopwatch stopwatch;
    report_.nodes = gather_nodes(ranks_, own_.nodes, host_name());
    const InterfaceTable table(ranks_, own_.leaves);
    report_.verification.unmatched_interface_faces = table.unmatched();
    report_.verification.input_faces_missing = count_missing_input_facets(ranks_, input_.facets, own_);
    const VertexNumbering numbering(input_.vertices, report_.nodes);
    surface_vertices_ = numbering.surface_vertices();
    std::vector<NodeId> own_leaves, leaves;
    for (const Leaf& leaf : own_.leaves) own_leaves.push_back(leaf.id);
    for (const auto& of_rank : all_gather(ranks_, own_leaves))
        leaves.insert(leaves.end(), of_rank.begin(), of_rank.end());
    const SharedVertices shared = table.shared_vertices(numbering, leaves);
    for (Leaf& leaf : own_.leaves) {
        PartJob job;
        job.part = leaf.id;
        job.boundary_id = numbering.global_ids(leaf.surface.vertex_key);
        job.neighbour = table.neighbours(leaf);
        job.shared = shared.groups_of(rank_of_leaf(leaves, leaf.id), job.boundary_id);
        job.patch_names = input_.patch_names;
        job.length_scale = input_.diagonal;
        job.surface = std::exchange(leaf.surface, {});
        PartReport report = describe_part(job, leaf.volume, ranks_.rank(), report_.options.decompose.cut.load);
        own_parts_.push_back({std::move(report), std::move(job)});
    }
    find_shared_edges(leaves);
    gather_parts();
    report_.seconds.prepare = longest(ranks_, stopwatch.seconds());
}

void Run::find_shared_edges(const std::vector<NodeId>& leaves) {
    std::vector<SharedEdges::Held> own, told;
    const auto append = [](std::vector<SharedEdges::Held>& all, const std::vector<SharedEdges::Held>& more) {
        all.insert(all.end(), more.begin(), more.end());
    };
    for (const OwnPart& part : own_parts_) append(own, SharedEdges::told_by(part_of_job(part.job)));
    for (const auto& of_rank : all_gather(ranks_, own)) append(told, of_rank);
    const SharedEdges shared(std::move(told), leaves);
    for (OwnPart& part : own_parts_) part.job.shared_edges = shared.groups_of(part_of_job(part.job));
}

// What is ahead.
void Run::announce_parts() {
    const RunOptions& options = report_.options;
    in_agreement(ranks_, [&] {
        if (listener_ && is_root() && options.volume)
            listener_->on_parts(report_.parts, plan_text(report_.parts, options, ranks_.size(), options.dry_run));
    });
}

void Run::gather_parts() {
    report_.parts.clear();
    std::vector<PartReport> own;
    for (const OwnPart& part : own_parts_) own.push_back(part.report);
    for (const auto& parts : all_gather(ranks_, own))
        report_.parts.insert(report_.parts.end(), parts.begin(), parts.end());
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
    gather_parts();
    const auto resumed = static_cast<std::size_t>(
        std::count_if(report_.parts.begin(), report_.parts.end(), std::mem_fn(&PartReport::resumed)));
    if (is_root() && resumed < finished_before)
        input_.notes.push_back(fmt::format("{} parts of an interrupted run were no longer of use and are removed",
                                           finished_before - resumed));
    report_.seconds.prepare += longest(ranks_, stopwatch.seconds());
}

void Run::mesh_parts() {
    const Stopwatch stopwatch;
    volume_->mesh(report_.parts, report_.quality);
    report_.seconds.mesh = longest(ranks_, stopwatch.seconds());
}

// In a worker like any part, but alone and with all the memory that there is.
void Run::mesh_reference() {
    if (!report_.options.reference) return;
    in_agreement(ranks_, [&] {
        if (!is_root()) return;
        constexpr int no_leaf = 0;
        PartJob job;
        job.part = no_leaf;
        job.surface = whole_->arrays();
        job.boundary_id.assign(job.surface.vertices.size(), -1);
        job.neighbour.assign(job.surface.facets.size(), -1);
        job.length_scale = input_.diagonal;
        const std::string job_file = folder_->job_file(no_leaf), part_file = folder_->stored_part_file(no_leaf);
        write_job(job_file, job);
        const RunOptions& options = report_.options;
        PartQueue queue({{job_file, part_file}},
                        {options.worker_program, options.mesher, 1, options.timeout_seconds, 0, options.attempts},
                        [](std::size_t) { return true; });
        std::optional<PartQueue::Finished> finished;
        while (!finished) {
            progress("reference", 0, 1);
            finished = queue.step(0.1);
        }
        remove_run_files(folder_->partial_path(), [&](const std::string& file) {
            return folder_->file(file) == job_file || folder_->file(file) == part_file;
        });
        report_.reference = compare_with_whole(std::move(finished->outcome));
    });
}

Reference Run::compare_with_whole(PartOutcome whole) {
    if (whole.result.code) return {std::move(whole), ""};
    const std::string name = std::filesystem::path(input_.path).filename().string();
    MeshQuality parts, one;
    parts.name = fmt::format("{} in {} parts", name, report_.parts.size());
    parts.parts = static_cast<std::int64_t>(report_.parts.size());
    parts.vertices = number_parts().outline().vertices;
    parts.cells = report_.quality;
    one.name = name + " in one piece";
    one.vertices = whole.result.vertices;
    one.cells = whole.result.quality;
    write_text_file(folder_->file("comparison.svg"), comparison_sheet(one, parts));
    return {std::move(whole), comparison_text(one, parts)};
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
    return {error.code(), fmt::format("{} {} parts are finished; kerf mesh --resume {} does the others.", error.what(),
                                      finished, report_.options.output)};
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
    return {std::move(outline), std::move(places)};
}

// Solvers cannot read a mesh with parts missing, people can look at it.
void Run::write_formats() {
    const Stopwatch stopwatch;
    const StoredParts parts = number_parts();
    std::vector<const Format*> formats = parse_formats(report_.options.formats);
    if (failure_code(report_.parts) != 0) formats = {&find_format("vtu")};
    report_.files = write_parts(ranks_, parts, places_in_run_folder(formats), {folder_->partial_path()},
                                report_.options.workers, listener_);
    report_.seconds.write = longest(ranks_, stopwatch.seconds());
}

void Run::verify() {
    RunVerification& v = report_.verification;
    double volume = 0;
    bool parts_hold = true;
    for (const PartReport& part : report_.parts) {
        const MeshLaws& laws = part.result.laws;
        volume += report_.options.volume ? laws.volume : part.surface_volume;
        v.inverted_tets += laws.inverted_tets;
        v.input_faces_missing += laws.missing_facets;
        v.extra_boundary_faces += laws.extra_boundary_faces;
        if (!report_.options.volume) continue;
        v.tets_zero_parts += part.result.tets == 0;
        parts_hold &= part.result.code == 0 && laws.hold();
    }
    v.volume_rel_error = std::abs(volume - input_.volume) / input_.volume;
    v.passed = parts_hold && v.all_hold();
}

// Where the time of the workers went in the meshing stage, as means over all of them.
void Run::measure_workers() {
    const auto workers = static_cast<std::size_t>(report_.ranks * report_.options.workers);
    std::vector<double> busy(workers, 0);
    WorkerSeconds& mean = report_.worker_seconds;
    for (const PartReport& part : report_.parts) {
        if (part.resumed) continue;
        busy[static_cast<std::size_t>(part.rank * report_.options.workers + part.worker)] += part.seconds;
        mean.mesher += part.result.mesh_seconds;
        mean.verify += part.result.verify_seconds;
        mean.store += part.result.store_seconds;
    }
    const double sum = std::accumulate(busy.begin(), busy.end(), 0.0);
    if (sum > 0) report_.imbalance = *std::max_element(busy.begin(), busy.end()) * static_cast<double>(workers) / sum;
    for (double* seconds : {&mean.mesher, &mean.verify, &mean.store}) *seconds /= static_cast<double>(workers);
    mean.start = sum / static_cast<double>(workers) - mean.mesher - mean.verify - mean.store;
    mean.idle = std::max(0.0, report_.seconds.mesh - sum / static_cast<double>(workers));
}

// Files of vtu hold all that those of the store do; a run with failed parts is continued from the latter.
void Run::remove_stored_parts() {
    const std::vector<const Format*> formats = parse_formats(report_.options.formats);
    const bool has_vtu = std::find(formats.begin(), formats.end(), &find_format("vtu")) != formats.end();
    if (!has_vtu || report_.exit_code != 0) return;
    remove_run_files(folder_->partial_path(), [](const std::string& file) { return is_stored_part(file); });
}

// Adds the files of the folder that no format has written, but the report. Each rank reads a share.
void Run::describe_other_files() {
    const std::vector<std::string> found = in_agreement(ranks_, [&] {
        std::vector<std::string> files = is_root() ? list_files(folder_->partial_path()) : std::vector<std::string>();
        std::set<std::string> known;
        for (const RunFile& file : report_.files) known.insert(file.path);
        std::erase_if(files, [&](const std::string& file) {
            return known.contains(file) || file.starts_with("work/") || file.ends_with('/') ||
                   !is_named_like_run_file(file);
        });
        return files;
    });
    const std::vector<std::string> files = all_gather(ranks_, found).front();
    std::map<std::string, FileHash> written;  // by the names of the files
    for (const PartReport& part : report_.parts) {
        written["parts/" + part_surface_file_name(part.id)] = part.surface_hash;
        if (part.result.code == 0) written["parts/" + stored_part_file_name(part.id)] = part.result.file_hash;
    }
    const LeafRange share = range_of_rank(static_cast<std::int32_t>(files.size()), ranks_);
    const std::vector<RunFile> own = in_agreement(ranks_, [&] {
        std::vector<RunFile> described;
        for (std::int32_t i = share.first; i < share.last; ++i) {
            progress("hash", static_cast<std::size_t>(i), files.size());
            described.push_back(describe_file(folder_->partial_path(), files[static_cast<std::size_t>(i)]));
            const auto expected = written.find(described.back().path);
            if (expected != written.end() && described.back().hash != hash_text(expected->second))
                throw Error(ErrorCode::io, fmt::format("{} is not what was written: the disk or the memory has damaged "
                                                       "it. Continue the run to write it again.",
                                                       folder_->file(expected->first)));
        }
        return described;
    });
    for (const auto& of_rank : all_gather(ranks_, own))
        report_.files.insert(report_.files.end(), of_rank.begin(), of_rank.end());
    sort_files(report_.files);
}

RunReport Run::finish(const Stopwatch& whole, double read_seconds) {
    const Stopwatch stopwatch;
    std::vector<PartHash> hashes;
    std::int64_t largest_worker = 0;
    for (const PartReport& part : report_.parts) {
        report_.tets += part.result.tets;
        largest_worker = std::max(largest_worker, part.result.peak_rss_bytes);
        hashes.push_back({part.id, part.result.hash});
    }
    verify();
    measure_workers();
    for (const std::int64_t bytes : all_gather(ranks_, own_peak_rss_bytes()))
        report_.peak_rss_bytes += bytes + report_.options.workers * largest_worker;
    if (report_.options.volume) report_.mesh_hash = hash_of_parts(hashes);
    report_.exit_code = failure_code(report_.parts);
    if (report_.exit_code == 0 && !report_.verification.passed)
        report_.exit_code = static_cast<int>(ErrorCode::verification);
    report_.seconds.read = read_seconds;
    in_agreement(ranks_, [&] {
        if (is_root() && report_.options.volume) remove_stored_parts();
    });
    describe_other_files();
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
    std::string worker_hash;
    in_agreement(ranks, [&] {
        options.resolve(cores_of_rank);
        const bool meshes = options.volume && !options.dry_run;
        if (meshes) worker_hash = describe_file("", options.worker_program).hash;
        if (listener) listener->on_progress("read", 0, 1);
        input = read_input(options.input, options.input_options);
        refuse_changed_input(options, input.file_hash);
        if (ranks.rank() != 0) return;
        options.decompose.parts = part_count(input, options, ranks.size());
        if (!options.dry_run) check_budget(options, static_cast<double>(input.facets), input.volume);
    });
    options.decompose.parts = all_gather(ranks, options.decompose.parts).front();
    const double read_seconds = longest(ranks, whole.seconds());
    const bool volume = options.volume, dry_run = options.dry_run;
    Run run(std::move(options), std::move(worker_hash), ranks, input, listener);
    try {
        if (!dry_run) run.open_folder();
        run.decompose_surface();
        run.join_interfaces();
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
        }
        return run.finish(whole, read_seconds);
    } catch (const Error& error) {
        throw run.with_way_to_go_on(error);
    }
}

}  // namespace kerf

// Every rank reads the input and descends its own branches of the tree. The ranks talk to bring both sides of the
// interfaces together, to share the parts out, to number the vertices, and to report. Surfaces and meshes travel as
// files only: a part goes from the rank that cut it to the worker that takes it, and from there to its place.
#include "run/pipeline.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <optional>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "core/host_name.h"
#include "decompose/straight_division.h"
#include "io/folder_files.h"
#include "io/output_file.h"
#include "io/run_folder.h"
#include "io/stl_writer.h"
#include "io/text_file.h"
#include "run/forecast.h"
#include "run/gathered_nodes.h"
#include "run/input_cover.h"
#include "run/interface_match.h"
#include "run/mesh_hash.h"
#include "run/numbering.h"
#include "run/peak_memory.h"
#include "run/saved_run.h"
#include "run/trace.h"
#include "run/volume_stage.h"

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

LeafRange range_of_rank(std::int32_t parts, const Communicator& ranks) {
    const auto begin = [&](int rank) {
        return static_cast<std::int32_t>(static_cast<std::int64_t>(parts) * rank / ranks.size());
    };
    return {begin(ranks.rank()), begin(ranks.rank() + 1)};
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

// What is known of a part before it is meshed.
PartReport describe_part(const Leaf& leaf, const std::vector<NodeId>& neighbours, int rank, const LoadModel& model) {
    PartReport part;
    part.id = leaf.id;
    part.rank = rank;
    part.surface_volume = leaf.volume;
    part.surface_vertices = static_cast<std::int64_t>(leaf.surface.vertices.size());
    part.surface_facets = static_cast<std::int64_t>(leaf.surface.facets.size());
    for (std::size_t f = 0; f < neighbours.size(); ++f) {
        if (neighbours[f] < 0) continue;
        ++part.interface_facets;
        const Triangle& t = leaf.surface.facets[f];
        const std::vector<Vec3>& p = leaf.surface.vertices;
        part.interface_area += (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm() / 2;
        part.neighbours.push_back(neighbours[f]);
    }
    part.load = model.load(static_cast<double>(part.surface_vertices), static_cast<double>(part.surface_facets),
                           part.surface_volume);
    std::sort(part.neighbours.begin(), part.neighbours.end());
    part.neighbours.erase(std::unique(part.neighbours.begin(), part.neighbours.end()), part.neighbours.end());
    return part;
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

// One rank's share of the run.
class Run {
 public:
    Run(RunOptions options, std::string worker_hash, Communicator& ranks, Input& input, RunListener* listener)
        : ranks_(ranks), worker_hash_(std::move(worker_hash)), input_(input), listener_(listener) {
        report_.options = std::move(options);
        report_.quality = PartQuality(input.diagonal);
        report_.ranks = ranks.size();
        report_.input = &input;
    }

    void open_folder();
    void decompose_surface();
    void divide_unfinished(CutListener* cuts);
    void join_interfaces();
    void gather_parts();
    void announce_parts();
    void hand_over_parts();
    void mesh_parts();
    void number_interiors();
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
    void verify();
    void measure_workers();
    std::vector<RunFile> describe_files();
    RunFile describe_part_file(const std::string& path, const PartReport& part) const;

    Communicator& ranks_;
    std::string worker_hash_;
    Input& input_;
    RunListener* listener_;
    std::optional<RunFolder> folder_;  // none for a dry run
    RunReport report_;
    Decomposition own_;
    std::vector<PartReport> own_parts_;
    std::vector<PartArrays> own_arrays_;
    std::optional<VolumeStage> volume_;
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
    for (const Leaf& leaf : own_.leaves) {
        PartArrays arrays;
        arrays.part = leaf.id;
        arrays.boundary_id = numbering.global_ids(leaf.surface.vertex_key);
        arrays.neighbour = table.neighbours(leaf);
        arrays.patch_names = input_.patch_names;
        own_parts_.push_back(describe_part(leaf, arrays.neighbour, ranks_.rank(), report_.options.decompose.cut.load));
        own_arrays_.push_back(std::move(arrays));
    }
    gather_parts();
    report_.seconds.prepare = longest(ranks_, stopwatch.seconds());
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
    for (const auto& parts : all_gather(ranks_, own_parts_))
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
        for (std::size_t i = 0; i < own_.leaves.size(); ++i) {
            progress("prepare", i, own_.leaves.size());
            const Leaf leaf = std::exchange(own_.leaves[i], {});
            PartJob job{leaf.surface, std::exchange(own_arrays_[i], {}), input_.diagonal};
            own_parts_[i].surface_hash =
                write_part_surface(folder_->part_surface_file(leaf.id), job.surface, job.arrays);
            if (report_.options.stl)
                write_stl(folder_->part_stl_file(leaf.id), job.surface.vertices, job.surface.facets);
            if (volume) volume_->hand_over(job, own_parts_[i]);
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

void Run::number_interiors() {
    const Stopwatch stopwatch;
    std::int64_t first = surface_vertices_;
    std::map<NodeId, std::int64_t> first_of;
    for (const PartReport& part : report_.parts) {
        first_of[part.id] = first;
        first += part.result.interior_vertices;
    }
    report_.vertices = first;
    const LeafRange share = range_of_rank(static_cast<std::int32_t>(report_.parts.size()), ranks_);
    in_agreement(ranks_, [&] {
        for (std::int32_t i = share.first; i < share.last; ++i) {
            progress("number", static_cast<std::size_t>(i - share.first), static_cast<std::size_t>(share.last));
            const PartReport& part = report_.parts[static_cast<std::size_t>(i)];
            if (part.result.code == 0) number_interior_vertices(folder_->part_file(part.id), first_of[part.id]);
        }
    });
    report_.seconds.number = longest(ranks_, stopwatch.seconds());
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
        mean.write += part.result.write_seconds;
    }
    const double sum = std::accumulate(busy.begin(), busy.end(), 0.0);
    if (sum > 0) report_.imbalance = *std::max_element(busy.begin(), busy.end()) * static_cast<double>(workers) / sum;
    for (double* seconds : {&mean.mesher, &mean.verify, &mean.write}) *seconds /= static_cast<double>(workers);
    mean.start = sum / static_cast<double>(workers) - mean.mesher - mean.verify - mean.write;
    mean.idle = std::max(0.0, report_.seconds.mesh - sum / static_cast<double>(workers));
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

// The file as it is now, of which the worker has said what it has written.
RunFile Run::describe_part_file(const std::string& path, const PartReport& part) const {
    const PartFileHashes hashes = hash_part_file(folder_->file(path));
    if (hashes.written != part.result.file_hash)
        throw Error(ErrorCode::io, fmt::format("{} is not what its worker has written: the disk or the memory has "
                                               "damaged it. That part is meshed again when the run is continued.",
                                               folder_->file(path)));
    return {path, hashes.bytes, hash_text(hashes.present)};
}

// All files of the folder but the report. Each rank reads a share.
std::vector<RunFile> Run::describe_files() {
    const std::vector<std::string> found = in_agreement(ranks_, [&] {
        std::vector<std::string> files = is_root() ? list_files(folder_->partial_path()) : std::vector<std::string>();
        std::erase_if(files, [](const std::string& file) {
            return file.starts_with("work/") || file.ends_with('/') || !is_named_like_run_file(file);
        });
        return files;
    });
    const std::vector<std::string> files = all_gather(ranks_, found).front();
    std::map<std::string, const PartReport*> part_of, part_of_surface;  // by the names of the files
    for (const PartReport& part : report_.parts) {
        part_of_surface["parts/" + part_surface_file_name(part.id)] = &part;
        if (part.result.code == 0) part_of["parts/" + part_file_name(part.id)] = &part;
    }
    const LeafRange share = range_of_rank(static_cast<std::int32_t>(files.size()), ranks_);
    const std::vector<RunFile> own = in_agreement(ranks_, [&] {
        std::vector<RunFile> described;
        for (std::int32_t i = share.first; i < share.last; ++i) {
            progress("hash", static_cast<std::size_t>(i), files.size());
            const std::string& path = files[static_cast<std::size_t>(i)];
            if (const auto part = part_of.find(path); part != part_of.end()) {
                described.push_back(describe_part_file(path, *part->second));
                continue;
            }
            described.push_back(describe_file(folder_->partial_path(), path));
            if (const auto part = part_of_surface.find(path);
                part != part_of_surface.end() && described.back().hash != hash_text(part->second->surface_hash))
                throw Error(ErrorCode::io, fmt::format("{} is not what was written: the disk or the memory has damaged "
                                                       "it. Continue the run to write it again.",
                                                       folder_->file(path)));
        }
        return described;
    });
    std::vector<RunFile> all;
    for (const auto& of_rank : all_gather(ranks_, own)) all.insert(all.end(), of_rank.begin(), of_rank.end());
    return all;
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
        if (!is_root() || !report_.options.volume) return;
        std::vector<std::string> pieces;
        for (const PartReport& part : report_.parts)
            if (part.result.code == 0) pieces.push_back("parts/" + part_file_name(part.id));
        write_pvtu(folder_->file("mesh.pvtu"), pieces);
    });
    report_.files = describe_files();
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
            run.number_interiors();
        }
        return run.finish(whole, read_seconds);
    } catch (const Error& error) {
        throw run.with_way_to_go_on(error);
    }
}

}  // namespace kerf

// Every rank reads the input and descends its own branches of the tree. The ranks talk three times: to bring both sides
// of the interfaces together, to number the vertices, and to report. Meshes never travel: a part goes from its worker
// to its file.
#include "run/pipeline.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "decompose/straight_division.h"
#include "io/run_folder.h"
#include "io/stl_writer.h"
#include "io/text_file.h"
#include "run/failed_part.h"
#include "run/input_cover.h"
#include "run/interface_match.h"
#include "run/mesh_hash.h"
#include "run/numbering.h"
#include "run/trace.h"

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

RunFolder open_run_folder(const std::string& path, Communicator& ranks) {
    std::optional<RunFolder> folder;
    const std::string temporary = in_agreement(ranks, [&] {
        if (ranks.rank() != 0) return std::string();
        folder.emplace(RunFolder::create(path));
        return folder->temporary_path();
    });
    const std::string shared = all_gather(ranks, temporary).front();
    if (!folder) folder.emplace(RunFolder::join(shared));
    return std::move(*folder);
}

// All nodes of the tree, ascending by number; ranks that share a branch have found the same.
std::vector<TreeNode> gather_nodes(Communicator& ranks, const std::vector<TreeNode>& own) {
    std::map<NodeId, TreeNode> by_id;
    for (const auto& nodes : all_gather(ranks, own))
        for (const TreeNode& node : nodes) by_id.emplace(node.id, node);
    std::vector<TreeNode> all;
    for (const auto& [id, node] : by_id) all.push_back(node);
    return all;
}

// What is known of a part before it is meshed.
PartReport describe_part(const Leaf& leaf, const std::vector<NodeId>& neighbours, int rank) {
    PartReport part;
    part.id = leaf.id;
    part.rank = rank;
    part.surface_volume = leaf.volume;
    part.surface_vertices = static_cast<std::int64_t>(leaf.surface.vertices.size());
    part.surface_facets = static_cast<std::int64_t>(leaf.surface.facets.size());
    for (std::size_t f = 0; f < neighbours.size(); ++f) {
        if (neighbours[f] < 0) continue;
        const Triangle& t = leaf.surface.facets[f];
        const std::vector<Vec3>& p = leaf.surface.vertices;
        part.interface_area += (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm() / 2;
        part.neighbours.push_back(neighbours[f]);
    }
    std::sort(part.neighbours.begin(), part.neighbours.end());
    part.neighbours.erase(std::unique(part.neighbours.begin(), part.neighbours.end()), part.neighbours.end());
    return part;
}

// Fewer facets leave no contour of edges; fewer than a tetrahedron has make no part.
std::int64_t least_facets(const DecomposeOptions& options) {
    return options.facets == FacetPolicy::keep ? min_facets_per_part : 4;
}

void check_part_count(const Input& input, const DecomposeOptions& options) {
    const std::int64_t most = std::max<std::int64_t>(1, input.facets / least_facets(options));
    if (options.parts > most)
        throw Error(ErrorCode::usage, fmt::format("{} has {} facets, too few for {} parts. Use -n {} or fewer, or a "
                                                  "finer surface.",
                                                  input.path, input.facets, options.parts, most));
}

// One rank's share of the run.
class Run {
 public:
    Run(RunOptions options, Communicator& ranks, Input& input, RunListener* listener)
        : ranks_(ranks), input_(input), listener_(listener), folder_(open_run_folder(options.output, ranks)) {
        report_.options = std::move(options);
        report_.ranks = ranks.size();
        report_.input = &input;
    }

    void decompose_surface();
    void divide_unfinished(CutListener* cuts);
    void join_interfaces();
    void mesh_parts();
    void number_interiors();
    void gather_results();
    RunReport finish(const Stopwatch& whole, double read_seconds);

 private:
    bool is_root() const { return ranks_.rank() == 0; }
    void progress(const char* stage, std::size_t done, std::size_t total) {
        if (!listener_) return;
        if (listener_->cancelled()) throw Error(ErrorCode::cancelled, "The run was cancelled.");
        listener_->on_progress(stage, done, total);
    }
    PartJob make_job(std::size_t leaf) const;
    void keep_reproducer(const Leaf& leaf, const PartReport& part) const;
    void verify();
    void measure_workers();

    Communicator& ranks_;
    Input& input_;
    RunListener* listener_;
    RunFolder folder_;
    RunReport report_;
    Decomposition own_;
    std::vector<PartReport> own_parts_;
    std::vector<PartArrays> own_arrays_;
    std::int64_t surface_vertices_ = 0;
};

void Run::decompose_surface() {
    const Stopwatch stopwatch;
    const DecomposeOptions& options = report_.options.decompose;
    const LeafRange range = range_of_rank(options.parts, ranks_);
    CutListener* cuts = listener_ && listener_->wants_cuts() ? listener_ : nullptr;
    std::optional<TraceRecorder> trace;
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
    whole.nodes = gather_nodes(ranks_, own_.nodes);
    for (std::vector<Leaf>& leaves : all_gather(ranks_, own_.leaves))
        std::move(leaves.begin(), leaves.end(), std::back_inserter(whole.leaves));
    const DecomposeOptions& options = report_.options.decompose;
    own_ = in_agreement(
        ranks_, [&] { return divide_straight(std::move(whole), options, range_of_rank(options.parts, ranks_), cuts); });
}

void Run::join_interfaces() {
    report_.nodes = gather_nodes(ranks_, own_.nodes);
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
        own_parts_.push_back(describe_part(leaf, arrays.neighbour, ranks_.rank()));
        own_arrays_.push_back(std::move(arrays));
    }
    in_agreement(ranks_, [&] {
        for (std::size_t i = 0; i < own_.leaves.size(); ++i) {
            const Leaf& leaf = own_.leaves[i];
            write_part_surface(folder_.part_surface_file(leaf.id), leaf.surface, own_arrays_[i]);
            if (report_.options.stl)
                write_stl(folder_.part_stl_file(leaf.id), leaf.surface.vertices, leaf.surface.facets);
        }
    });
}

PartJob Run::make_job(std::size_t leaf) const {
    PartJob job;
    job.surface = own_.leaves[leaf].surface;
    job.arrays = own_arrays_[leaf];
    job.mesher = report_.options.mesher;
    job.part_file = folder_.part_file(own_.leaves[leaf].id);
    job.length_scale = input_.diagonal;
    return job;
}

void Run::keep_reproducer(const Leaf& leaf, const PartReport& part) const {
    write_failed_part(folder_.file("failed"), leaf.id, leaf.surface, report_.options.mesher, part.result.message);
}

void Run::mesh_parts() {
    const Stopwatch stopwatch;
    const RunOptions& options = report_.options;
    in_agreement(ranks_, [&] {
        std::vector<std::size_t> order(own_.leaves.size());  // longest first
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        const auto load = [&](std::size_t i) {
            const SurfaceArrays& surface = own_.leaves[i].surface;
            return options.decompose.cut.load.load(static_cast<double>(surface.vertices.size()),
                                                   static_cast<double>(surface.facets.size()), own_.leaves[i].volume);
        };
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return load(a) > load(b); });
        std::vector<PartJob> jobs;
        for (const std::size_t i : order) jobs.push_back(make_job(i));
        std::size_t done = 0;
        progress("volume", 0, jobs.size());
        QueueOptions queue = {options.worker_program, options.workers, options.timeout_seconds, options.memory_mb,
                              options.attempts};
        if (listener_) queue.cancelled = [this] { return listener_->cancelled(); };
        run_part_jobs(std::move(jobs), queue, [&](std::size_t index, const PartOutcome& outcome) {
            PartReport& part = own_parts_[order[index]];
            part.worker = outcome.worker;
            part.attempts = outcome.attempts;
            part.seconds = outcome.seconds;
            part.failures = outcome.failures;
            part.remedy = outcome.remedy;
            part.result = outcome.result;
            if (part.result.code == static_cast<int>(ErrorCode::io)) throw Error(ErrorCode::io, part.result.message);
            if (part.result.code) keep_reproducer(own_.leaves[order[index]], part);
            progress("volume", ++done, order.size());
        });
    });
    report_.seconds.mesh = longest(ranks_, stopwatch.seconds());
}

void Run::gather_results() {
    for (const auto& parts : all_gather(ranks_, own_parts_))
        report_.parts.insert(report_.parts.end(), parts.begin(), parts.end());
}

void Run::number_interiors() {
    std::int64_t first = surface_vertices_;
    std::map<NodeId, std::int64_t> first_of;
    for (const PartReport& part : report_.parts) {
        first_of[part.id] = first;
        first += part.result.interior_vertices;
    }
    report_.vertices = first;
    in_agreement(ranks_, [&] {
        for (const PartReport& part : own_parts_)
            if (part.result.code == 0) number_interior_vertices(folder_.part_file(part.id), first_of[part.id]);
    });
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

// Sums of a measure over the parts of each worker of each rank.
template <class Measure>
std::vector<double> per_worker(const RunReport& report, Measure measure) {
    std::vector<double> sums(static_cast<std::size_t>(report.ranks * report.options.workers), 0);
    for (const PartReport& part : report.parts)
        sums[static_cast<std::size_t>(part.rank * report.options.workers + part.worker)] += measure(part);
    return sums;
}

void Run::measure_workers() {
    const auto longest_sum = [&](double PartResult::*seconds) {
        const auto sums = per_worker(report_, [&](const PartReport& part) { return part.result.*seconds; });
        return *std::max_element(sums.begin(), sums.end());
    };
    report_.seconds.verify = longest_sum(&PartResult::verify_seconds);
    report_.seconds.write = longest_sum(&PartResult::write_seconds);
    const auto busy = per_worker(report_, [](const PartReport& part) { return part.seconds; });
    const double sum = std::accumulate(busy.begin(), busy.end(), 0.0);
    if (sum > 0)
        report_.imbalance = *std::max_element(busy.begin(), busy.end()) * static_cast<double>(busy.size()) / sum;
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

std::int64_t own_peak_rss_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
}

RunReport Run::finish(const Stopwatch& whole, double read_seconds) {
    report_.quality = PartQuality(input_.diagonal);
    std::vector<PartHash> hashes;
    std::int64_t largest_worker = 0;
    for (const PartReport& part : report_.parts) {
        report_.tets += part.result.tets;
        if (part.result.tets) report_.quality.add(part.result.quality);
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
    report_.seconds.wall = longest(ranks_, whole.seconds());
    in_agreement(ranks_, [&] {
        if (!is_root()) return;
        if (report_.options.volume) {
            std::vector<std::string> pieces;
            for (const PartReport& part : report_.parts)
                if (part.result.code == 0) pieces.push_back("parts/" + part_file_name(part.id));
            write_pvtu(folder_.file("mesh.pvtu"), pieces);
        }
        const std::string json = to_json(report_);
        write_text_file(folder_.file("report.json"), json);
        folder_.commit();
        if (!report_.options.report_file.empty()) write_text_file(report_.options.report_file, json);
    });
    return std::move(report_);
}

}  // namespace

RunReport run(RunOptions options, int cores_of_rank, Communicator& ranks, Input& input, RunListener* listener) {
    const Stopwatch whole;
    // Hosts may differ, but the defaults of K and workers must not.
    for (const int cores : all_gather(ranks, cores_of_rank)) cores_of_rank = std::min(cores_of_rank, cores);
    in_agreement(ranks, [&] {
        options.resolve(ranks.size(), cores_of_rank);
        if (listener) listener->on_progress("read", 0, 1);
        input = read_input(options.input, options.input_options);
        check_part_count(input, options.decompose);
    });
    const double read_seconds = longest(ranks, whole.seconds());
    const bool volume = options.volume;
    Run run(std::move(options), ranks, input, listener);
    run.decompose_surface();
    run.join_interfaces();
    if (volume) run.mesh_parts();
    run.gather_results();
    if (volume) run.number_interiors();
    return run.finish(whole, read_seconds);
}

}  // namespace kerf

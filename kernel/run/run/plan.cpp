// The first rank decides all, in an order in which each choice has what it depends on: the input is read, lengths get
// its units, a forecast refuses a surface that could not be filled before it is remeshed, then the surface is remeshed
// and sized; nodes of second order are functions of the surface before it is cut, so they are made next; sizes are
// taken on the surface that is cut, K follows from its sized volume, and the budget is checked again. The other ranks
// get the result as bytes. Two things are agreed on before that: the cores of a rank are the fewest of any rank,
// because the defaults of K and workers depend on them and must not differ; and the first rank borrows the processors
// of the sleeping ranks of its host. "Sized volume" is the volume in which each place counts by the size that is wanted
// there.
#include "run/run/plan.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/core/bytes.h"
#include "base/core/host_name.h"
#include "base/core/ids.h"
#include "base/core/threads.h"
#include "base/parallel/on_root.h"
#include "base/parallel/processors.h"
#include "files/export/patch_types.h"
#include "files/io/program_finder.h"
#include "files/io/run_manifest.h"
#include "run/prepare/cells.h"
#include "run/prepare/remeshing.h"
#include "run/prepare/size_reader.h"
#include "run/request/saved_run.h"
#include "run/run/inside/forecast.h"

namespace kerf {

namespace {

constexpr double coarse_radius_edge = 2;

// The fewest facets of a part. Fewer than the first number leave no contour of edges; fewer than a tetrahedron has make
// no part.
std::int64_t least_facets(FacetPolicy facets) { return facets == FacetPolicy::keep ? min_facets_per_part : 4; }

// K as given, if the surface allows it; else that of a run into the same folder that was interrupted, perhaps on
// another machine; else as it follows from the surface, its sized volume, the machine and its memory.
std::int32_t part_count(const Input& input, const RunPlan& plan, double volume, int ranks) {
    const RunRequest& request = plan.request();
    const std::int32_t regions = input.complex.region_count();
    const std::int32_t most = std::max<std::int64_t>(regions, input.facets / least_facets(request.facets));
    if (request.parts == 0) {
        const std::int32_t interrupted = request.dry_run ? 0 : interrupted_part_count(request.output, input.file_hash);
        if (interrupted >= regions && interrupted <= most) return interrupted;
        const double facets = input.facets;
        return std::max({choose_parts(request.workers, plan.mesher(), facets, volume, ranks, most),
                         std::min(request.least_parts, most), regions});
    }
    if (request.parts > most)
        throw Error(ErrorCode::usage, fmt::format("{} has {} facets, too few for {} parts. Use -n {} or fewer, or a "
                                                  "finer surface.",
                                                  input.path, input.facets, request.parts, most));
    return std::max(request.parts, regions);
}

// The sized volume, in units of the size that holds where no region has one of its own.
double sized_volume_of(const Input& input, const SizeField& size, const RegionSizes& region_sizes) {
    if (!region_sizes.empty() && !size.is_empty()) {
        double sum = 0;
        for (const RegionIndex r : input.regions.ids())
            sum += input.regions[r].volume * size.reference_volume() / region_sizes.of(r, size).reference_volume();
        return sum;
    }
    const SurfaceArrays surface = size.is_constant() ? SurfaceArrays() : input.complex.arrays();
    return sized_volume(size, surface.vertices, surface.facets, input.volume);
}

// Checks the budget of the surface that remeshing would make: a surface of many facets takes longer to be made than to
// be found too large to be filled.
void check_budget_before_remeshing(const Input& input, const RunChoices& choices, int ranks) {
    RunRequest request = choices.request;
    if (request.dry_run || surface_change(input, request) == SurfaceChange::none) return;
    request.sizes = forecast_sizes(input, request);
    SizeOptions sizes = sizes_of_cells(request.sizes, input);
    sizes.growth = request.sizes.growth = 0;  // from edges that are to change
    const MesherOptions mesher(request.mesher, read_size_field(sizes, input));
    const double volume = sized_volume_of(input, mesher.size, {}), facets = forecast_changed_facets(input, request);
    constexpr std::int32_t no_limit = std::numeric_limits<std::int32_t>::max();
    const std::int32_t parts =
        request.parts > 0 ? request.parts : choose_parts(request.workers, mesher, facets, volume, ranks, no_limit);
    check_budget(choices, mesher, parts, facets, volume, Facets::follow_size);
}

// Bodies and the ground are walls of the air, and all but caps of what flows in a vessel, unless a type is asked for:
// what is asked for comes last and counts.
void put_walls_of_flow(const Input& input, std::vector<std::string>& patch_types) {
    const bool is_capped = input.ladder.done_by(RepairKind::caps) > 0;
    if (!input.enclosure && !is_capped) return;
    const auto is_wall = [&](const std::string& patch) {
        if (!input.enclosure) return !is_cap(patch);
        return !input.enclosure->has_face(patch) || patch == Enclosure::ground;
    };
    std::vector<std::string> types;
    for (const std::string& patch : input.patch_names)
        if (is_wall(patch)) types.push_back(patch + "=wall");
    patch_types.insert(patch_types.begin(), types.begin(), types.end());
}

bool keeps_most_facets(const Input& input) { return !input.remeshed || 2 * input.remeshed->facets_kept > input.facets; }

// The processors of the first rank's host, which that rank uses alone while the others wait.
class ProcessorsOfHost {
 public:
    // Collective.
    explicit ProcessorsOfHost(Communicator& ranks) {
        const std::string host = host_name();
        const Bytes of_root = ranks.broadcast(Bytes(host.begin(), host.end()), 0);
        std::vector<Bytes> to_rank(ranks.size());
        if (std::string(of_root.begin(), of_root.end()) == host) to_rank[0] = to_bytes(own_);
        for (const Bytes& bytes : ranks.exchange(std::move(to_rank))) {
            if (bytes.empty()) continue;
            ++ranks_;
            const auto of_rank = from_bytes<std::vector<int>>(bytes);
            all_.insert(all_.end(), of_rank.begin(), of_rank.end());
        }
        std::sort(all_.begin(), all_.end());
        all_.erase(std::unique(all_.begin(), all_.end()), all_.end());
    }

    // Calls body() with threads for all ranks of the host.
    template <class Body>
    void lend(int threads_of_rank, const Body& body) const {
        struct Borrowed {
            const ProcessorsOfHost& host;
            int threads_of_rank;
            ~Borrowed() {
                allow_processors(host.own_);
                set_thread_limit(threads_of_rank);
            }
        } const borrowed{*this, threads_of_rank};
        const int most = std::max(threads_of_rank, count_of(all_));
        if (ranks_ > 1) allow_processors(all_);
        set_thread_limit(std::min(threads_of_rank * std::max(1, ranks_), most));
        body();
    }

 private:
    std::vector<int> own_ = allowed_processors(), all_;
    int ranks_ = 0;  // number of ranks of the host
};

// The choices as far as a rank makes them by itself.
RunChoices own_choices(RunRequest request, int cores_of_rank, const std::optional<Input>& surface) {
    if (surface) request.input = surface->path;
    RunChoices choices = choices_of(std::move(request), cores_of_rank);
    std::string& program = choices.request.workers.program;
    if (choices.request.fills_parts() && program.empty()) program = find_kerf_program("kerf-worker");
    return choices;
}

// Takes the surface, or reads the input that the request names, and completes the plan.
PlannedRun plan_surface(RunPlan plan, std::optional<Input> surface, int ranks, StageListener* listener) {
    RunRequest& request = plan.choices.request;
    Input input = surface ? *std::move(surface) : read_input(request.input, plan.choices.input, listener);
    refuse_changed_input(request, input.file_hash);
    request.input_options.repairs.weld_tolerance = input.ladder.preparation(RepairKind::merge).amount;
    request.deviation = request.deviation.of(input.body_diagonal());
    request.sizes.resolve_lengths(input.body_diagonal());
    check_budget_before_remeshing(input, plan.choices, ranks);
    const SurfaceArrays behind = surface_behind(input, request);
    SizedInput sized = remesh_and_size(std::move(input), request, listener);
    input = std::move(sized.input);
    request.sizes = std::move(sized.sizes);
    plan.found_size = sized.found;
    plan.surface_nodes = make_surface_nodes(input, behind, request);
    if (keeps_most_facets(input)) {
        double& radius_edge = request.mesher.radius_edge;
        if (request.sizes.is_coarse() && radius_edge == MesherChoices().radius_edge) radius_edge = coarse_radius_edge;
        request.sizes.growth = request.sizes.growth_beside_kept_facets();
    }
    plan.size = read_size_field(sizes_of_cells(request.sizes, input), input);
    plan.region_sizes = RegionSizes(max_volumes_of_regions(request.sizes, input));
    put_walls_of_flow(input, request.outputs.patch_types);
    plan.choices.patch_types = parse_patch_types(request.outputs.patch_types);
    require_patches(plan.choices.patch_types, input.patch_names);
    if (request.outputs.split_regions) require_regions(input.complex.region_names().size());
    const double volume = sized_volume_of(input, plan.size, plan.region_sizes);
    const std::int32_t wanted_parts = std::exchange(request.parts, part_count(input, plan, volume, ranks));
    if (!request.dry_run) check_budget(plan.choices, plan.mesher(), request.parts, input.facets, volume);
    if (wanted_parts > 0 && request.parts > wanted_parts)
        input.notes.push_back(fmt::format("The {} regions are a part each, though -n {} asks for fewer parts.",
                                          input.complex.region_count(), wanted_parts));
    return {std::move(plan), std::move(input)};
}

// Lists the fields of the message from the first rank to the others, for writing and for reading.
template <class Archive>
class PlanArchive {
 public:
    explicit PlanArchive(Archive& archive) : archive_(archive) {}

    void plan(RunPlan& plan, Array<RegionIndex, double>& largest_of_regions) {
        RunRequest& request = plan.choices.request;
        archive_(request.input, request.parts, request.mesher.radius_edge, plan.size, largest_of_regions);
        archive_(request.outputs.patch_types);
        length(request.input_options.repairs.weld_tolerance);
        length(request.deviation);
        sizes(request.sizes);
        found(plan.found_size);
        archive_(plan.surface_nodes.edges, plan.surface_nodes.points, plan.surface_nodes.surface_edges);
    }
    void input(Input& input) {
        archive_(input.path, input.file_hash, input.vertices, input.facets, input.components, input.genus);
        archive_(input.volume, input.volume_error, input.area, input.largest_coordinate, input.diagonal);
        archive_(input.patch_names, input.patch_colours, input.notes, input.is_cad);
        regions(input.regions);
    }

 private:
    void length(Length& length) {
        double number = length.number();
        bool is_percent = length.is_percent();
        archive_(number, is_percent);
        length = is_percent ? Length::percent(number) : Length(number);
    }
    void sizes(SizeOptions& sizes) {
        length(sizes.size);
        length(sizes.chord_error);
        archive_(sizes.max_volume, sizes.cells, sizes.fineness, sizes.meaning, sizes.inside, sizes.on, sizes.near,
                 sizes.in_region);
        archive_(sizes.growth, sizes.segments_per_turn, sizes.cells_across);
    }
    void regions(std::vector<InputRegion>& regions) {
        std::uint64_t count = regions.size();
        archive_(count);
        regions.resize(count);
        for (InputRegion& region : regions)
            archive_(region.facets, region.components, region.volume, region.volume_error, region.area);
    }
    void found(std::optional<FoundSize>& found) {
        FoundSize size = found.value_or(FoundSize());
        bool is_found = found.has_value();
        archive_(is_found, size.cells, size.size, size.tets, size.remeshings);
        found = is_found ? std::optional(size) : std::nullopt;
    }

    Archive& archive_;
};

// Returns the plan and its input as bytes. O(#F) for several regions, else a few kilobytes beside sources of sizes, and
// nodes on edges.
Bytes bytes_of_plan(const PlannedRun& run) {
    const auto& [plan, input] = run;
    Bytes bytes;
    ByteWriter writer(bytes);
    PlanArchive<ByteWriter> archive(writer);
    // An archive that writes bytes does not change its fields.
    Array<RegionIndex, double> largest_of_regions = plan.region_sizes.max_volumes();
    archive.plan(const_cast<RunPlan&>(plan), largest_of_regions);
    archive.input(const_cast<Input&>(input));
    const std::span<const std::string> names = input.complex.region_names();
    const std::span<const FacetSides> sides = input.complex.all_sides();
    writer(std::vector<std::string>(names.begin(), names.end()));
    if (!names.empty()) writer(input.complex.arrays(), std::vector<FacetSides>(sides.begin(), sides.end()));
    return bytes;
}

// Returns the plan and its input from such bytes. `own`: with the choices as far as a rank makes them by itself.
// O(#F log #F) for several regions.
PlannedRun plan_of_bytes(const Bytes& told, RunPlan own) {
    PlannedRun run{std::move(own), {}};
    auto& [plan, input] = run;
    ByteReader reader(told);
    PlanArchive<ByteReader> archive(reader);
    Array<RegionIndex, double> largest_of_regions;
    archive.plan(plan, largest_of_regions);
    plan.region_sizes = RegionSizes(std::move(largest_of_regions));
    plan.choices.patch_types = parse_patch_types(plan.request().outputs.patch_types);
    archive.input(input);
    std::vector<std::string> names;
    reader(names);
    if (names.empty()) return run;
    SurfaceArrays facets;
    std::vector<FacetSides> sides;
    reader(facets, sides);
    input.complex = Complex(std::move(facets), std::move(sides), std::move(names));
    return run;
}

}  // namespace

PlannedRun plan_run(const RunRequest& request, int cores_of_rank, Communicator& ranks, StageListener* listener,
                    std::optional<Input> surface) {
    // Hosts may differ, but the defaults of K and workers must not.
    for (const int cores : all_gather(ranks, cores_of_rank)) cores_of_rank = std::min(cores_of_rank, cores);
    const ProcessorsOfHost host(ranks);
    PlannedRun run;
    RunPlan& plan = run.plan;
    in_agreement(ranks, [&] {
        plan.choices = own_choices(request, cores_of_rank, surface);
        if (ranks.rank() != 0) surface.reset();
        if (plan.request().fills_parts() && !plan.request().transient)
            plan.worker_hash = describe_file("", plan.request().workers.program).hash;
        if (listener) listener->on_progress("read", 0, 1);
        set_thread_limit(plan.request().workers.count);  // they have nothing to do yet
    });
    const int threads = plan.request().workers.count;
    const auto of_root = [&] {
        host.lend(threads, [&] { run = plan_surface(std::move(plan), std::move(surface), ranks.size(), listener); });
        return ranks.size() > 1 ? bytes_of_plan(run) : Bytes();
    };
    const Bytes told = bytes_of_root(ranks, of_root, [&] { end_if_cancelled(listener); });
    in_agreement(ranks, [&] {
        if (ranks.rank() != 0) run = plan_of_bytes(told, std::move(plan));
    });
    return run;
}

}  // namespace kerf

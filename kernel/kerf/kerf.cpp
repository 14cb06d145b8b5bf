// The facade: each function makes the options of a run of named options, calls the kernel and turns its report into
// arrays or errors. Meshing in memory is a transient run: it has a temporary folder for the files of its parts, and the
// arrays are made while these are there (ArraysListener::on_meshes()). Only the one function that runs on ranks,
// mesh_on_ranks(), is shared with kerf/mpi.h. Options of the surface are refused where a surface is given, because it
// was made with them. A remeshed surface is made of arrays again, so that it is checked like any other.
#include "kerf/kerf.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "base/core/ids.h"
#include "base/core/version.h"
#include "base/parallel/processors.h"
#include "files/export/merged_file.h"
#include "files/io/file_bytes.h"
#include "files/io/program_finder.h"
#include "files/io/run_folder.h"
#include "files/io/temporary_folder.h"
#include "files/part/second_order_parts.h"
#include "files/part/solution_parts.h"
#include "kerf/inside/array_points.h"
#include "kerf/inside/arrays_from_parts.h"
#include "kerf/inside/regions_as_parts.h"
#include "kerf/inside/run_request.h"
#include "kerf/mesh_on_ranks.h"
#include "kerf/progress_listener.h"
#include "run/prepare/remeshed_file.h"
#include "run/report/report.h"
#include "run/run/pipeline.h"

namespace kerf {

namespace {

namespace fs = std::filesystem;
using Sides = std::vector<std::array<std::int32_t, 2>>;

std::array<double, 3> to_array(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

bool has_option(const std::vector<OptionField>& fields, const std::string& name) {
    return std::any_of(fields.begin(), fields.end(), [&](const OptionField& field) { return field.name == name; });
}

FailedPart failed_part(const RunReport& report, const PartReport& part) {
    const auto node = std::find_if(report.cut.nodes.begin(), report.cut.nodes.end(),
                                   [&](const TreeNode& candidate) { return candidate.id == part.id; });
    return {part.id.value(), to_array(node->mass.centroid), part.result.message,
            fmt::format("{}/failed/{}", report.folder.path, failed_part_file_name(part.id))};
}

[[noreturn]] void refuse_sizes(const std::string& what) { throw Error(ErrorCode::input, "The sizes given: " + what); }

// Returns the given sizes as a mesh, null for none.
std::shared_ptr<const SizedMesh> sized_mesh_of(const GivenSizes* given) {
    if (!given) return nullptr;
    check_sizes(*given);
    return std::make_shared<const SizedMesh>(SizedMesh{to_points(given->vertices), given->tets, given->sizes});
}

// Throws the error of a run that is no result.
void require_success(const RunReport& report) {
    if (report.exit_code == 0) return;
    std::vector<FailedPart> failed;
    for (const PartReport& part : report.parts)
        if (part.result.code != 0) failed.push_back(failed_part(report, part));
    const auto code = static_cast<ErrorCode>(report.exit_code);
    if (failed.empty()) throw Error(code, "A law of the mesh does not hold.");
    const std::string message =
        fmt::format("Part {} could not be meshed: {}", failed.front().number, failed.front().message);
    throw PartsFailed(code, message, std::move(failed));
}

// Makes the arrays of the parts that a transient run has meshed.
class ArraysListener : public ProgressListener {
 public:
    ArraysListener(const MeshOptions& options, int threads)
        : ProgressListener(options.progress, options.is_cancelled), threads_(threads) {}
    void on_meshes(const StoredParts& parts, const SecondOrderParts* of_order_2) override {
        mesh = of_order_2 ? arrays_from_parts(*of_order_2) : arrays_from_parts(parts, threads_);
    }

    MeshArrays mesh;

 private:
    int threads_;
};

void refuse_files(const RunRequest& options) {
    const auto refuse = [](const char* option) {
        throw Error(ErrorCode::usage, fmt::format("--{} asks for files of a run folder, but the mesh is wanted in "
                                                  "memory. Leave it out, or name a folder for the run.",
                                                  option));
    };
    if (!options.outputs.formats.empty()) refuse("format");
    if (options.outputs.stl) refuse("stl");
}

int all_processors() { return std::max(1, count_of(allowed_processors())); }

ClosedSurface remeshed_as(const ClosedSurface& surface, const RunRequest& options, const Progress& progress,
                          const IsCancelled& is_cancelled) {
    options.sizes.check();
    ProgressListener listener(progress, is_cancelled);
    SizedInput sized = remesh_always(surface.input(), options, &listener);
    std::vector<std::string> notes = notes_of(sized.input);
    if (sized.found) notes.push_back("cells: " + found_size_text(*sized.found));
    const ClosedSurface result(std::make_shared<const Input>(std::move(sized.input)));
    const std::vector<std::string> regions = result.region_names();
    Input input = surface_of_regions(result.vertices(), result.facets(), regions.empty() ? Sides() : result.sides(),
                                     regions, result.patches(), result.patch_names(), {}, is_cancelled)
                      .input();
    input.notes = std::move(notes);
    return ClosedSurface(std::make_shared<const Input>(std::move(input)));
}

}  // namespace

void refuse_options_of_surface(const NamedOptions& options) {
    InputOptions of_surface;
    const std::vector<OptionField> fields = input_option_fields(of_surface);
    for (const auto& [name, text] : options)
        if (has_option(fields, name))
            throw Error(ErrorCode::usage,
                        fmt::format("--{} is an option of the surface: give it where that is made.", name));
}

RunRequest run_options(const std::string& input, const MeshOptions& options, const std::string& folder) {
    RunRequest run;
    const std::vector<OptionField> all = option_fields(run);
    std::vector<OptionText> texts;
    for (const auto& [name, text] : options.others) {
        if (!has_option(all, name)) throw Error(ErrorCode::usage, fmt::format("--{} is no option of a mesh.", name));
        texts.push_back({name, text});
    }
    run.sizes.size = options.size;
    run.parts = options.parts;
    run.workers.count = options.workers;
    set_options(run, texts, "MeshOptions::others");
    run.sizes.background = sized_mesh_of(options.sizes.get());
    run.output = folder;
    run.input = input;
    run.workers.program = find_kerf_program("kerf-worker", options.programs);
    return run;
}

const char* library_version() { return version; }

std::int64_t ClosedSurface::vertex_count() const { return input_->vertices; }
std::int64_t ClosedSurface::facet_count() const { return input_->facets; }
double ClosedSurface::volume() const { return input_->volume; }
double ClosedSurface::area() const { return input_->area; }
std::vector<std::string> ClosedSurface::notes() const { return notes_of(*input_); }
const std::vector<std::string>& ClosedSurface::patch_names() const { return input_->patch_names; }

std::vector<std::string> ClosedSurface::region_names() const {
    return {input_->complex.region_names().begin(), input_->complex.region_names().end()};
}

std::vector<std::array<std::int32_t, 2>> ClosedSurface::sides() const {
    std::vector<std::array<std::int32_t, 2>> sides;
    for (std::int32_t f = 0; f < input_->complex.facet_count(); ++f)
        sides.push_back({input_->complex.sides(f).back.value(), input_->complex.sides(f).front.value()});
    return sides;
}

std::vector<std::array<double, 3>> ClosedSurface::vertices() const {
    std::vector<std::array<double, 3>> points;
    for (std::int32_t v = 0; v < input_->complex.vertex_count(); ++v)
        points.push_back(to_array(input_->complex.point(v)));
    return points;
}

std::vector<std::array<std::int32_t, 3>> ClosedSurface::facets() const {
    std::vector<std::array<std::int32_t, 3>> facets;
    for (std::int32_t f = 0; f < input_->complex.facet_count(); ++f) facets.push_back(input_->complex.vertices(f));
    return facets;
}

std::vector<std::int32_t> ClosedSurface::patches() const {
    std::vector<std::int32_t> patches;
    for (std::int32_t f = 0; f < input_->complex.facet_count(); ++f) patches.push_back(input_->complex.patch(f));
    return patches;
}

ClosedSurface remeshed(const ClosedSurface& surface, double deviation, double size, const Progress& progress,
                       const IsCancelled& is_cancelled) {
    RunRequest options;
    options.deviation = deviation;
    options.sizes.size = size;
    return remeshed_as(surface, options, progress, is_cancelled);
}

ClosedSurface remeshed(const ClosedSurface& surface, const NamedOptions& options, const Progress& progress,
                       const IsCancelled& is_cancelled) {
    RunRequest wanted;
    const std::vector<OptionField> of_sizes = size_option_fields(wanted.sizes);
    std::vector<OptionText> texts;
    for (const auto& [name, text] : options) {
        if (name != "deviation" && !has_option(of_sizes, name))
            throw Error(ErrorCode::usage, fmt::format("--{} is no option of remeshing a surface.", name));
        texts.push_back({name, text});
    }
    set_options(wanted, texts, "options");
    return remeshed_as(surface, wanted, progress, is_cancelled);
}

void check_sizes(const GivenSizes& given) {
    const auto& [vertices, tets, sizes] = given;
    if (sizes.size() != vertices.size())
        refuse_sizes(fmt::format("there are {} for {} points.", sizes.size(), vertices.size()));
    if (tets.empty()) refuse_sizes("they have no tetrahedra.");
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        const auto& [x, y, z] = vertices[v];
        if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z))
            refuse_sizes(fmt::format("point {} (counted from 0) is ({}, {}, {}), which is no place.", v, x, y, z));
        if (!(sizes[v] > 0) || !std::isfinite(sizes[v]))
            refuse_sizes(
                fmt::format("that of point {} (counted from 0) is {}, but edge lengths are positive.", v, sizes[v]));
    }
    for (std::size_t t = 0; t < tets.size(); ++t)
        for (const std::int32_t v : tets[t])
            if (v < 0 || std::cmp_greater_equal(v, vertices.size()))
                refuse_sizes(fmt::format("tetrahedron {} (counted from 0) has the corner {}, but there are {} points.",
                                         t, v, vertices.size()));
}

void mesh_on_ranks(const ClosedSurface& surface, const MeshOptions& options, const std::string& folder,
                   int cores_of_rank, Communicator& ranks) {
    ProgressListener listener(options.progress, options.is_cancelled);
    const RunRequest request = in_agreement(ranks, [&] {
        refuse_options_of_surface(options.others);
        return run_options(surface.input().path, options, folder);
    });
    require_success(run(request, cores_of_rank, ranks, &listener, surface.input()));
}

void mesh_to_folder(const ClosedSurface& surface, const MeshOptions& options, const std::string& folder) {
    SingleRank alone;
    mesh_on_ranks(surface, options, folder, all_processors(), alone);
}

void mesh_file_to_folder(const std::string& path, const MeshOptions& options, const std::string& folder) {
    SingleRank alone;
    ProgressListener listener(options.progress, options.is_cancelled);
    require_success(run(run_options(path, options, folder), all_processors(), alone, &listener));
}

MeshArrays mesh_to_arrays(const ClosedSurface& surface, const MeshOptions& options) {
    const std::string stem = (fs::temp_directory_path() / "kerf").string();
    const TemporaryFolder folder(stem, "make a folder " + stem + ".XXXXXX", "Set TMPDIR.");
    refuse_options_of_surface(options.others);
    RunRequest request = run_options(surface.input().path, options, folder.path() + "/run");
    refuse_files(request);
    request.transient = true;
    SingleRank alone;
    ArraysListener listener(options, all_processors());
    const RunReport report = run(request, all_processors(), alone, &listener, surface.input());
    require_success(report);
    listener.mesh.report = to_json(report);
    return std::move(listener.mesh);
}

MeshArrays arrays_of_run(const std::string& folder) {
    MeshArrays mesh = arrays_from_parts(*open_parts(folder));
    std::error_code ignored;
    const std::optional<std::string> solution = find_solution_folder(folder);
    if (const std::string report = (solution ? mesh_of_solution(*solution) : folder) + "/report.json";
        fs::exists(report, ignored))
        mesh.report = read_file(report);
    return mesh;
}

void mesh_to_file(const MeshArrays& mesh, const std::string& path, const MeshFileOptions& options) {
    const MergeRequest request{.folder = "",
                               .output = path,
                               .options = {options.msh_version},
                               .msh_ascii = options.msh_ascii,
                               .is_cancelled = options.is_cancelled};
    check_merged_file(request);
    merge_parts(RegionsAsParts(mesh), request);
}

}  // namespace kerf

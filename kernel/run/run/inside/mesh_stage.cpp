// The workers leave each part in a store of its own, where all that follows reads it: nodes of second order, and the
// files of all formats. The store of a part goes as soon as its files are there, if no format asks for the part again:
// the disk never holds both, and a run that continues makes the store of the file of vtu again (restore_stored_part()).
// Of a mesh with parts missing, which no solver can read, only vtu is written, so that people can look at it. A
// transient run gives its store to the listener instead of writing formats. A reference, where one is asked for, is the
// mesh of the whole in one piece, beside which the mesh in parts can be judged.
#include "run/run/inside/mesh_stage.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/geometry/box.h"
#include "files/io/run_manifest.h"
#include "files/io/text_file.h"
#include "files/part/curved_nodes_file.h"
#include "files/part/part_indices.h"
#include "files/part/part_store.h"
#include "files/part/second_order_parts.h"
#include "files/quality/quality_sheet.h"
#include "files/quality/quality_text.h"
#include "run/report/totals.h"
#include "run/run/edge_numbering.h"
#include "run/run/inside/curve_stage.h"
#include "run/run/inside/write_stage.h"
#include "run/work/part_queue.h"

namespace kerf {

namespace {

// The parts that were meshed, as they lie in the folder, with the numbers of all vertices: those inside of parts come
// after those of the surfaces.
StoredParts number_parts(const RunFolder& folder, const RunReport& report, std::int64_t surface_vertices) {
    MeshOutline outline;
    std::vector<StoredParts::Place> places;
    outline.patch_names = report.input.patch_names;
    const std::span<const std::string> regions = report.input.complex.region_names();
    outline.region_names.assign(regions.begin(), regions.end());
    std::int64_t next = surface_vertices;
    for (const PartReport& part : report.parts) {
        if (part.result.code == 0) {
            const std::int64_t unlisted = part.interface_facets + part.walls_of_others;
            outline.parts.push_back(
                {part.id, part.result.vertices, part.result.tets, part.surface_facets - unlisted, unlisted});
            places.push_back({folder.stored_part_file(part.id), next, part.result.file_hash});
        }
        next += part.result.interior_vertices;
    }
    outline.vertices = next;
    outline.is_whole = outline.parts.size() == report.parts.size();
    return {std::move(outline), places};
}

// Fills the whole surface in a worker of its own, as a part is filled, but with all the memory that there is. The files
// that it writes into the folder are gone when this returns. That there is no mesh is said by the outcome.
PartOutcome mesh_in_one_piece(const RunContext& run, const RunFolder& folder, const Surface& surface,
                              double length_scale) {
    const WorkerOptions& workers = run.plan.request().workers;
    PartJob job;
    job.part = no_node;
    job.surface = surface.arrays();
    job.boundary_id.assign(job.surface.vertices.size(), -1);
    job.neighbour.assign(job.surface.facets.size(), NodeId::none());
    job.length_scale = length_scale;
    const std::string job_file = folder.job_file(no_node), part_file = folder.stored_part_file(no_node);
    write_job(job_file, job);
    PartQueue queue({{job_file, part_file, run.plan.size, box_around(job.surface.vertices)}},
                    {workers.program, run.plan.mesher(), 1, workers.timeout_seconds, 0, workers.attempts});
    queue.add(0);
    std::optional<PartQueue::Finished> finished;
    while (!finished) {
        tell_progress(run.listener, "reference", 0, 1);
        finished = queue.step(0.1);
    }
    remove_run_files(folder.partial_path(), [&](const std::string& file) {
        return folder.file(file) == job_file || folder.file(file) == part_file;
    });
    return std::move(finished->outcome);
}

// Returns the quality of the report's parts beside that of the whole as text, and writes both into the folder as a
// sheet of pictures.
Reference compare_with_whole(const RunFolder& folder, const RunReport& report, PartOutcome whole) {
    if (whole.result.code) return {std::move(whole), ""};
    const std::string name = std::filesystem::path(report.input.path).filename().string();
    MeshQuality parts, one;
    parts.name = fmt::format("{} in {} parts", name, report.parts.size());
    parts.parts = std::ssize(report.parts);
    parts.vertices = report.mesh.vertices;
    parts.cells = report.mesh.quality;
    one.name = name + " in one piece";
    one.vertices = whole.result.vertices;
    one.cells = whole.result.quality;
    write_text_file(folder.file("comparison.svg"), comparison_sheet(one, parts));
    return {std::move(whole), comparison_text(one, parts)};
}

std::optional<Reference> mesh_reference(const RunContext& run, const RunFolder& folder, const RunReport& report,
                                        const std::optional<Surface>& whole) {
    return in_agreement(run.ranks, [&]() -> std::optional<Reference> {
        if (!whole) return std::nullopt;
        return compare_with_whole(folder, report, mesh_in_one_piece(run, folder, *whole, report.input.diagonal));
    });
}

// The parts with a node on each edge, null for cells of order 1, and the fate of the edges on the surface.
struct NodesOnEdges {
    std::unique_ptr<const SecondOrderParts> parts;
    std::optional<CurveReport> curve = {};
};

NodesOnEdges with_second_order(const RunContext& run, const StoredParts& parts) {
    if (run.plan.request().order != 2) return {};
    EdgeNumbers numbers = number_edges_together(run.ranks, parts, run.listener);
    if (!run.plan.request().has_curved_edges())
        return {std::make_unique<const SecondOrderParts>(parts, std::move(numbers), CurvedNodes())};
    CurvedMesh curved = curve_parts(run.ranks, parts, numbers, run.plan.surface_nodes, run.listener);
    return {std::make_unique<const SecondOrderParts>(parts, std::move(numbers), std::move(curved.nodes)),
            curved.report};
}

// Returns the report with the number of nodes of the mesh, and that of each part that was meshed.
RunReport with_node_counts(RunReport report, const SecondOrderParts& parts) {
    report.mesh.nodes = parts.outline().nodes();
    report.mesh.curved_nodes = std::ssize(parts.curved().ids);
    std::vector<NodeId> ids;
    for (const PartReport& part : report.parts) ids.push_back(part.id);
    const PartIndices index(ids);
    for (const PartExtent& extent : parts.outline().parts)
        report.parts[index.of(extent.id).value()].mesh_nodes = extent.vertices + extent.edge_nodes;
    return report;
}

// Writes all formats; only vtu where parts have failed.
std::vector<RunFile> write_formats(const RunContext& run, const RunFolder& folder, const StoredParts& stored,
                                   const SecondOrderParts* of_order_2, const std::vector<PartReport>& reports) {
    const RunChoices& choices = run.plan.choices;
    std::vector<const Format*> formats = choices.formats;
    if (failure_code(reports) != 0) formats = {&find_format("vtu")};
    const bool stores_go =
        stored.outline().is_whole &&
        std::all_of(formats.begin(), formats.end(), [](const Format* f) { return f->asks_for_one_part; });
    const FormatOptions options{.fields = choices.fields,
                                .patch_types = choices.patch_types,
                                .split_regions = choices.request.outputs.split_regions};
    const WriteTarget target{.folder = folder.partial_path(), .options = options};
    in_agreement(run.ranks, [&] {
        if (run.is_root() && of_order_2 && !has_vtu(formats))  // vtu has all nodes
            write_curved_nodes(curved_nodes_file(folder.partial_path()), of_order_2->curved());
    });
    const PartSource& parts = of_order_2 ? static_cast<const PartSource&>(*of_order_2) : stored;
    return write_parts(run.ranks, parts, places_in_run_folder(formats), target, choices.request.workers.count,
                       run.listener, [&](PartIndex part) {
                           if (stores_go) stored.remove(part);
                       });
}

// Writes the parts as files, or gives them to the listener of a transient run.
std::vector<RunFile> pass_on_meshes(const RunContext& run, const RunFolder& folder, const StoredParts& parts,
                                    const SecondOrderParts* of_order_2, const std::vector<PartReport>& reports) {
    if (!run.plan.request().transient) return write_formats(run, folder, parts, of_order_2, reports);
    in_agreement(run.ranks, [&] {
        if (run.listener && parts.outline().is_whole) run.listener->on_meshes(parts, of_order_2);
    });
    return {};
}

}  // namespace

std::optional<Surface> surface_for_reference(const RunContext& run, const Input& input) {
    if (!run.plan.request().outputs.reference || !run.is_root()) return std::nullopt;
    if (input.complex.region_count() > 1)
        throw Error(ErrorCode::usage, fmt::format("--reference meshes the whole in one piece, but {} has {} regions. "
                                                  "Leave it out.",
                                                  input.path, input.complex.region_count()));
    return input.complex.surface_of(RegionIndex(0));
}

RunReport mesh_parts(const RunContext& run, const RunFolder& folder, RunReport report, VolumeStage& volume,
                     std::int64_t surface_vertices, const std::optional<Surface>& whole_surface) {
    StageSeconds& seconds = report.seconds;
    MeshedParts meshed = run.timed(seconds.mesh, [&] { return volume.mesh(report.parts); });
    report.parts = std::move(meshed.parts);
    report.mesh.quality = std::move(meshed.quality);
    report.mesh.improvement = std::move(meshed.improvement);
    const StoredParts stored = number_parts(folder, report, surface_vertices);
    report.mesh.vertices = stored.outline().vertices;
    report.reference = mesh_reference(run, folder, report, whole_surface);
    const NodesOnEdges of_order_2 = run.timed(seconds.curve, [&] { return with_second_order(run, stored); });
    report.curve = of_order_2.curve;
    if (of_order_2.parts) report = with_node_counts(std::move(report), *of_order_2.parts);
    report.folder.files = run.timed(
        seconds.write, [&] { return pass_on_meshes(run, folder, stored, of_order_2.parts.get(), report.parts); });
    return report;
}

}  // namespace kerf

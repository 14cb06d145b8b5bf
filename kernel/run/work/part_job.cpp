// A job goes through stages, whose times are told apart: the surface is filled (or cut in two first, which a mesher
// gets that has not filled it as a whole), the laws of the mesh are verified, sizes and quality are measured, the part
// is hashed, and it is stored. A mesh that breaks a law, or has cells without volume, is an error of the mesher like
// any other, and is never stored. Memory sets the order: neighbours of cells are freed before the laws are verified,
// nothing is kept twice, and the mesh moves into the part only after it is measured.
//
// All errors become part of the result, because the worker's answer is the only way back to the parent; memory that
// runs out has a result of its own.
#include "run/work/part_job.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/core/elements.h"
#include "base/core/error.h"
#include "base/core/ids.h"
#include "base/core/out_of_memory.h"
#include "base/core/record.h"
#include "base/core/stopwatch.h"
#include "cut/cut/bisect.h"
#include "files/io/checked_file.h"
#include "files/io/file_bytes.h"
#include "files/part/vtu_reader.h"
#include "fill/volume/meshers.h"
#include "run/work/mesh_hash.h"
#include "surface/complex/touching.h"

namespace kerf {

namespace {

void measure_cells(const TetMesh& mesh, const PartJob& job, PartResult& result) {
    std::vector<char> is_interface;
    is_interface.reserve(job.surface.facets.size());
    for (const Key key : job.surface.facet_key) is_interface.push_back(is_of_cut(key));
    const BoundaryTriangles boundary = {job.surface.facets, is_interface};
    result.quality = measure_quality(mesh, boundary, job.length_scale);
    const double smallest = result.quality.all.measures[0].min();
    if (smallest < WorstCells::bound_deg) result.worst = find_worst_cells(mesh, boundary, job.surface.patch);
    result.worst.smallest_deg = smallest;
}

std::string broken_laws(const MeshLaws& laws) {
    std::string text = "The mesher returned a mesh that breaks the laws:";
    for (const MeshLaw& law : mesh_laws)
        if (const std::int64_t count = laws.*law.count) text += fmt::format(" {} {};", count, law.broken);
    return text + fmt::format(" volume {:.6g}, {:+.2g} from the surface's, of which rounding explains {:.2g}.",
                              laws.volume, laws.volume - laws.surface_volume, laws.volume_error);
}

std::string without_volume(std::int64_t count) {
    return fmt::format(
        "{} no volume but for rounding: facets or walls of the surface are as thin. Use --surface remesh, or join what "
        "lies so near with kerf repair.",
        count == 1 ? "1 tetrahedron has" : fmt::format("{} tetrahedra have", count));
}

constexpr NodeId cut_node = root_node;

// Returns the surface with its vertices and facets named by their numbers, so that those of the cut are told from them.
SurfaceArrays renamed(SurfaceArrays arrays) {
    for (std::int32_t v = 0; v < count_of(arrays.vertices); ++v) arrays.vertex_key[v] = make_key(input_node, v);
    for (std::int32_t f = 0; f < count_of(arrays.facets); ++f) arrays.facet_key[f] = make_key(input_node, f);
    return arrays;
}

std::array<SurfaceArrays, 2> halves_of(const SurfaceArrays& arrays, const MesherOptions& options) {
    const Surface surface = separated_surface(renamed(arrays));
    const MassProperties mass = mass_properties(surface);
    CutOptions cut;
    cut.size = options.size;
    cut.volume_weight = find_mesher(options.name).forecast.volume_weight;
    cut = cut.of(surface);
    const Bisection bisection = bisect(surface, mass, cut_node, choose_place(surface, mass, 2, cut), cut, false);
    if (!bisection.cut.made())
        throw Error(ErrorCode::subdomain, "The part has no contour of edges that would cut it in two.");
    return {joined_by_key(bisection.halves[0].arrays()), joined_by_key(bisection.halves[1].arrays())};
}

// Fills a surface as mesh_volume(), by a cut of it: both halves are filled, improved and joined at the interface, whose
// vertices become interior ones. The boundary keeps every facet, so the neighbours of the part do not notice. Throws
// Error(subdomain) if the surface has no contour of edges near its middle, or if a half is not filled either.
// Deterministic.
Filling mesh_in_two(const SurfaceArrays& surface, const MesherOptions& options) {
    Filling filling;
    TetMesh& joined = filling.mesh;
    joined.vertices = surface.vertices;
    joined.boundary_vertex_count = count_of(surface.vertices);
    for (const SurfaceArrays& half : halves_of(surface, options)) {
        const Filling of_half = mesh_volume(half, options);
        filling.recovery.add(of_half.recovery);
        filling.improvement.add(of_half.improvement);
        filling.improve_seconds += of_half.improve_seconds;
        const TetMesh& mesh = of_half.mesh;
        if (filling.strategy.find(of_half.strategy) == std::string::npos)
            filling.strategy += (filling.strategy.empty() ? "" : ", ") + of_half.strategy;
        if (filling.reason.empty()) filling.reason = of_half.reason;
        std::vector<std::int32_t> number(mesh.vertices.size());
        const auto place = [&](std::size_t vertex, std::int32_t at) {
            if (at >= count_of(joined.vertices)) joined.vertices.resize(at + 1);
            joined.vertices[at] = mesh.vertices[vertex];
            number[vertex] = at;
        };
        for (std::size_t v = 0; v < half.vertices.size(); ++v) {
            const Key key = half.vertex_key[v];
            place(v, key_index(key) + (key_node(key) == cut_node ? joined.boundary_vertex_count : 0));
        }
        for (std::size_t v = half.vertices.size(); v < mesh.vertices.size(); ++v) place(v, count_of(joined.vertices));
        const std::size_t before = joined.tets.size();
        for (const Tetrahedron& t : mesh.tets)
            joined.tets.push_back({number[t[0]], number[t[1]], number[t[2]], number[t[3]]});
        const auto first = joined.tets.begin() + before;
        std::rotate(joined.tets.begin() + filling.core_tets, first, first + of_half.core_tets);  // the cores come first
        filling.core_tets += of_half.core_tets;
    }
    return filling;
}

}  // namespace

ImprovedAngles::ImprovedAngles(const Improvement& improvement, const PartQuality& after) {
    if (improvement.is_empty() || after.all.measures.empty()) return;
    const Distribution &was = improvement.smallest_before, &is = after.all.measures[0];
    min_before_deg = was.min();
    p1_before_deg = was.percentile(0.01);
    min_after_deg = is.min();
    p1_after_deg = is.percentile(0.01);
}

Part part_of_job(const PartJob& job) {
    TetMesh boundary;
    boundary.vertices = job.surface.vertices;
    boundary.boundary_vertex_count = count_of(boundary.vertices);
    return part_of_job(job, std::move(boundary));
}

Part part_of_job(const PartJob& job, TetMesh mesh) {
    Part part;
    part.id = job.part;
    part.facets = job.surface.facets;
    part.patch = job.surface.patch;
    part.facet.reserve(part.facets.size());
    for (const Key key : job.surface.facet_key) part.facet.push_back(is_of_input(key) ? key_index(key) : -1);
    part.neighbour = job.neighbour;
    part.tet_at_facet = tets_at_facets(mesh, part.facets);
    part.global_id = job.boundary_id;
    part.global_id.resize(mesh.vertices.size(), -1);
    part.patch_names = job.patch_names;
    part.region_names = job.region_names;
    if (!job.region_names.empty()) part.regions = {{0, job.region}};
    part.contact_vertices = job.contact_vertices;
    part.contact_edges = job.contact_edges;
    part.shared = job.shared;
    part.shared_edges = job.shared_edges;
    part.mesh = std::move(mesh);
    return part;
}

void restore_stored_part(const std::string& part_file, const std::string& vtu_file, const PartJob& job) {
    if (!is_complete_part_file(vtu_file)) return;
    Part part;
    try {
        part = read_part(vtu_file);
    } catch (const Error&) {  // the file is damaged
        return;
    }
    if (!are_in_range(part.facets, part.mesh.boundary_vertex_count)) return;
    part.tet_at_facet = tets_at_facets(part.mesh, part.facets);
    part.shared = job.shared;
    part.shared_edges = job.shared_edges;
    write_stored_part(part_file, part);
}

void write_job(const std::string& path, const PartJob& job) {
    const Bytes record = to_record(job);
    CheckedFile file(path, "wb");
    file.write(record.data(), record.size());
    file.close();
}

PartJob read_job(const std::string& path) {
    auto job = from_record<PartJob>(read_file(path));
    if (!job)
        throw Error(ErrorCode::io, fmt::format("{} is damaged. Check the disk; the same command again goes on.", path));
    return *std::move(job);
}

PartResult out_of_memory() {
    PartResult result;
    result.code = static_cast<int>(ErrorCode::memory);
    result.message = "Out of memory in the worker. Use more parts, fewer workers or a larger --memory.";
    return result;
}

PartResult run_part_job(const PartJob& job, const MesherCall& call, const std::string& part_file, bool durable) {
    PartResult result;
    try {
        result.mesher = call.options.name;
        Filling filling = timed(result.mesh_seconds, [&] {
            return call.cut_first ? mesh_in_two(job.surface, call.options) : mesh_volume(job.surface, call.options);
        });
        TetMesh& mesh = filling.mesh;
        result.strategy = filling.strategy;
        result.reason = filling.reason;
        result.recovery = filling.recovery;
        result.improvement = filling.improvement;
        result.improve_seconds = filling.improve_seconds;
        mesh.neighbours = {};  // parts are stored without neighbours
        timed(result.verify_seconds, [&] { result.laws = verify_mesh(mesh, job.surface, FaceProof::sum); });
        if (!result.laws.hold()) throw Error(ErrorCode::subdomain, broken_laws(result.laws));
        if (result.laws.tets_without_volume > 0)
            throw Error(ErrorCode::subdomain, without_volume(result.laws.tets_without_volume));
        result.vertices = std::ssize(mesh.vertices);
        result.interior_vertices = mesh.interior_vertex_count();
        result.tets = std::ssize(mesh.tets);
        result.core_tets = filling.core_tets;
        timed(result.store_seconds, [&] {
            result.sizes = measure_sizes(mesh, job.surface, call.options.size);
            measure_cells(mesh, job, result);
            result.angles = ImprovedAngles(result.improvement, result.quality);
        });
        const Part part = part_of_job(job, std::move(mesh));
        timed(result.verify_seconds, [&] { result.hash = hash_part(part); });
        timed(result.store_seconds, [&] { result.file_hash = write_stored_part(part_file, part, durable); });
    } catch (const Error& e) {
        result.code = static_cast<int>(e.code());
        result.message = e.what();
    } catch (const std::exception& e) {
        if (!is_out_of_memory(e)) throw;
        return out_of_memory();
    }
    return result;
}

}  // namespace kerf

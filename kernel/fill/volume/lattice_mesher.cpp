// The lattice as a row of the table: a core of lattice cells, which is stamped (fill/lattice/lattice_core.h), and a
// shell between it and the surface (fill/shell/shell.h). Where sizes differ, or there is no room, the shell is all.
// Where facets cannot be recovered, TetGen fills the surface, and the filling says so. The core's cells come first in
// the mesh, so that they are counted by one number and stay frozen; the shell alone is improved, before both are
// joined.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "base/geometry/triangle.h"
#include "fill/lattice/lattice_core.h"
#include "fill/shell/shell.h"
#include "fill/volume/meshers.h"
#include "surface/size/mean_edge.h"

namespace kerf {

namespace {

constexpr double lattice_angle_deg = 60;  // the smallest dihedral angle of a cell of the core

MesherOptions for_tetgen(MesherOptions options) {
    options.name = "tetgen";
    return options;
}

void check_lattice_options(const MesherOptions& options) {
    if (!options.tetgen.switches.empty())
        throw Error(ErrorCode::usage,
                    fmt::format("--tetgen-switches is \"{}\", but --mesher lattice has no such switches. Leave "
                                "one of them out.",
                                options.tetgen.switches));
}

// Returns the threshold of improvement. A cell on a facet of area A that is not above the bound V is at most 3V/A high;
// over the radius of the circle in an equilateral facet that is the tangent of its dihedral angle. Where most facets
// are so coarse that the angle must be small, no time is spent on such cells.
double angle_to_improve_deg(const SurfaceArrays& surface, const MesherOptions& options) {
    constexpr double least_deg = 10, share = 0.8, squared_radius_by_area = 0.19245;  // 1 / (3 sqrt 3)
    const double usual_deg = ImproveOptions().threshold_deg;
    if (options.size.is_empty() || !options.size.is_constant()) return usual_deg;
    std::vector<double> areas;
    for (const Triangle& t : surface.facets) areas.push_back(triangle_area(surface.vertices, t));
    const auto median = areas.begin() + areas.size() / 2;
    std::nth_element(areas.begin(), median, areas.end());
    const double height = 3 * options.size.reference_volume() / *median;
    const double possible_deg =
        std::atan(height / std::sqrt(squared_radius_by_area * *median)) * (180 / std::numbers::pi);
    return std::clamp(share * possible_deg, least_deg, usual_deg);
}

// Fills the shell and improves it. That is done before it is joined with the core, whose cells need no improvement.
Filling fill_shell_alone(const SurfaceArrays& surface, ShellCore core, const MesherOptions& options) {
    FilledShell shell = fill_shell(surface, std::move(core), {options.size, options.radius_edge});
    Filling filling{std::move(shell.mesh), "shell alone"};
    filling.recovery = shell.recovery;
    improve_filling(filling, options, angle_to_improve_deg(surface, options));
    return filling;
}

// Joins core and shell: the core's cells come first; vertices are those of the surface, of the core's boundary, others
// of the shell, others of the core.
TetMesh join(const SurfaceArrays& surface, const LatticeCore& core, TetMesh shell) {
    TetMesh mesh;
    mesh.boundary_vertex_count = count_of(surface.vertices);
    mesh.vertices = std::move(shell.vertices);
    const auto first_interior = count_of(mesh.vertices);
    shell.neighbours = {};
    core.append_interior_points(mesh.vertices);
    mesh.tets.reserve(core.cell_count() + shell.tets.size());
    core.append_cells(mesh.boundary_vertex_count, first_interior, mesh.tets);
    mesh.tets.insert(mesh.tets.end(), shell.tets.begin(), shell.tets.end());
    return mesh;
}

Filling fill_around_core(const SurfaceArrays& surface, const MesherOptions& options) {
    const LatticeCore core(surface, lattice_edge_below(options.size.reference_volume()));
    Filling filling =
        fill_shell_alone(surface, {core.boundary_points(), core.boundary_faces(), core.free_points()}, options);
    if (core.cell_count() == 0) return filling;
    filling.mesh = join(surface, core, std::move(filling.mesh));
    filling.strategy = "core and shell";
    filling.core_tets = core.cell_count();
    if (!filling.improvement.is_empty()) filling.improvement.smallest_before.add(lattice_angle_deg, core.cell_count());
    return filling;
}

Filling fill_with_lattice(const SurfaceArrays& surface, const MesherOptions& options) {
    const bool has_one_size = options.size.is_constant() && !options.size.is_empty();
    try {
        return has_one_size ? fill_around_core(surface, options) : fill_shell_alone(surface, {}, options);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::subdomain) throw;
        Filling filling = find_mesher("tetgen").fill(surface, for_tetgen(options));
        filling.strategy = way_by_tetgen;
        filling.reason = error.what();
        return filling;
    }
}

// Returns the calls of this mesher: as asked for, then those of TetGen but the one that asks the lattice.
std::vector<MesherCall> lattice_calls(const MesherOptions& wanted) {
    std::vector<MesherCall> calls = {{.fallback = "", .options = wanted}};
    for (MesherCall& call : find_mesher("tetgen").calls(for_tetgen(wanted))) {
        if (call.options.name == wanted.name) continue;
        call.fallback = call.fallback.empty() ? "TetGen" : "TetGen, " + call.fallback;
        calls.push_back(std::move(call));
    }
    return calls;
}

Reproducer lattice_reproducer(const SurfaceArrays& surface, const MesherOptions& options, const std::string& stem) {
    std::string command =
        fmt::format("kerf mesh {}.smesh -n 1 --mesher {} --radius-edge {:g}", stem, options.name, options.radius_edge);
    if (options.size.is_constant() && !options.size.is_empty())
        command += fmt::format(" --max-volume {:.17g}", options.size.reference_volume());
    return smesh_reproducer(surface, options, std::move(command));
}

}  // namespace

extern const Mesher lattice_mesher = {.name = "lattice",
                                      .forecast = lattice_forecast,
                                      .check = check_lattice_options,
                                      .fill = fill_with_lattice,
                                      .calls = lattice_calls,
                                      .reproducer = lattice_reproducer};

}  // namespace kerf

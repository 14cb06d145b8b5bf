// All points are triangulated at once; facets of surface and core that are missing are recovered; what lies between
// them is refined and cut out.
#include "shell/shell.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"
#include "delaunay/delaunay.h"
#include "delaunay/faces.h"
#include "shell/face_recovery.h"
#include "shell/vertex_merging.h"

namespace kerf {

namespace {

constexpr std::uint8_t shell_region = 1;

std::vector<Vec3> all_points(const SurfaceArrays& surface, const ShellCore& core) {
    std::vector<Vec3> points = surface.vertices;
    points.reserve(points.size() + core.points.size() + core.free_points.size());
    points.insert(points.end(), core.points.begin(), core.points.end());
    points.insert(points.end(), core.free_points.begin(), core.free_points.end());
    return points;
}

std::vector<Triangle> all_triangles(const SurfaceArrays& surface, const ShellCore& core) {
    std::vector<Triangle> triangles = surface.facets;
    triangles.reserve(triangles.size() + core.faces.size());
    const auto first = static_cast<std::int32_t>(surface.vertices.size());
    for (const auto& [a, b, c] : core.faces) triangles.push_back({first + a, first + c, first + b});
    return triangles;
}

Triangulation triangulate(std::vector<Vec3> points) {
    Delaunay result = delaunay(std::move(points));
    if (result.triangulation.cell_count() == 0)
        throw Error(ErrorCode::subdomain, "All vertices of the surface lie in one plane.");
    for (std::size_t v = 0; v < result.representative.size(); ++v)
        if (result.representative[v] != static_cast<std::int32_t>(v))
            throw Error(ErrorCode::subdomain, fmt::format("Vertices {} and {} of the surface lie at the same place.",
                                                          result.representative[v], v));
    return std::move(result.triangulation);
}

void mark_shell(Triangulation& triangulation, const std::vector<CellFace>& faces) {
    const auto behind = cells_behind(triangulation, faces);
    if (!behind) throw Error(ErrorCode::subdomain, "The facets do not enclose a body.");
    for (std::int32_t cell = 0; cell < triangulation.cell_count(); ++cell)
        if ((*behind)[cell]) triangulation.set_region(cell, shell_region);
}

// Recovery may have added some outside of the shell, and merging has taken some away.
void drop_unused_vertices(TetMesh& mesh) {
    std::vector<std::int32_t> number(mesh.vertices.size(), -1);
    for (const Tetrahedron& tet : mesh.tets)
        for (const std::int32_t v : tet) number[v] = 0;
    std::int32_t count = 0;
    for (std::size_t v = 0; v < number.size(); ++v) {
        if (static_cast<std::int32_t>(v) >= mesh.boundary_vertex_count && number[v] < 0) continue;
        mesh.vertices[count] = mesh.vertices[v];
        number[v] = count++;
    }
    mesh.vertices.resize(count);
    for (Tetrahedron& tet : mesh.tets)
        for (std::int32_t& v : tet) v = number[v];
}

}  // namespace

FilledShell fill_shell(const SurfaceArrays& surface, ShellCore core, const RefinementBounds& bounds) {
    FilledShell shell;
    const std::size_t boundary_vertices = surface.vertices.size() + core.points.size();
    const std::vector<Triangle> triangles = all_triangles(surface, core);
    Triangulation triangulation = triangulate(all_points(surface, core));
    core = {};
    const RecoveredFaces found = recover_faces(triangulation, triangles);
    if (found.lost > 0)
        throw Error(ErrorCode::subdomain,
                    fmt::format("{} of {} facets cannot be recovered.", found.lost, triangles.size()));
    shell.recovery.missing = found.missing;
    shell.recovery.by_flips = found.missing - found.lost;
    mark_shell(triangulation, found.faces);
    shell.refining_points = refine(triangulation, shell_region, bounds);
    if (!bounds.size.is_constant()) merge_close_vertices(triangulation, shell_region, bounds.size);
    shell.mesh = triangulation.take_mesh(shell_region, true);
    shell.mesh.boundary_vertex_count = static_cast<std::int32_t>(boundary_vertices);
    drop_unused_vertices(shell.mesh);
    return shell;
}

}  // namespace kerf

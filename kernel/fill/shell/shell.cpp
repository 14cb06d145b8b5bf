// All points of surface and core are triangulated at once, together with free points of the core's lattice, so that
// nearly all facets are faces. Facets that are missing are recovered; vertices that this took are merged away or moved,
// and flips make the cells Delaunay again as far as they can. Only then the space is refined, and where sizes differ,
// points that came too close are merged. The faces of the core are turned round, so that they and the facets enclose
// the shell alone; everything else, ghosts included, is cut out before points are added.
#include "fill/shell/shell.h"

#include <fmt/format.h>

#include "base/core/error.h"
#include "fill/delaunay/delaunay.h"
#include "fill/delaunay/delaunay_flips.h"
#include "fill/delaunay/enclosing_faces.h"
#include "fill/shell/inside/face_recovery.h"
#include "fill/shell/inside/steiner_points.h"
#include "fill/shell/inside/vertex_merging.h"

namespace kerf {

namespace {

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

SpatialTriangulation triangulate(std::vector<Vec3> points) {
    Delaunay result = delaunay(std::move(points));
    if (result.triangulation.cell_count() == 0)
        throw Error(ErrorCode::subdomain, "All vertices of the surface lie in one plane.");
    for (std::size_t v = 0; v < result.representative.size(); ++v)
        if (result.representative[v] != static_cast<std::int32_t>(v))
            throw Error(ErrorCode::subdomain, fmt::format("Vertices {} and {} of the surface lie at the same place.",
                                                          result.representative[v], v));
    return std::move(result.triangulation);
}

// Removes all cells but those between surface and core, and adds the caps.
void cut_out(SpatialTriangulation& triangulation, const RecoveredFaces& boundary) {
    const auto behind = cells_behind(triangulation, boundary.faces);
    if (!behind) throw Error(ErrorCode::subdomain, "The facets do not enclose a body.");
    triangulation.keep_cells(*behind);
    if (!boundary.caps.empty()) triangulation.add_cells(boundary.caps);
}

// Recovers all triangles. Throws where the surface meets itself, or so nearly that no double lies between.
RecoveredFaces recover(SpatialTriangulation& triangulation, const std::vector<Triangle>& triangles) {
    RecoveredFaces found = recover_faces(triangulation, triangles);
    if (!found.lost.empty())
        throw Error(ErrorCode::subdomain,
                    fmt::format("{} of {} facets cannot be recovered.", found.lost.size(), triangles.size()));
    return found;
}

// Drops vertices that merging has left without cells.
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
    const auto boundary_vertices = static_cast<std::int32_t>(surface.vertices.size() + core.points.size());
    const std::vector<Triangle> triangles = all_triangles(surface, core);
    SpatialTriangulation triangulation = triangulate(all_points(surface, core));
    core = {};
    const auto given_vertices = static_cast<std::int32_t>(triangulation.points().size());
    const RecoveredFaces found = recover(triangulation, triangles);
    cut_out(triangulation, found);
    shell.recovery = {found.missing, found.missing - found.split, found.split, 0};
    if (found.missing > 0) {
        shell.recovery.added_vertices = settle_steiner_points(triangulation, given_vertices);
        flip_to_delaunay(triangulation);
    }
    shell.refining_points = refine(triangulation, bounds);
    if (!bounds.size.is_constant()) merge_close_vertices(triangulation, boundary_vertices, bounds.size);
    shell.mesh = triangulation.take_mesh(true);
    shell.mesh.boundary_vertex_count = boundary_vertices;
    drop_unused_vertices(shell.mesh);
    return shell;
}

}  // namespace kerf

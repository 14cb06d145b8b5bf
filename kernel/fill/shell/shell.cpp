// All points of surface and core are triangulated at once, together with free points of the core's lattice, so that
// nearly all facets are faces. Facets that are missing are recovered; vertices that this took are merged away or moved,
// and flips make the cells Delaunay again as far as they can. Only then the space is refined, and where sizes differ,
// points that came too close are merged. The faces of the core are turned round, so that they and the facets enclose
// the shell alone; everything else, ghosts included, is cut out before points are added.
#include "fill/shell/shell.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "fill/delaunay/delaunay.h"
#include "fill/delaunay/delaunay_flips.h"
#include "fill/delaunay/enclosing_faces.h"
#include "fill/improve/cell_shape.h"
#include "fill/shell/inside/face_recovery.h"
#include "fill/shell/inside/vertex_star.h"

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
    const auto first = count_of(surface.vertices);
    for (const auto& [a, b, c] : core.faces) triangles.push_back({first + a, first + c, first + b});
    return triangles;
}

SpatialTriangulation triangulate(std::vector<Vec3> points) {
    Delaunay result = delaunay(std::move(points));
    if (result.triangulation.cell_count() == 0)
        throw Error(ErrorCode::subdomain, "All vertices of the surface lie in one plane.");
    for (std::int32_t v = 0; v < count_of(result.representative); ++v)
        if (result.representative[v] != v)
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

// --- vertices that recovery has added ---

constexpr int most_visits = 3;
constexpr double least_step = 1e-3;     // share of the way to the middle of the neighbours
constexpr double good_enough_deg = 10;  // cells this good may always replace a vertex

struct Place {
    Vec3 at;
    double badness;
};

// Returns the place towards the middle of a vertex's neighbours that makes the worst of its cells best.
Place best_place(const VertexStar& star, const std::vector<Vec3>& points) {
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t u : star.neighbours()) middle += points[u];
    middle /= star.neighbours().size();
    const Vec3& from = star.at();
    const Vec3 way = middle - from;
    Place best{from, star.badness_at(from)};
    for (double step = 1; step > least_step; step /= 2) {
        const Vec3 p = from + step * way;
        const double badness = star.badness_at(p);
        if (badness < best.badness) best = {p, badness};
    }
    return best;
}

// Merges or moves a vertex; true if it is gone.
bool settle(EditableTets& tets, std::int32_t v) {
    VertexStar star(tets, v);
    const Place place = best_place(star, tets.points());
    const auto merged = star.best_merged(std::max(place.badness, square_from_degrees(good_enough_deg)));
    if (merged.cells.empty())
        star.move_to(place.at);
    else
        star.replace_by(merged);
    return !merged.cells.empty();
}

// Merges each vertex from number `first` on with a neighbour where that leaves positive cells that are better than the
// worst at it, and otherwise moves it to where the worst of its cells is best. None of them may lie on the boundary.
// Returns how many are left. Deterministic. Linear.
std::int64_t settle_steiner_points(EditableTets& tets, std::int32_t first) {
    std::vector<std::int32_t> left(tets.points().size() - first);
    std::iota(left.begin(), left.end(), first);
    std::erase_if(left, [&](std::int32_t v) { return !tets.cell_at(v).is_valid(); });
    for (int visit = 0; visit < most_visits; ++visit)
        std::erase_if(left, [&](std::int32_t v) { return settle(tets, v); });
    return std::ssize(left);
}

// --- points where cells are smaller than wanted ---

constexpr double least_merged_angle_deg = 12;
constexpr double least_kept_edge_share = 0.7;  // share of the wanted length

void merge_if_close(EditableTets& tets, std::int32_t v, const SizeField& size) {
    VertexStar star(tets, v);
    const double kept = least_kept_edge_share * size.at(star.at());
    if (star.shortest_edge_sq() >= kept * kept) return;
    const double worst = std::max(square_from_degrees(least_merged_angle_deg), star.badness_at(star.at()));
    const auto merged =
        star.best_merged(worst, [&](const std::array<Vec3, 4>& corners) { return !is_too_large(size, corners); });
    if (!merged.cells.empty()) star.replace_by(merged);
}

// Merges vertices from number `first` on, none of which lies on the boundary, with a neighbour if an edge of theirs is
// shorter than 0.7 times the wanted length, and no new cell is too large (is_too_large()), or is worse than both the
// worst of those that are replaced and a cell of 12 degrees. Refinement of slender cells brings such vertices. Those
// that are merged are left without cells. Deterministic.
void merge_close_vertices(EditableTets& tets, std::int32_t first, const SizeField& size) {
    for (std::int32_t v = first; v < count_of(tets.points()); ++v)
        if (tets.cell_at(v).is_valid()) merge_if_close(tets, v, size);
}

// --- the whole ---

// Drops vertices that merging has left without cells.
void drop_unused_vertices(TetMesh& mesh) {
    std::vector<std::int32_t> number(mesh.vertices.size(), -1);
    for (const Tetrahedron& tet : mesh.tets)
        for (const std::int32_t v : tet) number[v] = 0;
    std::int32_t count = 0;
    for (std::int32_t v = 0; v < count_of(number); ++v) {
        if (v >= mesh.boundary_vertex_count && number[v] < 0) continue;
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
    const std::int32_t boundary_vertices = surface.vertices.size() + core.points.size();
    const std::vector<Triangle> triangles = all_triangles(surface, core);
    SpatialTriangulation triangulation = triangulate(all_points(surface, core));
    core = {};
    const auto given_vertices = count_of(triangulation.points());
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

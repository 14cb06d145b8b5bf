// CGAL's repairs of polygon meshes, one after another as its manual has them, for the benchmark of repairs.
// tests/bench/repair.py runs it.
//
//     repair_cgal_bench INPUT RESULT.obj
//
// Figures are one line of JSON. Seconds are those of the processor, without the system's, from facets in memory to
// facets in memory.
#include <iterator>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/format.h>

#include "bench/bench.h"
#include "files/io/obj_writer.h"
#include "files/io/surface_reader.h"

namespace kerf {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace processing = CGAL::Polygon_mesh_processing;

void fill_holes(Mesh& mesh) {
    std::vector<Mesh::Halfedge_index> holes;
    processing::extract_boundary_cycles(mesh, std::back_inserter(holes));
    for (const Mesh::Halfedge_index hole : holes) {
        std::vector<Mesh::Face_index> added;
        processing::triangulate_hole(mesh, hole, std::back_inserter(added));
    }
}

Mesh repaired(std::vector<Kernel::Point_3> points, std::vector<std::vector<std::size_t>> facets) {
    processing::repair_polygon_soup(points, facets);
    processing::orient_polygon_soup(points, facets);  // makes it a manifold, by copies of vertices
    Mesh mesh;
    processing::polygon_soup_to_polygon_mesh(points, facets, mesh);
    processing::stitch_borders(mesh);
    processing::duplicate_non_manifold_vertices(mesh);
    processing::remove_degenerate_faces(mesh);
    processing::experimental::remove_self_intersections(mesh);
    fill_holes(mesh);
    processing::experimental::remove_self_intersections(mesh);
    if (CGAL::is_closed(mesh)) processing::orient_to_bound_a_volume(mesh);
    mesh.collect_garbage();
    return mesh;
}

int run(const std::vector<std::string>& words) {
    if (words.size() != 2) return 2;
    const Soup soup = read_surface(words[0]);
    std::vector<Kernel::Point_3> points;
    std::vector<std::vector<std::size_t>> facets;
    for (const Vec3& p : soup.vertices) points.emplace_back(p.x(), p.y(), p.z());
    for (const Triangle& t : soup.facets) facets.emplace_back(t.begin(), t.end());
    bench::forget_process_memory();
    const double start = bench::user_seconds();
    const Mesh mesh = repaired(std::move(points), std::move(facets));
    const double seconds = bench::user_seconds() - start;
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    for (const Mesh::Vertex_index v : mesh.vertices()) {
        const Kernel::Point_3& p = mesh.point(v);
        vertices.emplace_back(p.x(), p.y(), p.z());
    }
    for (const Mesh::Face_index f : mesh.faces()) {
        Triangle t;
        std::size_t corner = 0;
        for (const Mesh::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(f)))
            if (corner < 3) t[corner++] = static_cast<std::int32_t>(v);
        triangles.push_back(t);
    }
    write_obj(words[1], vertices, triangles, std::vector<std::int32_t>(triangles.size(), 0), {"surface"});
    fmt::print("{{\"seconds\": {}, \"peak_bytes\": {}}}\n", seconds, bench::memory_bytes("VmHWM"));
    return 0;
}

}  // namespace

}  // namespace kerf

int main(int argc, char** argv) { return kerf::bench::run_by_words(argc, argv, kerf::run); }

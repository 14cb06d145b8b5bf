// What the benchmark of the remesher needs beside kerf: CGAL's isotropic remeshing as a program, files that every
// remesher reads, and one measure for all results. tests/bench/remesh.py runs it.
//
//     remesh_bench prepare INPUT OUT.stl           what all of them are given; prints figures of it
//     remesh_bench cgal INPUT.stl OUT.off SIZE     by CGAL, features protected
//     remesh_bench measure INPUT.stl RESULT        prints figures of a result
//
// Figures are one line of JSON.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/format.h>
#include <Eigen/Geometry>

#include "bench/bench.h"
#include "files/io/stl_writer.h"
#include "run/prepare/input.h"
#include "support/write_off.h"
#include "surface/remesh/remesh.h"
#include "surface/soup/triangle_tree.h"

namespace kerf {

namespace {

constexpr double feature_angle_deg = 30;  // kerf's own
constexpr int cgal_iterations = 5;        // more change angles by less than a degree

double diagonal_of(const std::vector<Vec3>& vertices) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : vertices) box.extend(p);
    return box.diagonal().norm();
}

void prepare(const std::string& input_path, const std::string& output) {
    const SurfaceArrays surface = read_input(input_path).complex.arrays();
    write_stl(output, surface.vertices, surface.facets);
    fmt::print(R"({{"facets": {}, "diagonal": {}}})"
               "\n",
               surface.facets.size(), diagonal_of(surface.vertices));
}

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using CgalVertex = CgalMesh::Vertex_index;

CgalMesh to_cgal(const SurfaceArrays& surface) {
    CgalMesh mesh;
    for (const Vec3& p : surface.vertices) mesh.add_vertex({p.x(), p.y(), p.z()});
    const auto vertex = [](std::int32_t v) { return CgalVertex(static_cast<CgalMesh::size_type>(v)); };
    for (const Triangle& t : surface.facets) mesh.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2]));
    return mesh;
}

// As CGAL's manual does it: edges that are protected must not be longer than 4/3 of the size, so these are split first.
void remesh_by_cgal(const std::string& input_path, const std::string& output, double size) {
    namespace processing = CGAL::Polygon_mesh_processing;
    namespace named = CGAL::parameters;
    CgalMesh mesh = to_cgal(read_input(input_path).complex.arrays());
    const auto is_feature = mesh.add_property_map<CgalMesh::Edge_index, bool>("e:is_feature", false).first;
    processing::detect_sharp_edges(mesh, feature_angle_deg, is_feature);
    std::vector<CgalMesh::Edge_index> features;
    for (const auto e : mesh.edges())
        if (is_feature[e]) features.push_back(e);
    processing::split_long_edges(features, size, mesh, named::edge_is_constrained_map(is_feature));
    processing::isotropic_remeshing(
        mesh.faces(), size, mesh,
        named::number_of_iterations(cgal_iterations).protect_constraints(true).edge_is_constrained_map(is_feature));
    mesh.collect_garbage();
    std::vector<Vec3> vertices;
    for (const auto v : mesh.vertices()) vertices.emplace_back(mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z());
    std::vector<Triangle> facets;
    for (const auto f : mesh.faces()) {
        Triangle& t = facets.emplace_back();
        std::size_t corner = 0;
        for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) t[corner++] = static_cast<std::int32_t>(v);
    }
    test::write_off(output, vertices, facets);
}

// The largest distance of points of one surface from another: of a grid on each facet, at most `spacing` apart along
// its edges, within limits.
double distance_between(const Soup& from, const TriangleTree& to, double spacing) {
    double largest = 0;
    const auto is_there = [](std::int32_t, double) { return true; };
    for (const Triangle& t : from.facets) {
        const Vec3 &a = from.vertices[t[0]], &b = from.vertices[t[1]], &c = from.vertices[t[2]];
        const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
        const int n = static_cast<int>(std::clamp(std::ceil(longest / spacing), 6.0, 40.0));
        for (int i = 0; i <= n; ++i)
            for (int j = 0; i + j <= n; ++j) {
                const Vec3 p = (i * a + j * b + (n - i - j) * c) / n;
                if (!to.any_within(p, largest, is_there)) largest = std::sqrt(to.closest(p).squared_distance);
            }
    }
    return largest;
}

std::vector<double> sorted_angles(const Soup& soup) {
    std::vector<double> angles;
    for (const Triangle& t : soup.facets) {
        const double sine = smallest_sine(soup.vertices[t[0]], soup.vertices[t[1]], soup.vertices[t[2]]);
        angles.push_back(std::asin(std::min(1.0, sine)) * 180 / std::numbers::pi);
    }
    std::sort(angles.begin(), angles.end());
    return angles;
}

void measure(const std::string& input_path, const std::string& result_path) {
    const Soup input = check_input(input_path).soup;
    const CheckedSoup result = check_input(result_path);
    const std::vector<double> angles = sorted_angles(result.soup);
    const auto below_5 = std::lower_bound(angles.begin(), angles.end(), 5.0) - angles.begin();
    const auto count = [&](DefectKind kind) { return result.diagnosis.count(kind); };
    const bool is_closed = count(DefectKind::open_edge) + count(DefectKind::non_manifold_edge) +
                               count(DefectKind::non_manifold_vertex) + count(DefectKind::one_sided) ==
                           0;
    const double diagonal = diagonal_of(input.vertices), spacing = 0.002 * diagonal;
    const double to_input = distance_between(result.soup, TriangleTree(input.vertices, input.facets), spacing);
    const double from_input = distance_between(input, TriangleTree(result.soup.vertices, result.soup.facets), spacing);
    fmt::print(R"({{"facets": {}, "smallest_angle": {}, "angle_1_percent": {}, "median_angle": {}, )"
               R"("share_below_5": {}, "to_input": {}, "from_input": {}, "closed": {}, "self_intersections": {}}})"
               "\n",
               angles.size(), angles.front(), angles[angles.size() / 100], angles[angles.size() / 2],
               static_cast<double>(below_5) / static_cast<double>(angles.size()), to_input / diagonal,
               from_input / diagonal, is_closed, count(DefectKind::self_intersection));
}

int run(const std::vector<std::string>& words) {
    if (words.size() == 3 && words[0] == "prepare")
        prepare(words[1], words[2]);
    else if (words.size() == 4 && words[0] == "cgal")
        remesh_by_cgal(words[1], words[2], std::stod(words[3]));
    else if (words.size() == 3 && words[0] == "measure")
        measure(words[1], words[2]);
    else
        return 2;
    return 0;
}

}  // namespace

}  // namespace kerf

int main(int argc, char** argv) { return kerf::bench::run_by_words(argc, argv, kerf::run); }

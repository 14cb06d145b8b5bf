// CGAL's mesher of complexes for the benchmark of several regions. tests/bench/regions.py runs it.
//
//     regions_cgal_bench SURFACE.smesh SIZE RESULT.mesh    SIZE: the largest radius of balls around cells and facets
//
// Figures are one line of JSON. Seconds are those of the processor, without the system's, from facets in memory to
// cells in memory.
#include <fstream>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polyhedral_complex_mesh_domain_3.h>
#include <CGAL/make_mesh_3.h>
#include <fmt/format.h>

#include "bench/bench.h"
#include "run/prepare/input.h"

namespace kerf {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Polyhedron = CGAL::Mesh_polyhedron_3<Kernel>::type;
using Domain = CGAL::Polyhedral_complex_mesh_domain_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Cells = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, Domain::Corner_index, Domain::Curve_index>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

// Bounds as in CGAL's manual, and facets within a tenth of the size.
constexpr double feature_angle_deg = 60, facet_angle_deg = 25, radius_edge = 2, distance_by_size = 0.1;

// The facets of a pair of regions, of which CGAL takes the one behind them first, whatever its manual says. It counts
// regions from 1, and 0 is outside.
struct Sheet {
    std::vector<Kernel::Point_3> points;
    std::vector<std::vector<std::size_t>> facets;
    std::map<std::int32_t, std::size_t> number;
};

std::map<std::pair<int, int>, Sheet> sheets_of(const Complex& complex) {
    std::map<std::pair<int, int>, Sheet> sheets;
    for (std::int32_t f = 0; f < complex.facet_count(); ++f) {
        const FacetSides sides = complex.sides(f);
        Sheet& sheet = sheets[{sides.back.value() + 1, sides.front.value() + 1}];
        std::vector<std::size_t>& facet = sheet.facets.emplace_back();
        for (const std::int32_t v : complex.vertices(f)) {
            const auto [found, is_new] = sheet.number.try_emplace(v, sheet.points.size());
            const Vec3& p = complex.point(v);
            if (is_new) sheet.points.emplace_back(p.x(), p.y(), p.z());
            facet.push_back(found->second);
        }
    }
    return sheets;
}

Cells fill(const Complex& complex, double size) {
    namespace processing = CGAL::Polygon_mesh_processing;
    namespace named = CGAL::parameters;
    std::vector<Polyhedron> surfaces;
    std::vector<std::pair<int, int>> sides;
    for (auto& [pair, sheet] : sheets_of(complex)) {
        processing::orient_polygon_soup(sheet.points, sheet.facets);  // makes it a manifold: all are oriented already
        processing::polygon_soup_to_polygon_mesh(sheet.points, sheet.facets, surfaces.emplace_back());
        sides.push_back(pair);
    }
    Domain domain(surfaces.begin(), surfaces.end(), sides.begin(), sides.end());
    domain.detect_features(feature_angle_deg);
    const Criteria criteria(named::edge_size = size, named::facet_angle = facet_angle_deg, named::facet_size = size,
                            named::facet_distance = distance_by_size * size,
                            named::cell_radius_edge_ratio = radius_edge, named::cell_size = size);
    return CGAL::make_mesh_3<Cells>(domain, criteria);
}

int run(const std::vector<std::string>& words) {
    if (words.size() != 3) return 2;
    const Complex complex = read_input(words[0]).complex;
    bench::forget_process_memory();
    const double start = bench::user_seconds();
    const Cells cells = fill(complex, std::stod(words[1]));
    const double seconds = bench::user_seconds() - start;
    fmt::print("{{\"seconds\": {}, \"peak_bytes\": {}}}\n", seconds, bench::memory_bytes("VmHWM"));
    std::ofstream file(words[2]);
    file.precision(std::numeric_limits<double>::max_digits10);
    cells.output_to_medit(file);
    return 0;
}

}  // namespace

}  // namespace kerf

int main(int argc, char** argv) { return kerf::bench::run_by_words(argc, argv, kerf::run); }

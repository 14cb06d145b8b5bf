// What the benchmark of several regions needs: the same facets for all meshers, TetGen on them, and one measure for all
// results. tests/bench/regions.py runs it.
//
//     regions_bench prepare STEM BODY FINENESS|FILE...    writes STEM.smesh, facets, holes and a point of each region;
//     and
//                                                STEM.msh, a surface for each pair of regions, for gmsh
//     regions_bench tetgen STEM.smesh BOUND RESULT.mesh     BOUND: largest volume, 0 for none
//     regions_bench measure STEM.smesh MESH      of a file of any program, whose names of regions end with a number
//
// Bodies: ball, rings, fibres, layers, grains. Figures are one line of JSON. Seconds are those of the processor,
// without the system's.
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#define TETLIBRARY
#include <tetgen.h>

#include "base/geometry/box.h"
#include "bench/bench.h"
#include "files/io/surface_reader.h"
#include "files/io/tet_mesh_reader.h"
#include "fill/volume/mesher.h"
#include "run/prepare/input.h"
#include "support/region_bodies.h"
#include "support/shapes.h"
#include "support/voxel_regions.h"
#include "surface/complex/mass_properties.h"

namespace kerf {

namespace {

// The number that the name of a region ends with.
int number_in(const std::string& name) { return std::stoi(name.substr(name.find_last_not_of("0123456789") + 1)); }

Soup soup_of(const test::VoxelBody& body) {
    Soup soup{body.facets.vertices, body.facets.facets, body.facets.patch, {"outside", "walls"}};
    soup.sides = body.sides;
    soup.region_names = body.names;
    return soup;
}

// A body and its fineness, or files.
Complex complex_of(const std::vector<std::string>& words) {
    const std::string& name = words[0];
    const int n = words.size() == 2 ? std::atoi(words[1].c_str()) : 0;
    if (n > 0 && name == "ball") return make_complex(test::ball_in_cube(n));
    if (n > 0 && name == "rings") return make_complex(test::linked_rings_in_box(n));
    if (n > 0 && name == "fibres") return make_complex(test::fibres_in_block(n));
    if (n > 0 && name == "layers")  // so thick as n cubes
        return make_complex(soup_of(
            test::voxel_body({10 * n, 10 * n, 20 * n}, [n](std::array<std::int32_t, 3> c) { return c[2] / n; })));
    if (n > 0 && name == "grains")  // in n^3 cubes
        return make_complex(soup_of(test::voxel_body({n, n, n}, test::grains({n, n, n}, 50, 1))));
    InputOptions options;
    options.more_files.assign(words.begin() + 1, words.end());
    return read_input(name, options).complex;
}

// The facets that `take` turns outwards, 1, or inwards, -1; 0: left out.
template <class Take>
Soup facets_of(const Complex& complex, const Take& take) {
    const SurfaceArrays arrays = complex.arrays();
    Soup soup{arrays.vertices, {}, {}, {"facets"}};
    for (std::int32_t f = 0; f < complex.facet_count(); ++f) {
        const int turn = take(complex.sides(f));
        if (turn == 0) continue;
        const auto [a, b, c] = arrays.facets[static_cast<std::size_t>(f)];
        soup.facets.push_back(turn > 0 ? Triangle{a, b, c} : Triangle{a, c, b});
    }
    soup.patch.assign(soup.facets.size(), 0);
    drop_unused_vertices(soup);
    return soup;
}

// One in every piece of the region: in the voids of a box that is full around the region.
std::vector<Vec3> points_in_region(const Complex& complex, RegionIndex region) {
    const Soup turned = facets_of(complex, [&](FacetSides sides) {
        return sides.back == region ? -1 : sides.front == region ? 1 : 0;
    });
    const Box box = box_around(turned.vertices);
    const Soup around = test::box(box.min() - box.sizes(), box.max() + box.sizes());
    return hole_points(test::to_arrays(test::join(around, turned)));
}

std::vector<Vec3> points_in_voids(const Complex& complex) {
    return hole_points(test::to_arrays(facets_of(complex, [](FacetSides sides) {
        return sides.is_wall() ? 0 : sides.back.is_valid() ? 1 : -1;
    })));
}

std::string row(const Vec3& p) { return fmt::format("{:.17g} {:.17g} {:.17g}", p.x(), p.y(), p.z()); }

// Points of a region have its number, from 1.
void write_smesh(const std::string& path, const Complex& complex) {
    std::ofstream file(path);
    file << fmt::format("{} 3 0 0\n", complex.vertex_count());
    for (std::int32_t v = 0; v < complex.vertex_count(); ++v) file << fmt::format("{} {}\n", v, row(complex.point(v)));
    file << fmt::format("{} 0\n", complex.facet_count());
    for (std::int32_t f = 0; f < complex.facet_count(); ++f)
        file << fmt::format("3 {}\n", fmt::join(complex.vertices(f), " "));
    const std::vector<Vec3> voids = points_in_voids(complex);
    file << fmt::format("{}\n", voids.size());
    for (std::size_t i = 0; i < voids.size(); ++i) file << fmt::format("{} {}\n", i, row(voids[i]));
    std::vector<std::string> rows;
    for (const RegionIndex region : ids<RegionIndex>(complex.region_count()))
        for (const Vec3& p : points_in_region(complex, region))
            rows.push_back(fmt::format("{} {} {} 0\n", rows.size(), row(p), region.value() + 1));
    file << fmt::format("{}\n{}", rows.size(), fmt::join(rows, ""));
}

// Returns which surfaces bound each region, as gmsh's script has them: "1, 3".
std::vector<std::string> write_msh(const std::string& path, const Complex& complex) {
    std::ofstream file(path);
    file << fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", complex.vertex_count());
    for (std::int32_t v = 0; v < complex.vertex_count(); ++v)
        file << fmt::format("{} {}\n", v + 1, row(complex.point(v)));
    file << fmt::format("$EndNodes\n$Elements\n{}\n", complex.facet_count());
    std::map<std::pair<RegionIndex, RegionIndex>, std::size_t> number;
    Array<RegionIndex, std::string> surfaces(static_cast<std::size_t>(complex.region_count()));
    for (std::int32_t f = 0; f < complex.facet_count(); ++f) {
        const FacetSides sides = complex.sides(f);
        const auto [pair, is_new] = number.try_emplace({sides.front, sides.back}, number.size() + 1);
        for (const RegionIndex region : {sides.front, sides.back})
            if (is_new && region.is_valid()) {
                std::string& list = surfaces[region];
                list += fmt::format("{}{}", list.empty() ? "" : ", ", pair->second);
            }
        const auto [a, b, c] = complex.vertices(f);
        file << fmt::format("{} 2 2 0 {} {} {} {}\n", f + 1, pair->second, a + 1, b + 1, c + 1);
    }
    file << "$EndElements\n";
    return surfaces;
}

void prepare(const std::string& stem, const std::vector<std::string>& words) {
    const Complex complex = complex_of(words);
    write_smesh(stem + ".smesh", complex);
    const std::vector<std::string> surfaces = write_msh(stem + ".msh", complex);
    fmt::print("{{\"facets\": {}, \"regions\": {}, \"surfaces\": [\"{}\"]}}\n", complex.facet_count(),
               complex.region_count(), fmt::join(surfaces, "\", \""));
}

// What TetGen will delete.
double* list_of(const std::vector<Vec3>& points) {
    auto* const list = new double[3 * points.size()];
    for (std::size_t i = 0; i < points.size(); ++i) std::copy_n(points[i].data(), 3, list + 3 * i);
    return list;
}

void give(tetgenio& in, const Soup& soup) {
    in.numberofpoints = static_cast<int>(soup.vertices.size());
    in.pointlist = list_of(soup.vertices);
    in.numberoffacets = static_cast<int>(soup.facets.size());
    in.facetlist = new tetgenio::facet[soup.facets.size()];
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        tetgenio::facet& facet = in.facetlist[f];
        tetgenio::init(&facet);
        facet.numberofpolygons = 1;
        facet.polygonlist = new tetgenio::polygon[1];
        tetgenio::init(&facet.polygonlist[0]);
        facet.polygonlist[0].numberofvertices = 3;
        const auto& [a, b, c] = soup.facets[f];
        facet.polygonlist[0].vertexlist = new int[3]{a, b, c};
    }
    in.numberofholes = static_cast<int>(soup.holes.size());
    in.holelist = list_of(soup.holes);
    in.numberofregions = static_cast<int>(soup.seeds.size());
    in.regionlist = new double[5 * soup.seeds.size()];
    for (std::size_t i = 0; i < soup.seeds.size(); ++i) {
        const RegionSeed& seed = soup.seeds[i];
        std::copy_n(seed.point.data(), 3, in.regionlist + 5 * i);
        in.regionlist[5 * i + 3] = number_in(seed.name);
        in.regionlist[5 * i + 4] = 0;
    }
}

void write_medit(const std::string& path, const tetgenio& out) {
    std::ofstream file(path);
    file << fmt::format("MeshVersionFormatted 2\nDimension 3\nVertices {}\n", out.numberofpoints);
    for (int v = 0; v < out.numberofpoints; ++v)
        file << row(Eigen::Map<const Vec3>(out.pointlist + 3 * std::ptrdiff_t(v))) << " 0\n";
    file << fmt::format("Tetrahedra {}\n", out.numberoftetrahedra);
    for (std::ptrdiff_t t = 0; t < out.numberoftetrahedra; ++t) {
        const int* const corners = out.tetrahedronlist + 4 * t;
        file << fmt::format("{} {} {} {} {:g}\n", corners[0] + 1, corners[1] + 1, corners[2] + 1, corners[3] + 1,
                            out.tetrahedronattributelist[t]);
    }
    file << "End\n";
}

// Facets are kept (Y); the bound of shapes is Kerf's.
void fill_by_tetgen(const std::string& path, double bound, const std::string& result) {
    const Soup soup = read_surface(path);
    std::string switches = bound > 0 ? fmt::format("pYAQq1.4a{:.12f}", bound) : "pYAQq1.4";
    tetgenio in, out;
    give(in, soup);
    bench::forget_process_memory();
    const double start = bench::user_seconds();
    try {
        tetrahedralize(switches.data(), &in, &out);
    } catch (int code) {
        throw std::runtime_error(fmt::format("TetGen stopped with code {}", code));
    }
    const double seconds = bench::user_seconds() - start;
    fmt::print("{{\"seconds\": {}, \"peak_bytes\": {}}}\n", seconds, bench::memory_bytes("VmHWM"));
    write_medit(result, out);
}

std::map<int, double> volumes_of(const Complex& complex) {
    std::map<int, double> volumes;
    for (const RegionIndex region : ids<RegionIndex>(complex.region_count())) {
        const SurfaceArrays surface = complex.arrays_of(region);
        volumes[number_in(complex.region_names()[static_cast<std::size_t>(region.value())])] +=
            enclosed_volume(surface.vertices, surface.facets);
    }
    return volumes;
}

// Volumes of regions are those inside of the faces of their cells; that of all cells is added up by itself.
void measure(const std::string& given_path, const std::string& path) {
    const std::map<int, double> given = volumes_of(read_input(given_path).complex),
                                found = volumes_of(make_complex(read_surface(path)));
    const TetMesh mesh = read_tet_file(path).mesh;
    double volume = 0, error = 0;
    for (const auto& [region, wanted] : given) {
        const auto same = found.find(region);
        error = std::max(error, same == found.end() ? 1 : std::abs(same->second / wanted - 1));
        volume += wanted;
    }
    const std::vector<double> angles = bench::sorted_min_dihedrals(mesh);
    fmt::print(R"({{"tets": {}, "regions": {}, "region_error": {}, "volume_error": {}, "dihedral_0": {}, )"
               R"("dihedral_1": {}, "dihedral_50": {}}})"
               "\n",
               angles.size(), found.size(), error, std::abs(bench::volume_of(mesh) / volume - 1), angles.front(),
               angles[angles.size() / 100], angles[angles.size() / 2]);
}

int run(const std::vector<std::string>& words) {
    if (words.size() >= 3 && words[0] == "prepare")
        prepare(words[1], {words.begin() + 2, words.end()});
    else if (words.size() == 4 && words[0] == "tetgen")
        fill_by_tetgen(words[1], std::stod(words[2]), words[3]);
    else if (words.size() == 3 && words[0] == "measure")
        measure(words[1], words[2]);
    else
        return 2;
    return 0;
}

}  // namespace

}  // namespace kerf

int main(int argc, char** argv) { return kerf::bench::run_by_words(argc, argv, kerf::run); }

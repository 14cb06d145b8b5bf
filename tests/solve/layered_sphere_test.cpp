// A thick sphere of two materials under pressure, against its formula.
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "files/part/run_parts.h"
#include "solve/case/material.h"
#include "support/facet_sides.h"
#include "support/file_contents.h"
#include "support/program.h"
#include "support/run_in_process.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

constexpr std::array<double, 3> radii = {1, 1.5, 2};  // inside, wall, outside
constexpr double pressure = 3;                        // inside
const std::array<Material, 2> layer_materials = {{{"soft", 10, 0.3, 0}, {"stiff", 100, 0.2, 0}}};

// A layer between two radii under the pressures p[0] inside and p[1] outside. Without forces in it the radial
// displacement is u = a r + b / r^2, with the radial stress 3 K a - 4 G b / r^3 and the hoop stress
// 3 K a + 2 G b / r^3 (K: bulk modulus, G: shear modulus). The pressures give a and b (Lame).
struct SphereLayer {
    double bulk, shear, a, b;

    SphereLayer(std::size_t layer, std::array<double, 2> p)
        : bulk(layer_materials[layer].lambda() + 2 * layer_materials[layer].mu() / 3),
          shear(layer_materials[layer].mu()) {
        const double inner = std::pow(radii[layer], 3), outer = std::pow(radii[layer + 1], 3);
        a = (p[0] * inner - p[1] * outer) / (outer - inner) / (3 * bulk);
        b = (p[0] - p[1]) * inner * outer / (outer - inner) / (4 * shear);
    }
    double displacement(double r) const { return a * r + b / (r * r); }
    double radial(double r) const { return 3 * bulk * a - 4 * shear * b / (r * r * r); }
    double hoop(double r) const { return 3 * bulk * a + 2 * shear * b / (r * r * r); }
};

// The wall presses on both layers with the same q, and moves with both: linear equations for q.
std::array<SphereLayer, 2> layers_of_sphere() {
    const auto gap = [](double q) {
        return SphereLayer(0, {pressure, q}).displacement(radii[1]) - SphereLayer(1, {q, 0}).displacement(radii[1]);
    };
    const double q = gap(0) / (gap(0) - gap(1));
    return {SphereLayer(0, {pressure, q}), SphereLayer(1, {q, 0})};
}

// Half of the work of the pressures on its two surfaces.
double energy_of_layer(const SphereLayer& layer, double inside, double outside) {
    const auto work = [&](double r) { return r * r * layer.radial(r) * layer.displacement(r); };
    return 2 * std::numbers::pi * (work(outside) - work(inside));
}

Input sphere_input(int subdivisions) {
    std::vector<Vec3> vertices;
    std::vector<Triangle> facets;
    std::vector<FacetSides> sides;
    std::vector<std::int32_t> patch;
    for (std::int32_t s = 0; s < 3; ++s) {
        const Soup sphere = test::icosphere(subdivisions, radii[static_cast<std::size_t>(s)]);
        const auto first = static_cast<std::int32_t>(vertices.size());
        vertices.insert(vertices.end(), sphere.vertices.begin(), sphere.vertices.end());
        for (const auto& [a, b, c] : sphere.facets) {
            facets.push_back({a + first, b + first, c + first});
            sides.push_back(test::facet_sides(s < 2 ? s : -1, s - 1));
            patch.push_back(s);
        }
    }
    return make_input(vertices, facets, sides, {"soft", "stiff"}, patch, {"inside", "wall", "outside"});
}

// A folder with the mesh, and the solution in out/.
void solve_sphere(const test::TemporaryFolder& folder, int subdivisions) {
    RunRequest options;
    options.sizes.size = 1.4 / (1 << (subdivisions - 1));
    ASSERT_EQ(test::run_parts(sphere_input(subdivisions), folder.file("mesh"), 4, options).exit_code, 0);
    std::ofstream file(folder.file("case.toml"));
    for (const Material& material : layer_materials)
        file << "[material." << material.name << "]\nyoung = " << material.young << "\npoisson = " << material.poisson
             << "\n";
    // Points that move along an axis alone prevent all motions, and need no force.
    file << R"(
[[support]]
point = [2, 0, 0]
y = 0
z = 0
[[support]]
point = [0, 2, 0]
x = 0
z = 0
[[support]]
point = [0, 0, 2]
x = 0
y = 0
[solver]
order = 2
[[load]]
patch = "inside"
pressure = )"
         << pressure << "\n";
    file.close();
    const ChildResult result = test::run_kerf({"solve", folder.file("mesh"), "--case", folder.file("case.toml"), "-o",
                                               folder.file("out"), "-q", "--ranks", "1"});
    ASSERT_EQ(result.exit_code, 0) << result.log;
}

// How far a solution is from the formula, beside the formula's value.
struct SphereErrors {
    double displacement = 0;                                     // the largest, beside that inside
    std::array<double, 2> energy{}, wall_hoop{}, wall_radial{};  // of the layers; stresses: means at the wall
};

// Stresses along the radius and across it, at the vertices of a layer on the wall.
struct WallStress {
    double radial = 0, hoop = 0, count = 0;

    void add(const Vec3& outwards, const PartValues& values, std::size_t v) {
        std::array<double, 6> s{};  // XX YY ZZ XY YZ XZ
        for (std::size_t i = 0; i < s.size(); ++i) s[i] = values.number(6 * v + i);
        Eigen::Matrix3d stress;
        stress << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
        const double along = outwards.dot(stress * outwards);
        radial += along;
        hoop += (stress.trace() - along) / 2;
        count += 1;
    }
};

SphereErrors errors_of_sphere(int subdivisions) {
    const test::TemporaryFolder folder;
    solve_sphere(folder, subdivisions);
    const std::array<SphereLayer, 2> layers = layers_of_sphere();
    const double moved_inside = layers[0].displacement(radii[0]);
    SphereErrors errors;
    std::array<WallStress, 2> at_wall;
    const RunParts solution(folder.file("mesh"), folder.file("out"));
    for (const PartIndex index : solution.outline().parts.ids()) {
        const Part part = solution.load(index);
        const auto layer = static_cast<std::size_t>(part.region_of(0).value());
        for (const PartValues& values : part.values)
            for (std::size_t v = 0; values.of == PartValues::Of::points && v < part.mesh.vertices.size(); ++v) {
                const double r = part.mesh.vertices[v].norm();
                const Vec3 outwards = part.mesh.vertices[v] / r;
                if (values.name == "Displacement") {
                    const Vec3 moved(values.number(3 * v), values.number(3 * v + 1), values.number(3 * v + 2));
                    const double off = (moved - layers[layer].displacement(r) * outwards).norm();
                    errors.displacement = std::max(errors.displacement, off / moved_inside);
                }
                if (values.name == "Stress" && std::abs(r - radii[1]) < 1e-9) at_wall[layer].add(outwards, values, v);
            }
    }
    const auto report = nlohmann::json::parse(test::bytes_of_file(folder.file("out/report.json")));
    for (std::size_t i = 0; i < 2; ++i) {
        const double energy = report["solve"]["cases"][0]["regions"][i]["strain_energy"];
        errors.energy[i] = std::abs(energy / energy_of_layer(layers[i], radii[i], radii[i + 1]) - 1);
        errors.wall_hoop[i] = std::abs(at_wall[i].hoop / at_wall[i].count / layers[i].hoop(radii[1]) - 1);
        errors.wall_radial[i] = std::abs(at_wall[i].radial / at_wall[i].count / layers[i].radial(radii[1]) - 1);
    }
    return errors;
}

// The hoop stress jumps at the wall from -0.29 to 2.14, the radial stress does not. Facets are flat, so that errors
// fall with the square of their edges, halved here; those of averages at the wall a little more slowly.
TEST(LayeredSphere, ConvergesToItsFormulaOnBothSidesOfTheWall) {
    const SphereErrors coarse = errors_of_sphere(2), fine = errors_of_sphere(3);
    EXPECT_LT(fine.displacement, 0.03);
    EXPECT_LT(fine.displacement, 0.4 * coarse.displacement);
    for (std::size_t i = 0; i < 2; ++i) {
        SCOPED_TRACE(layer_materials[i].name);
        EXPECT_LT(fine.energy[i], 0.015);
        EXPECT_LT(fine.energy[i], 0.4 * coarse.energy[i]);
        EXPECT_LT(fine.wall_hoop[i], 0.04);
        EXPECT_LT(fine.wall_hoop[i], 0.6 * coarse.wall_hoop[i]);
        EXPECT_LT(fine.wall_radial[i], 0.05);
        EXPECT_LT(fine.wall_radial[i], 0.6 * coarse.wall_radial[i]);
    }
}

}  // namespace
}  // namespace kerf

// How the error of kerf solve falls: known displacements on the surface of a finished run, and the forces that go with
// them inside.
//
//     solve_bench sine|bending|sphere FOLDER ORDER
//
// `sine`: products of sines in the unit cube. `bending`: a beam under moments at its ends, of which elements of order 2
// have all. `sphere`: a thick sphere between radii 1 and 2 under pressure inside
// (Lame). Prints one object of JSON: errors in the norm of L2 and of the energy over those of the solution, measured
// with 64 points in each tetrahedron, and the estimate of the latter.
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <mpi.h>

#include "mpi/mpi_ranks.h"
#include "part/run_parts.h"
#include "solve/linear_system.h"
#include "solve/stress.h"

namespace kerf {

namespace {

// A displacement that is known everywhere, of a material.
struct KnownField {
    Material material;
    Vec3 (*displacement)(const Vec3&);
    Eigen::Matrix3d (*gradient)(const Vec3&);
    Vec3 (*force)(const Material&, const Vec3&);  // per volume
};

constexpr double pi = std::numbers::pi;

// (sin(pi x) sin(pi y) sin(pi z)) (1, 2, -1) / 1000
Vec3 sine_displacement(const Vec3& p) {
    return 1e-3 * std::sin(pi * p.x()) * std::sin(pi * p.y()) * std::sin(pi * p.z()) * Vec3(1, 2, -1);
}
Vec3 slope_of_sines(const Vec3& p) {
    const Vec3 s = (pi * p).array().sin(), c = (pi * p).array().cos();
    return pi * Vec3(c.x() * s.y() * s.z(), s.x() * c.y() * s.z(), s.x() * s.y() * c.z());
}
Eigen::Matrix3d sine_gradient(const Vec3& p) { return 1e-3 * Vec3(1, 2, -1) * slope_of_sines(p).transpose(); }
// - (lambda + mu) grad(div u) - mu laplace(u)
Vec3 sine_force(const Material& material, const Vec3& p) {
    const Vec3 s = (pi * p).array().sin(), c = (pi * p).array().cos(), a(1, 2, -1);
    Eigen::Matrix3d second;  // of the product of sines
    const double all = -s.x() * s.y() * s.z();
    second << all, c.x() * c.y() * s.z(), c.x() * s.y() * c.z(),  //
        c.x() * c.y() * s.z(), all, s.x() * c.y() * c.z(),        //
        c.x() * s.y() * c.z(), s.x() * c.y() * c.z(), all;
    second *= pi * pi;
    return -1e-3 * ((material.lambda() + material.mu()) * second * a + material.mu() * second.trace() * a);
}

// u = (A r + B / r^2) e_r, for the pressure 1 at r = 1 and none at r = 2: 3 K A - 4 mu B / r^3 is the radial stress.
struct LameSphere {
    double growth, pushed;
};
LameSphere sphere_of(const Material& m) {
    const double bulk = m.lambda() + 2 * m.mu() / 3, inner = 1, outer = 8;  // cubes of the radii
    return {inner / (outer - inner) / (3 * bulk), inner * outer / (outer - inner) / (4 * m.mu())};
}
const Material sphere_material{"sphere", 100, 0.3, 0};
Vec3 sphere_displacement(const Vec3& p) {
    const auto [growth, pushed] = sphere_of(sphere_material);
    return (growth + pushed / std::pow(p.norm(), 3)) * p;
}
Eigen::Matrix3d sphere_gradient(const Vec3& p) {
    const auto [growth, pushed] = sphere_of(sphere_material);
    const double r = p.norm();
    return (growth + pushed / std::pow(r, 3)) * Eigen::Matrix3d::Identity() -
           3 * pushed / std::pow(r, 5) * p * p.transpose();
}
Vec3 no_force(const Material&, const Vec3&) { return Vec3::Zero(); }

const KnownField sine{{"sine", 1, 0.3, 0}, sine_displacement, sine_gradient, sine_force};
const KnownField sphere{sphere_material, sphere_displacement, sphere_gradient, no_force};

// Moments about y: stress XX = young * curvature * z, and nothing else.
constexpr double curvature = 1e-3;
const Material beam_material{"beam", 210e3, 0.3, 0};
Vec3 bending_displacement(const Vec3& p) {
    const double nu = beam_material.poisson;
    return curvature *
           Vec3(p.x() * p.z(), -nu * p.y() * p.z(), -(p.x() * p.x() - nu * p.y() * p.y() + nu * p.z() * p.z()) / 2);
}
Eigen::Matrix3d bending_gradient(const Vec3& p) {
    const double nu = beam_material.poisson;
    Eigen::Matrix3d gradient;
    gradient << p.z(), 0, p.x(),          //
        0, -nu * p.z(), -nu * p.y(),      //
        -p.x(), nu * p.y(), -nu * p.z();  //
    return curvature * gradient;
}
const KnownField bending{beam_material, bending_displacement, bending_gradient, no_force};

struct WeightedPoint {
    Barycentric place;
    double weight;  // of the volume
};

// Gauss and Legendre's four points in each direction of a cube that is collapsed to the tetrahedron.
std::vector<WeightedPoint> many_points() {
    const double inner = std::sqrt(3.0 / 7 - 2.0 / 7 * std::sqrt(6.0 / 5)),
                 outer = std::sqrt(3.0 / 7 + 2.0 / 7 * std::sqrt(6.0 / 5));
    const double of_inner = (18 + std::sqrt(30.0)) / 72, of_outer = (18 - std::sqrt(30.0)) / 72;
    const std::array<double, 4> x = {(1 - outer) / 2, (1 - inner) / 2, (1 + inner) / 2, (1 + outer) / 2};
    const std::array<double, 4> w = {of_outer, of_inner, of_inner, of_outer};
    std::vector<WeightedPoint> points;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            for (std::size_t k = 0; k < 4; ++k) {
                const double a = x[i], b = x[j] * (1 - a), c = x[k] * (1 - a - b);
                const double weight = 6 * w[i] * w[j] * w[k] * (1 - a) * (1 - a) * (1 - x[j]);
                points.push_back({{a, b, c, 1 - a - b - c}, weight});
            }
    return points;
}

void solve_and_print(MpiRanks& ranks, const KnownField& field, const std::string& folder, int order) {
    const RunParts run(folder);
    const std::vector<PartIndex> first = {PartIndex(0), PartIndex(run.outline().parts.size())};
    std::vector<Part> parts;
    for (const PartIndex index : run.outline().parts.ids()) parts.push_back(run.load(index));
    const FeSpace space(ranks, run.outline(), first, std::move(parts), order);

    ElasticProblem problem = make_free_problem(space, field.material);
    for (std::size_t p = 0; p < space.parts().size(); ++p)
        for (std::size_t f = 0; f < space.parts()[p].facets.size(); ++f)
            for (const std::int32_t node : space.nodes_of_facet(p, f))
                for (std::size_t c = 0; !space.parts()[p].is_interface(f) && node >= 0 && c < 3; ++c) {
                    const std::size_t dof = 3 * static_cast<std::size_t>(node) + c;
                    problem.support_of[dof] = 0;
                    problem.prescribed[dof] = field.displacement(
                        space.points()[static_cast<std::size_t>(node)])[static_cast<Eigen::Index>(c)];
                }
    const std::vector<WeightedPoint> points = many_points();
    const auto nodes_each = static_cast<std::size_t>(element_nodes(order));
    std::vector<double> forces(3 * space.node_count(), 0), u;
    for_all_tets(space, [&](std::size_t p, std::size_t t) {
        const TetElement element = space.element(p, t);
        const auto nodes = space.nodes_of(p, t);
        for (const auto& [place, weight] : points) {
            const auto shapes = TetElement::shapes_at(order, place);
            const Vec3 force = weight * element.volume() * field.force(field.material, element.position_of(place));
            for (std::size_t n = 0; n < nodes_each; ++n)
                Eigen::Map<Vec3>(&forces[3 * static_cast<std::size_t>(nodes[n])]) += shapes[n] * force;
        }
    });
    SolverOptions options;
    options.rtol = 1e-10;
    LinearSystem system(problem, options);
    const SolveOutcome outcome = system.solve(forces, u);
    const StressField stress = recover_stress(problem, u);

    double error = 0, all = 0, energy_error = 0, energy = 0;
    for_all_tets(space, [&](std::size_t p, std::size_t t) {
        const TetElement element = space.element(p, t);
        const auto nodes = space.nodes_of(p, t);
        std::array<Vec3, most_element_nodes> values;
        for (std::size_t n = 0; n < nodes_each; ++n)
            values[n] = Eigen::Map<const Vec3>(&u[3 * static_cast<std::size_t>(nodes[n])]);
        for (const auto& [place, weight] : points) {
            const Vec3 x = element.position_of(place);
            const auto shapes = TetElement::shapes_at(order, place);
            Vec3 found = Vec3::Zero();
            for (std::size_t n = 0; n < nodes_each; ++n) found += shapes[n] * values[n];
            const SymmetricTensor strain = strain_of(field.gradient(x)),
                                  wrong = strain_of(element.gradient_of(values, place)) - strain;
            const double w = weight * element.volume();
            error += w * (found - field.displacement(x)).squaredNorm();
            all += w * field.displacement(x).squaredNorm();
            energy_error += w * contracted(stress_of(field.material, wrong), wrong);
            energy += w * contracted(stress_of(field.material, strain), strain);
        }
    });
    fmt::print(R"({{"tets": {}, "nodes": {}, "iterations": {}, "residual": {:.3g}, "l2": {:.6g}, "energy": {:.6g}, )"
               R"("estimate": {:.6g}}})"
               "\n",
               run.outline().tets(), space.total_rows(), outcome.iterations, outcome.residual, std::sqrt(error / all),
               std::sqrt(energy_error / energy), stress.norms.error / std::sqrt(energy));
}

}  // namespace

}  // namespace kerf

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    int code = 2;
    if (argc == 4) try {
            kerf::MpiRanks ranks(MPI_COMM_SELF);
            const kerf::PetscSession petsc(ranks);
            const std::string name = argv[1];
            kerf::solve_and_print(ranks,
                                  name == "sphere"    ? kerf::sphere
                                  : name == "bending" ? kerf::bending
                                                      : kerf::sine,
                                  argv[2], std::stoi(argv[3]));
            code = 0;
        } catch (const std::exception& error) {
            fmt::print(stderr, "{}\n", error.what());
            code = 1;
        }
    MPI_Finalize();
    return code;
}

// Displacements that are known everywhere, what has them as its solution, and how far a solution is from them.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "solve/equations/elastic_problem.h"

namespace kerf::test {

// A displacement that is known everywhere, of a material.
struct KnownField {
    Material material;
    Vec3 (*displacement)(const Vec3&);
    Eigen::Matrix3d (*gradient)(const Vec3&);
    Vec3 (*force)(const Material&, const Vec3&);  // per volume
    /// Where the surface has a pressure of 1 on it; elsewhere displacements are prescribed. None: everywhere.
    bool (*is_pressed)(const Vec3& corner) = nullptr;  ///< of all three corners
};

inline constexpr double pi = std::numbers::pi;

// (sin(pi x) sin(pi y) sin(pi z)) (1, 2, -1) / 1000
inline Vec3 sine_displacement(const Vec3& p) {
    return 1e-3 * std::sin(pi * p.x()) * std::sin(pi * p.y()) * std::sin(pi * p.z()) * Vec3(1, 2, -1);
}
inline Vec3 slope_of_sines(const Vec3& p) {
    const Vec3 s = (pi * p).array().sin(), c = (pi * p).array().cos();
    return pi * Vec3(c.x() * s.y() * s.z(), s.x() * c.y() * s.z(), s.x() * s.y() * c.z());
}
inline Eigen::Matrix3d sine_gradient(const Vec3& p) { return 1e-3 * Vec3(1, 2, -1) * slope_of_sines(p).transpose(); }
// - (lambda + mu) grad(div u) - mu laplace(u)
inline Vec3 sine_force(const Material& material, const Vec3& p) {
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
inline LameSphere sphere_of(const Material& m) {
    const double bulk = m.lambda() + 2 * m.mu() / 3, inner = 1, outer = 8;  // cubes of the radii
    return {inner / (outer - inner) / (3 * bulk), inner * outer / (outer - inner) / (4 * m.mu())};
}
inline const Material sphere_material{"sphere", 100, 0.3, 0};
inline Vec3 sphere_displacement(const Vec3& p) {
    const auto [growth, pushed] = sphere_of(sphere_material);
    return (growth + pushed / std::pow(p.norm(), 3)) * p;
}
inline Eigen::Matrix3d sphere_gradient(const Vec3& p) {
    const auto [growth, pushed] = sphere_of(sphere_material);
    const double r = p.norm();
    return (growth + pushed / std::pow(r, 3)) * Eigen::Matrix3d::Identity() -
           3 * pushed / std::pow(r, 5) * p * p.transpose();
}
inline Vec3 no_force(const Material&, const Vec3&) { return Vec3::Zero(); }

inline const KnownField sine{{"sine", 1, 0.3, 0}, sine_displacement, sine_gradient, sine_force};
inline const KnownField sphere{sphere_material, sphere_displacement, sphere_gradient, no_force};
inline bool is_inside_of_sphere(const Vec3& p) { return p.norm() < 1 + 1e-9; }
inline const KnownField pressed_sphere{sphere_material, sphere_displacement, sphere_gradient, no_force,
                                       is_inside_of_sphere};

// Moments about y: stress XX = young * curvature * z, and nothing else.
inline constexpr double curvature = 1e-3;
inline const Material beam_material{"beam", 210e3, 0.3, 0};
inline Vec3 bending_displacement(const Vec3& p) {
    const double nu = beam_material.poisson;
    return curvature *
           Vec3(p.x() * p.z(), -nu * p.y() * p.z(), -(p.x() * p.x() - nu * p.y() * p.y() + nu * p.z() * p.z()) / 2);
}
inline Eigen::Matrix3d bending_gradient(const Vec3& p) {
    const double nu = beam_material.poisson;
    Eigen::Matrix3d gradient;
    gradient << p.z(), 0, p.x(),          //
        0, -nu * p.z(), -nu * p.y(),      //
        -p.x(), nu * p.y(), -nu * p.z();  //
    return curvature * gradient;
}
inline const KnownField bending{beam_material, bending_displacement, bending_gradient, no_force};

// Gauss and Legendre's four points in each direction of a cube that is collapsed to the tetrahedron.
inline std::vector<TetPoint> many_points() {
    const double inner = std::sqrt(3.0 / 7 - 2.0 / 7 * std::sqrt(6.0 / 5)),
                 outer = std::sqrt(3.0 / 7 + 2.0 / 7 * std::sqrt(6.0 / 5));
    const double of_inner = (18 + std::sqrt(30.0)) / 72, of_outer = (18 - std::sqrt(30.0)) / 72;
    const std::array<double, 4> x = {(1 - outer) / 2, (1 - inner) / 2, (1 + inner) / 2, (1 + outer) / 2};
    const std::array<double, 4> w = {of_outer, of_inner, of_inner, of_outer};
    std::vector<TetPoint> points;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            for (std::size_t k = 0; k < 4; ++k) {
                const double a = x[i], b = x[j] * (1 - a), c = x[k] * (1 - a - b);
                const double weight = 6 * w[i] * w[j] * w[k] * (1 - a) * (1 - a) * (1 - x[j]);
                points.push_back({{a, b, c, 1 - a - b - c}, weight});
            }
    return points;
}

/// Ranks have shares of the forces.
struct KnownProblem {
    ElasticProblem problem;
    std::vector<double> forces;
};

inline void hold_at(const KnownField& field, std::int32_t node, ElasticProblem& problem) {
    const Vec3 displacement = field.displacement(problem.space->points()[node]);
    for (int c = 0; c < 3; ++c) {
        problem.support_of[3 * node + c] = 0;
        problem.prescribed[3 * node + c] = displacement[c];
    }
}

/// A node of the surface may be there without a triangle: all ranks are told which are held.
inline KnownProblem known_problem(const FeSpace& space, const KnownField& field) {
    KnownProblem known{make_free_problem(space, field.material), std::vector<double>(3 * space.node_count(), 0)};
    known.problem.supports = {"surface"};
    const auto add = [&](std::int32_t node, const Vec3& force) {
        Eigen::Map<Vec3>(&known.forces[3 * static_cast<std::size_t>(node)]) += force;
    };
    for (std::size_t p = 0; p < space.parts().size(); ++p) {
        const Part& part = space.parts()[p];
        for (std::size_t f = 0; f < part.facets.size(); ++f) {
            if (part.is_interface(f)) continue;
            const auto nodes = space.nodes_of_facet(p, f);
            const auto is_pressed = [&](std::int32_t v) {
                return field.is_pressed && field.is_pressed(part.mesh.vertices[static_cast<std::size_t>(v)]);
            };
            if (std::all_of(part.facets[f].begin(), part.facets[f].end(), is_pressed)) {
                const FacetElement::Forces forces = space.facet_element(p, f).forces_of_pressure(1);
                for (std::size_t i = 0; i < nodes.size(); ++i)
                    if (nodes[i] >= 0) add(nodes[i], forces[i]);
                continue;
            }
            for (const std::int32_t node : nodes)
                if (node >= 0) hold_at(field, node, known.problem);
        }
    }
    space.ownership().smallest_over_ranks(std::span(known.problem.support_of), 3);
    for (std::int32_t n = 0; n < space.node_count(); ++n)
        if (known.problem.is_held(3 * n)) hold_at(field, n, known.problem);
    const std::vector<TetPoint> points = many_points();
    for_all_tets(space, [&](std::size_t p, std::size_t t) {
        const TetElement element = space.element(p, t);
        const auto nodes = space.nodes_of(p, t);
        for (const TetPoint& at : points) {
            const auto shapes = TetElement::shapes_at(space.order(), at.place);
            const Vec3 force = element.point(at).weight * field.force(field.material, element.position_of(at.place));
            for (int n = 0; n < element.node_count(); ++n) add(nodes[n], shapes[n] * force);
        }
    });
    return known;
}

/// Beside the norms of the field.
struct KnownErrors {
    double l2 = 0, energy = 0;
    double energy_of_field = 0;  ///< its norm
};

/// Collective.
inline KnownErrors errors_of(const FeSpace& space, const KnownField& field, const std::vector<double>& u) {
    const std::vector<TetPoint> points = many_points();
    std::array<double, 4> sums{};  // error, field, and both in the energy
    for_all_tets(space, [&](std::size_t p, std::size_t t) {
        const TetElement element = space.element(p, t);
        const auto nodes = space.nodes_of(p, t);
        TetElement::Nodes values;
        for (int n = 0; n < element.node_count(); ++n)
            values[n] = Eigen::Map<const Vec3>(&u[3 * static_cast<std::size_t>(nodes[n])]);
        for (const TetPoint& at : points) {
            const Vec3 x = element.position_of(at.place);
            const auto shapes = TetElement::shapes_at(space.order(), at.place);
            Vec3 found = Vec3::Zero();
            for (int n = 0; n < element.node_count(); ++n) found += shapes[n] * values[n];
            const SymmetricTensor strain = strain_of(field.gradient(x)),
                                  wrong = strain_of(element.gradient_of(values, at.place)) - strain;
            const double w = element.point(at).weight;
            sums[0] += w * (found - field.displacement(x)).squaredNorm();
            sums[1] += w * field.displacement(x).squaredNorm();
            sums[2] += w * contracted(stress_of(field.material, wrong), wrong);
            sums[3] += w * contracted(stress_of(field.material, strain), strain);
        }
    });
    space.ranks().all_reduce(std::span<double>(sums), Reduction::sum);
    return {std::sqrt(sums[0] / sums[1]), std::sqrt(sums[2] / sums[3]), std::sqrt(sums[3])};
}

}  // namespace kerf::test

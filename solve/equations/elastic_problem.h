// A case on a mesh: the degrees of freedom that are held, the nodal forces, the materials of the cells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "base/core/types.h"
#include "solve/case/elastic_case.h"
#include "solve/equations/inside/inertia_relief.h"
#include "solve/equations/inside/surface_springs.h"
#include "solve/multigrid/node_frames.h"
#include "solve/space/fe_space.h"
#include "solve/space/space_bodies.h"
#include "solve/space/surface_selection.h"

namespace kerf {

/// A force, and its moment about a point that the context defines.
struct ForceAndMoment {
    Vec3 force = Vec3::Zero();
    Vec3 moment = Vec3::Zero();

    ForceAndMoment& operator+=(const ForceAndMoment& other) {
        force += other.force;
        moment += other.moment;
        return *this;
    }
};

/// Sums of forces for each support, spring or inertia relief, and each region. A node on a wall has cells of several
/// regions, and each region counts the forces of its own cells: the sum over the regions is that of the support.
/// Moments are about a point of the support.
class HeldForces {
 public:
    HeldForces() = default;
    /// `places`: a point of each support.
    HeldForces(std::vector<Vec3> places, std::size_t regions)
        : places_(std::move(places)), sums_(6 * places_.size() * regions, 0) {}

    /// Adds a force that acts at the point `at`.
    void add(std::size_t support, std::size_t region, const Vec3& force, const Vec3& at) {
        double* sum = &sums_[6 * (supports() * region + support)];
        Eigen::Map<Vec3>{sum} += force;
        Eigen::Map<Vec3>{sum + 3} += (at - places_[support]).cross(force);
    }
    ForceAndMoment of(std::size_t support, std::size_t region) const {
        const double* sum = &sums_[6 * (supports() * region + support)];
        return {Eigen::Map<const Vec3>(sum), Eigen::Map<const Vec3>(sum + 3)};
    }
    /// Returns the sum over all regions.
    ForceAndMoment of(std::size_t support) const {
        ForceAndMoment sum;
        for (std::size_t region = 0; region < regions(); ++region) sum += of(support, region);
        return sum;
    }
    /// Adds the sums of `other`, which has the same supports and regions, times a factor.
    void add(double factor, const HeldForces& other) {
        for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += factor * other.sums_[i];
    }
    std::size_t supports() const { return places_.size(); }
    std::size_t regions() const { return places_.empty() ? 0 : sums_.size() / (6 * places_.size()); }
    std::span<double> numbers() { return sums_; }

 private:
    std::vector<Vec3> places_;
    std::vector<double> sums_;
};

/// The accelerations by which inertia balances the loads of a body that supports leave free.
struct BodyInertia {
    Vec3 centre = Vec3::Zero();                ///< centre of mass
    Vec3 acceleration = Vec3::Zero();          ///< of the centre
    Vec3 angular_acceleration = Vec3::Zero();  ///< radians per time squared
};

/// The number of a material among those of a problem.
using MaterialNumber = std::uint16_t;

/// One set of loads, or a sum of several with factors.
struct ProblemCase {
    std::string name;
    std::vector<double> forces;         ///< #dof of x, y and z; ranks have shares, which add up
    double load_sum = 0;                ///< sum of sizes of forces, before inertia balances them; ranks have shares
    HeldForces held_forces;             ///< forces at held degrees of freedom, but for thermal ones; ranks have shares
    std::vector<double> thermal;        ///< thermal strain of each material, in every direction; empty: none
    Vec3 inertia = Vec3::Zero();        ///< the sum of the forces of inertia, over all ranks
    std::vector<BodyInertia> relieved;  ///< one for each free body
    std::vector<std::pair<std::size_t, double>> factors;  ///< of a combination: numbers of earlier cases, and factors
};

/// A case on the mesh of a space. Degrees of freedom are 3 * node + component, along x, y and z but where `frames` says
/// otherwise. Arrays over local nodes hold the same for a node on every rank.
struct ElasticProblem {
    const FeSpace* space = nullptr;
    std::vector<Material> materials;
    /// The materials of the tetrahedra, for each part of this rank; empty: all have the first material.
    std::vector<std::vector<MaterialNumber>> material_of_tet;
    std::vector<std::string> supports;     ///< names of supports, then of springs, then of inertia relief
    std::vector<Vec3> places;              ///< of `supports`: the centres of their areas, for moments
    std::vector<std::int32_t> support_of;  ///< #dof: the first support that holds it, or `free`
    std::vector<double> prescribed;        ///< #dof: displacement where it is held
    std::vector<ProblemCase> cases;        ///< combinations last
    NodeFrames frames;
    SurfaceSprings springs;
    std::int32_t first_spring = 0;  ///< index of the first spring in `supports`
    InertiaRelief relief;

    static constexpr std::int32_t free = INT32_MAX;
    bool is_held(std::size_t dof) const { return support_of[dof] != free; }
    MaterialNumber material_number(std::size_t p, std::size_t tet) const {
        return material_of_tet.empty() ? MaterialNumber{0} : material_of_tet[p][tet];
    }
    const Material& material(std::size_t p, std::size_t tet) const { return materials[material_number(p, tet)]; }
    /// Returns the thermal strain of a tetrahedron in a case, the same in every direction; 0 without cases.
    double thermal_strain(std::size_t number, std::size_t p, std::size_t tet) const {
        if (number >= cases.size() || cases[number].thermal.empty()) return 0;
        return cases[number].thermal[material_number(p, tet)];
    }
    /// Calls take(support, share) for each support that holds the node, with its share of a force there.
    template <class Take>
    void share_among_holders(std::int32_t node, const Vec3& force, Take take) const {
        const std::size_t dof = 3 * static_cast<std::size_t>(node);
        const NodeFrames::Frame* frame = frames.at(node);
        const Vec3 shares = frame ? Vec3(frame->shares * force) : force;
        for (std::size_t c = 0; c < 3; ++c) {
            if (!is_held(dof + c)) continue;
            take(support_of[dof + c],
                 Vec3(shares[c] * (frame ? Vec3(frame->directions.col(c)) : Vec3::Unit(c).eval())));
        }
    }
    bool holds_any(std::int32_t node) const {
        const std::size_t dof = 3 * static_cast<std::size_t>(node);
        return is_held(dof) || is_held(dof + 1) || is_held(dof + 2);
    }
};

/// Puts the case on the mesh. Collective. Throws Error(usage) on all ranks alike: for names that the mesh does not
/// have, for a cell without a material or with two, and for a body that its supports leave free to move, naming the
/// motion, unless it may or inertia shall relieve it.
ElasticProblem make_problem(const FeSpace& space, const MeshOutline& outline, const ElasticCase& wanted);

/// Returns a problem without supports and forces, of one material, for callers that set the rest.
ElasticProblem make_free_problem(const FeSpace& space, const Material& material);

}  // namespace kerf

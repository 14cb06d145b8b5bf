// The content of a case file: materials, supports, loads.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/core/types.h"
#include "solve/case/inside/material_table.h"
#include "solve/case/material.h"

namespace kerf {

/// A selection of triangles of the user's surface, or of a vertex of it. Exactly one member is given.
struct SurfaceSelection {
    std::vector<std::string> patches;            ///< names; '*' stands for any characters
    std::optional<std::array<Vec3, 2>> box;      ///< low and high corner: triangles with all corners inside
    std::optional<std::array<double, 4>> plane;  ///< a, b, c, d: triangles with all corners on ax + by + cz = d
    std::optional<Vec3> point;                   ///< the nearest vertex of the surface
};

struct CaseAxis {
    Vec3 point = Vec3::Zero();
    Vec3 direction = Vec3::UnitZ();  ///< of length 1
};

/// Displacements that are prescribed, in one of four frames.
struct Support {
    /// x, y, z; or along the normal of the surface, outwards, of each patch by itself; or along a direction; or away
    /// from an axis, along it, and around it (as a length, counter-clockwise seen against its direction).
    enum class Frame { global, normal, direction, cylinder };

    std::string name;  ///< in the report; by default that of its selection
    SurfaceSelection where;
    std::array<std::optional<double>, 3> displacement;  ///< one at least; for `normal`, `direction` only the first
    Frame frame = Frame::global;
    Vec3 direction = Vec3::UnitX();  ///< of length 1
    CaseAxis axis;
};

/// An elastic support: forces against the displacement of a surface, without anything behind it that could move.
struct Spring {
    std::string name;
    SurfaceSelection where;         ///< not a point
    std::optional<double> normal;   ///< > 0; force per area and displacement, along the normal
    Vec3 stiffness = Vec3::Zero();  ///< >= 0; along x, y, z, where `normal` is not given
};

/// Forces on the surface. Exactly one of pressure, traction and force is given.
struct Load {
    std::string name;
    std::string load_case;  ///< empty: all cases
    SurfaceSelection where;
    std::optional<double> pressure;  ///< force per area, into the body
    std::optional<Vec3> traction;    ///< force per area
    std::optional<Vec3> force;       ///< the sum, spread evenly over the area
};

/// A field of acceleration that pulls at all masses.
struct Gravity {
    Vec3 acceleration = Vec3::Zero();
    std::string load_case;  ///< empty: all cases
};

/// The centrifugal load in a frame that turns with the body.
struct Rotation {
    CaseAxis axis;
    double omega = 0;  ///< radians per time
    std::string load_case;
};

/// A difference of temperature to the state without stress: everywhere, or in the materials or regions that are named.
struct Temperature {
    double difference = 0;
    std::vector<std::string> materials, regions;
    std::string load_case;
};

/// A sum of the results of cases, times factors.
struct Combination {
    std::string name;
    std::vector<std::pair<std::string, double>> factors;  ///< cases by their names, ascending
};

/// A material and its place: regions of the mesh, parts of the run, bodies that the patches bound, or, where none is
/// named, the region of its name, else everything that has no other material.
struct MaterialUse {
    Material material;
    std::vector<std::string> regions;
    std::vector<NodeId> parts;
    std::vector<std::string> patches;
    std::string source;  ///< origin of its numbers, if that is the table (material_table.h)

    bool says_where() const { return !regions.empty() || !parts.empty() || !patches.empty(); }
};

struct SolverOptions {
    int order = 0;                             ///< of the elements: 1 or 2; 0: that of the mesh
    std::string preconditioner = "multigrid";  ///< "multigrid" or "icc"
    double rtol = 1e-8;                        ///< for SolveOutcome::residual
    int max_iterations = 10000;
    std::string petsc;            ///< further options of PETSc, for experts
    bool inertia_relief = false;  ///< motions that supports leave free are balanced by inertia
};

/// A case file: one body, one set of supports, one or more sets of loads.
struct ElasticCase {
    std::vector<MaterialUse> materials;
    std::vector<Support> supports;
    std::vector<Load> loads;
    std::vector<Gravity> gravity;
    SolverOptions solver;
    CaseUnits units = CaseUnits::unknown;
    std::vector<Spring> springs;
    std::vector<Rotation> rotations;
    std::vector<Temperature> temperatures;
    std::vector<Combination> combinations;
    std::vector<std::string> load_cases;  ///< names in the order of the file
    std::vector<std::string> notes;       ///< sentences for the user, as about values that are spelled otherwise now
    bool may_float = false;               ///< supports may leave it free without inertia relief; not of the file

    /// Returns the names of the cases in the order of the file, without combinations; a single empty one if no case has
    /// a name.
    std::vector<std::string> names() const;
};

/// Returns whether an entry for the case `of` (empty: for all cases) counts in `load_case`.
inline bool is_in_case(const std::string& of, const std::string& load_case) { return of.empty() || of == load_case; }

/// Reads a file of TOML (docs/solvers.md). Unknown tables and keys, wrong types, and values out of their ranges are
/// refused with the line and a list of the valid ones. Throws Error(io) for a file that cannot be read, else
/// Error(usage).
ElasticCase read_case(const std::string& path);

/// Throws Error(usage) if the case would have no effect: nothing loads the body and no support moves it, a material has
/// no density where weight or rotation is to act, or none expands where it is warmer. `path`: the file, for the
/// message.
void require_effect(const ElasticCase& wanted, const std::string& path);

}  // namespace kerf

// What is asked of a body: materials, supports, loads.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/types.h"
#include "solve/material.h"
#include "solve/material_table.h"

namespace kerf {

/// Triangles of the user's surface, or a vertex of it. Exactly one way of saying which.
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

    std::string name;  ///< of the report; by default what it selects
    SurfaceSelection where;
    std::array<std::optional<double>, 3> displacement;  ///< one at least; `normal` and `direction`: only the first
    Frame frame = Frame::global;
    Vec3 direction = Vec3::UnitX();  ///< of length 1
    CaseAxis axis;
};

/// An elastic support: forces against the displacement of a surface, without anything behind it that could move.
struct Spring {
    std::string name;
    SurfaceSelection where;         ///< no point
    std::optional<double> normal;   ///< >= 0; force per area and displacement along the normal
    Vec3 stiffness = Vec3::Zero();  ///< >= 0; otherwise: along x, y, z
};

/// Forces on the surface. Exactly one of them.
struct Load {
    std::string name;
    std::string load_case;  ///< empty: of all cases
    SurfaceSelection where;
    std::optional<double> pressure;  ///< force per area, into the body
    std::optional<Vec3> traction;    ///< force per area
    std::optional<Vec3> force;       ///< the sum, spread evenly over the area
};

/// A field of acceleration that pulls at all masses.
struct Gravity {
    Vec3 acceleration = Vec3::Zero();
    std::string load_case;  ///< empty: of all cases
};

/// Inertia in a frame that turns with the body.
struct Rotation {
    CaseAxis axis;
    double omega = 0;  ///< radians per time
    std::string load_case;
};

/// By how much it is warmer than where there is no stress: everywhere, or in materials or regions that are named.
struct Temperature {
    double difference = 0;
    std::vector<std::string> materials, regions;
    std::string load_case;
};

/// Results of cases, times factors, added up.
struct Combination {
    std::string name;
    std::vector<std::pair<std::string, double>> factors;  ///< cases by their names, ascending
};

/// A material, and of what: regions of the mesh, parts of the run, bodies that the patches bound, or, where nothing is
/// said, the region of its name, else everything that has no other.
struct MaterialUse {
    Material material;
    std::vector<std::string> regions;
    std::vector<NodeId> parts;
    std::vector<std::string> patches;
    std::string source;  ///< of its numbers, if they are those of the table (solve/material_table.h)

    bool says_where() const { return !regions.empty() || !parts.empty() || !patches.empty(); }
};

struct SolverOptions {
    int order = 0;                        ///< of the elements: 1 or 2; 0: that of the mesh
    std::string preconditioner = "gamg";  ///< "gamg" or "icc"
    double rtol = 1e-8;                   ///< of SolveOutcome::residual
    int max_iterations = 10000;
    std::string petsc;            ///< further options of PETSc, for experts
    bool inertia_relief = false;  ///< what supports leave free is balanced by inertia
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
    bool may_float = false;               ///< supports may leave it free, and inertia relieves nothing; not of the file

    /// Names of the cases in the order of the file; one without a name if nothing has one. Without combinations.
    std::vector<std::string> names() const;
};

/// Whether what is said for `of` (empty: for all cases) counts in the case.
inline bool is_in_case(const std::string& of, const std::string& load_case) { return of.empty() || of == load_case; }

/// Reads a file of TOML (docs/solvers.md). Unknown tables and keys, wrong types, and values out of their ranges are
/// refused with the line and the list of what there is. Throws Error(io) for a file that cannot be read, else
/// Error(usage).
ElasticCase read_case(const std::string& path);

}  // namespace kerf

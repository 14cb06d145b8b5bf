// What is asked of a body: materials, supports, loads.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/types.h"
#include "solve/material.h"

namespace kerf {

/// Triangles of the user's surface, or a vertex of it. Exactly one way of saying which.
struct SurfaceSelection {
    std::vector<std::string> patches;            ///< names; '*' stands for any characters
    std::optional<std::array<Vec3, 2>> box;      ///< low and high corner: triangles with all corners inside
    std::optional<std::array<double, 4>> plane;  ///< a, b, c, d: triangles with all corners on ax + by + cz = d
    std::optional<Vec3> point;                   ///< the nearest vertex of the surface
};

/// Displacements that are prescribed.
struct Support {
    std::string name;  ///< of the report; by default what it selects
    SurfaceSelection where;
    std::array<std::optional<double>, 3> displacement;  ///< x, y, z; one at least
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

/// A material, and of what: regions of the mesh, parts of the run, bodies that the patches bound, or, where nothing is
/// said, the region of its name, else everything that has no other.
struct MaterialUse {
    Material material;
    std::vector<std::string> regions;
    std::vector<NodeId> parts;
    std::vector<std::string> patches;

    bool says_where() const { return !regions.empty() || !parts.empty() || !patches.empty(); }
};

struct SolverOptions {
    int order = 1;                        ///< of the elements: 1 or 2
    std::string preconditioner = "gamg";  ///< "gamg" or "icc"
    double rtol = 1e-8;                   ///< of the true residual beside that of no displacement
    int max_iterations = 10000;
    std::string petsc;  ///< further options of PETSc, for experts
};

/// A case file: one body, one set of supports, one or more sets of loads.
struct ElasticCase {
    std::vector<MaterialUse> materials;
    std::vector<Support> supports;
    std::vector<Load> loads;
    std::optional<Vec3> gravity;  ///< acceleration, in all cases
    SolverOptions solver;

    /// Names of the cases in the order of the file; one without a name if no load has one.
    std::vector<std::string> names() const;
};

/// Reads a file of TOML (docs/solve.md). Unknown tables and keys, wrong types, and values out of their ranges are
/// refused with the line and the list of what there is. Throws Error(io) for a file that cannot be read, else
/// Error(usage).
ElasticCase read_case(const std::string& path);

}  // namespace kerf

// From a surface to stresses: mesh, solve, and mesh again where the error is large.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "run/report/report.h"
#include "run/request/run_request.h"
#include "solve/run/inside/solve_run.h"

namespace kerf {

struct MeshAndSolveRequest {
    RunRequest mesh;         ///< all but its output
    SolveRequest solve;      ///< all but its folder; `output` is that of everything
    std::int32_t steps = 0;  ///< meshes after the first one, at most
};

/// One mesh and its results.
struct MeshAndSolveStep {
    std::string mesh, solution;  ///< folders
    std::int64_t tets = 0, nodes = 0;
    double relative_error = 0;  ///< estimated, in the energy norm; the largest of the cases
    double von_mises = 0;       ///< the largest of the cases
    double mesh_seconds = 0, solve_seconds = 0;
};

/// Told each step as soon as its solution is written, on every rank.
using StepDone = std::function<void(std::size_t number, const MeshAndSolveStep& step)>;

struct MeshAndSolveReport {
    std::vector<MeshAndSolveStep> steps;
    RunReport mesh;                       ///< of the last step
    std::optional<SolveReport> solution;  ///< of the last step; none if its mesh is not whole
    bool reached = false;                 ///< the target error is reached
    int exit_code = 0;
};

/// Makes OUT/mesh and OUT/solution; with steps, OUT/step_1/mesh and so on, each of which stays, and OUT/report.json. It
/// ends when the estimated error is at most solve.target_error, or after the last step; the sizes of a further mesh are
/// those that the solution before it asks for (sizes_for_error()) and no larger than the options say. Collective;
/// throws as run() and solve_run() do, and Error(io) for a folder with anything else in it. Results of an earlier run
/// of this kind there are removed when this one has ended well.
MeshAndSolveReport mesh_and_solve(const MeshAndSolveRequest& request, int cores_of_rank, MpiRanks& ranks,
                                  SolveListener* listener, const StepDone& step_done = {});

/// Returns a row of the table of the steps, for people; the first one has the head of the table above it. `number`
/// counts from 1.
std::string to_text(std::size_t number, const MeshAndSolveStep& step);

}  // namespace kerf

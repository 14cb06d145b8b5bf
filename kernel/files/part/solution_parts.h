// The parts of a finished run with the values of a solution of kerf solve.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "files/part/part.h"

namespace kerf {

/// Tells whether a report is that of kerf solve.
template <class Json>
bool is_of_solution(const Json& report) {
    return report.contains("solve") || report.contains("steps");
}

/// Returns the folder of the solution under a path: the path itself, the folder of its last step if it is of kerf solve
/// on a surface, or PATH/solution if PATH has no report; nothing if there is no solution. Throws Error(io) for a report
/// that is damaged, and Error(verification) for one that is not as it was written.
std::optional<std::string> find_solution_folder(const std::string& path);

/// Returns the run that a solution stands on. Throws Error(io) if it is not where it was, or is another one now.
std::string mesh_of_solution(const std::string& solution);

/// Returns the run for a path where only a run can be meant: the path itself, or the run of a solution there. Throws as
/// mesh_of_solution().
std::string mesh_in(const std::string& folder);

/// Returns the parts of a finished run, or of the run of a solution, with Part::values. Throws Error(io).
std::unique_ptr<PartSource> open_parts(const std::string& folder);

}  // namespace kerf

// The parts of a finished run with what kerf solve has found on them.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "part/part.h"

namespace kerf {

/// Whether a report is that of kerf solve.
template <class Json>
bool is_of_solution(const Json& report) {
    return report.contains("solve") || report.contains("steps");
}

/// The folder of the solution under a path: itself, or that of kerf solve on a surface, whose last step counts. Nothing
/// if there is none. Throws Error(io) for a report that is damaged, and Error(verification) for one that is not as it
/// was written.
std::optional<std::string> find_solution_folder(const std::string& path);

/// The run that a solution stands on. Throws Error(io) if it is not where it was, or is another one now.
std::string mesh_of_solution(const std::string& solution);

/// The run that is meant where only a run can be: itself, or that of a solution, as mesh_of_solution() throws for.
std::string mesh_in(const std::string& folder);

/// The parts of a finished run, or of the run of a solution, with Part::values. Throws Error(io).
std::unique_ptr<PartSource> open_parts(const std::string& folder);

}  // namespace kerf

// The parts of a finished run with what kerf solve has found on them.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "part/part.h"

namespace kerf {

/// The folder of the solution under a path: itself, or that of kerf solve on a surface, whose last step counts. Nothing
/// if there is none. Throws Error(io) for a report that is damaged, and
/// Error(verification) for one that is not as it was written.
std::optional<std::string> find_solution_folder(const std::string& path);

/// The run that a solution stands on. Throws Error(io) if it is not where it was, or is another one now.
std::string mesh_of_solution(const std::string& solution);

/// The parts of a finished run, or of the run of a solution, with Part::values. Throws Error(io).
std::unique_ptr<PartSource> open_parts(const std::string& folder);

}  // namespace kerf

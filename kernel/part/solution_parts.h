// The parts of a finished run with what kerf solve has found on them.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "part/run_parts.h"

namespace kerf {

/// The folder of the solution under a path: itself, or that of kerf solve on a surface, whose last step counts. Nothing
/// if there is none. Throws Error(io) for a report that is damaged.
std::optional<std::string> find_solution_folder(const std::string& path);

/// The run that a solution stands on. Throws Error(io) if it is not where it was, or is another one now.
std::string mesh_of_solution(const std::string& solution);

/// As RunParts of its mesh, but for load() and load_only() of everything, which have Part::values.
class SolutionParts : public PartSource {
 public:
    /// `folder`: of the solution. Throws Error(io) as mesh_of_solution() and RunParts do.
    explicit SolutionParts(std::string folder);

    const MeshOutline& outline() const override { return outline_; }
    Part load(std::int32_t rank) const override;
    Part load_only(std::int32_t rank, PartContent content) const override;

 private:
    std::string folder_;
    RunParts mesh_;
    MeshOutline outline_;
};

/// Those of a finished run, or of a solution on one. Throws Error(io).
std::unique_ptr<PartSource> open_parts(const std::string& folder);

}  // namespace kerf

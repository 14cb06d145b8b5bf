// The parts of a run become meshes and their files.
#pragma once

#include <cstdint>
#include <optional>

#include "files/io/run_folder.h"
#include "run/report/report.h"
#include "run/run/inside/run_context.h"
#include "run/run/inside/volume_stage.h"

namespace kerf {

/// Returns the whole surface on the root rank, before it is cut; none if no reference is wanted. Throws Error(usage)
/// there for several regions.
std::optional<Surface> surface_for_reference(const RunContext& run, const Input& input);

/// Meshes the parts that `volume` has, numbers their vertices and nodes, and writes all formats, or gives the meshes to
/// the listener of a transient run. Returns the report with all that meshes tell, but the sums over parts.
/// `surface_vertices`: the number of vertices on surfaces; `whole_surface`: that of surface_for_reference().
/// Collective; throws Error on every rank alike.
RunReport mesh_parts(const RunContext& run, const RunFolder& folder, RunReport report, VolumeStage& volume,
                     std::int64_t surface_vertices, const std::optional<Surface>& whole_surface);

}  // namespace kerf

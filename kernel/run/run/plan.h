// The plan of a run, made from the request of a user.
#pragma once

#include <optional>
#include <string>

#include "base/parallel/communicator.h"
#include "run/prepare/cells.h"
#include "run/prepare/input.h"
#include "run/prepare/stage_listener.h"
#include "run/prepare/surface_nodes.h"
#include "run/request/run_choices.h"

namespace kerf {

/// All that is decided of a run before its stages; none of it changes while they go on.
struct RunPlan {
    RunChoices choices;  ///< the request has the numbers then that depend on the surface: K, lengths in units of the
                         ///< input, the size for a number of cells
    SizeField size;      ///< wanted edge lengths over the surface that is cut, by which cuts, loads and meshers go
    RegionSizes region_sizes;             ///< of regions that have other sizes
    std::optional<FoundSize> found_size;  ///< size that was found for the number of tetrahedra that was asked for
    std::string worker_hash;  ///< hash of the program that meshes the parts; empty if nothing is meshed, or the run is
                              ///< transient
    SurfaceNodes surface_nodes = {};  ///< nodes on edges, for cells of order 2; else none

    const RunRequest& request() const { return choices.request; }
    DecomposeOptions decompose_options() const { return choices.decompose_options(size, region_sizes); }
    SizeField size_in(RegionIndex region) const { return region_sizes.of(region, size); }
    /// Returns the options of the mesher for the whole.
    MesherOptions mesher() const { return MesherOptions(request().mesher, size); }
};

/// A plan, and the surface that it is about.
struct PlannedRun {
    RunPlan plan;
    Input input;  ///< on other ranks than the first: numbers and names, and the surface only if it has several regions;
                  ///< repairs and remeshing are known to the first rank alone
};

/// Reads the surface, or takes the `surface` of the first rank instead of a file, remeshes it where that is asked for,
/// puts it on the faces of a CAD file where cells of order 2 are to have curved edges (run/prepare/surface_nodes.h),
/// and makes all choices. Throws Error on every rank alike; a run that cannot end well (check_budget()) is refused
/// before the surface is remeshed or cut.
///
/// Collective; the same plan on every rank. The first rank does the work, with the processors of all ranks of its host,
/// which sleep meanwhile.
PlannedRun plan_run(const RunRequest& request, int cores_of_rank, Communicator& ranks, StageListener* listener,
                    std::optional<Input> surface = {});

}  // namespace kerf

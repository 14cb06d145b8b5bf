// The surface of a run becomes those of its parts, and the jobs of the parts.
#pragma once

#include <vector>

#include "files/io/run_folder.h"
#include "run/report/report.h"
#include "run/run/inside/run_context.h"
#include "run/run/inside/volume_stage.h"
#include "run/run/prepare_stage.h"

namespace kerf {

struct CutParts {
    RunReport report;        ///< with the tree, all parts, and the facets that are missing or do not match
    PreparedParts prepared;  ///< with the parts of this rank
};

/// Cuts the surface of report.input, which is gone then unless it has several regions, and makes the jobs of the parts.
/// Collective; throws Error on every rank alike.
CutParts cut_into_parts(const RunContext& run, RunReport report);

/// Moves the surfaces of this rank's parts out of its memory into the folder: their jobs are written for the stage that
/// meshes, unless `volume` is null. Returns the report with all that is known of the parts by then, and with a note on
/// parts of an interrupted run that are of no use. Collective; throws Error on every rank alike.
RunReport hand_over_parts(const RunContext& run, RunFolder& folder, RunReport report, std::vector<OwnPart> own,
                          VolumeStage* volume);

/// Tells the listener of the parts and the forecast before they are meshed. Collective.
void announce_parts(const RunContext& run, const RunReport& report);

/// Writes all surfaces as one file: the whole that a run without meshes has to show. Collective; throws Error on every
/// rank alike.
void join_surfaces(const RunContext& run, const RunFolder& folder, const RunReport& report);

}  // namespace kerf

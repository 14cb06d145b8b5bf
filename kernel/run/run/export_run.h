// A finished run in further formats.
#pragma once

#include <string>
#include <vector>

#include "base/parallel/communicator.h"
#include "run/report/listener.h"

namespace kerf {

struct ExportRequest {
    std::string folder;      ///< folder of the run, or of a solution on one, whose values go into formats that hold any
    std::string formats;     ///< names of formats with commas between
    std::string output;      ///< folder for the files; empty: export/NAME in that of the run
    std::int32_t into = 0;   ///< number of pieces into which the parts are joined; 0: the parts as they are
    std::string fields;      ///< fields of cells in vtu files (parse_cell_fields())
    bool msh_ascii = false;  ///< msh as text
    std::vector<std::string> patch_types;  ///< words of parse_patch_types(), for openfoam, beside those of the run
    int threads = 1;                       ///< number of threads of each rank
    bool split_regions = false;            ///< openfoam: one mesh for each region
    int order = 0;                         ///< order of the cells: 1 or 2; 0: that of the run
};

/// The files that an export has written, and the size of the mesh in them.
struct ExportSummary {
    std::string folder;
    std::vector<RunFile> files;
    std::int32_t pieces = 0;
    std::int64_t vertices = 0, tets = 0;
    std::vector<std::string> notes = {};  ///< sentences on what the formats leave out
};

/// Writes the parts of a finished run in all formats of the request. Collective.
///
/// A single format goes into the output folder itself, several go into sub-folders with their names. The folder may
/// hold other files: those that an earlier export has listed in kerf_export.json are replaced or removed; a file of
/// anybody else in the way is refused, before anything has changed there. Without an output folder the files become
/// part of the run, and its report lists them. Files get their places when all of them are complete. Throws Error on
/// every rank alike: `io` where the folder is no finished run or cannot be written, `usage` for a format that cannot
/// hold the mesh.
ExportSummary export_run(const ExportRequest& request, Communicator& ranks, RunListener* listener);

}  // namespace kerf

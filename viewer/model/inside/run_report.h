// Reads report.json back into memory.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "viewer/model/document.h"

namespace kerf::view {

/// The contents of a report that the viewer shows.
struct RunReportFile {
    Tree tree;
    RunRequest options;  ///< options of the run, with the input's path
    std::int64_t input_facets = 0, input_vertices = 0;
    std::vector<std::string> region_names;  ///< names of the regions, where there are several
    std::vector<std::string> patch_names;   ///< empty in a report of an older version
    bool remeshed = false;                  ///< the surface that was cut is not that of the file
    double volume = 0;
    double seconds = 0;                          ///< wall clock of the whole run
    double cut_seconds = -1, mesh_seconds = -1;  ///< as in Document
    std::array<std::optional<MeasureHistogram>, 8> histograms;
    std::vector<std::string> notes;
    int exit_code = 0;
    std::optional<bool> verified;  ///< as in Document
    std::string damage;  ///< sentence on files that are missing or not as long as the run has left them; empty: none
};

/// Reads FOLDER/report.json. Throws Error(io) if it cannot be read or is no report.
RunReportFile read_report(const std::string& folder);

/// Returns whether the cuts of the tree are those of the trace, as far as their planes are known.
bool is_trace_of(const Trace& trace, const Tree& tree);

}  // namespace kerf::view

// Runs as they are read on the loader's thread, as far as the first picture needs them, and how a document tells of
// them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewer/model/file_kind.h"
#include "viewer/model/partial_run.h"
#include "viewer/model/run_report.h"
#include "viewer/model/shown.h"

namespace kerf::view {

/// A finished run.
struct OpenedRun {
    RunReportFile report;
    std::optional<Solution> solution;  ///< on it
    std::string folder, trace;         ///< the trace: where it is, if there is one
    std::vector<std::string> patch_names;
    Eigen::AlignedBox3d box;
    std::vector<RegionPlace> region_places;
};

/// One that is under way, or was interrupted.
struct OpenedPartialRun {
    RunOptions options;
    std::string folder, partial, trace;
    PartialRun state;
    std::vector<std::string> patch_names;
    Eigen::AlignedBox3d box;
    std::shared_ptr<const Soup> soup;  ///< its input, if that is there
};

/// `path`: its folder, or that of a solution on it. Throws Error(io).
OpenedRun read_run(const std::string& path);
/// Throws Error(io).
OpenedPartialRun read_partial_run(const OpenedPath& path);

/// Those of the trace, which lies at `path`; an option of another version is no reason not to show it.
RunOptions options_of(const Trace& trace, const std::string& path);

/// The tree, the numbers and the files of a finished run; a trace stays if its cuts are those of the run.
void complete_from_report(OpenedRun run, Shown& shown);
/// The surface that was read: its patches and its size.
void set_input(const Soup& soup, Document& document);
/// The surface that was cut.
void set_input(const Trace& trace, Document& document);
/// Document::remeshed, for its options; without its file there is nothing to compare with.
void note_remeshing(bool remeshed, Document& document);
/// A run of the surface that is open repeats those of its reader.
void add_note(const std::string& note, Document& document);

}  // namespace kerf::view

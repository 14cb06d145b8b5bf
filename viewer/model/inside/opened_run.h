// Reads runs on the loader's thread, as far as the first picture needs them, and fills a document with them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewer/model/file_kind.h"
#include "viewer/model/inside/partial_run.h"
#include "viewer/model/inside/run_report.h"
#include "viewer/model/inside/shown.h"

namespace kerf::view {

/// A finished run.
struct OpenedRun {
    RunReportFile report;
    std::optional<Solution> solution;  ///< the solution on it that was opened, if one was
    std::string folder, trace;         ///< trace: the path of its trace, or empty
    std::vector<std::string> patch_names;
    Eigen::AlignedBox3d box;
    std::vector<RegionPlace> region_places;
};

/// A run that is under way, or was interrupted.
struct OpenedPartialRun {
    RunOptions options;
    std::string folder, partial, trace;
    PartialRun state;
    std::vector<std::string> patch_names;
    Eigen::AlignedBox3d box;
    std::shared_ptr<const Soup> soup;  ///< the content of its input, if that is there; else null
};

/// Reads a finished run. `path` is its folder, or that of a solution on it. Throws Error(io).
OpenedRun read_run(const std::string& path);
/// Reads a run that is under way, or was interrupted. Throws Error(io).
OpenedPartialRun read_partial_run(const OpenedPath& path);

/// Returns the options of the trace, which lies at `path`. Options that this version does not know are left out, so
/// that the trace of another version is shown, too.
RunOptions options_of(const Trace& trace, const std::string& path);

/// Fills a document with the tree, the numbers and the files of a finished run. Its trace stays: the caller drops one
/// whose cuts are not those of the run (is_trace_of()).
void complete_from_report(OpenedRun run, Shown& shown);
/// Fills a document with the patches and the size of the surface that was read.
void set_input(const Soup& soup, Document& document);
/// Fills a document with box, patches, regions, size and volume of the surface that was cut.
void set_input(const Trace& trace, Document& document);
/// Sets Document::remeshed by the options of the document; without its input file there is nothing to compare with.
void note_remeshing(bool remeshed, Document& document);
/// Adds a note, unless the document has it: a run of the open surface repeats the notes of the surface's reader.
void add_note(const std::string& note, Document& document);

}  // namespace kerf::view

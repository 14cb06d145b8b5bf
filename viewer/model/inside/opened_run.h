// Reads runs on the loader's thread, as far as the first picture needs them, and fills a document with them.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "viewer/model/file_kind.h"
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
    Array<RegionIndex, RegionPlace> region_places;
};

/// The state of the folder DIR.kerf-partial.
struct PartialRun {
    bool exists = false;
    bool is_alive = false;   ///< its process lives, or runs on another host, where nobody can tell
    std::set<NodeId> parts;  ///< parts that are cut out: their surfaces are there
    std::set<NodeId> taken;  ///< parts that are, or were, meshed in this run
    std::set<NodeId> finished;
    std::set<NodeId> failed;
    std::vector<TreeRow> outcomes;  ///< tets and seconds of finished parts that were not known before

    bool is_at_the_same(const PartialRun& o) const {
        return exists == o.exists && is_alive == o.is_alive && parts == o.parts && taken == o.taken &&
               finished == o.finished && failed == o.failed;
    }
};

/// A run that is under way, or was interrupted.
struct OpenedPartialRun {
    RunRequest options;
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

/// Reads the state of a folder DIR.kerf-partial. `known` are finished parts whose outcome need not be read. Files that
/// cannot be read are passed over.
PartialRun look_at_partial_run(const std::string& partial, const std::set<NodeId>& known);

/// Returns the parts that workers have taken.
std::set<NodeId> parts_taken(const std::string& partial);

/// Returns the options of the trace, which lies at `path`. Options that this version does not know are left out, so
/// that the trace of another version is shown, too.
RunRequest options_of(const Trace& trace, const std::string& path);

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

// Parts to files of all formats, by the threads of all ranks.
#pragma once

#include <functional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "base/parallel/communicator.h"
#include "files/export/format.h"
#include "run/report/listener.h"

namespace kerf {

/// A format and the place of its files.
struct FormatPlace {
    const Format* format;
    std::string sub_folder;  ///< path below the folder of the whole export; may be empty
};

/// Returns the places of formats in a run folder: export/NAME, but for `vtu` the folder itself.
std::vector<FormatPlace> places_in_run_folder(const std::vector<const Format*>& formats);

/// Returns whether vtu is among the formats, which holds all that the store of a part does.
bool has_vtu(const std::vector<const Format*>& formats);

/// The place of an export and its options, as ExportFiles takes them.
struct WriteTarget {
    std::string folder;
    std::string place = "";
    std::set<std::string> own = {};
    FormatOptions options = {};
};

/// Is told of each part that is written in all formats, by its index in the outline: it is not loaded again, if its
/// formats ask for no other part (Format::asks_for_one_part). From any thread; may throw Error.
using PartWritten = std::function<void(PartIndex)>;

/// Writes all parts in all formats below the folder of the target. Collective: every rank writes its share of the parts
/// with so many `threads`, each of which holds one part at a time; files that belong to no part, and formats that are
/// read in one piece, are written by the root rank. Returns the files that were written, with paths relative to the
/// folder, on every rank; with sizes and hashes on the root rank. The bytes depend on the parts alone. Throws Error on
/// every rank alike.
std::vector<RunFile> write_parts(Communicator& ranks, const PartSource& parts, std::span<const FormatPlace> formats,
                                 const WriteTarget& target, int threads, RunListener* listener,
                                 const PartWritten& part_written = {});

}  // namespace kerf

// A surface file repaired for its own sake, and written to another file.
#pragma once

#include <optional>
#include <string>

#include "run/prepare/input.h"
#include "run/prepare/inside/repair_measures.h"
#include "run/prepare/remedy.h"
#include "run/prepare/stage_listener.h"
#include "run/request/input_options.h"

namespace kerf {

/// Report on a repair by repair_file().
struct RepairedFile {
    std::string input, output;
    CheckedSoup checked;           ///< the result; the diagnosis is empty if it can be meshed
    RepairMeasures measures;       ///< comparison of the result with the files as they were read
    OrientationReport turned;      ///< facets turned in a result that can be meshed
    bool can_be_meshed = false;    ///< the result, as it was written
    bool is_unchanged = false;     ///< nothing was found to be repaired
    bool is_copy = false;          ///< the output has the bytes of the input, too
    std::optional<Remedy> remedy;  ///< a way out where the result cannot be meshed

    /// Returns the value of an ErrorCode, 0 for a result that can be meshed.
    int exit_code() const { return can_be_meshed ? 0 : static_cast<int>(ErrorCode::input); }
};

/// Repairs a file and InputOptions::more_files as `options` ask, and writes the result to `output`, whether it can be
/// meshed or not: an .obj with patches, of several regions with a closed group for each instead, or an .stl. Where
/// nothing was to be repaired, a file of the same ending is copied. `listener` may be null. Throws Error, before the
/// work where the output cannot be written, and before it is written where an .stl, whose coordinates have 7 digits,
/// would have new defects.
RepairedFile repair_file(const std::string& input, const InputOptions& options, const std::string& output,
                         StageListener* listener = nullptr);

}  // namespace kerf

// The defects of a surface file, as values, text and JSON.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "run/prepare/input.h"
#include "run/prepare/remedy.h"
#include "run/report/patch_summary.h"

namespace kerf {

inline constexpr NumberRange needle_angle_range = {"0 (no needles) to 60 degrees", 0, 60};

/// The wall that a region has in common with another one.
struct CommonWall {
    std::string region;  ///< name of the other region
    double area = 0;
    RegionIndex number;  ///< number of the other region
};

/// The measures of one region of a surface.
struct RegionSummary {
    std::string name;
    double volume = 0;
    std::int64_t shells = 0;
    double outer_area = 0;          ///< area of the facets with nothing on their other side
    std::vector<CommonWall> walls;  ///< its walls, in the order of the other regions
};

/// The reason why there is no surface to be diagnosed.
struct RefusedFile {
    std::string kind;  ///< "unreadable", "wrong row", "open region", "misplaced region", or that of a SolidDefect
    Error error;
};

struct FileDiagnosis {
    std::string path;
    CheckedSoup checked;
    Array<RegionIndex, RegionSummary> regions;  ///< regions of a surface that can be meshed; empty if it has none
    std::optional<RefusedFile> refused;         ///< reason of a refusal; `checked` is empty then
    std::optional<Remedy> remedy = {};          ///< remedy, if one was looked for

    bool can_be_meshed() const { return !refused && checked.diagnosis.clean(); }
    /// Returns a value of ErrorCode; 0: the file can be meshed.
    int exit_code() const;
};

/// Reads and diagnoses a file. A reader stops at the first thing that it does not understand, or of which it cannot
/// make a surface: the file is refused then. Throws Error for a file that cannot be opened, and Error(usage) for
/// options out of range. `check_cancelled`: see check_files(); it must not throw Error(input).
FileDiagnosis diagnose_file(const std::string& path, const InputOptions& options = {}, double needle_angle_deg = 1,
                            const std::function<void()>& check_cancelled = {});

/// Diagnoses a surface of arrays, see check_arrays(). Throws like diagnose_file(), and Error(usage) for sizes that do
/// not fit.
FileDiagnosis diagnose_arrays(Soup soup, const InputOptions& options = {}, double needle_angle_deg = 1,
                              const std::function<void()>& check_cancelled = {});

/// Returns one sentence on a defect: its kind, its place, and the way to mend it.
std::string defect_text(const Defect& defect, const Soup& soup);

/// Returns a line or several for each kind of defect: the ten worst ones, and the way to mend them; of all, or of
/// errors alone.
std::string defects_text(const CheckedSoup& checked, bool errors_only = false);

/// Returns a JSON object with every defect, its numbers those of the file, and the way to mend it.
std::string to_json(const FileDiagnosis& found);

/// Returns lines for people: counts, extent, area and volume, the ten worst defects of each kind, the ways to mend
/// them, the verdict.
std::string to_text(const FileDiagnosis& found);

/// Returns a table with a line for each region of the file, one with a line for each wall, and for each region the
/// option --region with a point inside of it; names are last. Throws the Error for which the file was refused or cannot
/// be meshed.
std::string tables_of_regions(const FileDiagnosis& found);

/// Returns the patches that a run would have: those of the file, or those that InputOptions::feature_angle_deg makes.
/// Throws the Error for which the file was refused, and Error(input) where a surface that cannot be meshed is to be
/// divided by an angle.
std::vector<PatchSummary> patches_of_run(FileDiagnosis found, const InputOptions& options);

}  // namespace kerf

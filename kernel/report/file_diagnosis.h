// What is wrong with a surface file, as values, text and JSON.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "prepare/input.h"
#include "prepare/remedy.h"
#include "report/patch_summary.h"
#include "report/region_summary.h"

namespace kerf {

inline constexpr NumberRange needle_angle_range = {"0 (no needles) to 60 degrees", 0, 60};

/// Why there is no surface to be diagnosed.
struct RefusedFile {
    std::string kind;  ///< "unreadable", "wrong row", "open region", "misplaced region", or that of a SolidDefect
    Error error;
};

struct FileDiagnosis {
    std::string path;
    CheckedSoup checked;
    std::vector<RegionSummary> regions;  ///< if there are any, of a surface that can be meshed
    std::optional<RefusedFile> refused;  ///< if there is one, `checked` is empty
    std::optional<Remedy> remedy = {};   ///< if it was looked for

    bool can_be_meshed() const { return !refused && checked.diagnosis.clean(); }
    /// Value of ErrorCode, 0: it can be meshed.
    int exit_code() const;
};

/// Reads and diagnoses a file. A reader stops at the first thing that it does not understand, or of which it cannot
/// make a surface: the file is refused then. Throws Error for a file that cannot be opened, and Error(usage) for
/// options out of range. `poll`: as of check_files(); what it throws must be no Error(input).
FileDiagnosis diagnose_file(const std::string& path, const InputOptions& options = {}, double needle_angle_deg = 1,
                            const std::function<void()>& poll = {});

/// The same of arrays, see check_arrays(). Throws Error(usage) for sizes that do not fit, too.
FileDiagnosis diagnose_arrays(Soup soup, const InputOptions& options = {}, double needle_angle_deg = 1,
                              const std::function<void()>& poll = {});

/// What it is, where, and what to do about it, in one sentence.
std::string defect_text(const Defect& defect, const Soup& soup);

/// A line or several for each kind of defect, the ten worst of it and what to do; of all, or of errors alone.
std::string defects_text(const CheckedSoup& checked, bool errors_only = false);

/// An object with every defect, its numbers those of the file, and what to do about it.
std::string to_json(const FileDiagnosis& found);

/// Lines for people: counts, the ten worst defects of each kind, what to do, the verdict.
std::string to_text(const FileDiagnosis& found);

/// What region_tables() says of them. Throws Error: why the file was refused, or cannot be meshed.
std::string tables_of_regions(const FileDiagnosis& found);

/// The patches that a run would have: those of the file, or those that InputOptions::feature_angle_deg makes. Throws
/// Error: why the file was refused, or that only a surface that can be meshed is divided by an angle.
std::vector<PatchSummary> patches_of_run(FileDiagnosis found, const InputOptions& options);

}  // namespace kerf

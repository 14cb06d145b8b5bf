// The defects of a soup of one body or several.
#pragma once

#include <string>
#include <vector>

#include "base/core/error.h"
#include "run/prepare/input.h"
#include "run/prepare/input_files.h"

namespace kerf {

/// Error(input) for names or points of regions that do not fit facets which are as they should be.
class MisplacedRegion : public Error {
 public:
    static constexpr const char* kind = "misplaced region";
    explicit MisplacedRegion(const std::string& message) : Error(ErrorCode::input, message) {}
};

/// Diagnoses the soup, finds its regions where it does not say which it bounds (surface/regions/region_finder.h), and
/// looks for gaps between bodies (surface/diagnosis/given_bodies.h). Where bodies that are known, by files or because
/// each patch is closed by itself, cannot be regions, each of them is diagnosed by itself, and so are the places where
/// two do not fit. `files`: without its soup. Throws MisplacedRegion, naming regions and places, for points of regions
/// and for names of walls.
void diagnose_regions(CheckedSoup& checked, const InputFiles& files, const DiagnosisOptions& options,
                      bool voids_are_regions);

/// Returns a note on each gap for a run that goes on.
std::vector<std::string> notes_on_gaps(const CheckedSoup& checked);

}  // namespace kerf

// What is wrong with a soup of one body or several.
#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "prepare/input.h"
#include "prepare/input_files.h"

namespace kerf {

/// What is said of regions does not fit the facets, which are as they should be.
class MisplacedRegion : public Error {
 public:
    static constexpr const char* kind = "misplaced region";
    explicit MisplacedRegion(const std::string& message) : Error(ErrorCode::input, message) {}
};

/// Diagnoses the soup, finds its regions where it does not say what it bounds (surface/region_finder.h), and looks for
/// gaps between bodies (surface/given_bodies.h). Where bodies that are known, by files or because each patch is closed
/// by itself, cannot be regions, each of them is diagnosed by itself, and where two do not fit. `files`: without its
/// soup. Throws MisplacedRegion, naming regions and places, for points of regions and for names of walls.
void diagnose_regions(CheckedSoup& checked, const InputFiles& files, const DiagnosisOptions& options,
                      bool voids_are_regions);

/// What a run that goes on says about each gap.
std::vector<std::string> notes_on_gaps(const CheckedSoup& checked);

}  // namespace kerf

// kerf check: what is wrong with a surface.
#pragma once

#include <string>

#include "report/file_diagnosis.h"

namespace kerf {

struct CheckRequest {
    std::string path;
    InputOptions options;
    double needle_angle_deg = 1;
    bool json = false;
    bool list_patches = false;   ///< in place of the diagnosis
    std::string offenders_file;  ///< VTU of the offending facets and vertices; empty: none
};

/// Prints counts, the ten worst of each kind and what to do, or with `json` every defect, to standard output. Returns 0
/// for a surface that can be meshed, else 3, also for one that cannot be parsed, whose defect is "unreadable" then, and
/// for solids of a CAD file of which no surface can be made: their defect is the kind of a SolidDefect.
/// Throws Error for a file that cannot be opened or written.
int check_surface(const CheckRequest& request);

}  // namespace kerf

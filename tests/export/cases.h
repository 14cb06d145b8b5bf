// Runs with what formats stumble over: every format has its laws checked on all of them.
#pragma once

#include <string>
#include <vector>

#include "surface/soup/soup.h"

namespace kerf::test {

struct ExportCase {
    std::string name;
    Soup surface;
    std::int32_t parts = 1;
    bool straight_cuts = false, cut_by_volume = false;
};

/// One part; two solids with names that need care; 300 patches; voids; straight cuts; 64 parts, of which some have no
/// triangle on a patch and some touch at an edge or a vertex only.
const std::vector<ExportCase>& export_cases();

/// The folder of the finished run of a case, in the default format or those of the list. It is meshed when it is first
/// asked for and removed when the program ends.
std::string run_of(const ExportCase& wanted, const std::string& formats = "");

}  // namespace kerf::test

// kerf quality: how good the cells of a mesh are, alone or beside another one.
#pragma once

#include <string>

namespace kerf {

struct QualityRequest {
    std::string mesh;        ///< folder of a run, or a file
    std::string compare;     ///< the other one; empty: none
    bool json = false;       ///< to standard output in place of the tables
    bool verbose = false;    ///< all tables and histograms
    std::string picture;     ///< SVG; empty: none
    std::string fail_below;  ///< limits as parse_limits() reads them
    std::string fail_above;
};

/// Returns the exit code: that of the quality gate if the mesh misses a limit. Throws Error.
int show_quality(const QualityRequest& request);

}  // namespace kerf

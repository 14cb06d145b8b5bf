// The names of a run as its report has them.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace kerf {

struct RunNames {
    std::vector<std::string> patches;  ///< empty: the report is of an older version, and each file of a part has all
    std::vector<std::string> regions;  ///< empty if there is one region
    std::vector<std::string> patch_types;  ///< the words NAME=TYPE of --patch-type that the run was given

    /// Reads the names from a report; exceptions of the JSON pass.
    static RunNames of_report(const nlohmann::json& report);
};

}  // namespace kerf

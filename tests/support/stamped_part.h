// A report as if a mesher had stamped cells.
#pragma once

#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "support/file_contents.h"

namespace kerf::test {

/// Has a report say that so many cells of its first part are of the core.
inline void stamp_first_part(const std::string& report, std::int64_t core_tets) {
    std::string text = bytes_of_file(report);
    const std::size_t at = text.find("\"surface_volume\":");  // only parts have it
    ASSERT_NE(at, std::string::npos);
    text.insert(at, "\"way\": \"core and shell\", \"core_tets\": " + std::to_string(core_tets) + ", ");
    std::ofstream(report) << text;
}

}  // namespace kerf::test

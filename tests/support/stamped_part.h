// A report as if a mesher had stamped cells.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "files/io/text_file.h"
#include "support/file_contents.h"
#include "support/sealed_run.h"

namespace kerf::test {

/// Has a report say that so many cells of its first part are of the core.
inline void stamp_first_part(const std::string& folder, std::int64_t core_tets) {
    const std::string report = folder + "/report.json";
    std::string text = bytes_of_file(report);
    const std::size_t at = text.find("\"surface_volume\":");  // only parts have it
    ASSERT_NE(at, std::string::npos);
    text.insert(at, "\"way\": \"core and shell\", \"core_tets\": " + std::to_string(core_tets) + ", ");
    write_text_file(report, text);
    seal_run(folder);
}

}  // namespace kerf::test

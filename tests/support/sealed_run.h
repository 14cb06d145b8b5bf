// A folder that a test has made or changed, sealed as if a run had left it.
#pragma once

#include <string>

namespace kerf::test {

/// The report of the folder lists all files that lie there now, and carries its own hash.
void seal_run(const std::string& folder);

}  // namespace kerf::test

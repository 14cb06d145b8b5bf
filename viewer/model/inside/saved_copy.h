// Makes a temporary run one that stays.
#pragma once

#include <string>

namespace kerf::view {

/// Copies the finished run in `folder` to `path`, which appears complete or not at all, and its trace, if there is one,
/// beside it, to its name and ".trace". Only a run of Kerf and a trace are ever replaced. Returns the absolute path of
/// the run, which is `path`.failed for one with failed parts if a valid one has that name. Throws Error(io).
std::string copy_run(const std::string& folder, const std::string& trace, const std::string& path);

}  // namespace kerf::view

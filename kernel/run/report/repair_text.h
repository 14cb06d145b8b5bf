// Repairs for people.
#pragma once

#include <string>

#include "run/prepare/remedy.h"
#include "run/prepare/repaired_file.h"

namespace kerf {

/// Returns the command that does a remedy, for a shell, with all files and options: "kerf repair a.stl b.stl -o
/// a_repaired.obj --repair near". `path`: the first file.
std::string command_of(const Remedy& remedy, const std::string& path);

/// Returns two lines: the remedy, with its losses, and the command.
std::string to_text(const Remedy& remedy, const std::string& path);

/// Returns lines: the steps, how far anything moved, volume and area before and after, the defects that are left, the
/// verdict.
std::string to_text(const RepairedFile& repaired);

}  // namespace kerf

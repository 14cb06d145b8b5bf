// Repairs for people.
#pragma once

#include <string>

#include "prepare/remedy.h"
#include "prepare/repaired_file.h"

namespace kerf {

/// The command that does it, for a shell, with all files and options: "kerf repair a.stl b.stl -o a_repaired.obj
/// --repair near". `path`: the first file.
std::string command_of(const Remedy& remedy, const std::string& path);

/// Lines: what would do, and the command.
std::string to_text(const Remedy& remedy, const std::string& path);

/// Lines: the steps, how far anything moved, volume and area before and after, what is left, the verdict.
std::string to_text(const RepairedFile& repaired);

}  // namespace kerf

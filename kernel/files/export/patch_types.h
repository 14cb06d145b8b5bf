// The types of patches for formats that have them: OpenFOAM's boundaries.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace kerf {

struct PatchType {
    std::string patch;  ///< name, in which '*' stands for any characters
    std::string type;
};

/// Reads texts NAME=TYPE, split at the last =. Throws Error(usage) for another form, and for a type that is none of
/// those of OpenFOAM that need no entries of their own.
std::vector<PatchType> parse_patch_types(std::span<const std::string> texts);

/// Throws Error(usage), with the names that there are, for a name that matches none of the patches.
void require_patches(std::span<const PatchType> types, std::span<const std::string> patch_names);

/// Checks a request for --split-regions. Throws Error(usage) if there are less than two regions.
void require_regions(std::size_t count);

/// Returns the type of a patch: the last one given for its name, else `patch`.
std::string type_of_patch(std::span<const PatchType> types, const std::string& patch);

}  // namespace kerf

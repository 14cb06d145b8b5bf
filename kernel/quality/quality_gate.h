// Limits that a mesh must keep.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "quality/measured_mesh.h"

namespace kerf {

/// What the worst cell or boundary triangle may have.
struct QualityLimit {
    std::string measure;  ///< "min-dihedral", "shape", ...: see limit_names()
    double value = 0;
};

/// A measure as options name it: "min_dihedral_deg" is min-dihedral.
std::string option_name(const Measure& measure);

/// Which end of a measure is bad.
enum class BadEnd { small, large };

/// The measures that are bad at this end: "min-dihedral, shape, volume, min-edge, unforced-dihedral, min-angle".
std::string limit_names(BadEnd end);

/// Limits of a list "min-dihedral=5,shape=0.01"; an empty list has none. Throws Error(usage) for what is no such list,
/// and for a measure that is bad at the other end.
std::vector<QualityLimit> parse_limits(std::string_view list, BadEnd end);

/// A sentence for every limit that the mesh misses: "The worst smallest dihedral angle is 3.21 deg, below the limit
/// 5."; of several regions another one says in which the cell is.
std::vector<std::string> missed_limits(const MeshQuality& quality, const std::vector<QualityLimit>& limits, BadEnd end);

}  // namespace kerf

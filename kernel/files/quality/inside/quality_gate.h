// The limits of quality that a mesh must keep.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "files/quality/inside/measured_mesh.h"

namespace kerf {

/// A limit for the worst cell or boundary triangle.
struct QualityLimit {
    std::string measure;  ///< "min-dihedral", "shape", ...: see limit_names()
    double value = 0;
};

/// Returns the name of a measure in options: "min_dihedral_deg" is min-dihedral.
std::string option_name(const Measure& measure);

/// The end of a measure at which its values are bad.
enum class BadEnd { small, large };

/// Returns the measures that are bad at this end: "min-dihedral, shape, volume, min-edge, unforced-dihedral,
/// min-angle".
std::string limit_names(BadEnd end);

/// Parses a list of limits "min-dihedral=5,shape=0.01"; an empty list has none. Throws Error(usage) for a text that is
/// no such list, and for a measure that is bad at the other end.
std::vector<QualityLimit> parse_limits(std::string_view list, BadEnd end);

/// Returns a sentence for every limit that the mesh misses: "The worst smallest dihedral angle is 3.21 deg, below the
/// limit 5."; for several regions another sentence names the one of that cell.
std::vector<std::string> missed_limits(const MeshQuality& quality, const std::vector<QualityLimit>& limits, BadEnd end);

}  // namespace kerf

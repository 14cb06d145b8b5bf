// The quality of a mesh, alone or beside that of another one, and the limits that it misses.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/quality/inside/measured_mesh.h"
#include "files/quality/quality_text.h"

namespace kerf {

struct ComparedQuality {
    MeshQuality mesh;
    std::optional<MeshQuality> other;
};

/// Measures a mesh, the folder of a run or a file (MeasurableMesh), and with the same length scale another one, unless
/// its path is empty. Throws Error(io) or Error(input).
ComparedQuality compare_quality(const std::string& mesh, const std::string& other = "");

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

/// Limits that the worst cells and boundary triangles must keep.
struct QualityGate {
    std::vector<QualityLimit> below, above;

    /// Parses the limits of --fail-below and --fail-above, lists as parse_limits() takes them. Throws Error(usage).
    static QualityGate parse(std::string_view fail_below, std::string_view fail_above);
    /// Returns a sentence for every limit that the mesh misses.
    std::vector<std::string> missed_by(const MeshQuality& quality) const;
};

/// Returns the quality of the mesh as JSON (quality_json.h), with "compared_with", if there is another one, and
/// "missed_limits".
std::string to_json(const ComparedQuality& quality, const std::vector<std::string>& missed);

/// Returns the tables of quality_text.h.
std::string to_text(const ComparedQuality& quality, QualityDetail detail);

/// Returns the sheet of quality_sheet.h (SVG).
std::string to_picture(const ComparedQuality& quality);

}  // namespace kerf

// The quality of a mesh, alone or beside that of another one, and the limits that it misses.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "files/quality/inside/measured_mesh.h"
#include "files/quality/inside/quality_gate.h"
#include "files/quality/quality_text.h"

namespace kerf {

struct ComparedQuality {
    MeshQuality mesh;
    std::optional<MeshQuality> other;
};

/// Measures a mesh, the folder of a run or a file (MeasurableMesh), and with the same length scale another one, unless
/// its path is empty. Throws Error(io) or Error(input).
ComparedQuality compare_quality(const std::string& mesh, const std::string& other = "");

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

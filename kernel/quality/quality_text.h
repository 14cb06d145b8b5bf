// Quality as tables of text.
#pragma once

#include <string>

#include "quality/measured_mesh.h"

namespace kerf {

enum class QualityDetail {
    brief,  ///< counts, and percentiles over all cells, of the angles that are forced, if any, and of the smallest
            ///< angles of several regions, of more than ten those with the worst cells
    all
};

/// Counts; percentiles of every measure over all cells, of the smallest angles of those that the surface forces and of
/// those that it does not; of every measure over cells with a vertex on an interface, over the others, and of the
/// angles of boundary triangles; then a histogram of each measure in two columns. Ends with a line end.
std::string quality_text(const MeshQuality& quality, QualityDetail detail = QualityDetail::all);

/// Percentiles of two meshes line by line, with those of angles that are not forced where one has others, then for each
/// measure their distributions and accumulated distributions side by side. Both must have been measured with one length
/// scale, else throws Error(internal).
std::string comparison_text(const MeshQuality& first, const MeshQuality& second,
                            QualityDetail detail = QualityDetail::all);

/// A number with four digits.
std::string four_digits(double value);

}  // namespace kerf

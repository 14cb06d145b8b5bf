// Writes quality as tables of text.
#pragma once

#include <string>

#include "files/quality/inside/measured_mesh.h"

namespace kerf {

enum class QualityDetail {
    brief,  ///< counts; percentiles over all cells, of forced angles if there are any, and of the smallest angles of
            ///< several regions, of more than ten only those with the worst cells
    all
};

/// Returns counts; percentiles of every measure over all cells, of the smallest angles of the cells that the surface
/// forces and of those that it does not; of every measure over cells with a vertex on an interface, over the others,
/// and of the angles of boundary triangles; then a histogram of each measure in two columns. Ends with a line end.
std::string quality_text(const MeshQuality& quality, QualityDetail detail = QualityDetail::all);

/// Returns percentiles of two meshes line by line, with those of angles that are not forced if either mesh has forced
/// ones, then for each measure their distributions and accumulated distributions side by side. Both must have been
/// measured with one length scale, else throws Error(internal).
std::string comparison_text(const MeshQuality& first, const MeshQuality& second,
                            QualityDetail detail = QualityDetail::all);

/// Returns a number with four digits.
std::string four_digits(double value);

}  // namespace kerf

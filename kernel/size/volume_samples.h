// How many tetrahedra a size field wants inside of a surface.
#pragma once

#include <vector>

#include "size/size_field.h"
#include "surface/surface.h"

namespace kerf {

/// A point inside of a closed surface, which stands for a share of its volume in units of the reference volume's cells:
/// the volume that would hold as many tetrahedra if all were as small as the smallest.
struct VolumeSample {
    Vec3 point;
    double sized_volume;
};

/// Samples whose sum approximates the integral of reference_volume() / max_volume_at() over the body, by the centres of
/// about 10,000 cells of an octree, split where the field may want most tetrahedra. Over the bodies and fields of the
/// tests the sum is within 5 % of the integral. A body so thin that few samples lie inside has its exact volume; where
/// there is none, one at the mean of its corners stands for it. The field must not be empty, nor constant.
/// Deterministic. O(#F log #F).
std::vector<VolumeSample> sample_volume(const SizeField& field, const std::vector<Vec3>& vertices,
                                        const std::vector<Triangle>& facets);

/// The integral itself. Of a constant field it is `volume`, the enclosed one, as it is given.
double sized_volume(const SizeField& field, const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                    double volume);

}  // namespace kerf

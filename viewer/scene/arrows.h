// Vectors as arrows.
#pragma once

#include <memory>
#include <vector>

#include "viewer/model/camera.h"
#include "viewer/scene/layer.h"

namespace kerf::view {

/// A vector and where it is drawn. Coordinates of the file.
struct Arrow {
    Vec3 from = Vec3::Zero(), along = Vec3::Zero();
    Vec3 rest = Vec3::Zero();  ///< of `from` when nothing is deformed, by which some of many are chosen
};

/// How long the longest is drawn.
double longest_arrow(double diagonal);

/// At most some hundreds of them, about evenly spread: of each cube of a grid over all space that has any, the one
/// nearest to its middle, the first of these. Sides of cubes are a fourteenth of the diagonal of the body. O(n log n).
std::vector<Arrow> spread(const std::vector<Arrow>& arrows, double diagonal);

/// Shaft and head of each: one of length `longest` is as long as longest_arrow() says, others as they are shorter;
/// of what is not known (0) the longest of them is it. Nothing of those below a hundredth of that.
std::shared_ptr<Geometry> arrow_segments(const std::vector<Arrow>& arrows, double longest, double diagonal,
                                         const Frame& frame);

}  // namespace kerf::view

// Draws vectors as arrows.
#pragma once

#include <memory>
#include <vector>

#include "viewer/model/camera.h"
#include "viewer/scene/layer.h"

namespace kerf::view {

/// A vector and the place where it is drawn, in coordinates of the file.
struct Arrow {
    Vec3 from = Vec3::Zero(), along = Vec3::Zero();
    Vec3 rest = Vec3::Zero();  ///< place of `from` when nothing is deformed; some of many arrows are chosen by it
};

/// Returns the length of the longest arrow that is drawn, for the diagonal of the body.
double longest_arrow(double diagonal);

/// Returns at most some hundreds of the arrows, about evenly spread: for each cube of a grid over all space that has
/// any, the one nearest to its middle, and of equally near ones the first. Cubes have sides of a fourteenth of the
/// diagonal of the body. O(n log n).
std::vector<Arrow> spread(const std::vector<Arrow>& arrows, double diagonal);

/// Returns shaft and head of each arrow. A vector of length `longest` is drawn as long as longest_arrow() says, others
/// in proportion; if `longest` is not known (0) it is the length of the longest of these vectors. Vectors up to a
/// hundredth of it are left out.
std::shared_ptr<Geometry> arrow_segments(const std::vector<Arrow>& arrows, double longest, double diagonal,
                                         const Frame& frame);

}  // namespace kerf::view

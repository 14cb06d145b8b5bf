// The pieces of isolines that are seen.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "viewer/model/camera.h"
#include "viewer/scene/layer.h"

namespace kerf::view {

/// A piece of an isoline on the picture, in pixels.
struct SeenSegment {
    float value = 0;  ///< value of the isoline
    Eigen::Vector2f from, to;
};

/// Returns the segments with Geometry::origins whose middle lies on a pixel that shows their triangle, or next to one.
/// `ids`: four numbers for each pixel of the viewport, of which the first two are the layer + 1 or 0 and the triangle,
/// rows from the bottom to the top. Pixels of the result, too, count from the lower left corner of the viewport.
/// O(segments).
std::vector<SeenSegment> seen_lines(const Scene& scene, const Projection& projection,
                                    std::span<const std::uint32_t> ids);

}  // namespace kerf::view

// Where there is room for the numbers of isolines.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "viewer/render/seen_lines.h"

namespace kerf::view {

struct LineLabel {
    float value = 0;
    Eigen::Vector2f place;  ///< the middle of its text, on the line
};

/// A rectangle of pixels that labels stay inside of.
struct LabelArea {
    Eigen::Vector2f low, high;
};

/// Places of numbers on lines: one for each value where it is seen longest, then more of them, `spacing` pixels apart
/// at least where they are of one value; no two texts overlap, nor one and what is taken, and a line is longer than its
/// text where it has one. `size`: of the text of a value, in pixels. Depends on the segments alone, not on their order
/// but for ties. O(n log n).
std::vector<LineLabel> places_on_lines(std::span<const SeenSegment> segments,
                                       const std::function<Eigen::Vector2f(float value)>& size, const LabelArea& area,
                                       float spacing, std::span<const LabelArea> taken = {});

}  // namespace kerf::view

// Places for the numbers of isolines.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "viewer/render/inside/seen_lines.h"

namespace kerf::view {

struct LineLabel {
    float value = 0;
    Eigen::Vector2f place;  ///< middle of the text, on the line, in pixels
};

/// A rectangle of pixels.
struct LabelArea {
    Eigen::Vector2f low, high;
};

/// Returns places of numbers on lines: for each value the place where its line is seen longest, then more, at least
/// `spacing` pixels apart if they are of one value; at most 80. Lengths are those in a square of a grid of side
/// `spacing`, and a line gets a number only where it is 1.5 times as long as its text. No two texts overlap, nor one
/// and a rectangle of `taken`; all lie within `area`. `size`: the size of the text of a value, in pixels. The result
/// depends on the segments alone, not on their order but for ties. O(n log n).
std::vector<LineLabel> places_on_lines(std::span<const SeenSegment> segments,
                                       const std::function<Eigen::Vector2f(float value)>& size, const LabelArea& area,
                                       float spacing, std::span<const LabelArea> taken = {});

}  // namespace kerf::view

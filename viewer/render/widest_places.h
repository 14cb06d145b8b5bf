// Where there is room for a number on what it is of.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace kerf::view {

struct NumberPlace {
    std::int32_t number = 0;
    int x = 0, y = 0;  ///< a pixel
    int room = 0;      ///< pixels from there to the nearest one with another number, along rows and columns
};

/// Of an image with a number for each pixel, row after row, or -1 for none: for each number the pixel that is farthest
/// from all others and from the border, in the middle of these where there are several. Ascending by number. O(pixels).
std::vector<NumberPlace> widest_places(std::span<const std::int32_t> image, int width, int height);

}  // namespace kerf::view

// Places with room for numbers on the faces that they number.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace kerf::view {

struct NumberPlace {
    std::int32_t number = 0;
    int x = 0, y = 0;  ///< pixel of the place
    int room = 0;      ///< distance to the nearest pixel with another number, along rows and columns
};

/// Takes an image with a number for each pixel, row after row, or -1 for none, and returns for each number the pixel
/// that is farthest from all others and from the border, in the middle of these where there are several. The result is
/// ascending by number. O(pixels).
std::vector<NumberPlace> widest_places(std::span<const std::int32_t> image, int width, int height);

}  // namespace kerf::view

#include "viewer/render/frame_size.h"

#include <algorithm>

namespace kerf::view {

namespace {

float pixels_per_unit(int pixels, int units) {
    return pixels > 0 && units > 0 ? static_cast<float>(pixels) / units : 1;
}

}  // namespace

FrameSize frame_size_of_window(int pixel_width, int pixel_height, int window_width, int window_height, float scale) {
    return {.width = std::max(pixel_width, 1),
            .height = std::max(pixel_height, 1),
            .scale = scale > 0 ? std::clamp(scale, 0.5f, 8.f) : 1,
            .pixels_per_unit_x = pixels_per_unit(pixel_width, window_width),
            .pixels_per_unit_y = pixels_per_unit(pixel_height, window_height)};
}

}  // namespace kerf::view

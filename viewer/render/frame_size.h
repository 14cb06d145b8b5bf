// The size of a frame. All drawing, and every place of the mouse once a frame has begun, is in pixels of the
// framebuffer. A window has units of its own: on X11 they are pixels; elsewhere a HiDPI screen has several pixels a
// unit.
#pragma once

namespace kerf::view {

struct FrameSize {
    int width = 0, height = 0;                           ///< size of the picture in pixels
    float scale = 1;                                     ///< scale of fonts and lines: 2 on a HiDPI screen
    float pixels_per_unit_x = 1, pixels_per_unit_y = 1;  ///< pixels per unit of the window, in which the mouse comes
};

/// Returns the frame size of a window with its framebuffer. A number that is not positive, as while the window is
/// iconified, counts as 1; scales are limited to [0.5, 8].
FrameSize frame_size_of_window(int pixel_width, int pixel_height, int window_width, int window_height, float scale);

}  // namespace kerf::view

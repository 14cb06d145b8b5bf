// How large a frame is. All that is drawn, and every place of the mouse once a frame has begun, is in pixels of the
// framebuffer. A window has units of its own: on X11 they are pixels; elsewhere a HiDPI screen has several pixels a
// unit.
#pragma once

namespace kerf::view {

struct FrameSize {
    int width = 0, height = 0;                           ///< pixels of the picture
    float scale = 1;                                     ///< of fonts and lines: 2 on a HiDPI screen
    float pixels_per_unit_x = 1, pixels_per_unit_y = 1;  ///< of the window, in whose units the mouse comes
};

/// Of a window with its framebuffer. What is not positive, as while it is iconified, counts as 1; scales are
/// limited to [0.5, 8].
FrameSize frame_size_of_window(int pixel_width, int pixel_height, int window_width, int window_height, float scale);

}  // namespace kerf::view

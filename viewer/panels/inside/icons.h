// Small pictures that are drawn with lines and shapes, so that they look alike with any font.
#pragma once

#include <string>

#include <imgui.h>

namespace kerf::view {

class Widgets;

enum class Icon {
    eye,
    eye_closed,
    isolate,
    glass,
    play,
    pause,
    left,
    right,
    up,
    down,
    folder,
    run,
    surface,
    trace,
    file
};

/// Draws the icon within a square of side `size` about `center`.
void draw_icon(ImDrawList& list, Icon icon, const ImVec2& center, float size, ImU32 color);

/// Draws a square button without a frame, recorded under `label`, and returns whether it was pressed. `color`: of the
/// icon. `tip` may be null.
bool icon_button(Widgets& widgets, const std::string& label, Icon icon, float size, ImU32 color, const char* tip);

}  // namespace kerf::view

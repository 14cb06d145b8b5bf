// Small drawn pictures: they look alike with any font.
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

/// Within a square of side `size` about `center`.
void draw_icon(ImDrawList& list, Icon icon, const ImVec2& center, float size, ImU32 color);

/// A square button without a frame, recorded under `label`. `color`: of the picture.
bool icon_button(Widgets& widgets, const std::string& label, Icon icon, float size, ImU32 color, const char* tip);

}  // namespace kerf::view

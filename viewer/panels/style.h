// Colours, sizes and fonts of the user interface. Colours have a meaning: it is in their names.
#pragma once

#include <imgui.h>

#include "viewer/model/view_state.h"
#include "viewer/scene/layer.h"

namespace kerf::view {

/// Colours of one theme.
struct Palette {
    ImVec4 text, dim;          ///< dim: what explains, units, what is switched off
    ImVec4 accent, on_accent;  ///< what is chosen, and text on it
    ImVec4 good, busy, warning, bad, waiting;
    ImVec4 panel, frame, border;
    ImVec4 backdrop;  ///< behind text in the scene
};
const Palette& palette(Theme theme);

/// Sizes and colours of ImGui's style.
void set_style(Theme theme, float scale);

inline ImU32 packed(const ImVec4& color) { return ImGui::ColorConvertFloat4ToU32(color); }
inline ImU32 packed(const Color& c) { return packed(ImVec4(c.r, c.g, c.b, c.a)); }
inline ImVec4 faded(ImVec4 color, float alpha) {
    color.w *= alpha;
    return color;
}

/// Of items with a label to the left: where the item begins, of the width of the panel.
inline constexpr float value_place = 0.42f;

/// The font's size, in which all sizes are given; also before the first frame.
float em();
/// For titles in the scene; the usual font if there is no other.
ImFont* large_font();

}  // namespace kerf::view

// Colours, sizes and fonts of the user interface. Colours are named by their meaning.
#pragma once

#include <imgui.h>

#include "viewer/model/view_state.h"
#include "viewer/scene/layer.h"

namespace kerf::view {

/// Colours of one theme.
struct Palette {
    ImVec4 text, dim;          ///< dim: explanations, units, items that are switched off
    ImVec4 accent, on_accent;  ///< the choice, and text on it
    ImVec4 good, busy, warning, bad, waiting;
    ImVec4 panel, frame, border;
    ImVec4 backdrop;  ///< ground of text in the scene
};
const Palette& palette(Theme theme);

/// Sets the sizes and colours of ImGui's style.
void set_style(Theme theme, float scale);

inline ImU32 packed(const ImVec4& color) { return ImGui::ColorConvertFloat4ToU32(color); }
inline ImU32 packed(const Color& c) { return packed(ImVec4(c.r, c.g, c.b, c.a)); }
inline ImVec4 faded(ImVec4 color, float alpha) {
    color.w *= alpha;
    return color;
}

/// The place where an item with a label to its left begins, as a fraction of the width of the panel.
inline constexpr float value_place = 0.42f;

/// Returns the font's size in pixels, the unit of all sizes; also before the first frame.
float em();
/// Returns the font of titles in the scene; the usual font if there is no other.
ImFont* large_font();

}  // namespace kerf::view

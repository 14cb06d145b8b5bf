// Where everything goes: columns left and right, the timeline below the scene, bars above and below.
#pragma once

#include "viewer/panels/panels.h"

namespace kerf::view {

struct Layout {
    Rectangle left, right, timeline, status, scene;
    bool has_left = false, has_right = false, has_timeline = false;
};

/// Of a window of this size. A panel that has nothing to say leaves its place to the scene, which keeps a part of the
/// window whatever the sizes are.
Layout layout_of(const ViewState& state, const Document& document, const PanelSizes& sizes, float width, float height);

/// Above and below the text of the menu bar.
float menu_padding();

/// There is something to look at.
bool has_body(const Document& document);
/// Nodes to choose from, or the only part of a run: more than a surface that nothing was done to.
bool has_tree(const Document& document);
/// Defects, notes, or a message that the problems panel shows.
bool has_remarks(const Document& document);

/// Begins a window that fills the rectangle and stays there; call ImGui::End().
void begin_place(const char* name, const Rectangle& place, ImGuiWindowFlags flags = 0);
/// A line along the left, right or upper border of that window.
void draw_border(const Rectangle& place, ImGuiDir side);

}  // namespace kerf::view

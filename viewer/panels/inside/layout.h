// The places of all panels: columns left and right, the timeline below the scene, bars above and below.
#pragma once

#include "viewer/panels/panels.h"

namespace kerf::view {

struct Layout {
    Rectangle left, right, timeline, status, scene;
    bool has_left = false, has_right = false, has_timeline = false;
};

/// Returns the layout of a window of this size. A panel that has nothing to say leaves its place to the scene, which
/// keeps a part of the window whatever the sizes are.
Layout layout_of(const ViewState& state, const Document& document, const PanelSizes& sizes, float width, float height);

/// Returns the space above and below the text of the menu bar.
float menu_padding();

/// Returns whether there is a body to look at.
bool has_body(const Document& document);
/// Returns whether there are nodes to choose from, or the only part of a run: more than a surface that has not been
/// cut.
bool has_tree(const Document& document);
/// Returns whether there are defects, repairs, notes or a message that the problems panel shows.
bool has_remarks(const Document& document);

/// Begins a window that fills the rectangle and stays there. End it by ImGui::End().
void begin_place(const char* name, const Rectangle& place, ImGuiWindowFlags flags = 0);
/// Draws a line along the left, right or upper border of that window.
void draw_border(const Rectangle& place, ImGuiDir side);

}  // namespace kerf::view

// Handles at the borders of the panels, by which a user makes columns as wide and the timeline as high as he wants.
#include <algorithm>

#include "viewer/panels/inside/parts.h"

namespace kerf::view {

namespace {

struct Splitter {
    const char* label;
    Rectangle place;
    bool moves_sideways;
    float& size;      // size of the panel, in ems
    float shown;      // size that it has now, in pixels
    float direction;  // 1: the panel grows with x or y; -1: against it
};

void draw_splitter(UiContext& context, const Splitter& splitter) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    begin_place((std::string("##") + splitter.label).c_str(), splitter.place,
                ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::InvisibleButton(splitter.label, {splitter.place.width, splitter.place.height});
    context.widgets.record(splitter.label);
    const bool held = ImGui::IsItemActive(), hovered = ImGui::IsItemHovered();
    if (held || hovered) {
        ImGui::SetMouseCursor(splitter.moves_sideways ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
        const Rectangle& r = splitter.place;
        const ImVec2 middle = {r.x + r.width / 2, r.y + r.height / 2}, half = {r.width / 2, r.height / 2};
        const ImVec2 reach = splitter.moves_sideways ? ImVec2{0.08f * em(), half.y} : ImVec2{half.x, 0.08f * em()};
        ImGui::GetWindowDrawList()->AddRectFilled({middle.x - reach.x, middle.y - reach.y},
                                                  {middle.x + reach.x, middle.y + reach.y},
                                                  packed(palette(context.state.theme).accent));
    }
    if (hovered && ImGui::IsMouseDoubleClicked(0)) {
        splitter.size = 0;
    } else if (held) {
        const ImVec2 delta = ImGui::GetIO().MouseDelta;
        const float moved = splitter.direction * (splitter.moves_sideways ? delta.x : delta.y);
        if (moved != 0) splitter.size = std::max(1.f, (splitter.shown + moved) / em());
    }
    ImGui::End();
    ImGui::PopStyleVar();
}

}  // namespace

void draw_splitters(UiContext& context, const Layout& layout) {
    PanelSizes& sizes = context.settings.panels;
    const float wide = 0.45f * em();
    if (layout.has_left) {
        const Rectangle& r = layout.left;
        draw_splitter(context,
                      {"left splitter", {r.x + r.width - wide / 2, r.y, wide, r.height}, true, sizes.left, r.width, 1});
    }
    if (layout.has_right) {
        const Rectangle& r = layout.right;
        draw_splitter(context,
                      {"right splitter", {r.x - wide / 2, r.y, wide, r.height}, true, sizes.right, r.width, -1});
    }
    if (layout.has_timeline) {
        const Rectangle& r = layout.timeline;
        draw_splitter(context,
                      {"timeline splitter", {r.x, r.y - wide / 2, r.width, wide}, false, sizes.timeline, r.height, -1});
    }
}

}  // namespace kerf::view

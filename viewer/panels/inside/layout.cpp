#include "viewer/panels/inside/layout.h"

#include <algorithm>
#include <cmath>

#include "viewer/panels/inside/style.h"

namespace kerf::view {

namespace {

bool is_open(const Document& document) {
    return has_body(document) || !document.error.empty() || document.progress.running;
}

bool wants_left(const ViewState& state, const Document& document) {
    return is_open(document) && (state.panels.tree || (state.panels.problems && has_remarks(document)));
}

bool wants_right(const ViewState& state, const Document& document) {
    const Panels& panels = state.panels;
    return has_body(document) && (panels.display || panels.parameters || panels.quality);
}

}  // namespace

float menu_padding() { return std::round(0.35f * em()); }

bool has_body(const Document& document) { return document.kind != Document::Kind::none || document.checked; }

bool has_tree(const Document& document) {
    const bool has_run = document.kind != Document::Kind::surface || document.trace || !document.folder.empty();
    return document.tree.rows.size() > 1 || (document.tree.rows.size() == 1 && has_run);
}

bool has_remarks(const Document& document) {
    const bool defects = document.checked && !document.checked->diagnosis.defects.empty();
    const bool repairs = document.unrepaired || (document.checked && !document.checked->ladder.steps.empty());
    return defects || repairs || !document.error.empty() || !document.notes.empty() ||
           !document.progress.message.empty();
}

Layout layout_of(const ViewState& state, const Document& document, const PanelSizes& sizes, float width, float height) {
    const float e = em();
    const float menu = e + 2 * menu_padding(), status = std::round(1.8f * e);
    Layout layout;
    layout.has_left = wants_left(state, document);
    layout.has_right = wants_right(state, document);
    layout.has_timeline = state.panels.timeline && has_tree(document);
    const float middle = std::max(0.f, height - menu - status);
    const auto size_of = [&](bool shown, float wanted, float suggested, float least, float most) {
        if (!shown) return 0.f;
        return std::round(wanted > 0 ? std::min(std::max(wanted * e, least), most) : suggested);
    };
    const float left =
        size_of(layout.has_left, sizes.left, std::min(std::clamp(0.285f * width, 20 * e, 28 * e), 0.36f * width), 9 * e,
                0.42f * width);
    const float right =
        size_of(layout.has_right, sizes.right, std::min(std::clamp(0.22f * width, 20 * e, 24 * e), 0.34f * width),
                12 * e, 0.42f * width);
    const float rows = width - right < 58 * e ? 9 : 8;  // a narrow timeline has two rows of steps
    const float timeline = size_of(layout.has_timeline, sizes.timeline, rows * e, 6.5f * e, 0.4f * middle);
    const float above = std::max(1.f, middle - timeline);
    layout.left = {0, menu, left, above};
    layout.right = {width - right, menu, right, middle};
    layout.status = {0, height - status, width, status};
    layout.scene = {left, menu, std::max(1.f, width - left - right), above};
    layout.timeline = {0, menu + above, std::max(1.f, width - right),
                       timeline};  // below the left column, too: the words of all steps need room
    return layout;
}

Rectangle scene_rectangle(const ViewState& state, const Document& document, const PanelSizes& sizes, float width,
                          float height, bool panels) {
    return panels ? layout_of(state, document, sizes, width, height).scene : Rectangle{0, 0, width, height};
}

void begin_place(const char* name, const Rectangle& place, ImGuiWindowFlags flags) {
    ImGui::SetNextWindowPos({place.x, place.y});
    ImGui::SetNextWindowSize({place.width, place.height});
    ImGui::Begin(name, nullptr,
                 flags | ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNavFocus);
}

void draw_border(const Rectangle& place, ImGuiDir side) {
    const float x0 = place.x, y0 = place.y, x1 = place.x + place.width, y1 = place.y + place.height;
    ImVec2 from = {x0, y0}, to = {x1, y0 + 1};
    if (side == ImGuiDir_Left) to = {x0 + 1, y1};
    if (side == ImGuiDir_Right) from = {x1 - 1, y0}, to = {x1, y1};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect({x0, y0}, {x1, y1});  // the clip rectangle of the window leaves its border out
    list.AddRectFilled(from, to, ImGui::GetColorU32(ImGuiCol_Border));
    list.PopClipRect();
}

}  // namespace kerf::view

// Wrappers of ImGui's items that record the rectangle of each under its label. A rectangle counts as visible if its
// middle lies within the clip rectangle of its window and no dialog covers it, so that a test clicks only items that a
// user could click. Labels of fields stand to the left (label_left()), as ImGui would put them to the right; the id of
// the item is "##" and the label then, so that only the name before any "##" is shown and recorded. Disabled items show
// their tips, too, as these say why.
#include "viewer/panels/inside/widgets.h"

#include <algorithm>
#include <cfloat>

#include <imgui.h>
#include <imgui_internal.h>  // flags of the last item, the dialog on top
#include <imgui_stdlib.h>

#include "base/core/ids.h"
#include "viewer/panels/inside/style.h"

namespace kerf::view {

namespace {

std::string name_of(const std::string& label) {
    const std::size_t end = label.find("##");
    return end == 0 || end == std::string::npos ? label : label.substr(0, end);
}

// Draws the label to the left and makes the item beside it as wide as there is room, so that items of a panel line up,
// but for those with long labels. Returns the item's id.
std::string label_left(const char* label) {
    const std::string name = name_of(label);
    if (name.starts_with("##")) return name;
    const float left = ImGui::GetCursorPosX();
    const float room = ImGui::GetContentRegionAvail().x;
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(name.c_str());
    const float words = ImGui::CalcTextSize(name.c_str()).x + ImGui::GetStyle().ItemInnerSpacing.x;
    const float place = std::max(value_place * room, words);
    ImGui::SameLine(left + place, 0);
    ImGui::SetNextItemWidth(room - place);
    return std::string("##") + label;
}

void explain(const char* tip) {
    if (!tip || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, 1);  // a disabled item is dim, its tip is not
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(22 * ImGui::GetFontSize());
    ImGui::TextUnformatted(tip);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
    ImGui::PopStyleVar();
}

// Whether a dialog covers the window: nothing behind an open dialog can be clicked, but its own menus lie above it.
bool covered_by_dialog() {
    const ImGuiWindow* dialog = ImGui::GetTopMostPopupModal();
    const ImGuiWindow* window = ImGui::GetCurrentWindowRead()->RootWindow;
    return dialog && window != dialog && !(window->Flags & ImGuiWindowFlags_Popup);
}

}  // namespace

std::optional<ItemRect> Widgets::find(const std::string& label) const {
    const auto found = items_.find(label);
    return found == items_.end() ? std::nullopt : std::optional(found->second);
}

void Widgets::record(const std::string& label) { record(label, ImGui::GetItemRectMin(), ImGui::GetItemRectMax()); }

void Widgets::record(const std::string& label, const ImVec2& from, const ImVec2& to) {
    ItemRect item{.left = from.x, .top = from.y, .right = to.x, .bottom = to.y};
    item.enabled = (ImGui::GetItemFlags() & ImGuiItemFlags_Disabled) == 0;
    const ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 low = list.GetClipRectMin(), high = list.GetClipRectMax();
    const float x = (from.x + to.x) / 2, y = (from.y + to.y) / 2;
    item.visible = x > low.x && x < high.x && y > low.y && y < high.y && !covered_by_dialog();
    items_[name_of(label)] = item;
}

bool Widgets::button(const char* label, const char* tip) {
    const bool pressed = ImGui::Button(label);
    record(label);
    explain(tip);
    return pressed;
}

bool Widgets::small_button(const char* label, const char* tip) {
    const bool pressed = ImGui::SmallButton(label);
    record(label);
    explain(tip);
    return pressed;
}

bool Widgets::checkbox(const char* label, bool* value, const char* tip) {
    const bool changed = ImGui::Checkbox(label, value);
    record(label);
    explain(tip);
    return changed;
}

bool Widgets::radio(const char* label, bool active) {
    const bool pressed = ImGui::RadioButton(label, active);
    record(label);
    return pressed;
}

bool Widgets::slider(const char* label, double* value, double low, double high, const char* format) {
    const std::string id = label_left(label);
    const bool changed =
        ImGui::SliderScalar(id.c_str(), ImGuiDataType_Double, value, &low, &high, format, ImGuiSliderFlags_AlwaysClamp);
    record(label);
    return changed;
}

bool Widgets::combo(const char* label, int* index, const std::vector<std::string>& names,
                    const std::vector<const char*>& why_not) {
    // Words that would be cut beside the label get a line of their own.
    float widest = 0;
    for (const std::string& name : names) widest = std::max(widest, ImGui::CalcTextSize(name.c_str()).x);
    widest += 2 * ImGui::GetStyle().FramePadding.x + ImGui::GetFrameHeight();
    const bool is_wide = widest > (1 - value_place) * ImGui::GetContentRegionAvail().x;
    if (is_wide) {
        ImGui::TextUnformatted(name_of(label).c_str());
        ImGui::SetNextItemWidth(-FLT_MIN);
    }
    const std::string id = is_wide ? std::string("##") + label : label_left(label);
    const bool known = *index >= 0 && *index < count_of(names);
    const bool open = ImGui::BeginCombo(id.c_str(), known ? names[*index].c_str() : "", ImGuiComboFlags_HeightLarge);
    record(label);
    if (!open) return false;
    bool changed = false;
    for (int i = 0; i < count_of(names); ++i) {
        const std::string& name = names[i];
        const char* reason = why_not.empty() ? nullptr : why_not[i];
        ImGui::BeginDisabled(reason != nullptr);
        if (ImGui::Selectable(name.c_str(), i == *index)) {
            changed = i != *index;
            *index = i;
        }
        record(name_of(label) + ": " + name);
        explain(reason);
        ImGui::EndDisabled();
    }
    ImGui::EndCombo();
    return changed;
}

bool Widgets::menu_item(const char* label, const char* shortcut, bool* value) {
    const bool pressed = ImGui::MenuItem(label, shortcut, value);
    record(label);
    return pressed;
}

bool Widgets::header(const char* label, bool open_at_first) {
    // The usual colour of headers is that of the choice.
    ImGui::PushStyleColor(ImGuiCol_Header, ImGui::GetStyleColorVec4(ImGuiCol_FrameBg));
    const bool open = ImGui::CollapsingHeader(label, open_at_first ? ImGuiTreeNodeFlags_DefaultOpen : 0);
    ImGui::PopStyleColor();
    record(label);
    return open;
}

bool Widgets::input_text(const char* label, std::string* text) {
    const std::string id = label_left(label);
    const bool changed = ImGui::InputText(id.c_str(), text);
    record(label);
    return changed;
}

bool Widgets::input_number(const char* label, double* value) {
    const std::string id = label_left(label);
    const bool changed = ImGui::InputScalar(id.c_str(), ImGuiDataType_Double, value, nullptr, nullptr, "%.6g");
    record(label);
    return changed;
}

}  // namespace kerf::view

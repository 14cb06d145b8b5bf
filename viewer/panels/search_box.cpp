// Commands by a few letters of their names: type, choose by the arrows, Enter.
#include <algorithm>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "base/core/ids.h"
#include "viewer/panels/inside/commands.h"

namespace kerf::view {

namespace {

constexpr int most_rows = 14;

// Up and down in the field of text move the choice.
int note_arrows(ImGuiInputTextCallbackData* data) {
    *static_cast<int*>(data->UserData) += data->EventKey == ImGuiKey_UpArrow ? -1 : 1;
    return 0;
}

// Draws the field of text, and returns whether Enter was pressed.
bool draw_field(Widgets& widgets, SearchBox& search) {
    int moved = 0;
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-FLT_MIN);
    const std::string before = search.typed;
    const bool entered = ImGui::InputTextWithHint(
        "##what to do", "What do you want to do?", &search.typed,
        ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackHistory, note_arrows, &moved);
    widgets.record("search commands");
    search.chosen = search.typed == before ? search.chosen + moved : 0;
    search.moved = moved != 0;
    return entered;
}

// Draws a command that was found, and returns whether it was clicked.
bool draw_found(const Command& command, bool is_chosen, UiContext& context) {
    const Palette& colors = palette(context.state.theme);
    const bool enabled = is_enabled(command, context), is_on = command.is_on && command.is_on(context);
    ImGui::BeginDisabled(!enabled);
    const bool clicked =
        ImGui::Selectable((std::string("##") + command.name).c_str(), is_chosen, ImGuiSelectableFlags_DontClosePopups);
    ImGui::EndDisabled();
    context.widgets.record(std::string("command ") + command.name);
    ImGui::SameLine(0.3f * em());
    show(command.name, enabled ? colors.text : colors.dim);
    ImGui::SameLine();
    show((is_on ? "(on) " : "") + std::string(command.heading), colors.dim);
    ImGui::SameLine();
    show_right(command.keys, colors.accent);
    return clicked && enabled;
}

const Command* draw_list(UiContext& context, SearchBox& search, const std::vector<const Command*>& found) {
    const Command* clicked = nullptr;
    ImGui::BeginChild("##found", {0, most_rows * ImGui::GetTextLineHeightWithSpacing()});
    for (int i = 0; i < count_of(found); ++i) {
        const bool is_chosen = i == search.chosen;
        const float top = ImGui::GetCursorPosY();
        if (draw_found(*found[i], is_chosen, context)) clicked = found[i];
        if (is_chosen && search.moved) scroll_to_row(top, ImGui::GetTextLineHeightWithSpacing());
    }
    if (found.empty()) show("No command has these words.", palette(context.state.theme).dim);
    ImGui::EndChild();
    return clicked;
}

}  // namespace

void draw_search(UiContext& context, Dialogs& dialogs) {
    SearchBox& search = dialogs.search;
    if (search.requested) {
        search = {};
        ImGui::OpenPopup("##search box");
    }
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x / 2, 0.12f * screen.y}, ImGuiCond_Always, {0.5f, 0});
    ImGui::SetNextWindowSize({std::min(36 * em(), screen.x), 0});
    if (!ImGui::BeginPopup("##search box", ImGuiWindowFlags_NoMove)) return;
    const bool entered = draw_field(context.widgets, search);
    const std::vector<const Command*> found = find_commands(search.typed);
    search.chosen = std::clamp(search.chosen, 0, std::max(0, count_of(found) - 1));
    const Command* command = draw_list(context, search, found);
    if (entered && !found.empty()) command = found[search.chosen];
    if (command && is_enabled(*command, context)) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    if (command && is_enabled(*command, context)) command->run(context, dialogs);
}

}  // namespace kerf::view

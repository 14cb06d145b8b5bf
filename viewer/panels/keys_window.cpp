#include "viewer/panels/parts.h"

namespace kerf::view {

namespace {

struct Key {
    const char* keys;
    const char* what;
};

constexpr Key moving[] = {{"Left button", "turn"},
                          {"Right or middle button", "move; also Shift and the left one"},
                          {"Wheel", "come closer to what is under the mouse"},
                          {"Click", "select the facet, cell or vertex"},
                          {"Double click", "turn about this point from now on"},
                          {"Home", "fit everything"},
                          {"F", "frame the selection"},
                          {"1, 3, 7", "view from the front, the right, the top"},
                          {"9", "view from the opposite side"},
                          {"5", "perspective or parallel projection"}};
constexpr Key stepping[] = {{"Left, right", "previous step, next step"},
                            {"Up, down", "previous node, next node"},
                            {"Space", "play the steps, or pause"},
                            {"Up, down in a list", "previous, next defect or cell"},
                            {"C", "clip plane on or off"},
                            {"Shift+C", "clip plane through the selection"},
                            {"N", "only the neighbours of a selected cell, or all"},
                            {"E", "edges on or off"},
                            {"B", "the run or the repair before, or the one after"},
                            {"Ctrl+Z, Ctrl+Shift+Z", "undo the last repair, redo it"},
                            {"Escape", "select nothing, close a menu or dialog"}};
constexpr Key files[] = {{"Ctrl+O", "open a file or folder"},
                         {"Ctrl+R", "read it again"},
                         {"F12", "save the picture as PNG"},
                         {"H", "show or hide this window"},
                         {"Ctrl+Q", "quit"}};

template <std::size_t N>
void draw_table(const char* title, const Key (&keys)[N], const Palette& colors) {
    show(title, colors.accent);
    if (ImGui::BeginTable(title, 2, ImGuiTableFlags_NoSavedSettings)) {
        ImGui::TableSetupColumn("##keys", ImGuiTableColumnFlags_WidthFixed, 12 * em());
        ImGui::TableSetupColumn("##what", ImGuiTableColumnFlags_WidthStretch);
        for (const Key& key : keys) {
            ImGui::TableNextRow();
            ImGui::TableSetColumnIndex(0);
            show(key.keys, colors.text);
            ImGui::TableSetColumnIndex(1);
            show(key.what, colors.dim);
        }
        ImGui::EndTable();
    }
    ImGui::Spacing();
}

}  // namespace

void draw_keys(UiContext& context) {
    bool& open = context.state.panels.keys;
    if (!open) return;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const Palette& colors = palette(context.state.theme);
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Appearing, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(33 * em(), screen.x), 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.3f * em());
    const bool shown = ImGui::Begin("Keys and mouse##keys window", &open,
                                    ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                                        ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PopStyleVar(2);
    if (shown) {
        draw_table("Looking", moving, colors);
        draw_table("Stepping and showing", stepping, colors);
        draw_table("Files", files, colors);
        if (context.widgets.button("Close keys")) open = false;
    }
    ImGui::End();
}

}  // namespace kerf::view

#include <string_view>

#include "viewer/panels/inside/commands.h"

namespace kerf::view {

namespace {

struct MouseUse {
    const char* button;
    const char* what;
};

constexpr MouseUse mouse_uses[] = {{"Left button", "turn"},
                                   {"Right or middle", "move; also Shift and the left button"},
                                   {"Wheel", "come closer to what is under the mouse"},
                                   {"Click", "select the facet, cell or vertex"},
                                   {"Double click", "turn about this point from now on"}};

void draw_row(const char* left, const char* right, const Palette& colors) {
    ImGui::TableNextRow();
    ImGui::TableSetColumnIndex(0);
    show(left, colors.text);
    ImGui::TableSetColumnIndex(1);
    show(right, colors.dim);
}

template <class DrawRows>
void draw_table(const char* title, const Palette& colors, DrawRows draw_rows) {
    show(title, colors.accent);
    if (ImGui::BeginTable(title, 2, ImGuiTableFlags_NoSavedSettings)) {
        ImGui::TableSetupColumn("##keys", ImGuiTableColumnFlags_WidthFixed, 10.5f * em());
        ImGui::TableSetupColumn("##what", ImGuiTableColumnFlags_WidthStretch);
        draw_rows();
        ImGui::EndTable();
    }
    ImGui::Spacing();
}

void draw_mouse(const Palette& colors) {
    draw_table("Mouse", colors, [&] {
        for (const MouseUse& use : mouse_uses) draw_row(use.button, use.what, colors);
    });
}

void draw_heading(const char* heading, const Palette& colors) {
    draw_table(heading, colors, [&] {
        for (const Command& command : commands())
            if (*command.keys && std::string_view(command.heading) == heading)
                draw_row(command.keys, command.name, colors);
    });
}

void draw_all_keys(const Palette& colors) {
    if (!ImGui::BeginTable("##keys of all", 2, ImGuiTableFlags_NoSavedSettings)) return;
    ImGui::TableNextRow();
    ImGui::TableSetColumnIndex(0);
    draw_mouse(colors);
    for (const char* heading : {"Looking", "Files"}) draw_heading(heading, colors);
    ImGui::TableSetColumnIndex(1);
    for (const char* heading : {"Stepping", "Showing", "Help"}) draw_heading(heading, colors);
    ImGui::EndTable();
}

}  // namespace

void draw_keys(UiContext& context) {
    bool& open = context.state.panels.keys;
    if (!open) return;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Appearing, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(60 * em(), screen.x), 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.3f * em());
    const bool shown = ImGui::Begin("Keys and mouse##keys window", &open,
                                    ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                                        ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PopStyleVar(2);
    if (shown) {
        draw_all_keys(palette(context.state.theme));
        if (context.widgets.button("Close keys")) open = false;
    }
    ImGui::End();
}

}  // namespace kerf::view

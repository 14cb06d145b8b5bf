#include <string_view>

#include "viewer/panels/inside/commands.h"

namespace kerf::view {

namespace {

bool begin_menu(Widgets& widgets, const char* label, bool enabled = true) {
    const bool open = ImGui::BeginMenu(label, enabled);
    // An open menu has made itself the current window, so that only a closed one is recorded here.
    if (!open) widgets.record(label);
    return open;
}

// The rectangle of an open menu's title is known before its window begins.
void end_menu(Widgets& widgets, const char* label) {
    ImGui::EndMenu();
    widgets.record(label);
}

void draw_recent(UiContext& context) {
    if (!begin_menu(context.widgets, "Open recent", !context.settings.recent.empty())) return;
    const std::vector<RecentFile> recent = context.settings.recent;  // opening changes it
    for (std::size_t i = 0; i < recent.size(); ++i) {
        const std::string label = shortened_path(recent[i].path, 36 * em()) + "##recent" + std::to_string(i);
        if (ImGui::MenuItem(label.c_str())) context.actions.files.open_files({recent[i].path});
        context.widgets.record("recent " + std::to_string(i + 1));
    }
    end_menu(context.widgets, "Open recent");
}

void draw_entry(UiContext& context, Dialogs& dialogs, const Command& command) {
    bool is_on = command.is_on && command.is_on(context);
    ImGui::BeginDisabled(!is_enabled(command, context));
    if (context.widgets.menu_item(command.name, command.keys, &is_on)) command.run(context, dialogs);
    ImGui::EndDisabled();
    if (command.ends_section) ImGui::Separator();
}

void draw_commands(UiContext& context, Dialogs& dialogs, const char* menu) {
    if (!begin_menu(context.widgets, menu)) return;
    for (const Command& command : commands()) {
        if (std::string_view(command.menu) != menu) continue;
        draw_entry(context, dialogs, command);
        if (std::string_view(command.name) == "Open...") draw_recent(context);
    }
    end_menu(context.widgets, menu);
}

}  // namespace

void draw_menu(UiContext& context, Dialogs& dialogs) {
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.4f * em(), menu_padding()});
    const bool shown = ImGui::BeginMainMenuBar();
    ImGui::PopStyleVar();
    if (!shown) return;
    for (const char* menu : {"File", "View", "Help"}) draw_commands(context, dialogs, menu);
    const Document& document = context.session.document();
    ImGui::SameLine(0, 1.5f * em());
    show_right(shortened_path(document.title, ImGui::GetContentRegionAvail().x), palette(context.state.theme).dim);
    explain(document.path);
    ImGui::EndMainMenuBar();
}

}  // namespace kerf::view

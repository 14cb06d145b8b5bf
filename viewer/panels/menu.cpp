#include "core/error.h"
#include "viewer/panels/parts.h"

namespace kerf::view {

namespace {

bool begin_menu(Widgets& widgets, const char* label, bool enabled = true) {
    const bool open = ImGui::BeginMenu(label, enabled);
    // A menu that opens from a menu has made itself the current window.
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
    const std::vector<std::string> recent = context.settings.recent;  // opening changes it
    for (std::size_t i = 0; i < recent.size(); ++i) {
        const std::string label = shortened_path(recent[i], 36 * em()) + "##recent" + std::to_string(i);
        if (ImGui::MenuItem(label.c_str())) context.actions.files.open_files({recent[i]});
        context.widgets.record("recent " + std::to_string(i + 1));
    }
    end_menu(context.widgets, "Open recent");
}

void draw_file_menu(UiContext& context, FileBrowser& browser) {
    Widgets& w = context.widgets;
    if (!begin_menu(w, "File")) return;
    if (w.menu_item("Open...", "Ctrl+O")) browser.requested = true;
    draw_recent(context);
    if (w.menu_item("Reload", "Ctrl+R")) context.actions.files.reload();
    ImGui::Separator();
    if (w.menu_item("Screenshot", "F12")) context.actions.window.take_screenshot();
    ImGui::Separator();
    if (w.menu_item("Quit", "Ctrl+Q")) context.actions.window.quit();
    end_menu(w, "File");
}

void paste_camera(UiContext& context) {
    try {
        context.state.camera = camera_from_json(context.actions.window.clipboard(), "the clipboard");
    } catch (const Error& error) {
        context.actions.window.complain(error.what());
    }
}

void draw_views(UiContext& context) {
    struct Entry {
        const char* label;
        const char* key;
        Direction direction;
    };
    constexpr Entry entries[] = {
        {"Front view", "1", Direction::front},      {"Back view", nullptr, Direction::back},
        {"Right view", "3", Direction::right},      {"Left view", nullptr, Direction::left},
        {"Top view", "7", Direction::top},          {"Bottom view", nullptr, Direction::bottom},
        {"Corner view", nullptr, Direction::corner}};
    for (const Entry& entry : entries)
        if (context.widgets.menu_item(entry.label, entry.key)) context.actions.camera.look(entry.direction);
    Camera camera = context.camera;
    if (context.widgets.menu_item("Perspective", "5", &camera.perspective)) context.state.camera = camera;
}

void draw_view_menu(UiContext& context) {
    Widgets& w = context.widgets;
    if (!begin_menu(w, "View")) return;
    Panels& panels = context.state.panels;
    w.menu_item("Tree panel", nullptr, &panels.tree);
    w.menu_item("Problems panel", nullptr, &panels.problems);
    w.menu_item("Display panel", nullptr, &panels.display);
    w.menu_item("Worst cells panel", nullptr, &panels.quality);
    w.menu_item("Parameters panel", nullptr, &panels.parameters);
    w.menu_item("Timeline panel", nullptr, &panels.timeline);
    w.menu_item("Times in the tree", nullptr, &context.state.times);
    ImGui::Separator();
    bool is_dark = context.state.theme == Theme::dark;
    if (w.menu_item("Dark theme", nullptr, &is_dark))
        context.state.theme = context.settings.theme = is_dark ? Theme::dark : Theme::light;
    ImGui::Separator();
    if (w.menu_item("Fit everything", "Home")) context.actions.camera.fit_all();
    if (w.menu_item("Frame the selection", "F")) context.actions.camera.frame_selection();
    draw_views(context);
    ImGui::Separator();
    if (w.menu_item("Copy camera")) context.actions.window.copy(to_json(context.camera));
    if (w.menu_item("Paste camera")) paste_camera(context);
    end_menu(w, "View");
}

void draw_help_menu(UiContext& context) {
    if (!begin_menu(context.widgets, "Help")) return;
    context.widgets.menu_item("Keys and mouse", "H", &context.state.panels.keys);
    end_menu(context.widgets, "Help");
}

}  // namespace

void draw_menu(UiContext& context, FileBrowser& browser) {
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.4f * em(), menu_padding()});
    const bool shown = ImGui::BeginMainMenuBar();
    ImGui::PopStyleVar();
    if (!shown) return;
    draw_file_menu(context, browser);
    draw_view_menu(context);
    draw_help_menu(context);
    const Document& document = context.session.document();
    ImGui::SameLine(0, 1.5f * em());
    show_right(shortened_path(document.title, ImGui::GetContentRegionAvail().x), palette(context.state.theme).dim);
    explain(document.path);
    ImGui::EndMainMenuBar();
}

}  // namespace kerf::view

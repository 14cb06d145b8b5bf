// What one sees before anything is open.
#include <algorithm>
#include <iterator>

#include "viewer/panels/parts.h"

namespace kerf::view {

namespace {

constexpr std::size_t most_recent = 8;

constexpr const char* what_can_be_opened[] = {
    "Surfaces: STL, OBJ, PLY, OFF, .msh, .mesh, .smesh, .poly, also .gz or .zst",
    "CAD files: STEP, IGES, BREP",
    "Traces: what kerf mesh --trace FILE has written",
    "Runs: the folder of kerf mesh -o DIR, finished or under way",
    "Solutions: the folder of kerf solve -o DIR",
};

void show_centered(const std::string& text, const ImVec4& color) {
    const float room = ImGui::GetContentRegionAvail().x, width = ImGui::CalcTextSize(text.c_str()).x;
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.f, (room - width) / 2));
    show(text, color);
}

void draw_recent(UiContext& context, const Palette& colors) {
    const std::vector<std::string> recent = context.settings.recent;  // opening changes it
    if (recent.empty()) return;
    ImGui::Dummy({0, em()});
    show_centered("Opened before", colors.dim);
    for (std::size_t i = 0; i < std::min(recent.size(), most_recent); ++i) {
        const std::string text = shortened_path(recent[i], ImGui::GetContentRegionAvail().x - 2 * em());
        ImGui::PushStyleColor(ImGuiCol_Text, colors.accent);
        ImGui::PushStyleVar(ImGuiStyleVar_SelectableTextAlign, {0.5f, 0.5f});
        if (ImGui::Selectable((text + "##open recent" + std::to_string(i)).c_str()))
            context.actions.files.open_files({recent[i]});
        ImGui::PopStyleVar();
        ImGui::PopStyleColor();
        context.widgets.record("open recent " + std::to_string(i + 1));
    }
}

// As it is drawn below.
float content_height(const UiContext& context) {
    const float line = ImGui::GetTextLineHeightWithSpacing(), gap = ImGui::GetStyle().ItemSpacing.y;
    const float title = large_font()->FontSize * ImGui::GetIO().FontGlobalScale + gap;
    const std::size_t recent = std::min(context.settings.recent.size(), most_recent);
    const float titles = context.session.document().error.empty() ? title : 2 * title;
    const float list = recent > 0 ? static_cast<float>(recent + 1) * line + em() + gap : 0;
    const auto lines = static_cast<float>(1 + std::size(what_can_be_opened));
    return titles + lines * line + 3.6f * em() + 3 * gap + list;
}

}  // namespace

void draw_welcome(UiContext& context, const Rectangle& scene) {
    const Document& document = context.session.document();
    const Palette& colors = palette(context.state.theme);
    const float e = em(), width = std::min(38 * e, scene.width - 2 * e);
    const float height = std::min(content_height(context), scene.height - 2 * e);
    begin_place("##welcome",
                {scene.x + (scene.width - width) / 2, scene.y + (scene.height - height) / 2, width, height},
                ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoFocusOnAppearing);
    const ImVec2 from = ImGui::GetWindowPos();
    draw_backdrop(*ImGui::GetWindowDrawList(), context.state.theme, {from.x + 0.5f * e, from.y + 0.5f * e},
                  {from.x + width - 0.5f * e, from.y + height - 0.5f * e});
    ImGui::Dummy({0, 0.4f * e});
    ImGui::PushFont(large_font());
    if (!document.error.empty()) show_centered("This file could not be opened", colors.bad);
    show_centered(document.error.empty() ? "Drop a surface, a trace or a run folder here" : "Drop another one here",
                  colors.text);
    ImGui::PopFont();
    ImGui::Dummy({0, 0.4f * e});
    show_centered("or press Ctrl+O to choose one", colors.text);
    ImGui::Dummy({0, 0.6f * e});
    for (const char* kind : what_can_be_opened) show_centered(kind, colors.dim);
    draw_recent(context, colors);
    ImGui::End();
}

}  // namespace kerf::view

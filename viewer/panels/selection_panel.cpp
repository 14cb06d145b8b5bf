#include "viewer/panels/inside/parts.h"

namespace kerf::view {

namespace {

// Draws "facet: 12" with the words before the colon in the colour of explanations.
void draw_line(const std::string& line, const Palette& colors) {
    const std::size_t colon = line.find(": ");
    if (colon == std::string::npos || colon > 24) return show_wrapped(line, colors.text);
    show(line.substr(0, colon), colors.dim);
    ImGui::SameLine(std::max(8 * em(), ImGui::CalcTextSize(line.c_str(), line.c_str() + colon).x + 1.2f * em()));
    show_wrapped(line.substr(colon + 2), colors.text);
}

void draw_lines(const std::string& text, const Palette& colors) {
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        draw_line(text.substr(begin, end - begin), colors);
        begin = end + 1;
    }
}

}  // namespace

void draw_selection(UiContext& context) {
    ImGui::Separator();
    ImGui::AlignTextToFramePadding();
    show("Selection", palette(context.state.theme).accent);
    ImGui::SameLine(0, em());
    if (context.widgets.small_button("Frame", "Come close to it (F)")) context.actions.camera.frame_selection();
    ImGui::SameLine();
    if (context.widgets.small_button("Copy", "These lines to the clipboard"))
        context.actions.window.copy(context.facts.selection);
    ImGui::SameLine();
    if (context.widgets.small_button("Clear", "Select nothing (Escape)")) context.state.selection = {};
    if (context.state.selection.kind == Selection::Kind::cell) {
        ImGui::SameLine();
        bool& only_ring = context.state.visibility.neighbours;
        if (context.widgets.small_button(only_ring ? "All cells" : "Neighbours",
                                         only_ring
                                             ? "Shows the other cells again (N)"
                                             : "Shows only the cells that share a vertex with it, of all parts (N)"))
            only_ring = !only_ring;
    }
    ImGui::BeginChild("##selection");
    draw_lines(context.facts.selection, palette(context.state.theme));
    ImGui::EndChild();
}

}  // namespace kerf::view

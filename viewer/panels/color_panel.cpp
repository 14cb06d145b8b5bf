// What colours mean: the choice, its range, its distribution, the worst cells.
#include <cmath>

#include <fmt/format.h>

#include "viewer/model/surface_values.h"
#include "viewer/panels/parts.h"

namespace kerf::view {

namespace {

void draw_choice(UiContext& context) {
    static const std::vector<std::string> titles = [] {
        std::vector<std::string> all;
        for (int i = 0; i < color_by_count; ++i) all.emplace_back(title(static_cast<ColorBy>(i)));
        return all;
    }();
    int index = static_cast<int>(context.state.color);
    if (!context.widgets.combo("Colour by", &index, titles)) return;
    context.state.color = static_cast<ColorBy>(index);
    context.state.filter.reset();  // these were other values
    context.state.color_range.reset();
}

void draw_range(UiContext& context) {
    ViewState& state = context.state;
    const Palette& colors = palette(state.theme);
    bool fixed = state.color_range.has_value();
    if (context.widgets.checkbox("Fixed range", &fixed, "The same colours for the same values, whatever is shown"))
        state.color_range = fixed ? std::optional(context.facts.values.value_or(ValueRange{0, 1})) : std::nullopt;
    if (state.color_range) {
        context.widgets.input_number("Lowest", &state.color_range->low);
        context.widgets.input_number("Highest", &state.color_range->high);
    } else if (context.facts.values) {
        ImGui::SameLine();
        show_right(fmt::format("{} to {}", rounded(context.facts.values->low), rounded(context.facts.values->high)),
                   colors.dim);
    }
}

// How a solution is drawn.
void draw_solution(UiContext& context) {
    ViewState& state = context.state;
    const Document& document = context.session.document();
    if (!document.solution) return;
    const auto& cases = document.solution->cases;
    if (cases.size() > 1) {
        std::vector<std::string> names;
        for (const Solution::Case& one : cases) names.push_back(one.name);
        context.widgets.combo("Case", &state.load_case, names);
    }
    context.widgets.input_number("Deform", &state.deform);
    ImGui::SameLine();
    const auto number = static_cast<std::size_t>(state.load_case);
    if (context.widgets.small_button("Auto", "So that the largest displacement is well seen") && number < cases.size())
        state.deform = good_deformation(cases[number].largest_displacement, document.box.diagonal().norm());
    if (is_at_vertices(state.color))
        context.widgets.checkbox("Isolines", &state.isolines, "Lines where values are alike, at tenths of the range");
}

void draw_filter(UiContext& context) {
    ViewState& state = context.state;
    if (!state.filter) return;
    ImGui::AlignTextToFramePadding();
    show(fmt::format("Only {} to {}", rounded(state.filter->low), rounded(state.filter->high)),
         palette(state.theme).accent);
    ImGui::SameLine();
    if (context.widgets.button("Clear filter", "Shows cells of all values again")) state.filter.reset();
}

void fly_to_cell(UiContext& context, const WorstCell& cell) {
    ViewState& state = context.state;
    if (!lies_below(cell.part, state.node)) state.node = cell.part;
    state.step = {Stage::tetrahedra, -1};
    reveal(state, cell.part);
    context.actions.fly_to(cell.center, 0.02 * diagonal_of(context.session.document()));
    state.selection = {Selection::Kind::cell, cell.part, cell.cell, cell.center};
}

void draw_worst_row(UiContext& context, const WorstCell& cell, int i) {
    const Selection& selection = context.state.selection;
    const bool is_selected =
        selection.kind == Selection::Kind::cell && selection.owner == cell.part && selection.index == cell.cell;
    ImGui::TableNextRow();
    ImGui::TableSetColumnIndex(0);
    const std::string label = fmt::format("worst {}", i + 1);
    if (ImGui::Selectable(fmt::format("{}##{}", i + 1, label).c_str(), is_selected,
                          ImGuiSelectableFlags_SpanAllColumns))
        fly_to_cell(context, cell);
    const ImVec2 from = ImGui::GetItemRectMin();  // the row spans columns, which are clipped one by one
    context.widgets.record(label, from, {from.x + 2 * em(), ImGui::GetItemRectMax().y});
    const ImVec4& color = palette(context.state.theme).text;
    ImGui::TableSetColumnIndex(1);
    show_right(rounded(cell.value), color);
    ImGui::TableSetColumnIndex(2);
    show_right(fmt::format("{}", cell.part), color);
    ImGui::TableSetColumnIndex(3);
    show_right(fmt::format("{}", cell.cell), color);
}

void draw_worst_table(UiContext& context, const std::vector<WorstCell>& cells) {
    constexpr ImGuiTableFlags flags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_NoSavedSettings;
    const float rows = std::min(10.f, static_cast<float>(cells.size()) + 1.3f);
    if (!ImGui::BeginTable("##worst", 4, flags, {0, rows * (ImGui::GetTextLineHeight() + 0.4f * em())})) return;
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("##number", ImGuiTableColumnFlags_WidthFixed, 2 * em());
    for (const char* column : {"##value", "##part", "##cell"}) ImGui::TableSetupColumn(column);
    ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
    const ImVec4& dim = palette(context.state.theme).dim;
    int index = 0;
    for (const char* head : {"", "value", "part", "cell"}) {
        ImGui::TableSetColumnIndex(index++);
        show_right(head, dim);
    }
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(cells.size()));
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
            draw_worst_row(context, cells[static_cast<std::size_t>(i)], i);
    ImGui::EndTable();
}

}  // namespace

void draw_worst_cells(UiContext& context) {
    ImGui::SetNextItemOpen(context.state.panels.quality);
    context.state.panels.quality = context.widgets.header("Worst cells", false);
    if (!context.state.panels.quality) return;
    const Palette& colors = palette(context.state.theme);
    if (context.session.document().folder.empty())
        return show_wrapped("There are no cells: open the folder of a run.", colors.dim);
    if (!is_measure(context.state.color))
        return show_wrapped("Choose a measure of cells under Colour, for example the minimum dihedral angle.",
                            colors.dim);
    const auto cells = context.session.worst_cells(context.state.color, 100);
    if (!cells) return show("Reading the cells...", colors.dim);
    if (cells->empty()) return show("No cells have been written yet.", colors.dim);
    draw_worst_table(context, *cells);
}

void draw_color(UiContext& context, Memory& memory) {
    if (context.widgets.header("Colour", true)) {
        const ViewState& state = context.state;
        draw_choice(context);
        const bool needs_cells = is_measure(state.color) || is_kind(state.color) ||
                                 (is_of_solution(state.color) && context.session.document().solution);
        if (needs_cells && context.session.document().folder.empty())
            show_wrapped("Needs tetrahedra, which only the folder of a run has.", palette(state.theme).warning);
        else if (needs_cells && state.step.stage != Stage::tetrahedra) {
            show_wrapped("Only tetrahedra have it.", palette(state.theme).dim);
            if (context.widgets.button("Show the tetrahedra")) context.state.step = {Stage::tetrahedra, -1};
        }
        if (const char* missing = why_without_values(context.session.document(), state.color))
            show_wrapped(missing, palette(state.theme).dim);
        if (is_measure(state.color) || context.facts.values) draw_range(context);
        draw_solution(context);
        if (is_measure(state.color)) {
            draw_histogram(context, memory);
            draw_filter(context);
        }
        ImGui::Spacing();
    }
    draw_worst_cells(context);
    draw_worst_interfaces(context, memory);
}

}  // namespace kerf::view

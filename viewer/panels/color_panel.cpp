// The section of colours: the choice of a colouring, the range of its colours, a filter of cells, and the lists of the
// worst cells and interfaces. Range and filter are two things: the range says which values the colours span, the filter
// which cells are drawn at all. Fields of both are always there, so that nothing below them moves when one is used.
// Another colouring clears both, as their numbers were other values. The list of worst cells holds a hundred and is
// drawn by an ImGuiListClipper, which needs rows of one height.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/core/ids.h"
#include "viewer/model/surface_values.h"
#include "viewer/panels/inside/parts.h"

namespace kerf::view {

namespace {

constexpr float title_place = 0.24f;  // share of the title in the width of a row

void draw_choice(UiContext& context) {
    static const std::vector<std::string> titles = [] {
        std::vector<std::string> all;
        for (int i = 0; i < color_by_count; ++i) all.emplace_back(title(static_cast<ColorBy>(i)));
        return all;
    }();
    std::vector<const char*> why_not;
    for (int i = 0; i < color_by_count; ++i)
        why_not.push_back(why_without_values(context.session.document(), static_cast<ColorBy>(i)));
    int index = static_cast<int>(context.state.coloring.by);
    if (!context.widgets.combo("Colour by", &index, titles, why_not)) return;
    context.state.coloring.by = static_cast<ColorBy>(index);
    context.state.coloring.filter.reset();  // these limits were for other values
    context.state.coloring.range.reset();
}

// Draws a title and two fields in a row, and returns whether one of them was changed.
bool draw_limits(Widgets& widgets, const char* title, const std::array<const char*, 2>& labels, const ValueRange& value,
                 ValueRange& typed, ValueRange& changed) {
    const float left = ImGui::GetCursorPosX(), room = ImGui::GetContentRegionAvail().x;
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x, width = ((1 - title_place) * room - gap) / 2;
    ImGui::AlignTextToFramePadding();
    show(title);
    ImGui::SameLine(left + title_place * room, 0);
    const bool low = input_on_leaving(widgets, labels[0], width, value.low, typed.low);
    if (low) changed.low = typed.low;
    ImGui::SameLine(0, gap);
    const bool high = input_on_leaving(widgets, labels[1], width, value.high, typed.high);
    if (high) changed.high = typed.high;
    return low || high;
}

// Draws the range of the colours. It is always there, so that nothing below moves when it is used.
void draw_range(UiContext& context, ColorMemory& memory) {
    Coloring& coloring = context.state.coloring;
    bool fixed = coloring.range.has_value();
    if (context.widgets.checkbox("Fixed range", &fixed, "The same colours for the same values, whatever is shown"))
        coloring.range = fixed ? std::optional(context.facts.legend.values.value_or(ValueRange{0, 1})) : std::nullopt;
    draw_color_bar(context, memory.bar);
    const ValueRange shown = coloring.range.value_or(context.facts.legend.values.value_or(ValueRange{0, 1}));
    ValueRange changed = shown;
    if (draw_limits(context.widgets, "Colours", {"Lowest", "Highest"}, shown, memory.range, changed))
        coloring.range = changed;
    context.widgets.checkbox("Mark extremes", &coloring.extremes, "Where the least and the largest value are");
}

// Draws the limits of the filter. They are always there, so that nothing below moves when a filter begins.
void draw_filter(UiContext& context, ColorMemory& memory) {
    std::optional<ValueRange>& filter = context.state.coloring.filter;
    const Palette& colors = palette(context.state.theme);
    const ValueRange all = values_of_run(context);
    const ValueRange shown = filter.value_or(all);
    ValueRange changed = shown;
    if (draw_limits(context.widgets, "Only", {"Only from", "Only to"}, shown, memory.filter, changed)) filter = changed;
    ImGui::BeginDisabled(!filter);
    if (context.widgets.button("Clear filter", "Shows cells of all values again")) filter.reset();
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    show(filter ? "Only some cells are shown." : "Cells of all values are shown.", filter ? colors.accent : colors.dim);
}

void fly_to_cell(UiContext& context, const WorstCell& cell) {
    ViewState& state = context.state;
    if (!lies_below(cell.part, state.node)) state.node = cell.part;
    state.step = {Stage::tetrahedra, -1};
    reveal(context, cell.part);
    context.actions.camera.fly_to(cell.center, 0.02 * diagonal_of(context.session.document()), Vec3::Zero());
    state.selection = {Selection::Kind::cell, cell.part, cell.cell, cell.center};
    context.actions.camera.turn_to_selection();
}

// Goes on in the list as far as keys have asked for, and brings the row into sight.
void step_through_worst(UiContext& context, WorstCellsMemory& memory, ListKeys& keys,
                        const std::vector<WorstCell>& cells) {
    const int steps = keys.take(ListKeys::List::worst_cells);
    if (steps == 0) return;
    const int last = count_of(cells) - 1;
    memory.chosen = std::clamp(memory.chosen + steps, 0, last);
    fly_to_cell(context, cells[memory.chosen]);
    const float height = ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y;
    scroll_to_row(memory.chosen * height, 2 * height);
}

void draw_worst_row(UiContext& context, WorstCellsMemory& memory, ListKeys& keys, const WorstCell& cell, int i) {
    const Selection& selection = context.state.selection;
    const bool is_selected =
        selection.kind == Selection::Kind::cell && selection.owner == cell.part && selection.index == cell.cell;
    ImGui::TableNextRow();
    ImGui::TableSetColumnIndex(0);
    const std::string label = fmt::format("worst {}", i + 1);
    if (ImGui::Selectable(fmt::format("{}##{}", i + 1, label).c_str(), is_selected,
                          ImGuiSelectableFlags_SpanAllColumns)) {
        memory.chosen = i;
        keys.list = ListKeys::List::worst_cells;
        fly_to_cell(context, cell);
    }
    const ImVec2 from = ImGui::GetItemRectMin();  // the row spans columns, which are clipped one by one
    context.widgets.record(label, from, {from.x + 2 * em(), ImGui::GetItemRectMax().y});
    const ImVec4& color = palette(context.state.theme).text;
    ImGui::TableSetColumnIndex(1);
    show_right(rounded(cell.value), color);
    ImGui::TableSetColumnIndex(2);
    show_right(fmt::format("{}", cell.part.value()), color);
    ImGui::TableSetColumnIndex(3);
    show_right(fmt::format("{}", cell.cell), color);
}

void draw_worst_table(UiContext& context, WorstCellsMemory& memory, ListKeys& keys,
                      const std::vector<WorstCell>& cells) {
    constexpr ImGuiTableFlags flags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_NoSavedSettings;
    const float rows = std::min(10.f, cells.size() + 1.3f);
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
    step_through_worst(context, memory, keys, cells);
    ImGuiListClipper clipper;
    clipper.Begin(count_of(cells));
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
            draw_worst_row(context, memory, keys, cells[i], i);
    ImGui::EndTable();
}

}  // namespace

ValueRange values_of_run(const UiContext& context) {
    const int measure = histogram_number(context.state.coloring.by);
    if (measure >= 0)
        if (const auto& histogram = context.session.document().histograms[measure])
            return {histogram->min, histogram->max};
    return context.facts.legend.values.value_or(ValueRange{0, 1});
}

void draw_worst_cells(UiContext& context, WorstCellsMemory& memory, ListKeys& keys) {
    draw_head(context.widgets, "Worst cells", context.state.panels.quality, memory.section);
    if (!context.state.panels.quality) return;
    const Palette& colors = palette(context.state.theme);
    if (context.session.document().folder.empty())
        return show_wrapped("There are no cells: open the folder of a run.", colors.dim);
    if (!is_measure(context.state.coloring.by))
        return show_wrapped("Choose a measure of cells under Colour, for example the minimum dihedral angle.",
                            colors.dim);
    const auto cells = context.session.fetched().worst_cells(context.state.coloring.by, 100);
    if (!cells) return show("Reading the cells...", colors.dim);
    if (cells->empty()) return show("No cells have been written yet.", colors.dim);
    draw_worst_table(context, memory, keys, *cells);
}

void draw_color(UiContext& context, ColorMemory& memory, ListKeys& keys) {
    if (context.widgets.header("Colour", true)) {
        const ViewState& state = context.state;
        draw_choice(context);
        const bool needs_cells = is_measure(state.coloring.by) || is_kind(state.coloring.by) ||
                                 (is_of_solution(state.coloring.by) && context.session.document().solution);
        if (needs_cells && context.session.document().folder.empty())
            show_wrapped("Needs tetrahedra, which only the folder of a run has.", palette(state.theme).warning);
        else if (needs_cells && context.session.document().has_surfaces_alone())
            show_wrapped("Needs tetrahedra: kerf mesh makes them.", palette(state.theme).warning);
        else if (needs_cells && state.step.stage != Stage::tetrahedra) {
            show_wrapped("Only tetrahedra have it.", palette(state.theme).dim);
            if (context.widgets.button("Show the tetrahedra")) context.state.step = {Stage::tetrahedra, -1};
        }
        if (state.coloring.by == ColorBy::patch)
            context.widgets.checkbox("Numbers on faces", &context.state.look.numbers, "The numbers of the patches");
        if (const char* missing = why_without_values(context.session.document(), state.coloring.by))
            show_wrapped(missing, palette(state.theme).dim);
        if (is_measure(state.coloring.by) || context.facts.legend.values) draw_range(context, memory);
        draw_solution(context);
        if (is_measure(state.coloring.by)) {
            draw_histogram(context, memory.histogram);
            draw_filter(context, memory);
        }
        ImGui::Spacing();
    }
    draw_worst_cells(context, memory.worst_cells, keys);
    draw_worst_interfaces(context, memory.worst_interfaces);
}

}  // namespace kerf::view

#include "viewer/panels/tree_columns.h"

#include <algorithm>

#include "viewer/panels/style.h"
#include "viewer/panels/text.h"
#include "viewer/panels/tree_words.h"

namespace kerf::view {

namespace {

// In ems.
constexpr float show_width = 2.5f, number_width = 2.75f, load_width = 2.4f, seconds_width = 2, rank_width = 2;
constexpr float widest_state = 4.6f;  // a longer word may be shortened

}  // namespace

TreeColumns::TreeColumns(const std::vector<const TreeRow*>& rows, bool times, float room) {
    find_known(rows, times);
    find_widths(rows);
    // What there is no room for is in the tooltip of a row.
    for (bool* column : {&load, &seconds, &rank})
        if (needed() > room) *column = false;
}

void TreeColumns::find_known(const std::vector<const TreeRow*>& rows, bool times) {
    for (const TreeRow* row : rows) {
        facets |= row->facets >= 0;
        tets |= row->tets >= 0;
        seconds |= times && row->seconds >= 0;
        rank |= row->rank > 0;  // of a single rank there is nothing to say
        if (row->leaf() && row->load > 0) total_load += row->load;
    }
    load = total_load > 0;
}

void TreeColumns::find_widths(const std::vector<const TreeRow*>& rows) {
    node_width = 2.8f;
    for (const TreeRow* row : rows) {
        const auto digits = static_cast<float>(std::to_string(row->id).size());
        const float left = tree_indent * static_cast<float>(level_of(row->id));
        node_width = std::max(node_width, left + 1.3f + 0.56f * digits);
        state_width = std::max(state_width, width_of(word_of(*row, false)) / em() + 0.9f);
    }
}

float TreeColumns::needed() const {
    float width = node_width + show_width + std::min(state_width, widest_state);
    int columns = 3;
    for (const auto& [shown, more] : {std::pair(facets, number_width),
                                      {tets, number_width},
                                      {load, load_width},
                                      {seconds, seconds_width},
                                      {rank, rank_width}}) {
        if (!shown) continue;
        width += more;
        ++columns;
    }
    return width * em() + 2 * static_cast<float>(columns) * ImGui::GetStyle().CellPadding.x;
}

void TreeColumns::set_up() const {
    const auto fixed = [](const char* name, bool shown, float width) {
        const int off = shown ? 0 : ImGuiTableColumnFlags_Disabled;
        ImGui::TableSetupColumn(name, ImGuiTableColumnFlags_WidthFixed | off, width * em());
    };
    ImGui::TableSetupScrollFreeze(0, 1);
    fixed("node", true, node_width);
    fixed("##show", true, show_width);
    ImGui::TableSetupColumn("state", ImGuiTableColumnFlags_WidthStretch);
    fixed("facets", facets, number_width);
    fixed("tets", tets, number_width);
    fixed("load", load, load_width);
    fixed("seconds", seconds, seconds_width);
    fixed("rank", rank, rank_width);
    constexpr const char* titles[column_count] = {"node", "", "state", "facets", "tets", "load", "s", "rank"};
    ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
    for (int i = 0; i < column_count; ++i) {
        if (!ImGui::TableSetColumnIndex(i)) continue;
        const ImVec4 dim = ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled);
        i >= facets_column ? show_right(titles[i], dim) : show(titles[i], dim);
    }
}

}  // namespace kerf::view

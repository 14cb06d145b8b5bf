// The choice and the widths of the tree's columns. A column is shown if a row has a number in it; those about cuts only
// where the user has chosen them. Then columns go, in the order of `first_to_go`, until the rest has room: those chosen
// go last, and the tooltip of a row has all numbers anyway. Sorting puts rows that deserve a look first, which are the
// largest numbers but for angles; it is stable, and rows without a number come last also in reverse. Widths are in ems.
#include "viewer/panels/inside/tree_columns.h"

#include <algorithm>

#include "viewer/panels/inside/style.h"
#include "viewer/panels/inside/tree_words.h"
#include "viewer/panels/text.h"

namespace kerf::view {

namespace {

struct ColumnFacts {
    const char* title;
    float width;  // in ems
    const char* meaning;
};
constexpr std::array<ColumnFacts, column_count> column_facts = {{
    {"node", 0, "Number in the binary tree; a click shows the tree again"},
    {"", 2.5f, ""},
    {"state", 0, "State of a part, or how an inner node was cut"},
    {"facets", 2.75f, "Facets of the closed surface"},
    {"tets", 2.75f, "Tetrahedra"},
    {"load", 2.4f, "Share of the load of all parts"},
    {"s", 2, "Seconds of meshing a part, or of cutting a node"},
    {"rank", 2, "Rank that meshed the part"},
    {"tries", 2, "Planes and repairs that were tried for the cut"},
    {"angle", 2.4f, "Smallest angle of the triangles of the interface, degrees"},
    {"dihedral", 3.4f, "Smallest angle between interface and surface, degrees"},
    {"ratio", 2.4f, "Area of the interface over that of the plane section"},
}};
constexpr float widest_state = 4.6f, narrowest_state = 3.6f;  // in ems; a longer word may be shortened

// The columns that go first where there is no room for all: the tooltip of a row has their numbers, too. Those that the
// user has chosen go last.
constexpr std::array<TreeColumn, 9> first_to_go = {load_column,   seconds_column,  rank_column,
                                                   facets_column, tets_column,     ratio_column,
                                                   tries_column,  dihedral_column, angle_column};

// Whether the largest numbers of a column deserve a look; of the others the smallest do.
bool is_large_first(TreeColumn column) { return column != angle_column && column != dihedral_column; }

std::optional<double> if_known(double value) { return value >= 0 ? std::optional(value) : std::nullopt; }

// An angle, or none where nothing was measured and it is negative or a straight angle.
std::optional<double> if_measured(double angle_deg) {
    return angle_deg >= 0 && angle_deg < 180 ? std::optional(angle_deg) : std::nullopt;
}

}  // namespace

const char* title(TreeColumn column) { return column_facts[column].title; }
const char* meaning(TreeColumn column) { return column_facts[column].meaning; }

std::optional<double> number_in(const TreeRow& row, TreeColumn column) {
    const bool has_interface = row.cut && row.cut->made();
    switch (column) {
        case facets_column:
            return if_known(row.facets);
        case tets_column:
            return if_known(row.tets);
        case load_column:
            return if_known(row.load);
        case seconds_column:
            return if_known(row.seconds);
        case rank_column:
            return if_known(row.rank);
        case tries_column:
            return row.cut && row.cut->tries > 0 ? std::optional<double>(row.cut->tries) : std::nullopt;
        case angle_column:
            return has_interface ? if_measured(row.cut->quality.angle_deg) : std::nullopt;
        case dihedral_column:
            return has_interface ? if_measured(row.cut->quality.dihedral_deg) : std::nullopt;
        case ratio_column:
            return has_interface && row.cut->section_area > 0 && row.cut->interface_area >= 0
                       ? std::optional(row.cut->interface_area / row.cut->section_area)
                       : std::nullopt;
        default:
            return std::nullopt;
    }
}

TreeOrder TreeOrder::after_click(TreeColumn column) const {
    if (column < facets_column || (by == column && reversed)) return {};
    return {column, by == column};
}

void sort_rows(std::vector<const TreeRow*>& rows, const TreeOrder& order) {
    if (!order.by) return;
    const bool large_first = is_large_first(*order.by) != order.reversed;
    std::stable_sort(rows.begin(), rows.end(), [&](const TreeRow* a, const TreeRow* b) {
        const std::optional<double> x = number_in(*a, *order.by), y = number_in(*b, *order.by);
        if (!x || !y) return x.has_value() && !y;
        return large_first ? *x > *y : *x < *y;
    });
}

TreeColumns::TreeColumns(const std::vector<const TreeRow*>& rows, bool times, const std::set<int>& chosen, float room) {
    find_known(rows, times, chosen);
    find_widths(rows);
    for (const TreeColumn column : first_to_go)
        if (needed() > room) shown[column] = false;
}

void TreeColumns::find_known(const std::vector<const TreeRow*>& rows, bool times, const std::set<int>& chosen) {
    shown[node_column] = shown[eye_column] = shown[state_column] = true;
    for (const TreeRow* row : rows) {
        for (int i = facets_column; i < column_count; ++i)
            shown[i] |= number_in(*row, static_cast<TreeColumn>(i)).has_value();
        if (row->leaf() && row->load > 0) total_load += row->load;
    }
    // A run on a single rank needs no column of ranks.
    shown[rank_column] = std::any_of(rows.begin(), rows.end(), [](const TreeRow* row) { return row->rank > 0; });
    shown[seconds_column] &= times;
    shown[load_column] = total_load > 0;
    for (int i = tries_column; i < column_count; ++i) shown[i] &= chosen.contains(i);
}

void TreeColumns::find_widths(const std::vector<const TreeRow*>& rows) {
    node_width = 2.8f;
    for (const TreeRow* row : rows) {
        const float digits = std::to_string(row->id.value()).size();
        const float left = tree_indent * level_of(row->id);
        node_width = std::max(node_width, left + 1.3f + 0.56f * digits);
        state_width = std::max(state_width, width_of(word_of(*row, false)) / em() + 0.9f);
    }
}

float TreeColumns::needed() const {
    const bool any_chosen =
        std::any_of(shown.begin() + tries_column, shown.end(), [](bool is_shown) { return is_shown; });
    float width = node_width + std::min(state_width, any_chosen ? narrowest_state : widest_state);
    int columns = 0;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        width += shown[i] ? column_facts[i].width : 0;
        columns += shown[i];
    }
    return width * em() + 2 * columns * ImGui::GetStyle().CellPadding.x;
}

void TreeColumns::set_up() const {
    ImGui::TableSetupScrollFreeze(0, 1);
    for (int i = 0; i < column_count; ++i) {
        const int off = shown[i] ? 0 : ImGuiTableColumnFlags_Disabled;
        const float width = i == node_column ? node_width : column_facts[i].width;
        if (i == state_column)
            ImGui::TableSetupColumn("state", ImGuiTableColumnFlags_WidthStretch);
        else
            ImGui::TableSetupColumn(i == eye_column ? "##show" : column_facts[i].title,
                                    ImGuiTableColumnFlags_WidthFixed | off, width * em());
    }
}

}  // namespace kerf::view

// The columns of the tree: those that have something to show and that there is room for.
#pragma once

#include <array>
#include <optional>
#include <set>
#include <vector>

#include "viewer/model/tree.h"

namespace kerf::view {

enum TreeColumn {
    node_column,
    eye_column,
    state_column,
    facets_column,
    tets_column,
    load_column,
    seconds_column,
    rank_column,
    tries_column,
    angle_column,
    dihedral_column,
    ratio_column,
};
inline constexpr int column_count = ratio_column + 1;
inline constexpr float tree_indent = 0.5f;  ///< of a level, in ems

const char* title(TreeColumn column);
/// What the head of the column explains.
const char* meaning(TreeColumn column);

/// The number of a row in a column; none if it has none, or is not known.
std::optional<double> number_in(const TreeRow& row, TreeColumn column);
/// Which column a list is sorted by, the rows that deserve a look first, or in reverse; none: as a tree.
struct TreeOrder {
    std::optional<TreeColumn> by;
    bool reversed = false;

    /// After a click on the head of a column: sorted by it, in reverse, as a tree again.
    TreeOrder after_click(TreeColumn column) const;
};
/// Sorts; rows without a number come last, rows alike stay in their order.
void sort_rows(std::vector<const TreeRow*>& rows, const TreeOrder& order);

struct TreeColumns {
    std::array<bool, column_count> shown = {};
    float node_width = 0, state_width = 0;  ///< ems; of the widest text
    double total_load = 0;                  ///< of all parts

    /// For rows in a table of this width. `chosen`: of those about cuts.
    TreeColumns(const std::vector<const TreeRow*>& rows, bool times, const std::set<int>& chosen, float room);
    /// After ImGui::BeginTable(): the columns.
    void set_up() const;

 private:
    void find_known(const std::vector<const TreeRow*>& rows, bool times, const std::set<int>& chosen);
    void find_widths(const std::vector<const TreeRow*>& rows);
    float needed() const;
};

}  // namespace kerf::view

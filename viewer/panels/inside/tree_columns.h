// The columns of the tree: those that have values and for which there is room.
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
inline constexpr float tree_indent = 0.5f;  ///< indent of a level, in ems

const char* title(TreeColumn column);
/// Returns the explanation of a column, which its head shows.
const char* meaning(TreeColumn column);

/// Returns the number of a row in a column; none if there is none, or it is not known.
std::optional<double> number_in(const TreeRow& row, TreeColumn column);
/// The column by which the list of nodes is sorted, the rows that deserve a look first, or in reverse; none: the list
/// is a tree.
struct TreeOrder {
    std::optional<TreeColumn> by;
    bool reversed = false;

    /// Returns the order after a click on the head of a column: sorted by it, then in reverse, then as a tree again.
    TreeOrder after_click(TreeColumn column) const;
};
/// Sorts the rows; those without a number come last, equal ones stay in their order.
void sort_rows(std::vector<const TreeRow*>& rows, const TreeOrder& order);

struct TreeColumns {
    std::array<bool, column_count> shown = {};
    float node_width = 0, state_width = 0;  ///< width of the widest text, in ems
    double total_load = 0;                  ///< sum of the loads of all parts

    /// Chooses the columns for these rows in a table of width `room`, in pixels. `times`: seconds are shown. `chosen`:
    /// the columns about cuts that may be shown.
    TreeColumns(const std::vector<const TreeRow*>& rows, bool times, const std::set<int>& chosen, float room);
    /// Sets up the columns of ImGui's table. Call it after ImGui::BeginTable().
    void set_up() const;

 private:
    void find_known(const std::vector<const TreeRow*>& rows, bool times, const std::set<int>& chosen);
    void find_widths(const std::vector<const TreeRow*>& rows);
    float needed() const;
};

}  // namespace kerf::view

// The columns of the tree: those that have something to show and that there is room for.
#pragma once

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
    rank_column
};
inline constexpr int column_count = rank_column + 1;
inline constexpr float tree_indent = 0.45f;  ///< of a level, in ems

struct TreeColumns {
    bool facets = false, tets = false, load = false, seconds = false, rank = false;  ///< shown; the others always are
    float node_width = 0, state_width = 0;                                           ///< ems; of the widest text
    double total_load = 0;                                                           ///< of all parts

    /// For rows in a table of this width.
    TreeColumns(const std::vector<const TreeRow*>& rows, bool times, float room);
    /// After ImGui::BeginTable(): the columns and their header.
    void set_up() const;

 private:
    void find_known(const std::vector<const TreeRow*>& rows, bool times);
    void find_widths(const std::vector<const TreeRow*>& rows);
    float needed() const;
};

}  // namespace kerf::view

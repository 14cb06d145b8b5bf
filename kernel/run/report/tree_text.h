// The tree of cuts for people.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "cut/decompose/decomposition.h"

namespace kerf {

/// Above this number of parts the tree is printed level by level.
inline constexpr std::ptrdiff_t most_parts_of_node_lines = 32;

/// Returns a line for each node in the order of `nodes`: the node that it was cut from (source) and those that it was
/// cut into (products), its size, the way in which it was cut and the quality of the cut. Above
/// most_parts_of_node_lines parts, unless `every_node` is set, a line for each level instead. A legend ends it. No line
/// is longer than 100 characters, as long as numbers have at most 7 digits. `nodes`: all of the tree, ascending by
/// number.
std::string tree_text(std::span<const TreeNode> nodes, bool every_node);

}  // namespace kerf

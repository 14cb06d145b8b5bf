// The tree of cuts for people.
#pragma once

#include <span>
#include <string>

#include "decompose/decomposition.h"

namespace kerf {

/// Above this number of parts the tree is printed level by level.
inline constexpr std::size_t most_parts_of_node_lines = 32;

/// A line for each node in the order of `nodes`: what it was cut from (source) and into (products), its size, how it
/// was cut and how well. Above most_parts_of_node_lines parts, unless `every_node` is set, a line for each level
/// instead. A legend ends it. No line is longer than 100 characters, as long as numbers have at most 7 digits. `nodes`:
/// all of the tree, ascending by number.
std::string tree_text(std::span<const TreeNode> nodes, bool every_node);

}  // namespace kerf

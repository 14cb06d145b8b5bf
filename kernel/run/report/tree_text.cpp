// The tree is printed as fixed columns below a header: a line for each node, or for each level where there are many
// parts. The children of node i are 2i and 2i+1, so the level of a node is the place of its highest bit, and its source
// is i/2. Nodes ascend by number, so they ascend by level, too: a level is a run of them.
#include "run/report/tree_text.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/core/check.h"
#include "base/core/words.h"

namespace kerf {

namespace {

constexpr const char* node_header =
    "level   node source  products   facets vertices  vol %  cut          tries  section angle dihedral\n";
constexpr const char* node_legend =
    "source: the node it was cut from; products: its halves, a part if it was not cut; vol %: of the\n"
    "whole body; section: area where the plane cuts; angle, dihedral: smallest of interface triangles\n"
    "and between interface and surface, in degrees.\n";
constexpr const char* level_header =
    "level   cuts  parts facets min      max vol % min    max first try  soft whole tries angle dihedral\n";
constexpr const char* level_legend =
    "vol %: of the whole body; first try, soft, whole: cuts by their remedy; tries: mean of the cuts;\n"
    "angle, dihedral: smallest of interface triangles and between interface and surface, in degrees.\n"
    "-v prints every node.\n";

std::string percent(double part, double whole) { return fmt::format("{:.2f}", 100 * part / whole); }

std::string node_line(const TreeNode& node, double volume) {
    const std::string source = node.id == root_node ? "-" : std::to_string(parent_of(node.id).value());
    const std::string products =
        node.is_divided() ? fmt::format("{} {}", child_of(node.id, 0).value(), child_of(node.id, 1).value()) : "part";
    std::string line = fmt::format("{:>5} {:>6} {:>6} {:>9} {:>8} {:>8} {:>6}", level_of(node.id), node.id.value(),
                                   source, products, node.facets, node.vertices, percent(node.mass.volume, volume));
    if (node.regions > 1) line += fmt::format("  {} regions", node.regions);
    if (node.cut_tried) line += fmt::format("  {:<12} {:>5}", in_words(name(node.strategy)), node.tries);
    if (node.cut_made)
        line += fmt::format(" {:>8.3g} {:>5.1f} {:>8.1f}", node.section_area, node.quality.angle_deg,
                            node.quality.dihedral_deg);
    return line + '\n';
}

// Counts over the nodes of a level, and the worst and best of them.
struct LevelSummary {
    std::int32_t cuts = 0, parts = 0, first_tries = 0, soft = 0, whole = 0, tries = 0;
    std::int32_t least_facets = 0, most_facets = 0;
    double least_volume = 0, most_volume = 0;
    InterfaceQuality quality;
};

LevelSummary summarise(std::span<const TreeNode> nodes) {
    LevelSummary level;
    level.least_facets = level.most_facets = nodes.front().facets;
    level.least_volume = level.most_volume = nodes.front().mass.volume;
    for (const TreeNode& node : nodes) {
        level.least_facets = std::min(level.least_facets, node.facets);
        level.most_facets = std::max(level.most_facets, node.facets);
        level.least_volume = std::min(level.least_volume, node.mass.volume);
        level.most_volume = std::max(level.most_volume, node.mass.volume);
        level.parts += !node.is_divided();
        if (!node.cut_tried) continue;
        level.cuts += node.cut_made;
        level.first_tries += node.strategy == CutStrategy::first_try;
        level.soft += node.strategy == CutStrategy::soft;
        level.whole += node.strategy == CutStrategy::whole;
        level.tries += node.tries;
        if (!node.cut_made) continue;
        level.quality.angle_deg = std::min(level.quality.angle_deg, node.quality.angle_deg);
        level.quality.dihedral_deg = std::min(level.quality.dihedral_deg, node.quality.dihedral_deg);
    }
    return level;
}

std::string level_line(std::span<const TreeNode> nodes, double volume) {
    const LevelSummary level = summarise(nodes);
    std::string line = fmt::format("{:>5} {:>6} {:>6} {:>10} {:>8} {:>9} {:>6}", level_of(nodes.front().id), level.cuts,
                                   level.parts, level.least_facets, level.most_facets,
                                   percent(level.least_volume, volume), percent(level.most_volume, volume));
    if (level.tries)
        line += fmt::format(" {:>9} {:>5} {:>5} {:>5.1f}", level.first_tries, level.soft, level.whole,
                            1.0 * level.tries / (level.cuts + level.whole));
    if (level.cuts) line += fmt::format(" {:>5.1f} {:>8.1f}", level.quality.angle_deg, level.quality.dihedral_deg);
    return line + '\n';
}

std::string lines_of_nodes(std::span<const TreeNode> nodes) {
    std::string text = node_header;
    for (const TreeNode& node : nodes) text += node_line(node, nodes.front().mass.volume);
    return text + node_legend;
}

std::string lines_of_levels(std::span<const TreeNode> nodes) {
    std::string text = level_header;
    for (std::size_t begin = 0, end = 0; begin < nodes.size(); begin = end) {
        while (end < nodes.size() && level_of(nodes[end].id) == level_of(nodes[begin].id)) ++end;
        text += level_line(nodes.subspan(begin, end - begin), nodes.front().mass.volume);
    }
    return text + level_legend;
}

}  // namespace

std::string tree_text(std::span<const TreeNode> nodes, bool every_node) {
    const auto by_number = [](const TreeNode& a, const TreeNode& b) { return a.id < b.id; };
    KERF_CHECK(!nodes.empty() && std::is_sorted(nodes.begin(), nodes.end(), by_number));
    const auto parts =
        std::count_if(nodes.begin(), nodes.end(), [](const TreeNode& node) { return !node.is_divided(); });
    const bool few = parts <= most_parts_of_node_lines;
    return every_node || few ? lines_of_nodes(nodes) : lines_of_levels(nodes);
}

}  // namespace kerf

// The printed tree: complete, and no wider than a terminal.
#include "run/report/tree_text.h"

#include <random>
#include <sstream>

#include <gtest/gtest.h>

#include "base/core/words.h"
#include "support/lines.h"

namespace kerf {
namespace {

// Lines that begin with a number: those of nodes or levels.
std::vector<std::string> rows(const std::string& text) {
    std::vector<std::string> found;
    for (const std::string& line : test::lines_of(text))
        if (line.find_first_not_of(' ') == line.find_first_of("0123456789")) found.push_back(line);
    return found;
}

std::vector<std::string> words(const std::string& line) {
    std::istringstream stream(line);
    return {std::istream_iterator<std::string>(stream), {}};
}

TreeNode random_node(NodeId id, bool cut, std::mt19937& random) {
    TreeNode node;
    node.id = id;
    node.facets = static_cast<std::int32_t>(1 + random() % 9999999);
    node.vertices = node.facets / 2;
    node.mass.volume = id == root_node ? 1e6 : 1 + static_cast<double>(random() % 999999);
    node.cut_tried = cut || random() % 4 == 0;
    node.cut_made = cut;
    node.strategy =
        cut ? static_cast<CutStrategy>(random() % static_cast<unsigned>(CutStrategy::whole)) : CutStrategy::whole;
    node.tries = static_cast<std::int32_t>(1 + random() % 99);
    node.section_area = std::ldexp(1.0 + static_cast<double>(random() % 1000), static_cast<int>(random() % 80) - 40);
    node.quality.angle_deg = 1 + static_cast<double>(random() % 89);
    node.quality.dihedral_deg = 1 + static_cast<double>(random() % 179);
    return node;
}

// A complete tree: `parts` leaves, numbers ascending.
std::vector<TreeNode> random_tree(std::int32_t parts, std::mt19937& random) {
    std::vector<TreeNode> nodes;
    for (std::int32_t id = 1; id < 2 * parts; ++id) nodes.push_back(random_node(NodeId(id), id < parts, random));
    return nodes;
}

TEST(TreeText, ALinePerNodeOrPerLevelAndNoneTooLong) {
    constexpr unsigned seed = 3;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    for (const std::int32_t parts : {1, 2, 3, 7, 32, 33, 64, 128, 500}) {
        SCOPED_TRACE(testing::Message() << parts << " parts");
        const std::vector<TreeNode> nodes = random_tree(parts, random);
        const std::string brief = tree_text(nodes, false), full = tree_text(nodes, true);
        for (const std::string& line : test::lines_of(brief + full)) EXPECT_LE(line.size(), 100u) << line;
        EXPECT_EQ(rows(full).size(), nodes.size());
        const int levels = std::bit_width(static_cast<unsigned>(2 * parts - 1));
        EXPECT_EQ(rows(brief).size(), parts <= 32 ? nodes.size() : static_cast<std::size_t>(levels));
    }
}

TEST(TreeText, LinesNameSourceAndProducts) {
    std::mt19937 random(1);
    for (const TreeNode& node : random_tree(9, random)) {
        const std::vector<TreeNode> nodes = {node};
        const std::vector<std::string> found = words(rows(tree_text(nodes, true)).at(0));
        EXPECT_EQ(found[0], std::to_string(std::bit_width(static_cast<unsigned>(node.id.value())) - 1));
        EXPECT_EQ(found[1], std::to_string(node.id.value()));
        EXPECT_EQ(found[2], node.id == root_node ? "-" : std::to_string(parent_of(node.id).value()));
        EXPECT_EQ(found[3], node.cut_made ? std::to_string(child_of(node.id, 0).value()) : "part");
        EXPECT_EQ(found[node.cut_made ? 7 : 6], "100.00") << "of the first node, which is the whole body";
        const bool two_words = node.cut_tried && in_words(name(node.strategy)).find(' ') != std::string::npos;
        EXPECT_EQ(found.size(), (node.cut_made ? 13u : node.cut_tried ? 9u : 7u) + (two_words ? 1 : 0));
    }
}

TEST(TreeText, LevelsAddUp) {
    std::mt19937 random(2);
    const std::vector<TreeNode> nodes = random_tree(77, random);
    std::int32_t cuts = 0, parts = 0;
    for (const std::string& row : rows(tree_text(nodes, false))) {
        const std::vector<std::string> found = words(row);
        cuts += std::stoi(found[1]);
        parts += std::stoi(found[2]);
        EXPECT_LE(std::stoi(found[3]), std::stoi(found[4]));
        EXPECT_LE(std::stod(found[5]), std::stod(found[6]));
    }
    EXPECT_EQ(cuts, 76);
    EXPECT_EQ(parts, 77);
}

}  // namespace
}  // namespace kerf

#include <random>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "files/part/part.h"

namespace kerf {
namespace {

// The leaves of a tree in its order, each node divided by chance.
void add_leaves(NodeId node, std::mt19937& engine, MeshOutline& outline) {
    if (node >= NodeId(1 << 24) || engine() % 100 < 40) {
        outline.parts.push_back({node});
        return;
    }
    add_leaves(child_of(node, 0), engine, outline);
    add_leaves(child_of(node, 1), engine, outline);
}

TEST(MeshOutline, FindsEachPartAndNoOther) {
    for (unsigned seed = 0; seed < 40; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 engine(seed);
        MeshOutline outline;
        add_leaves(root_node, engine, outline);
        for (const PartIndex index : outline.parts.ids()) {
            const NodeId id = outline.parts[index].id;
            EXPECT_EQ(outline.index_of(id), index);
            EXPECT_THROW(outline.index_of(child_of(id, 0)), Error) << "a child of a part";
            if (id > root_node) {
                EXPECT_THROW(outline.index_of(parent_of(id)), Error) << "a node above a part";
            }
        }
        EXPECT_THROW(outline.index_of(NodeId::none()), Error);
        EXPECT_THROW(outline.index_of(no_node), Error);
    }
}

}  // namespace
}  // namespace kerf

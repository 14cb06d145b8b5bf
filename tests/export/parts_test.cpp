// The laws of the parts that all formats are written from.
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "export/cases.h"
#include "part/run_parts.h"

namespace kerf {
namespace {

using Holders = std::map<std::int64_t, std::vector<NodeId>>;  // of every boundary vertex, in the order of the tree

Holders holders_of_boundary(const std::vector<Part>& parts) {
    Holders holders;
    for (const Part& part : parts)
        for (std::int32_t v = 0; v < part.mesh.boundary_vertex_count; ++v)
            holders[part.global_id[static_cast<std::size_t>(v)]].push_back(part.id);
    return holders;
}

std::vector<Part> load_all(const RunParts& run) {
    std::vector<Part> parts;
    for (std::size_t rank = 0; rank < run.outline().parts.size(); ++rank)
        parts.push_back(run.load(static_cast<std::int32_t>(rank)));
    return parts;
}

TEST(Parts, GroupsHoldEveryVertexThatSeveralPartsHave) {
    for (const test::ExportCase& each : test::export_cases()) {
        SCOPED_TRACE(each.name);
        const RunParts run(test::run_of(each));
        const std::vector<Part> parts = load_all(run);
        const Holders holders = holders_of_boundary(parts);
        for (const Part& part : parts) {
            std::set<std::int64_t> grouped;
            for (const SharedGroup& group : part.shared) {
                std::int64_t last = -1;
                for (const std::int32_t v : group.vertices) {
                    const std::int64_t id = part.global_id[static_cast<std::size_t>(v)];
                    EXPECT_EQ(holders.at(id), group.parts);
                    EXPECT_LT(last, id);
                    last = id;
                    EXPECT_TRUE(grouped.insert(id).second);
                }
            }
            for (std::int32_t v = 0; v < part.mesh.boundary_vertex_count; ++v) {
                const std::int64_t id = part.global_id[static_cast<std::size_t>(v)];
                EXPECT_EQ(grouped.contains(id), holders.at(id).size() > 1) << "vertex " << id;
            }
        }
    }
}

TEST(Parts, TheOutlineHasTheNumbersOfTheParts) {
    for (const test::ExportCase& each : test::export_cases()) {
        SCOPED_TRACE(each.name);
        const RunParts run(test::run_of(each));
        std::int64_t owned = 0;
        for (std::size_t rank = 0; rank < run.outline().parts.size(); ++rank) {
            const PartExtent& extent = run.outline().parts[rank];
            const Part part = run.load(static_cast<std::int32_t>(rank));
            std::int64_t interface_facets = 0;
            for (std::size_t f = 0; f < part.facets.size(); ++f) interface_facets += part.is_interface(f);
            EXPECT_EQ(part.id, extent.id);
            EXPECT_EQ(part.vertex_count(), extent.vertices);
            EXPECT_EQ(part.tet_count(), extent.tets);
            EXPECT_EQ(interface_facets, extent.interface_facets);
            EXPECT_EQ(static_cast<std::int64_t>(part.facets.size()) - interface_facets, extent.patch_facets);
            for (const NodeId owner : owners_of_vertices(part)) owned += owner == part.id;
        }
        EXPECT_EQ(owned, run.outline().vertices) << "every vertex has one owner";
    }
}

// What the cases are there for.
TEST(Parts, TheCasesHaveWhatFormatsStumbleOver) {
    const auto find = [](const char* name) {
        const auto& cases = test::export_cases();
        return *std::find_if(cases.begin(), cases.end(), [&](const auto& each) { return each.name == name; });
    };
    const RunParts run(test::run_of(find("inner_parts")));
    bool has_inner_part = false, touches_at_less_than_a_face = false;
    for (const Part& part : load_all(run)) {
        has_inner_part |=
            run.outline().parts[static_cast<std::size_t>(run.outline().rank_of(part.id))].patch_facets == 0;
        const std::set<NodeId> beside(part.neighbour.begin(), part.neighbour.end());
        for (const SharedGroup& group : part.shared)
            for (const NodeId other : group.parts)
                touches_at_less_than_a_face |= other != part.id && !beside.contains(other);
    }
    EXPECT_TRUE(has_inner_part);
    EXPECT_TRUE(touches_at_less_than_a_face);
}

}  // namespace
}  // namespace kerf

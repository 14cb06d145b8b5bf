// The laws of the parts that all formats are written from.
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "export/cases.h"
#include "files/part/joined_parts.h"
#include "files/part/run_parts.h"
#include "fill/mesh/adjacency.h"
#include "fill/mesh/verification.h"

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

std::vector<Part> load_all(const PartSource& run) {
    std::vector<Part> parts;
    for (std::size_t rank = 0; rank < run.outline().parts.size(); ++rank) parts.push_back(run.load(PartIndex(rank)));
    return parts;
}

// Calls check(source) with the parts of every case as they are, and joined into fewer pieces.
template <class Check>
void for_each_source(Check check) {
    for (const test::ExportCase& each : test::export_cases()) {
        const RunParts run(test::run_of(each));
        {
            SCOPED_TRACE(each.name);
            check(run);
        }
        for (const std::int32_t pieces : {1, 2, 3, 5, 7, each.parts}) {
            if (pieces > each.parts) continue;
            SCOPED_TRACE(each.name + " into " + std::to_string(pieces));
            check(JoinedParts(run, pieces));
        }
    }
}

TEST(Parts, GroupsHoldEveryVertexThatSeveralPartsHave) {
    for_each_source([](const PartSource& run) {
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
    });
}

TEST(Parts, TheOutlineHasTheNumbersOfTheParts) {
    for_each_source([](const PartSource& run) {
        std::int64_t owned = 0;
        for (std::size_t rank = 0; rank < run.outline().parts.size(); ++rank) {
            const PartExtent& extent = run.outline().parts[rank];
            const Part part = run.load(PartIndex(rank));
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
    });
}

// Each part obeys the laws of a mesh by itself, with its facets as boundary and each with the tetrahedron behind it;
// together they fill the body.
TEST(Parts, AreMeshesWithTheirFacetsAsBoundary) {
    for_each_source([](const PartSource& run) {
        double volume = 0, area = 0;
        std::map<std::array<std::int64_t, 3>, int> sides;
        for (Part& part : load_all(run)) {
            SurfaceArrays surface;
            surface.vertices = boundary_of(part).mesh.vertices;
            surface.facets = part.facets;
            connect_tets(part.mesh);
            const MeshLaws laws = verify_mesh(part.mesh, surface);
            EXPECT_TRUE(laws.hold());
            EXPECT_EQ(part.tet_at_facet, tets_at_facets(part.mesh, part.facets));
            EXPECT_EQ(std::count(part.tet_at_facet.begin(), part.tet_at_facet.end(), -1), 0);
            volume += laws.volume;
            for (std::size_t f = 0; f < part.facets.size(); ++f) {
                const Triangle& t = part.facets[f];
                const std::vector<Vec3>& p = part.mesh.vertices;
                EXPECT_EQ(part.is_interface(f), part.patch[f] < 0);
                if (!part.is_interface(f)) area += (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm() / 2;
                std::array<std::int64_t, 3> corners;
                for (std::size_t i = 0; i < 3; ++i) corners[i] = part.global_id[static_cast<std::size_t>(t[i])];
                std::sort(corners.begin(), corners.end());
                sides[corners] += part.is_interface(f) ? 1 : 2;
            }
        }
        for (const auto& [corners, count] : sides) EXPECT_EQ(count, 2) << "each triangle is a patch's or two sides";
        const RunParts* whole = dynamic_cast<const RunParts*>(&run);
        static double volume_of_run = 0, area_of_run = 0;
        if (whole) volume_of_run = volume, area_of_run = area;
        EXPECT_NEAR(volume, volume_of_run, 1e-12 * volume);
        EXPECT_NEAR(area, area_of_run, 1e-12 * area);
    });
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
        has_inner_part |= run.outline().parts[run.outline().index_of(part.id)].patch_facets == 0;
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

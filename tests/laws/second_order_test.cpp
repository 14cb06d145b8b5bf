// Meshes of order 2: the same nodes in all parts, however these are written, read and joined; kerf verify sees what is
// wrong with them.
#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "files/io/file_bytes.h"
#include "files/io/run_folder.h"
#include "files/part/curved_nodes_file.h"
#include "files/part/inside/vtu_header.h"
#include "files/part/joined_parts.h"
#include "files/part/run_parts.h"
#include "run/run/verify_folder.h"
#include "support/assets.h"
#include "support/places.h"
#include "support/run_in_process.h"
#include "support/run_laws.h"
#include "support/sealed_run.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

// Number and point of the node on each edge, by the global numbers of its ends.
using NodesOfEdges = std::map<std::array<std::int64_t, 2>, std::pair<std::int64_t, std::array<double, 3>>>;

NodesOfEdges nodes_of(const PartSource& parts) {
    NodesOfEdges nodes;
    for (const PartIndex index : parts.outline().parts.ids()) {
        const Part part = parts.load(index);
        part.edge_nodes.edges.for_all([&](std::int64_t e, const UndirectedEdge& edge) {
            const auto [low, high] = std::minmax(part.global_id[edge[0]], part.global_id[edge[1]]);
            const Vec3& p = part.edge_nodes.points[e];
            nodes[{low, high}] = {part.edge_nodes.global_id[e], {p.x(), p.y(), p.z()}};
        });
    }
    return nodes;
}

class SecondOrder : public testing::TestWithParam<std::string> {
 protected:
    RunReport run(const std::string& name, const std::string& formats = "", int workers = 2) {
        RunRequest options;
        options.order = 2;
        options.curving = Curving::straight;
        options.outputs.formats = formats;
        options.input = test::asset_path(GetParam());
        options.output = folder_.file(name);
        options.workers.program = test::worker_program();
        options.workers.count = workers;
        options.parts = 5;
        SingleRank rank;
        return kerf::run(options, workers, rank);
    }
    FolderVerification verified(const std::string& name) {
        VerifyOptions options;
        options.without_input = true;
        return verify_folder(folder_.file(name), options);
    }

    test::TemporaryFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(Assets, SecondOrder, testing::Values("hollow_box", "cylinder"),
                         [](const auto& param) { return param.param; });

TEST_P(SecondOrder, NodesAreTheSameHoweverPartsAreWrittenReadAndJoined) {
    const RunReport report = run("vtu");
    EXPECT_EQ(report.exit_code, 0);
    const RunParts of_run(folder_.file("vtu"));
    EXPECT_EQ(of_run.outline().order, 2);
    EXPECT_EQ(of_run.outline().nodes(), report.mesh.nodes);
    EXPECT_EQ(test::broken_edge_nodes(of_run), "");
    const NodesOfEdges nodes = nodes_of(of_run);
    for (const std::int32_t pieces : {1, 2, 3}) {
        const JoinedParts joined(of_run, pieces);
        EXPECT_EQ(test::broken_edge_nodes(joined), "");
        EXPECT_EQ(nodes_of(joined), nodes);
    }
    run("stored", "medit");
    const RunParts stored(folder_.file("stored"));
    EXPECT_EQ(nodes_of(stored), nodes);
    run("one_worker", "", 1);
    for (const PartExtent& part : of_run.outline().parts)
        EXPECT_EQ(read_file(path_of_part(folder_.file("one_worker"), part.id)),
                  read_file(path_of_part(folder_.file("vtu"), part.id)));
    for (const char* name : {"vtu", "stored"}) {
        const FolderVerification found = verified(name);
        EXPECT_EQ(found.exit_code(), 0) << to_text(found, name, {});
        EXPECT_EQ(found.nodes, report.mesh.nodes);
        EXPECT_EQ(found.curved_nodes, 0);
    }
}

TEST_P(SecondOrder, SomeContentIsThatOfTheWhole) {
    run("vtu");
    run("stored", "medit");
    for (const char* name : {"vtu", "stored"}) {
        const RunParts parts(folder_.file(name));
        for (const PartIndex index : parts.outline().parts.ids()) {
            const Part whole = parts.load(index);
            const Part cells = parts.load_only(index, PartContent::cells);
            const Part vertices = parts.load_only(index, PartContent::vertices);
            const Part surface = parts.load_only(index, PartContent::surface);
            ASSERT_EQ(cells.node_count(), whole.node_count());
            for (std::int64_t t = 0; t < whole.tet_count(); ++t)
                for (std::size_t i = 0; i < 10; ++i)
                    ASSERT_EQ(cells.node_id(cells.nodes_of_tet(t)[i]), whole.node_id(whole.nodes_of_tet(t)[i]));
            ASSERT_EQ(vertices.node_count(), whole.node_count());
            for (std::int64_t n = 0; n < whole.node_count(); ++n)
                ASSERT_EQ(vertices.node_point(n), whole.node_point(n));
            for (std::int64_t f = 0; f < std::ssize(whole.facets); ++f)
                for (std::size_t i = 0; i < 6; ++i) {
                    const std::int32_t here = surface.nodes_of_facet(f)[i], there = whole.nodes_of_facet(f)[i];
                    ASSERT_EQ(surface.node_id(here), whole.node_id(there));
                    ASSERT_EQ(surface.node_point(here), whole.node_point(there));
                }
        }
    }
}

// Stored parts have the nodes that are not in the middle of their edges in a file of the whole mesh.
TEST_P(SecondOrder, CurvedNodesOfStoredPartsAreThoseOfTheFile) {
    run("stored", "medit");
    const std::string file = curved_nodes_file(folder_.file("stored"));
    EXPECT_TRUE(read_curved_nodes(file).ids.empty());
    NodesOfEdges nodes;
    CurvedNodes curved;
    {
        const RunParts straight(folder_.file("stored"));
        nodes = nodes_of(straight);
    }
    std::map<std::int64_t, std::array<double, 3>> moved;
    for (auto& [edge, node] : nodes) {
        if (node.first % 5 != 0) continue;
        node.second[0] += 1e-9;
        moved[node.first] = node.second;
    }
    for (const auto& [id, p] : moved) {
        curved.ids.push_back(id);
        curved.points.emplace_back(p[0], p[1], p[2]);
    }
    write_curved_nodes(file, curved);
    test::seal_run(folder_.file("stored"));
    const RunParts of_run(folder_.file("stored"));
    EXPECT_EQ(nodes_of(of_run), nodes);
    EXPECT_EQ(nodes_of(JoinedParts(of_run, 2)), nodes);
    const FolderVerification found = verified("stored");
    EXPECT_EQ(found.curved_nodes, std::ssize(curved.ids));
    EXPECT_EQ(found.laws.unequal_edge_nodes + found.laws.misnumbered + found.laws.invalid_curved_cells, 0);
    EXPECT_FALSE(found.laws.passed) << "the report has none";
    curved.points[0] += Vec3(1e3, 2e3, -3e3);
    write_curved_nodes(file, curved);
    test::seal_run(folder_.file("stored"));
    EXPECT_GT(verified("stored").laws.invalid_curved_cells, 0);
    std::filesystem::remove(file);
    EXPECT_THROW(RunParts(folder_.file("stored")), Error);
}

TEST_P(SecondOrder, VerifyFindsWrongNodes) {
    run("vtu");
    const RunParts parts(folder_.file("vtu"));
    const NodeId id = parts.outline().parts.front().id;
    const Part part = parts.load(PartIndex(0));
    const UndirectedEdge edge = part.shared_edges.front().edges.front();
    const std::int64_t node = part.first_edge_node() + part.edge_nodes.edges.find(undirected(edge[0], edge[1]));
    const std::string path = path_of_part(folder_.file("vtu"), id), good = read_file(path);
    const auto overwritten = [&](const char* array, std::size_t at, auto value) {
        std::string bytes = good;
        const VtuHeader header = parse_vtu_header(bytes, path);
        std::memcpy(bytes.data() + header.find(array)->position + 8 + at * sizeof value, &value, sizeof value);
        std::ofstream(path, std::ios::binary) << bytes;
        return verified("vtu").laws;
    };
    const auto place = static_cast<std::size_t>(node);
    EXPECT_GT(overwritten("Points", 3 * place, 0.1234).unequal_edge_nodes, 0);
    EXPECT_GT(overwritten("GlobalVertexId", place, std::int64_t{7}).unequal_edge_nodes, 0);
    const auto last = static_cast<std::size_t>(part.node_count() - 1);  // inside
    EXPECT_GT(overwritten("GlobalVertexId", last, part.node_id(part.node_count() - 1) + 1).misnumbered, 0);
    const RunVerification moved = overwritten("Points", 3 * last, 0.1234);
    EXPECT_FALSE(moved.passed);
    EXPECT_EQ(moved.unequal_edge_nodes, 0);
}

}  // namespace
}  // namespace kerf

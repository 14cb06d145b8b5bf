// Part files of order 2: what was written comes back, and what is damaged does not.
#include <algorithm>
#include <cstring>
#include <fstream>
#include <random>

#include <gtest/gtest.h>

#include "files/io/file_bytes.h"
#include "files/part/curved_nodes_file.h"
#include "files/part/inside/edge_node_reader.h"
#include "files/part/vtu_writer.h"
#include "support/io_error.h"
#include "support/random_part.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

// Facets are faces of tetrahedra; nodes lie anywhere.
Part random_part_of_order_2(unsigned seed) {
    Part part = test::random_part(seed);
    std::mt19937 engine(seed);
    for (std::size_t f = 0; f < part.facets.size(); ++f) {
        Tetrahedron& tet = part.mesh.tets[f % part.mesh.tets.size()];
        for (std::int32_t& v : tet) v = static_cast<std::int32_t>(engine() % part.mesh.boundary_vertex_count);
    }
    for (std::size_t f = 0; f < part.facets.size(); ++f) {
        const Tetrahedron& tet = part.mesh.tets[f % part.mesh.tets.size()];
        part.facets[f] = {tet[f % 4], tet[(f + 1) % 4], tet[(f + 2) % 4]};
    }
    EdgeNodes& nodes = part.edge_nodes;
    nodes.edges = EdgeTable(part.mesh.tets, part.mesh.vertices.size());
    for (std::size_t e = 0; e < nodes.edges.size(); ++e) {
        nodes.points.emplace_back(Vec3(static_cast<double>(engine()), 1.0 / 3, -0.0));
        nodes.global_id.push_back((std::int64_t{1} << 40) + static_cast<std::int64_t>(engine()));
    }
    return part;
}

std::vector<UndirectedEdge> all_edges(const EdgeTable& table) {
    std::vector<UndirectedEdge> edges;
    table.for_all([&](std::int64_t, const UndirectedEdge& edge) { edges.push_back(edge); });
    return edges;
}

class SecondOrderFiles : public testing::Test {
 protected:
    std::string refusal_of(const std::string& bytes) const {
        std::ofstream(damaged_, std::ios::binary) << bytes;
        return test::io_error([&] { read_part(damaged_); });
    }

    test::TemporaryFolder folder_;
    std::string file_ = folder_.file("part.vtu"), damaged_ = folder_.file("damaged.vtu");
};

TEST_F(SecondOrderFiles, NodesComeBackAsTheyWere) {
    for (unsigned seed = 1; seed <= 30; ++seed) {
        SCOPED_TRACE(seed);
        const Part part = random_part_of_order_2(seed);
        const FileHash hash = write_part(file_, part);
        EXPECT_EQ(hash, digest_of(read_file(file_)));
        const Part whole = read_part(file_);
        EXPECT_EQ(whole.order(), 2);
        EXPECT_EQ(whole.mesh.vertices, part.mesh.vertices);
        EXPECT_EQ(whole.mesh.tets, part.mesh.tets);
        EXPECT_EQ(whole.facets, part.facets);
        EXPECT_EQ(whole.global_id, part.global_id);
        EXPECT_EQ(all_edges(whole.edge_nodes.edges), all_edges(part.edge_nodes.edges));
        EXPECT_EQ(whole.edge_nodes.points, part.edge_nodes.points);
        EXPECT_EQ(whole.edge_nodes.global_id, part.edge_nodes.global_id);
        const Part cells = read_part(file_, PartContent::cells), vertices = read_part(file_, PartContent::vertices);
        EXPECT_EQ(cells.order(), 2);
        EXPECT_TRUE(cells.edge_nodes.points.empty());
        EXPECT_EQ(cells.edge_nodes.global_id, part.edge_nodes.global_id);
        for (std::int64_t t = 0; t < part.tet_count(); ++t) EXPECT_EQ(cells.nodes_of_tet(t), part.nodes_of_tet(t));
        EXPECT_EQ(vertices.edge_nodes.points, part.edge_nodes.points);
        EXPECT_EQ(vertices.node_count(), part.node_count());
        const PartCellCounts counts = read_cell_counts(file_);
        EXPECT_EQ(counts.tets, part.tet_count());
        EXPECT_EQ(counts.facets, std::ssize(part.facets));
        const PartPointCounts points = read_point_counts(file_);
        EXPECT_EQ(points.order, 2);
        EXPECT_EQ(points.vertices, part.vertex_count());
        EXPECT_EQ(points.on_edges, std::ssize(part.edge_nodes.points));
    }
}

TEST_F(SecondOrderFiles, SurfacesGetTheNodesOfTheirEdges) {
    for (unsigned seed = 1; seed <= 30; ++seed) {
        SCOPED_TRACE(seed);
        const Part part = random_part_of_order_2(seed);
        write_part(file_, part);
        Part surface = boundary_of(part);
        add_edge_nodes_of_surface(file_, surface);
        for (std::int64_t f = 0; f < std::ssize(part.facets); ++f) {
            const auto here = surface.nodes_of_facet(f), there = part.nodes_of_facet(f);
            for (std::size_t i = 0; i < here.size(); ++i) {
                EXPECT_EQ(surface.node_id(here[i]), part.node_id(there[i]));
                EXPECT_EQ(surface.node_point(here[i]), part.node_point(there[i]));
            }
        }
        surface.facets.pop_back();
        EXPECT_NE(test::io_error([&] { add_edge_nodes_of_surface(file_, surface); }), "");
    }
}

TEST_F(SecondOrderFiles, ValuesHaveARowForEachNode) {
    const Part part = random_part_of_order_2(3);
    std::vector<double> numbers(3 * part.node_count());
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<double>(i) / 7;
    const std::vector<PartValues> values = {{"Displacement", PartValues::Of::points, 3, numbers}};
    write_part(file_, part, {}, values);
    const std::vector<PartValues> back = read_values(file_);
    ASSERT_EQ(back.size(), 1u);
    EXPECT_EQ(std::get<std::vector<double>>(back.front().numbers), numbers);
}

TEST_F(SecondOrderFiles, ThatEndTooEarlyAreRefused) {
    write_part(file_, random_part_of_order_2(6));
    const std::string bytes = read_file(file_);
    for (std::size_t missing = 1; missing <= bytes.size(); missing += missing < 300 ? 7 : 997)
        EXPECT_NE(refusal_of(bytes.substr(0, bytes.size() - missing)).find(damaged_), std::string::npos) << missing;
}

TEST_F(SecondOrderFiles, AnyWrongNodeIsFound) {
    const Part part = random_part_of_order_2(8);
    write_part(file_, part);
    const std::string bytes = read_file(file_);
    const VtuHeader header = parse_vtu_header(bytes, file_);
    const std::int64_t cells = header.find("connectivity")->position + 8;
    std::mt19937 engine(1);
    for (int change = 0; change < 200; ++change) {
        const std::int64_t rows = change % 2 ? part.tet_count() : std::ssize(part.facets);
        const std::int64_t width = change % 2 ? 10 : 6, corners = change % 2 ? 4 : 3;
        const std::int64_t first = change % 2 ? 0 : 10 * part.tet_count();
        const std::int64_t place = first + width * static_cast<std::int64_t>(engine() % rows) + corners +
                                   static_cast<std::int64_t>(engine() % (width - corners));
        std::string damaged = bytes;
        std::int32_t node = 0;
        std::memcpy(&node, damaged.data() + cells + 4 * place, sizeof node);
        node += change % 3 ? 1 : -1;
        std::memcpy(damaged.data() + cells + 4 * place, &node, sizeof node);
        EXPECT_NE(refusal_of(damaged).find("is not that of its edge"), std::string::npos) << change;
    }
}

TEST_F(SecondOrderFiles, DamagedOnesAreRefusedOrReadButNeverWorse) {
    write_part(file_, random_part_of_order_2(9));
    const std::string bytes = read_file(file_);
    int refused = 0;
    for (unsigned seed = 1; seed <= 400; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 engine(seed);
        std::string damaged = bytes;
        const std::size_t range = seed % 2 ? bytes.find("AppendedData") : bytes.size();
        damaged[engine() % range] = static_cast<char>(engine());
        refused += !refusal_of(damaged).empty();
    }
    EXPECT_GT(refused, 50);
}

TEST_F(SecondOrderFiles, CurvedNodesComeBackOrAreRefused) {
    const std::string file = folder_.file("curved");
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{100}}) {
        CurvedNodes nodes;
        for (std::size_t i = 0; i < count; ++i) {
            nodes.ids.push_back(static_cast<std::int64_t>(3 * i) + 7'000'000'000);
            nodes.points.emplace_back(1.0 / 3, -0.0, static_cast<double>(i));
        }
        write_curved_nodes(file, nodes);
        EXPECT_EQ(read_curved_nodes(file).ids, nodes.ids);
        EXPECT_EQ(read_curved_nodes(file).points, nodes.points);
        const std::string bytes = read_file(file);
        for (std::size_t at = 0; at < bytes.size(); at += 1 + bytes.size() / 40) {
            std::string damaged = bytes;
            damaged[at] = static_cast<char>(damaged[at] ^ 16);
            std::ofstream(file, std::ios::binary) << damaged;
            EXPECT_NE(test::io_error([&] { read_curved_nodes(file); }), "") << at;
            std::ofstream(file, std::ios::binary) << bytes.substr(0, at);
            EXPECT_NE(test::io_error([&] { read_curved_nodes(file); }), "") << at;
        }
        if (count < 2) continue;
        std::swap(nodes.ids.front(), nodes.ids.back());
        write_curved_nodes(file, nodes);
        EXPECT_NE(test::io_error([&] { read_curved_nodes(file); }), "");
    }
}

}  // namespace
}  // namespace kerf

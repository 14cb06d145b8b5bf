// Cells of order 2 in all formats that have them: readers of their own tell which node lies on which edge, after the
// formats' manuals; tests/oracles/second_order_test.sh has programs of others do it.
#include <filesystem>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "export/bent_run.h"
#include "export/merged_readers.h"
#include "export/more_merged_readers.h"
#include "export/msh_reader.h"
#include "files/export/format.h"
#include "files/export/merged_file.h"
#include "files/export/whole_mesh.h"
#include "files/part/parts_of_order.h"
#include "fill/mesh/edge_table.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace kerf::second_order_test {
namespace {

using test::BentNodes;
using test::BentRun;
using test::MergedMesh;
using test::MshContent;

const std::vector<test::ExportCase>& cases() { return test::export_cases(); }

// The node on the edge between two corners is the one that the parts have there.
template <std::size_t n, std::size_t m>
void expect_nodes(const BentNodes& nodes, const std::array<std::int64_t, n>& corners,
                  const std::array<std::array<int, 2>, m>& edges, const std::array<std::int64_t, m>& on_edges) {
    for (std::size_t e = 0; e < m; ++e) {
        const std::int64_t a = corners[edges[e][0]], b = corners[edges[e][1]];
        ASSERT_EQ(on_edges[e], nodes.at({std::min(a, b), std::max(a, b)}).id);
    }
}

void expect_points(const BentNodes& nodes, const std::vector<Vec3>& points) {
    for (const auto& [ends, node] : nodes)
        EXPECT_LE((points.at(static_cast<std::size_t>(node.id)) - node.point).norm(), 1e-13 * node.point.norm());
}

void expect_order_2(const BentRun& run, const MergedMesh& mesh, bool has_triangles) {
    const MeshOutline& outline = run.parts().outline();
    const BentNodes nodes = test::nodes_of_edges(run.parts());
    ASSERT_EQ(std::ssize(mesh.points), outline.nodes());
    expect_points(nodes, mesh.points);
    ASSERT_EQ(std::ssize(mesh.tets), outline.tets());
    ASSERT_EQ(mesh.on_edges.size(), mesh.tets.size());
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) expect_nodes(nodes, mesh.tets[t], tet_edges, mesh.on_edges[t]);
    ASSERT_EQ(mesh.on_triangle_edges.size(), has_triangles ? mesh.triangles.size() : 0);
    for (std::size_t f = 0; f < mesh.on_triangle_edges.size(); ++f)
        expect_nodes(nodes, mesh.triangles[f], triangle_edges, mesh.on_triangle_edges[f]);
    // The node sets of patches have the nodes of all edges of their triangles.
    std::map<std::string, std::set<std::int64_t>> of_patches;
    for (std::size_t f = 0; f < mesh.triangles.size() && !mesh.nodes.empty(); ++f) {
        const test::GlobalTriangle& corners = mesh.triangles[f];
        std::set<std::int64_t>& of_patch = of_patches[mesh.patch[f]];
        of_patch.insert(corners.begin(), corners.end());
        for (const auto& [i, j] : triangle_edges)
            of_patch.insert(nodes.at({std::min(corners[i], corners[j]), std::max(corners[i], corners[j])}).id);
    }
    EXPECT_EQ(mesh.nodes, of_patches);
}

TEST(SecondOrder, MergedFilesHaveTheNodesOfEdges) {
    for (const test::ExportCase& each : cases()) {
        const BentRun run(each);
        for (const auto& [name, read, has_triangles] : {std::tuple{"medit", &test::read_medit, true},
                                                        {"tetgen", &test::read_tetgen, false},
                                                        {"abaqus", &test::read_abaqus, false},
                                                        {"vtk", &test::read_vtk, true},
                                                        {"unv", &test::read_unv, true},
                                                        {"feb", &test::read_feb, true}}) {
            SCOPED_TRACE(each.name + " as " + name);
            const test::TemporaryFolder folder;
            ExportFiles files(folder.file("out"));
            const Format& format = find_format(name);
            format.write_merged(run.parts(), {}, files, "whole");
            expect_order_2(run, read(folder.file("out/whole") + format.ending), has_triangles);
        }
    }
}

// Gmsh's manual has the edges 23 and 13 of a tetrahedron in this order.
void expect_msh_nodes(const BentNodes& nodes, const MshContent& file) {
    for (const auto& [tag, element] : file.elements) {
        std::vector<std::int64_t> ids;
        for (const std::int64_t node : element.corners) ids.push_back(node - 1);
        if (element.entity[0] == 2) {
            ASSERT_EQ(ids.size(), 6U);
            expect_nodes(nodes, std::array{ids[0], ids[1], ids[2]}, triangle_edges, std::array{ids[3], ids[4], ids[5]});
        } else {
            ASSERT_EQ(ids.size(), 10U);
            expect_nodes(nodes, std::array{ids[0], ids[1], ids[2], ids[3]}, tet_edges,
                         std::array{ids[4], ids[5], ids[6], ids[7], ids[9], ids[8]});
        }
    }
}

MshContent read_merged_msh(const PartSource& parts, const std::string& version, bool ascii) {
    const test::TemporaryFolder folder;
    ExportFiles files(folder.file("out"), "", {}, {.msh_ascii = ascii});
    find_format("msh").write_merged(parts, {version}, files, "whole");
    return test::read_msh(folder.file("out/whole.msh"));
}

TEST(SecondOrder, MshHasTheNodesOfEdges) {
    for (const test::ExportCase& each : cases()) {
        SCOPED_TRACE(each.name);
        const BentRun run(each);
        const BentNodes nodes = test::nodes_of_edges(run.parts());
        const MshContent whole = read_merged_msh(run.parts(), "4.1", false);
        ASSERT_EQ(std::ssize(whole.nodes), run.parts().outline().nodes());
        EXPECT_EQ(whole.nodes.rbegin()->first, run.parts().outline().nodes());
        for (const auto& [ends, node] : nodes) EXPECT_EQ(whole.nodes.at(node.id + 1).point, node.point);
        expect_msh_nodes(nodes, whole);
        const MshContent old = read_merged_msh(run.parts(), "2.2", false);
        for (const auto& [tag, node] : old.nodes) EXPECT_EQ(node.point, whole.nodes.at(tag).point);
        EXPECT_EQ(old.elements, whole.elements);
        EXPECT_EQ(old, read_merged_msh(run.parts(), "2.2", true));
        EXPECT_EQ(whole, read_merged_msh(run.parts(), "4.1", true));
    }
}

// Each file is complete by itself: its nodes and those of its ghosts are those of the whole.
TEST(SecondOrder, PartsOfMshAreThoseOfTheWhole) {
    for (const test::ExportCase& each : cases()) {
        SCOPED_TRACE(each.name);
        const BentRun run(each);
        const MshContent whole = read_merged_msh(run.parts(), "4.1", false);
        const test::TemporaryFolder folder;
        ExportFiles files(folder.file("out"));
        write_format(find_format("msh"), run.parts(), files);
        std::size_t own = 0;
        for (const RunFile& file : files.list()) {
            const MshContent part = test::read_msh(folder.file("out/" + file.path));
            std::set<std::int64_t> used;
            for (const auto& [tag, element] : part.elements) {
                EXPECT_EQ(element.corners, whole.elements.at(tag).corners);
                used.insert(element.corners.begin(), element.corners.end());
                own += !part.is_ghost(element.entity);
            }
            EXPECT_EQ(used.size(), part.nodes.size());
            for (const auto& [tag, node] : part.nodes) {
                EXPECT_TRUE(used.contains(tag));
                EXPECT_EQ(node.point, whole.nodes.at(tag).point);
            }
        }
        EXPECT_EQ(own, whole.elements.size());
    }
}

TEST(SecondOrder, ItsCornersAreTheMeshOfOrder1) {
    const BentRun run(cases()[1]);
    const auto corners = parts_of_order(run.parts(), 1, [&] { return number_edges(run.parts()); });
    for (const Format* format : formats()) {
        SCOPED_TRACE(format->name);
        const test::TemporaryFolder folder;
        ExportFiles one(folder.file("one")), two(folder.file("two"));
        write_format(*format, run.of_order_1(), one);
        write_format(*format, *corners, two);
        EXPECT_EQ(test::contents_below(folder.file("one")), test::contents_below(folder.file("two")));
    }
    EXPECT_EQ(parts_of_order(run.parts(), 0, {}), nullptr);
    EXPECT_EQ(parts_of_order(run.parts(), 2, {}), nullptr);
}

TEST(SecondOrder, FormatsWithoutSuchCellsRefuseThemBeforeTheFirstByte) {
    const BentRun run(cases()[0]);
    std::string able;
    for (const Format* format : formats())
        if (format->highest_order == 2) able += (able.empty() ? "" : ", ") + std::string(format->name);
    int refused = 0;
    for (const Format* format : formats()) {
        if (format->highest_order == 2) continue;
        ++refused;
        const test::TemporaryFolder folder;
        ExportFiles files(folder.file("out"));
        try {
            write_format(*format, run.parts(), files);
            ADD_FAILURE() << format->name;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage);
            EXPECT_EQ(error.what(), std::string(format->name) +
                                        " has no cells of order 2. Choose --order 1, or a format that has: " + able +
                                        ".");
        }
        EXPECT_TRUE(folder.names().empty());
    }
    EXPECT_EQ(refused, 3) << "openfoam, su2 and vtp";
}

// ---- as users start it ----

class SecondOrderOfARun : public testing::Test {
 protected:
    ChildResult kerf(const std::vector<std::string>& arguments) const { return test::run_kerf(arguments); }
    const std::string run_ = test::run_of(cases()[1]);
    test::TemporaryFolder folder_;
};

TEST_F(SecondOrderOfARun, ExportAndMergeMakeIt) {
    ASSERT_EQ(kerf({"export", run_, "--format", "msh", "--order", "2", "-o", folder_.file("parts"), "-q"}).exit_code,
              0);
    ASSERT_EQ(kerf({"merge", run_, "-o", folder_.file("whole.msh"), "--order", "2", "-q"}).exit_code, 0);
    const RunParts parts(run_);
    const SecondOrderParts straight(parts, number_edges(parts));
    const MshContent whole = test::read_msh(folder_.file("whole.msh"));
    expect_msh_nodes(test::nodes_of_edges(straight), whole);
    for (std::size_t k = 1; k <= parts.outline().parts.size(); ++k) {
        const MshContent part = test::read_msh(folder_.file("parts/mesh_" + std::to_string(k) + ".msh"));
        for (const auto& [tag, element] : part.elements) EXPECT_EQ(element.corners, whole.elements.at(tag).corners);
    }
}

TEST_F(SecondOrderOfARun, WritesWhatAnExportOfOrder1Writes) {
    const std::string formats = "msh,mfem,hdf5,medit,tetgen,abaqus";
    ASSERT_EQ(kerf({"mesh", run_ + ".stl", "-o", folder_.file("run"), "-n", "5", "--order", "2", "--curve", "straight",
                    "--format", formats, "-q"})
                  .exit_code,
              0);
    ASSERT_EQ(kerf({"export", run_, "--format", formats, "--order", "2", "-o", folder_.file("out"), "-q"}).exit_code,
              0);
    std::filesystem::remove(folder_.file("out/kerf_export.json"));
    EXPECT_TRUE(test::contents_below(folder_.file("run/export")) == test::contents_below(folder_.file("out")));
}

TEST_F(SecondOrderOfARun, WhatCannotHoldItIsRefused) {
    const ChildResult merged = kerf({"merge", run_, "-o", folder_.file("whole.su2"), "--order", "2"});
    EXPECT_EQ(merged.exit_code, 2) << merged.log;
    const ChildResult exported =
        kerf({"export", run_, "--format", "msh,openfoam", "--order", "2", "-o", folder_.file("case")});
    EXPECT_EQ(exported.exit_code, 2) << exported.log;
    EXPECT_NE(exported.log.find("openfoam has no cells of order 2."), std::string::npos) << exported.log;
    const ChildResult meshed =
        kerf({"mesh", run_ + ".stl", "-o", folder_.file("run"), "--order", "2", "--format", "su2"});
    EXPECT_EQ(meshed.exit_code, 2) << meshed.log;
    EXPECT_TRUE(folder_.names().empty());
}

}  // namespace
}  // namespace kerf::second_order_test

// The files are read as MFEM's ParMesh reads them, comments only where it skips them. What the ranks say they share is
// compared with what they have in common by the global numbers of their parts.
#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "export/bent_run.h"
#include "export/input_sums.h"
#include "files/export/format.h"
#include "files/part/bodies.h"
#include "files/part/joined_parts.h"
#include "files/part/run_parts.h"
#include "support/temporary_folder.h"

namespace kerf::mfem_test {
namespace {

using Ranks = std::vector<int>;
template <std::size_t n>
using Ids = std::array<std::int64_t, n>;  // global numbers

struct MfemCell {
    int attribute = 0, geometry = 0;
    std::vector<int> corners;
};

struct MfemGroupRead {
    Ranks ranks;
    std::vector<std::array<int, 1>> vertices;
    std::vector<std::array<int, 2>> edges;
    std::vector<std::array<int, 3>> faces;
};

struct MfemRank {
    std::vector<MfemCell> elements, boundary;
    std::vector<Vec3> vertices;
    std::map<std::array<int, 2>, Vec3> on_edges;  // of order 2, by both ends, the smaller one first
    std::vector<MfemGroupRead> groups;
    std::map<int, std::string> names;  // of attributes
};

class MfemReader {
 public:
    explicit MfemReader(const std::string& path) : stream_(path) {}

    MfemRank read() {
        std::string line;
        std::getline(stream_, line);
        EXPECT_EQ(line, "MFEM mesh v1.2");
        EXPECT_EQ(section("dimension"), 3);
        read_cells("elements", rank_.elements);
        read_cells("boundary", rank_.boundary);
        rank_.vertices.resize(section("vertices"));
        std::string coordinates;
        stream_ >> coordinates;
        if (coordinates != "nodes") {
            EXPECT_EQ(coordinates, "3");
            for (Vec3& p : rank_.vertices) p = point();
        } else {
            read_nodes();
        }
        skip_comments();
        std::getline(stream_, line);
        EXPECT_EQ(line, "mfem_serial_mesh_end");
        read_groups();
        skip_comments();
        expect("mfem_mesh_end");
        EXPECT_TRUE(stream_) << "the file is long enough";
        stream_ >> line;
        EXPECT_FALSE(stream_) << "and ends there";
        return std::move(rank_);
    }

 private:
    int number() {
        int value = -1;
        stream_ >> value;
        return value;
    }
    void expect(const std::string& word) {
        std::string found;
        stream_ >> found;
        EXPECT_EQ(found, word);
    }
    int entry(const std::string& name) {
        expect(name);
        return number();
    }
    int section(const std::string& name) {
        skip_comments();
        return entry(name);
    }

    void skip_comments() {
        for (stream_ >> std::ws; stream_.peek() == '#'; stream_ >> std::ws) {
            std::string line;
            std::getline(stream_, line);
            const std::string key = "# boundary attribute ";
            if (!line.starts_with(key)) continue;
            const std::size_t colon = line.find(": ");
            rank_.names[std::stoi(line.substr(key.size()))] = line.substr(colon + 2);
        }
    }

    Vec3 point() {
        Vec3 p = Vec3::Zero();
        stream_ >> p[0] >> p[1] >> p[2];
        return p;
    }

    // As GridFunction reads a space of one unknown a vertex and an edge, with the components of each together. MFEM
    // numbers edges as Mesh::GetVertexToVertexTable() meets them: cell after cell, 01 02 03 12 13 23 in each.
    void read_nodes() {
        std::string line;
        stream_ >> std::ws;
        for (const char* expected :
             {"FiniteElementSpace", "FiniteElementCollection: H1_3D_P2", "VDim: 3", "Ordering: 1"}) {
            std::getline(stream_, line);
            EXPECT_EQ(line, expected);
        }
        for (Vec3& p : rank_.vertices) p = point();
        for (const MfemCell& cell : rank_.elements)
            for (std::size_t i = 0; i < 4; ++i)
                for (std::size_t j = i + 1; j < 4; ++j) {
                    const std::array edge{std::min(cell.corners[i], cell.corners[j]),
                                          std::max(cell.corners[i], cell.corners[j])};
                    if (!rank_.on_edges.contains(edge)) rank_.on_edges[edge] = point();
                }
    }

    void read_cells(const std::string& name, std::vector<MfemCell>& cells) {
        cells.resize(section(name));
        for (MfemCell& cell : cells) {
            cell.attribute = number();
            cell.geometry = number();
            cell.corners.resize(cell.geometry == 4 ? 4 : 3);
            for (int& v : cell.corners) v = number();
        }
    }

    template <std::size_t n>
    void read_shared(const std::string& name, std::vector<std::array<int, n>>& entities) {
        entities.resize(entry(name));
        for (auto& entity : entities) {
            if (n == 3) {
                EXPECT_EQ(number(), 2) << "geometry of a shared triangle";
            }
            for (int& v : entity) v = number();
        }
    }

    void read_groups() {
        skip_comments();
        expect("communication_groups");
        rank_.groups.resize(entry("number_of_groups"));
        skip_comments();
        for (MfemGroupRead& group : rank_.groups) {
            group.ranks.resize(number());
            for (int& r : group.ranks) r = number();
        }
        std::size_t vertices = section("total_shared_vertices"), edges = section("total_shared_edges"),
                    faces = section("total_shared_faces");
        for (std::size_t g = 1; g < rank_.groups.size(); ++g) {
            MfemGroupRead& group = rank_.groups[g];
            skip_comments();
            read_shared("shared_vertices", group.vertices);
            read_shared("shared_edges", group.edges);
            read_shared("shared_faces", group.faces);
            vertices -= group.vertices.size(), edges -= group.edges.size(), faces -= group.faces.size();
        }
        EXPECT_EQ(vertices, 0u);
        EXPECT_EQ(edges, 0u);
        EXPECT_EQ(faces, 0u);
    }

    std::ifstream stream_;
    MfemRank rank_;
};

struct MfemMesh {
    std::vector<MfemRank> ranks;
    std::vector<Part> parts;
    std::vector<std::vector<std::int32_t>> bodies;  // of the tetrahedra of each part
};

MfemMesh export_and_read(const PartSource& run) {
    const test::TemporaryFolder folder;
    ExportFiles files(folder.file("mfem"));
    write_format(find_format("mfem"), run, files);
    EXPECT_EQ(files.list().size(), run.outline().parts.size());
    MfemMesh mesh;
    for (std::size_t r = 0; r < run.outline().parts.size(); ++r) {
        SCOPED_TRACE("rank " + std::to_string(r));
        mesh.ranks.push_back(MfemReader(folder.file(fmt::format("mfem/mesh.{:06}", r))).read());
        mesh.parts.push_back(run.load(PartIndex(r)));
        mesh.bodies.push_back(run.bodies().of_tets(PartIndex(r), mesh.parts.back()));
    }
    return mesh;
}

// Calls take(case, mesh) for the parts of all cases, and for about a third as many pieces that they are joined into.
template <class Take>
void for_each_mesh(Take take) {
    for (const test::ExportCase& each : test::export_cases()) {
        SCOPED_TRACE(each.name);
        const RunParts run(test::run_of(each));
        take(each, export_and_read(run));
        SCOPED_TRACE("joined");
        take(each, export_and_read(JoinedParts(run, (each.parts + 2) / 3)));
    }
}

template <std::size_t n>
Ids<n> ids_of(const Part& part, const std::array<int, n>& corners) {
    Ids<n> ids;
    for (std::size_t i = 0; i < n; ++i) ids[i] = part.global_id.at(static_cast<std::size_t>(corners[i]));
    return ids;
}

template <std::size_t n>
Ids<n> sorted(Ids<n> ids) {
    std::sort(ids.begin(), ids.end());
    return ids;
}

// The ranks that hold an entity, found by looking at every cell.
struct Holders {
    std::map<Ids<1>, Ranks> vertices;
    std::map<Ids<2>, Ranks> edges;
    std::map<Ids<3>, Ranks> faces;
    std::int64_t cells = 0;

    static void add(Ranks& ranks, int rank) {
        if (ranks.empty() || ranks.back() != rank) ranks.push_back(rank);
    }
    explicit Holders(const MfemMesh& mesh) {
        for (std::size_t r = 0; r < mesh.ranks.size(); ++r)
            for (const MfemCell& cell : mesh.ranks[r].elements) {
                const std::vector<int>& v = cell.corners;
                const int rank = static_cast<int>(r);
                const Part& part = mesh.parts[r];
                ++cells;
                for (int i = 0; i < 4; ++i) {
                    add(vertices[ids_of<1>(part, {v[i]})], rank);
                    for (int j = 0; j < i; ++j) add(edges[sorted(ids_of<2>(part, {v[j], v[i]}))], rank);
                    add(faces[sorted(ids_of<3>(part, {v[tet_faces[i][0]], v[tet_faces[i][1]], v[tet_faces[i][2]]}))],
                        rank);
                }
            }
    }
};

TEST(Mfem, EveryRankIsItsPart) {
    for_each_mesh([](const test::ExportCase&, const MfemMesh& mesh) {
        for (std::size_t r = 0; r < mesh.ranks.size(); ++r) {
            SCOPED_TRACE("rank " + std::to_string(r));
            const MfemRank& rank = mesh.ranks[r];
            const Part& part = mesh.parts[r];
            EXPECT_EQ(rank.vertices, part.mesh.vertices);
            ASSERT_EQ(rank.elements.size(), part.mesh.tets.size());
            std::set<int> used;
            for (std::size_t t = 0; t < rank.elements.size(); ++t) {
                const MfemCell& cell = rank.elements[t];
                EXPECT_EQ(cell.attribute, mesh.bodies[r][t] + 1);
                EXPECT_EQ(cell.geometry, 4);
                used.insert(cell.corners.begin(), cell.corners.end());
            }
            EXPECT_EQ(used.size(), rank.vertices.size()) << "MFEM would renumber others";
        }
    });
}

// Oriented as in the tetrahedron behind it, and there is none in front of it.
TEST(Mfem, TheBoundaryIsTheUsersSurface) {
    for_each_mesh([](const test::ExportCase&, const MfemMesh& mesh) {
        std::map<Ids<3>, int> sides;  // of triangles without a second tetrahedron
        for (std::size_t r = 0; r < mesh.ranks.size(); ++r)
            for (const MfemCell& cell : mesh.ranks[r].elements)
                for (const auto& face : tet_faces) {
                    const Ids<3> ids =
                        ids_of<3>(mesh.parts[r], {cell.corners[face[0]], cell.corners[face[1]], cell.corners[face[2]]});
                    const bool even = (ids[0] < ids[1]) + (ids[1] < ids[2]) + (ids[2] < ids[0]) == 2;
                    sides[sorted(ids)] += even ? 1 : -1;
                }
        std::int64_t outer = 0, listed = 0;
        for (const auto& [ids, side] : sides) outer += side != 0;
        for (std::size_t r = 0; r < mesh.ranks.size(); ++r)
            for (const MfemCell& cell : mesh.ranks[r].boundary) {
                const std::vector<int>& v = cell.corners;
                const Ids<3> ids = ids_of<3>(mesh.parts[r], {v[0], v[1], v[2]});
                const bool even = (ids[0] < ids[1]) + (ids[1] < ids[2]) + (ids[2] < ids[0]) == 2;
                EXPECT_EQ(cell.geometry, 2);
                EXPECT_EQ(sides.at(sorted(ids)), even ? 1 : -1);
                ++listed;
            }
        EXPECT_EQ(listed, outer);
    });
}

TEST(Mfem, VolumeAndAreasAreThoseOfTheInput) {
    for_each_mesh([](const test::ExportCase& each, const MfemMesh& mesh) {
        double volume = 0;
        std::map<std::string, double> areas;
        for (const MfemRank& rank : mesh.ranks) {
            const auto& p = rank.vertices;
            for (const MfemCell& cell : rank.elements) {
                const std::vector<int>& v = cell.corners;
                const double of_cell = test::signed_volume(p[v[0]], p[v[1]], p[v[2]], p[v[3]]);
                EXPECT_GT(of_cell, 0);
                volume += of_cell;
            }
            for (const MfemCell& cell : rank.boundary)
                areas[rank.names.at(cell.attribute)] +=
                    test::area(p[cell.corners[0]], p[cell.corners[1]], p[cell.corners[2]]);
        }
        EXPECT_NEAR(volume, test::volume_of(each.surface), 1e-9 * volume);
        test::expect_same_areas(areas, test::area_by_patch(each.surface));
    });
}

TEST(Mfem, GroupsAreSetsOfRanksThatAllOfThemList) {
    for_each_mesh([](const test::ExportCase&, const MfemMesh& mesh) {
        for (std::size_t r = 0; r < mesh.ranks.size(); ++r) {
            SCOPED_TRACE("rank " + std::to_string(r));
            const int rank = static_cast<int>(r);
            ASSERT_FALSE(mesh.ranks[r].groups.empty());
            EXPECT_EQ(mesh.ranks[r].groups[0].ranks, Ranks{rank});
            std::set<Ranks> seen;
            for (const MfemGroupRead& group : mesh.ranks[r].groups) {
                EXPECT_TRUE(std::is_sorted(group.ranks.begin(), group.ranks.end())) << "MFEM looks sets up sorted";
                EXPECT_TRUE(std::binary_search(group.ranks.begin(), group.ranks.end(), rank));
                EXPECT_TRUE(seen.insert(group.ranks).second);
                for (const int other : group.ranks) {
                    const auto& theirs = mesh.ranks.at(other).groups;
                    EXPECT_TRUE(std::any_of(theirs.begin(), theirs.end(),
                                            [&](const MfemGroupRead& g) { return g.ranks == group.ranks; }));
                }
            }
        }
    });
}

// The entities of a group, with their corners in the order of the file, must be the same list in all of its ranks.
template <std::size_t n>
void expect_shared(const MfemMesh& mesh, const std::map<Ids<n>, Ranks>& holders,
                   std::vector<std::array<int, n>> MfemGroupRead::*entities) {
    std::map<Ranks, std::vector<Ids<n>>> lists;
    std::map<int, std::set<Ids<n>>> listed;  // by rank
    for (std::size_t r = 0; r < mesh.ranks.size(); ++r)
        for (const MfemGroupRead& group : mesh.ranks[r].groups) {
            std::vector<Ids<n>> list;
            for (const auto& entity : group.*entities) {
                list.push_back(ids_of<n>(mesh.parts[r], entity));
                const Ids<n> key = sorted(list.back());
                ASSERT_TRUE(holders.contains(key));
                EXPECT_EQ(holders.at(key), group.ranks);
                EXPECT_TRUE(listed[static_cast<int>(r)].insert(key).second) << "listed twice";
            }
            if (group.ranks.size() > 1) {
                EXPECT_EQ(lists.emplace(group.ranks, list).first->second, list);
            }
        }
    for (const auto& [ids, ranks] : holders)
        for (const int rank : ranks) EXPECT_EQ(listed[rank].contains(ids), ranks.size() > 1);
}

TEST(Mfem, GroupsListWhatTheirRanksShareInOneOrder) {
    for_each_mesh([](const test::ExportCase&, const MfemMesh& mesh) {
        const Holders holders(mesh);
        expect_shared(mesh, holders.vertices, &MfemGroupRead::vertices);
        expect_shared(mesh, holders.edges, &MfemGroupRead::edges);
        expect_shared(mesh, holders.faces, &MfemGroupRead::faces);
    });
}

// Ranks count what they hold, except for what a rank before them shares with them.
TEST(Mfem, EulersCountOfTheRanksIsThatOfTheWhole) {
    for_each_mesh([](const test::ExportCase&, const MfemMesh& mesh) {
        const Holders holders(mesh);
        const auto count = [](auto a, auto b, auto c, auto d) {
            return static_cast<std::int64_t>(a) - static_cast<std::int64_t>(b) + static_cast<std::int64_t>(c) -
                   static_cast<std::int64_t>(d);
        };
        std::int64_t of_ranks = 0;
        for (std::size_t r = 0; r < mesh.ranks.size(); ++r) {
            MfemMesh alone;
            alone.ranks.push_back(mesh.ranks[r]);
            alone.parts.push_back(mesh.parts[r]);
            const Holders own(alone);
            of_ranks += count(own.vertices.size(), own.edges.size(), own.faces.size(), own.cells);
            for (const MfemGroupRead& group : mesh.ranks[r].groups)
                if (group.ranks.front() != static_cast<int>(r))
                    of_ranks -= count(group.vertices.size(), group.edges.size(), group.faces.size(), 0);
        }
        EXPECT_EQ(of_ranks, count(holders.vertices.size(), holders.edges.size(), holders.faces.size(), holders.cells));
    });
}

TEST(Mfem, OfOrder2HasTheNodesOfEdgesInTheOrderOfItsNumbers) {
    for (const test::ExportCase& each : test::export_cases()) {
        SCOPED_TRACE(each.name);
        const test::BentRun run(each);
        const MfemMesh mesh = export_and_read(run.parts());
        for (std::size_t r = 0; r < mesh.ranks.size(); ++r) {
            const Part& part = mesh.parts[r];
            EXPECT_EQ(mesh.ranks[r].vertices, part.mesh.vertices);
            ASSERT_EQ(mesh.ranks[r].on_edges.size(), part.edge_nodes.points.size());
            part.edge_nodes.edges.for_all([&](std::int64_t e, const UndirectedEdge& edge) {
                EXPECT_EQ(mesh.ranks[r].on_edges.at({edge[0], edge[1]}), part.edge_nodes.points[e]);
            });
        }
    }
}

// What the case of 64 parts is there for: two ends in common, and not the edge between them.
TEST(Mfem, PartsMayShareBothEndsOfAnEdgeAndNotTheEdge) {
    const auto& cases = test::export_cases();
    const auto inner =
        std::find_if(cases.begin(), cases.end(), [](const test::ExportCase& c) { return c.name == "inner_parts"; });
    ASSERT_NE(inner, cases.end());
    const Holders holders(export_and_read(RunParts(test::run_of(*inner))));
    std::int64_t many = 0, without_edge = 0;
    for (const auto& [ids, ranks] : holders.edges) {
        const Ranks &a = holders.vertices.at({ids[0]}), &b = holders.vertices.at({ids[1]});
        Ranks both;
        std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
        without_edge += both.size() > ranks.size();
        many += ranks.size() > 2;
    }
    EXPECT_GT(many, 0) << "edges of three parts";
    EXPECT_GT(without_edge, 0);
}

}  // namespace
}  // namespace kerf::mfem_test

// Regions and the walls between them in every format: as many cells of each, and each wall once or not at all.
#include <map>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "export/merged_readers.h"
#include "export/more_merged_readers.h"
#include "export/msh_reader.h"
#include "export/regions_cases.h"
#include "files/export/format.h"
#include "files/export/inside/hdf5_arrays.h"
#include "files/io/surface_reader.h"
#include "files/part/joined_surfaces.h"
#include "support/all_formats.h"
#include "support/temporary_folder.h"

namespace kerf::regions_export_test {
namespace {

using test::FinishedRegions, test::RegionsCase;
using Sizes = std::vector<std::int64_t>;
using SizeByName = std::map<std::string, std::int64_t>;

// What the parts say.
struct Expected {
    explicit Expected(const PartSource& parts) : tets(parts.outline().region_names.size(), 0) {
        for (const PartIndex index : parts.outline().parts.ids()) {
            const Part part = parts.load(index);
            for (std::int32_t t = 0; t < part.tet_count(); ++t)
                ++tets[static_cast<std::size_t>(part.region_of(t).value())];
            for (std::size_t f = 0; f < part.facets.size(); ++f) {
                outer += part.is_on_outer_boundary(f);
                walls += part.is_wall(f);
            }
        }
        EXPECT_EQ(walls % 2, 0);
        walls /= 2;
        EXPECT_EQ(outer + walls, parts.outline().patch_facets());
        EXPECT_EQ(walls > 0, parts.outline().parts.size() > 1);
    }
    // Triangles by patch, as formats count them that list walls.
    Sizes triangles() const { return walls > 0 ? Sizes{outer, walls} : Sizes{outer}; }

    Sizes tets;
    std::int64_t outer = 0, walls = 0;
};

template <class Items>
Sizes sizes_of(const Items& items) {
    std::map<typename Items::value_type, std::int64_t> counts;
    for (const auto& item : items) ++counts[item];
    Sizes sizes;
    for (const auto& [item, count] : counts) sizes.push_back(count);
    return sizes;
}

Sizes in_order(const SizeByName& named) {
    Sizes sizes;
    for (const auto& [name, size] : named) sizes.push_back(size);
    return sizes;
}

test::MergedMesh merged(const PartSource& parts, const char* format, test::MergedMesh (*read)(const std::string&)) {
    const test::TemporaryFolder folder;
    ExportFiles files(folder.file("out"));
    find_format(format).write_merged(parts, {}, files, "whole");
    return read(folder.file("out/whole") + find_format(format).ending);
}

TEST(Regions, AreTheMaterialsOfMergedFiles) {
    test::for_each_regions_source([](const PartSource& parts) {
        const Expected expected(parts);
        const auto check = [&](const char* format, test::MergedMesh (*read)(const std::string&)) {
            SCOPED_TRACE(format);
            const test::MergedMesh mesh = merged(parts, format, read);
            EXPECT_EQ(sizes_of(mesh.body), expected.tets);
            EXPECT_EQ(sizes_of(mesh.patch), expected.triangles());
        };
        check("medit", test::read_medit);
        check("tetgen", test::read_tetgen);
        check("abaqus", test::read_abaqus);
        check("vtu", test::read_vtu);
        check("vtk", test::read_vtk);
        check("unv", test::read_unv);
        check("feb", test::read_feb);
    });
}

// Pressure on a wall must not turn round from one part to the next.
TEST(Regions, SurfacesOfAbaqusLieOnOneSideOfWalls) {
    test::for_each_regions_source([](const PartSource& parts) {
        const test::MergedMesh mesh = merged(parts, "abaqus", test::read_abaqus);
        std::map<std::set<std::int64_t>, std::vector<std::size_t>> tets_at;
        for (std::size_t t = 0; t < mesh.tets.size(); ++t)
            for (std::size_t left_out = 0; left_out < 4; ++left_out) {
                std::set<std::int64_t> corners(mesh.tets[t].begin(), mesh.tets[t].end());
                corners.erase(mesh.tets[t][left_out]);
                tets_at[corners].push_back(t);
            }
        std::int64_t walls = 0;
        for (const test::GlobalTriangle& triangle : mesh.triangles) {
            const auto at = [&](std::int64_t v) { return mesh.points[static_cast<std::size_t>(v)]; };
            const Vec3 a = at(triangle[0]), normal = (at(triangle[1]) - a).cross(at(triangle[2]) - a);
            const auto& tets = tets_at.at({triangle.begin(), triangle.end()});
            if (tets.size() == 1) continue;
            ++walls;
            const auto height = [&](std::size_t t) {
                double sum = 0;
                for (const std::int64_t v : mesh.tets[t]) sum += normal.dot(at(v) - a);
                return sum;
            };
            const bool is_first_behind = height(tets[0]) < 0;
            EXPECT_EQ(mesh.body[tets[0]] < mesh.body[tets[1]], is_first_behind);
        }
        EXPECT_EQ(walls, Expected(parts).walls);
    });
}

TEST(Regions, TrianglesOfVtuHaveThoseBehindThem) {
    test::for_each_regions_source([](const PartSource& parts) {
        const test::TemporaryFolder folder;
        ExportFiles files(folder.file("out"));
        find_format("vtu").write_merged(parts, {}, files, "whole");
        test::VtuReader file(folder.file("out/whole.vtu"));
        std::vector<std::int32_t> wanted;
        for (const PartIndex index : parts.outline().parts.ids()) {
            const Part part = parts.load(index);
            for (std::size_t f = 0; f < part.facets.size(); ++f)
                if (part.is_listed(f)) wanted.push_back(part.region_of(part.tet_at_facet[f]).value());
        }
        const auto regions = file.values<std::int32_t>("Region");
        ASSERT_EQ(regions.size(), static_cast<std::size_t>(parts.outline().tets()) + wanted.size());
        EXPECT_TRUE(std::equal(wanted.begin(), wanted.end(), regions.end() - std::ssize(wanted)));
        std::string names;
        for (const std::string& name : parts.outline().region_names) names += name + '\0';
        const auto bytes = file.values<char>("RegionNames");
        EXPECT_EQ(std::string(bytes.begin(), bytes.end()), names);
    });
}

TEST(Regions, OfTheSurfaceAloneHaveTheVolumeOfTheirCells) {
    test::for_each_regions_source([](const PartSource& parts) {
        if (dynamic_cast<const JoinedParts*>(&parts)) return;  // walls inside of a piece are gone
        const test::TemporaryFolder folder;
        ExportFiles files(folder.file("out"));
        find_format("vtp").write_merged(parts, {}, files, "whole");
        const Soup surface = read_surface(folder.file("out/whole.vtp"));
        EXPECT_EQ(surface.region_names, parts.outline().region_names);
        std::map<RegionIndex, double> enclosed, filled;
        for (std::size_t f = 0; f < surface.facets.size(); ++f) {
            const auto at = [&](std::size_t i) {
                return surface.vertices[static_cast<std::size_t>(surface.facets[f][i])];
            };
            const double volume = at(0).dot(at(1).cross(at(2))) / 6;
            enclosed[surface.sides[f].back] += volume;
            enclosed[surface.sides[f].front] -= volume;
        }
        for (const PartIndex index : parts.outline().parts.ids()) {
            const Part part = parts.load(index);
            for (std::int32_t t = 0; t < part.tet_count(); ++t) {
                const auto& [a, b, c, d] = part.mesh.tets[static_cast<std::size_t>(t)];
                const auto at = [&](std::int32_t v) { return part.mesh.vertices[static_cast<std::size_t>(v)]; };
                filled[part.region_of(t)] += (at(b) - at(a)).cross(at(c) - at(a)).dot(at(d) - at(a)) / 6;
            }
        }
        for (const auto& [region, volume] : filled) EXPECT_NEAR(enclosed[region], volume, 1e-9 * volume);
    });
}

TEST(Regions, AreNamedByTheFileThatJoinsSurfaces) {
    EXPECT_NE(surfaces_pvtu_text({"a.vtu"}, std::vector<std::string>{"a", "b"}).find("Name=\"Region\""),
              std::string::npos);
    EXPECT_EQ(surfaces_pvtu_text({"a.vtu"}, {}).find("Name=\"Region\""), std::string::npos);
}

TEST(Regions, WallsAreNoMarkersOfSu2) {
    test::for_each_regions_source([](const PartSource& parts) {
        const test::MergedMesh mesh = merged(parts, "su2", test::read_su2);
        EXPECT_EQ(static_cast<std::int64_t>(mesh.tets.size()), parts.outline().tets());
        EXPECT_EQ(sizes_of(mesh.patch), Sizes{Expected(parts).outer});
    });
}

void count_msh(const test::MshContent& file, SizeByName& tets, SizeByName& triangles) {
    for (const auto& [tag, element] : file.elements) {
        if (file.is_ghost(element.entity)) continue;
        const std::int32_t physical = file.entities.at(element.entity).physicals.at(0);
        ++(element.entity[0] == 3 ? tets : triangles)[file.names.at({element.entity[0], physical})];
    }
}

TEST(Regions, ArePhysicalVolumesOfGmsh) {
    test::for_each_regions_source([](const PartSource& parts) {
        const Expected expected(parts);
        const test::TemporaryFolder folder;
        ExportFiles files(folder.file("out"));
        const Format& msh = find_format("msh");
        for (const char* version : {"4.1", "2.2"}) {
            SizeByName tets, triangles;
            msh.write_merged(parts, {version}, files, "whole");
            const test::MshContent file = test::read_msh(folder.file("out/whole.msh"));
            count_msh(file, tets, triangles);
            EXPECT_EQ(in_order(tets), expected.tets) << version;
            EXPECT_EQ(tets.begin()->first, "region_0");
            EXPECT_EQ(in_order(triangles), expected.triangles()) << version;
        }
        write_format(msh, parts, files);
        SizeByName tets, triangles;
        for (const PartIndex index : parts.outline().parts.ids()) {
            const Part part = parts.load(index);
            const bool is_one = parts.outline().parts.size() == 1;
            const test::MshContent file = test::read_msh(
                folder.file(is_one ? "out/mesh.msh" : fmt::format("out/mesh_{}.msh", index.value() + 1)));
            count_msh(file, tets, triangles);
            for (std::size_t f = 0; f < part.facets.size(); ++f)
                for (const std::int32_t v : part.facets[f]) {
                    if (part.patch[f] < 0) continue;
                    const std::int64_t id = part.global_id[static_cast<std::size_t>(v)];
                    EXPECT_EQ(file.nodes.at(id + 1).entity[0], 2) << "on a surface, on both sides of a wall";
                }
        }
        EXPECT_EQ(in_order(tets), expected.tets);
        EXPECT_EQ(in_order(triangles), expected.triangles());
    });
}

// The numbers behind "NAME { type cellZone; cellLabels List<label>", by name, in the order of the file.
std::vector<std::pair<std::string, Sizes>> read_zones(const std::string& path) {
    std::string text = test::bytes_of_file(path);
    EXPECT_NE(text.find("class       regIOobject;"), text.npos);
    std::istringstream words(text.substr(text.find("\n}\n") + 3));
    std::size_t count = 0;
    std::string word;
    words >> count >> word;
    std::vector<std::pair<std::string, Sizes>> zones(count);
    for (auto& [name, cells] : zones) {
        for (words >> word; word == "//"; words >> word) std::getline(words, word);
        name = word;
        for (const char* wanted : {"{", "type", "cellZone;", "cellLabels", "List<label>"}) {
            words >> word;
            EXPECT_EQ(word, wanted);
        }
        words >> count >> word;
        cells.resize(count);
        for (std::int64_t& cell : cells) words >> cell;
        words >> word;
        EXPECT_EQ(word, ");");
        words >> word;
    }
    words >> word;
    EXPECT_EQ(word, ")");
    return zones;
}

TEST(Regions, AreCellZonesOfOpenFoam) {
    test::for_each_regions_source([](const PartSource& parts) {
        const Expected expected(parts);
        const test::TemporaryFolder folder;
        ExportFiles files(folder.file("out"));
        write_format(find_format("openfoam"), parts, files);
        Sizes sizes(expected.tets.size(), 0);
        std::int64_t outer = 0;
        for (const PartIndex index : parts.outline().parts.ids()) {
            const bool is_one = parts.outline().parts.size() == 1;
            const std::string mesh =
                folder.file(is_one ? "out" : fmt::format("out/processor{}", index.value())) + "/constant/polyMesh/";
            const Part part = parts.load(index);
            const auto zones = read_zones(mesh + "cellZones");
            ASSERT_EQ(zones.size(), sizes.size());
            for (std::size_t r = 0; r < zones.size(); ++r) {
                EXPECT_EQ(zones[r].first, fmt::format("region_{}", r));
                sizes[r] += std::ssize(zones[r].second);
                for (const std::int64_t cell : zones[r].second)
                    EXPECT_EQ(part.region_of(static_cast<std::int32_t>(cell)), RegionIndex(r));
            }
            const std::string boundary = test::bytes_of_file(mesh + "boundary");
            EXPECT_EQ(boundary.find("patch_1"), boundary.npos) << "a patch of walls is none";
            const std::size_t faces = boundary.find("nFaces", boundary.find("    patch_0\n"));
            ASSERT_NE(faces, boundary.npos);
            outer += std::stoll(boundary.substr(faces + 6));
        }
        EXPECT_EQ(sizes, expected.tets);
        EXPECT_EQ(outer, expected.outer);
    });
}

TEST(Regions, AreAttributesOfMfemAndWallsAreBoundaryOnce) {
    test::for_each_regions_source([](const PartSource& parts) {
        const Expected expected(parts);
        const test::TemporaryFolder folder;
        ExportFiles files(folder.file("out"));
        write_format(find_format("mfem"), parts, files);
        std::vector<std::int64_t> attributes, patches;
        for (const PartIndex index : parts.outline().parts.ids()) {
            std::istringstream text = test::text_of(folder.file(fmt::format("out/mesh.{:06}", index.value())), '#');
            std::string word;
            for (const auto& [section, corners, found] :
                 {std::tuple{"elements", 4, &attributes}, std::tuple{"boundary", 3, &patches}}) {
                while (text >> word && word != section) {
                }
                for (auto count = test::read_number<std::int64_t>(text); count > 0; --count) {
                    found->push_back(test::read_number<std::int64_t>(text));
                    for (int skipped = 0; skipped <= corners; ++skipped) text >> word;
                }
            }
        }
        EXPECT_EQ(sizes_of(attributes), expected.tets);
        EXPECT_EQ(sizes_of(patches), expected.triangles());
    });
}

TEST(Regions, AreArraysOfHdf5) {
    test::for_each_regions_source([](const PartSource& parts) {
        const Expected expected(parts);
        const test::TemporaryFolder folder;
        ExportFiles files(folder.file("out"));
        find_format("hdf5").write_merged(parts, {}, files, "whole");
        const std::string path = folder.file("out/whole.h5"), bytes = test::bytes_of_file(path);
        const Hdf5Bytes places(path, arrays_of(parts.outline()));
        const auto counts_in = [&](const char* array, std::int64_t rows, std::int64_t first) {
            Sizes counts(expected.tets.size(), 0);
            for (std::int64_t row = 0; row < rows; ++row) {
                std::int32_t value = -1;
                std::memcpy(&value, bytes.data() + places.place_of(array, row), sizeof value);
                ++counts.at(static_cast<std::size_t>(value - first));
            }
            return counts;
        };
        const std::int64_t tets = parts.outline().tets(), triangles = parts.outline().patch_facets();
        EXPECT_EQ(counts_in("viz/region", tets, 1), expected.tets);
        Sizes cells = counts_in("VTKHDF/CellData/Region", tets + triangles, 0);
        for (const PartIndex index : parts.outline().parts.ids()) {
            const Part part = parts.load(index);
            for (std::size_t f = 0; f < part.facets.size(); ++f)
                if (part.is_listed(f)) --cells[static_cast<std::size_t>(part.region_of(part.tet_at_facet[f]).value())];
        }
        EXPECT_EQ(cells, expected.tets);
        const std::string xdmf = test::bytes_of_file(folder.file("out/whole.xdmf"));
        EXPECT_NE(xdmf.find("<Information Name=\"region 2\" Value=\"region_1\"/>"), xdmf.npos);
        EXPECT_LT(xdmf.find("Name=\"region\""), xdmf.find("Name=\"body\"")) << "DOLFINx takes the first";
    });
}

// Names that are those of something else, or no words. What a run writes is what an export writes, with walls, too.
TEST(Regions, HaveNamesOfTheirOwnAndAreWrittenByRuns) {
    RegionsCase odd = test::regions_cases[0];
    odd.names = {"subdomain_1", "patch_0", "Stahl (2)"};
    const FinishedRegions run(odd, test::all_formats());
    for (const Format* format : formats()) {
        if (std::string_view(format->name) == "vtu") continue;  // its files are what the export reads
        SCOPED_TRACE(format->name);
        const test::TemporaryFolder folder;
        ExportFiles files(folder.file(format->name));
        write_format(*format, run.parts(), files);
        EXPECT_TRUE(test::contents_below(folder.file(format->name)) ==
                    test::contents_below(run.path() + "/export/" + format->name));
    }
    const std::string inp = test::bytes_of_file(run.path() + "/export/abaqus/mesh.inp");
    for (const char* set : {"subdomain_1_2", "patch_0", "Stahl_2"})
        EXPECT_NE(inp.find(fmt::format("*ELSET, ELSET={}\n", set)), inp.npos) << set;
    const auto names = test::read_msh(run.path() + "/export/msh/mesh_1.msh").names;
    EXPECT_EQ(names.at({3, 3}), "subdomain_1");
    EXPECT_EQ(names.at({3, 4}), "patch_0 (4)");
    const auto zones = read_zones(run.path() + "/export/openfoam/processor0/constant/polyMesh/cellZones");
    EXPECT_EQ(zones.at(1).first, "patch_0");
    EXPECT_EQ(zones.at(2).first, "Stahl_2");
}

}  // namespace
}  // namespace kerf::regions_export_test

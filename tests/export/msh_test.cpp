// What is in MSH files, read by a reader of its own, against the parts and the surface that went in.
#include <map>
#include <set>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "base/core/error.h"
#include "export/cases.h"
#include "export/msh_reader.h"
#include "files/export/format.h"
#include "files/part/bodies.h"
#include "files/part/run_parts.h"
#include "support/temporary_folder.h"

namespace kerf::msh_test {
namespace {

using test::MshContent;
using test::MshElements;
using test::MshEntity;
using test::MshGhost;
using test::MshReader;
using test::read_msh;

// ---- what is measured ----

using AreaByName = std::map<std::string, double>;

std::string name_in_gmsh(std::string name) {
    std::replace(name.begin(), name.end(), '"', '\'');
    return name;
}

AreaByName areas_of(const Soup& soup) {
    AreaByName areas;
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        const auto corner = [&](std::size_t i) { return soup.vertices[static_cast<std::size_t>(soup.facets[f][i])]; };
        const std::string& name = soup.patch_names[static_cast<std::size_t>(soup.patch[f])];
        areas[name_in_gmsh(name)] += (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm() / 2;
    }
    return areas;
}

double volume_of(const Soup& soup) {
    double volume = 0;
    for (const Triangle& f : soup.facets)
        volume += soup.vertices[static_cast<std::size_t>(f[0])].dot(soup.vertices[static_cast<std::size_t>(f[1])].cross(
                      soup.vertices[static_cast<std::size_t>(f[2])])) /
                  6;
    return volume;
}

// Of a whole mesh: the elements of all parts, or of a merged file.
struct MshMeasure {
    double volume = 0;
    AreaByName areas;
};

void measure(const MshContent& file, MshMeasure& sum) {
    for (const auto& [tag, element] : file.elements) {
        if (file.is_ghost(element.entity)) continue;
        const auto corner = [&](std::size_t i) { return file.nodes.at(element.corners[i]).point; };
        const std::vector<std::int32_t>& physicals = file.entities.at(element.entity).physicals;
        ASSERT_EQ(physicals.size(), 1U);
        const std::string& name = file.names.at({element.entity[0], physicals[0]});
        const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
        if (element.entity[0] == 2) {
            sum.areas[name] += normal.norm() / 2;
            continue;
        }
        const double volume = normal.dot(corner(3) - corner(0)) / 6;
        EXPECT_GT(volume, 0);
        EXPECT_TRUE(name == "volume" || name.starts_with("body_")) << name;
        sum.volume += volume;
    }
}

void expect_measure_of(const Soup& soup, const MshMeasure& sum) {
    EXPECT_NEAR(sum.volume, volume_of(soup), 1e-9 * volume_of(soup));
    const AreaByName wanted = areas_of(soup);
    ASSERT_EQ(sum.areas.size(), wanted.size());
    for (const auto& [name, area] : wanted) EXPECT_NEAR(sum.areas.at(name), area, 1e-9 * area) << name;
}

// ---- files ----

// The parts of a case as files, and what is in them.
struct MshParts {
    explicit MshParts(const test::ExportCase& each) : run(test::run_of(each)) {
        ExportFiles written(folder.file("msh"));
        write_format(find_format("msh"), run, written);
        const std::size_t count = run.outline().parts.size();
        EXPECT_EQ(written.list().size(), count);
        for (std::size_t i = 1; i <= count; ++i) {
            const std::string name = count == 1 ? "mesh.msh" : "mesh_" + std::to_string(i) + ".msh";
            files.push_back(read_msh(folder.file("msh/" + name)));
        }
    }

    MshContent merged(const std::string& version) const {
        ExportFiles written(folder.file("merged"));
        find_format("msh").write_merged(run, {version}, written, "whole");
        EXPECT_EQ(written.list().size(), 1U);
        return read_msh(folder.file("merged/whole.msh"));
    }

    test::TemporaryFolder folder;
    RunParts run;
    std::vector<MshContent> files;  // by rank
};

const MshParts& parts_of(const test::ExportCase& each) {
    static std::map<std::string, std::unique_ptr<MshParts>> read;
    auto& parts = read[each.name];
    if (!parts) parts = std::make_unique<MshParts>(each);
    return *parts;
}

template <class Items>
void expect_dense(const Items& items, std::int64_t count) {
    ASSERT_EQ(static_cast<std::int64_t>(items.size()), count);
    EXPECT_EQ(items.begin()->first, 1);
    EXPECT_EQ(items.rbegin()->first, count);
}

// All elements without ghosts, each once.
MshElements own_elements(const std::vector<MshContent>& files) {
    MshElements own;
    for (const MshContent& file : files)
        for (const auto& [tag, element] : file.elements) {
            if (file.is_ghost(element.entity)) continue;
            EXPECT_TRUE(own.emplace(tag, element).second) << tag;
        }
    return own;
}

std::map<std::int64_t, Vec3> points_of(const MshContent& file) {
    std::map<std::int64_t, Vec3> points;
    for (const auto& [tag, node] : file.nodes) points[tag] = node.point;
    return points;
}

std::map<std::int64_t, Vec3> points_of(const std::vector<MshContent>& files) {
    std::map<std::int64_t, Vec3> points;
    for (const MshContent& file : files)
        for (const auto& [tag, node] : file.nodes) EXPECT_EQ(points.emplace(tag, node.point).first->second, node.point);
    return points;
}

std::int64_t triangles_of(const MeshOutline& outline) { return outline.patch_facets(); }

// Faces of tetrahedra that no other one has, and triangles, are the same.
void expect_triangles_bound_tets(const MshElements& elements) {
    std::map<std::vector<std::int64_t>, int> sides;
    const auto side = [](std::vector<std::int64_t> corners) {
        std::sort(corners.begin(), corners.end());
        return corners;
    };
    for (const auto& [tag, element] : elements)
        if (element.entity[0] == 3)
            for (std::size_t skipped = 0; skipped < 4; ++skipped) {
                std::vector<std::int64_t> face = element.corners;
                face.erase(face.begin() + static_cast<std::ptrdiff_t>(skipped));
                ++sides[side(face)];
            }
    std::int64_t open = 0, triangles = 0;
    for (const auto& [face, count] : sides) open += count == 1;
    for (const auto& [tag, element] : elements)
        if (element.entity[0] == 2) {
            ++triangles;
            EXPECT_EQ(sides[side(element.corners)], 1);
        }
    EXPECT_EQ(open, triangles);
}

TEST(Msh, PartsTogetherAreTheWholeMesh) {
    for (const test::ExportCase& each : test::export_cases()) {
        SCOPED_TRACE(each.name);
        const MshParts& parts = parts_of(each);
        const MeshOutline& outline = parts.run.outline();
        const MshElements elements = own_elements(parts.files);
        expect_dense(elements, outline.tets() + triangles_of(outline));
        EXPECT_EQ(elements.at(outline.tets()).entity[0], 3);
        EXPECT_EQ(elements.at(outline.tets() + 1).entity[0], 2) << "triangles follow tetrahedra";
        expect_dense(points_of(parts.files), outline.vertices);
        expect_triangles_bound_tets(elements);
        MshMeasure sum;
        for (const MshContent& file : parts.files) measure(file, sum);
        expect_measure_of(each.surface, sum);
    }
}

TEST(Msh, TagsAreTheNumbersOfTheParts) {
    for (const test::ExportCase& each : test::export_cases()) {
        SCOPED_TRACE(each.name);
        const MshParts& parts = parts_of(each);
        for (std::size_t rank = 0; rank < parts.files.size(); ++rank) {
            const MshContent& file = parts.files[rank];
            const Part part = parts.run.load(PartIndex(rank));
            for (std::size_t v = 0; v < part.global_id.size(); ++v)
                EXPECT_EQ(file.nodes.at(part.global_id[v] + 1).point, part.mesh.vertices[v]);
            std::int64_t tag = parts.run.outline().first_tet(PartIndex(rank));
            for (const Tetrahedron& tet : part.mesh.tets) {
                std::vector<std::int64_t> corners;
                for (const std::int32_t v : tet) corners.push_back(part.global_id[static_cast<std::size_t>(v)] + 1);
                ASSERT_EQ(file.elements.at(++tag).corners, corners);
            }
        }
    }
}

TEST(Msh, GhostsAreTheCellsOfOtherPartsThatShareAVertex) {
    for (const test::ExportCase& each : test::export_cases()) {
        SCOPED_TRACE(each.name);
        const std::vector<MshContent>& files = parts_of(each).files;
        std::map<std::int64_t, std::int32_t> partition;  // of each element
        for (std::size_t rank = 0; rank < files.size(); ++rank)
            for (const auto& [tag, element] : files[rank].elements)
                if (!files[rank].is_ghost(element.entity)) partition[tag] = static_cast<std::int32_t>(rank) + 1;
        const MshElements all = own_elements(files);
        for (std::size_t rank = 0; rank < files.size(); ++rank) {
            const MshContent& file = files[rank];
            const auto own = static_cast<std::int32_t>(rank) + 1;
            std::set<std::int64_t> own_nodes;
            for (const auto& [tag, element] : file.elements)
                if (!file.is_ghost(element.entity)) own_nodes.insert(element.corners.begin(), element.corners.end());
            std::map<std::int64_t, MshGhost> wanted;
            for (const auto& [tag, element] : all)
                if (element.entity[0] == 3 && partition[tag] != own &&
                    std::any_of(element.corners.begin(), element.corners.end(),
                                [&](std::int64_t node) { return own_nodes.contains(node); }))
                    wanted[tag] = {partition[tag], {own}};
            EXPECT_EQ(file.ghosts, wanted);
            std::size_t cells = 0;
            for (const auto& [tag, element] : file.elements) {
                if (!file.is_ghost(element.entity)) continue;
                ++cells;
                EXPECT_TRUE(wanted.contains(tag));
                EXPECT_EQ(element.corners, all.at(tag).corners);
            }
            EXPECT_EQ(cells, wanted.size());
            for (const auto& [tag, node] : file.nodes)
                EXPECT_EQ(own_nodes.contains(tag), !file.is_ghost(node.entity)) << "node " << tag;
        }
    }
}

TEST(Msh, PartitionedEntitiesSayWhatTheyArePartsOf) {
    for (const test::ExportCase& each : test::export_cases()) {
        SCOPED_TRACE(each.name);
        const std::vector<MshContent>& files = parts_of(each).files;
        std::set<MshEntity> partitioned;
        for (std::size_t rank = 0; rank < files.size(); ++rank) {
            const MshContent& file = files[rank];
            const auto own = static_cast<std::int32_t>(rank) + 1;
            EXPECT_EQ(file.partitions, static_cast<std::int64_t>(files.size()));
            EXPECT_EQ(file.ghost_entities.size(), file.ghosts.empty() ? 0U : 1U);
            for (const auto& [tag, partition] : file.ghost_entities) {
                EXPECT_EQ(partition, own);
                EXPECT_TRUE(partitioned.insert({3, tag}).second) << "tags differ between parts";
            }
            for (const auto& [entity, facts] : file.entities) {
                if (facts.partitions.empty()) continue;
                EXPECT_EQ(facts.partitions, std::vector<std::int32_t>{own});
                EXPECT_EQ(facts.whole[0], entity[0]);
                EXPECT_EQ(facts.physicals, file.entities.at(facts.whole).physicals);
                EXPECT_TRUE(file.entities.at(facts.whole).partitions.empty());
                EXPECT_TRUE(partitioned.insert(entity).second) << "tags differ between parts";
            }
            for (const auto& [tag, element] : file.elements)
                EXPECT_TRUE(file.is_ghost(element.entity) || !file.entities.at(element.entity).partitions.empty());
        }
        for (const MshContent& file : files)
            for (const auto& [entity, facts] : file.entities)
                EXPECT_EQ(facts.partitions.empty(), !partitioned.contains(entity));
    }
}

void expect_boxes_hold(const MshContent& file) {
    std::map<MshEntity, std::array<Vec3, 2>> boxes;
    for (const auto& [tag, element] : file.elements)
        for (const std::int64_t corner : element.corners) {
            const Vec3& p = file.nodes.at(corner).point;
            auto& box = boxes.try_emplace(element.entity, std::array{p, p}).first->second;
            box = {box[0].cwiseMin(p), box[1].cwiseMax(p)};
        }
    for (const auto& [entity, box] : boxes) EXPECT_TRUE(file.is_ghost(entity) || file.entities.at(entity).box == box);
}

// Nodes are corners of an element of the entity that they belong to; those of triangles belong to surfaces. Merged, the
// part that owns a node of a patch need not have a triangle there, which is rare: `must_be_on_surfaces` is false.
void expect_nodes_on_their_entities(const MshContent& file, bool must_be_on_surfaces) {
    std::set<std::pair<MshEntity, std::int64_t>> corners;
    std::set<std::int64_t> on_triangles;
    for (const auto& [tag, element] : file.elements)
        for (const std::int64_t corner : element.corners) {
            corners.insert({element.entity, corner});
            if (element.entity[0] == 2) on_triangles.insert(corner);
        }
    std::size_t on_surfaces = 0;
    for (const auto& [tag, node] : file.nodes) {
        EXPECT_TRUE(corners.contains({node.entity, tag})) << tag;
        on_surfaces += node.entity[0] == 2;
    }
    EXPECT_TRUE(on_surfaces == on_triangles.size() || !must_be_on_surfaces);
    EXPECT_GE(10 * on_surfaces, 9 * on_triangles.size());
}

TEST(Msh, EntitiesHoldTheirBoxesAndNodes) {
    for (const test::ExportCase& each : test::export_cases()) {
        SCOPED_TRACE(each.name);
        const MshParts& parts = parts_of(each);
        for (const MshContent& file : parts.files) {
            expect_boxes_hold(file);
            expect_nodes_on_their_entities(file, true);
        }
        const MshContent merged = parts.merged("4.1");
        expect_boxes_hold(merged);
        expect_nodes_on_their_entities(merged, false);
    }
}

TEST(Msh, EveryFileNamesAllPatches) {
    for (const test::ExportCase& each : test::export_cases()) {
        SCOPED_TRACE(each.name);
        const MshParts& parts = parts_of(each);
        std::map<MshEntity, std::string> wanted;
        std::int32_t tag = 0;
        std::set<std::string> known;  // solids of one name are one patch
        for (const std::string& name : each.surface.patch_names)
            if (known.insert(name).second) wanted[{2, ++tag}] = name_in_gmsh(name);
        const std::int32_t bodies = parts.run.bodies().count();
        EXPECT_EQ(bodies, each.name == "two_solids" ? 2 : 1);
        for (std::int32_t body = 1; body <= bodies; ++body)
            wanted[{3, ++tag}] = bodies == 1 ? "volume" : "body_" + std::to_string(body);
        for (const MshContent& file : parts.files) EXPECT_EQ(file.names, wanted);
        EXPECT_EQ(parts.merged("4.1").names, wanted);
        EXPECT_EQ(parts.merged("2.2").names, wanted);
    }
}

TEST(Msh, MergedFilesHaveTheElementsOfTheParts) {
    for (const test::ExportCase& each : test::export_cases())
        for (const char* version : {"4.1", "2.2"}) {
            SCOPED_TRACE(each.name + " in " + version);
            const MshParts& parts = parts_of(each);
            const MshContent merged = parts.merged(version);
            EXPECT_EQ(points_of(merged), points_of(parts.files));
            const MshElements elements = own_elements(parts.files);
            ASSERT_EQ(merged.elements.size(), elements.size());
            for (const auto& [tag, element] : elements) EXPECT_EQ(merged.elements.at(tag).corners, element.corners);
            // Parts are volumes, those of several bodies one for each.
            const std::int32_t bodies = parts.run.bodies().count();
            for (std::size_t rank = 0; rank < parts.files.size(); ++rank)
                for (const auto& [tag, element] : parts.files[rank].elements) {
                    if (element.entity[0] == 2 || parts.files[rank].is_ghost(element.entity)) continue;
                    ASSERT_EQ((merged.elements.at(tag).entity[1] - 1) / bodies, static_cast<std::int32_t>(rank));
                }
            MshMeasure sum;
            measure(merged, sum);
            expect_measure_of(each.surface, sum);
        }
}

// The physical group of a tetrahedron is its body, in the parts and in merged files.
TEST(Msh, BodiesAreGroups) {
    for (const test::ExportCase& each : test::export_cases()) {
        SCOPED_TRACE(each.name);
        const MshParts& parts = parts_of(each);
        const auto patches = static_cast<std::int32_t>(parts.run.outline().patch_names.size());
        const MshContent merged = parts.merged("4.1"), old = parts.merged("2.2");
        for (std::size_t r = 0; r < parts.files.size(); ++r) {
            const auto rank = static_cast<std::int32_t>(r);
            std::int64_t tag = parts.run.outline().first_tet(PartIndex(rank));
            for (const std::int32_t body :
                 parts.run.bodies().of_tets(PartIndex(rank), parts.run.load(PartIndex(rank)))) {
                ++tag;
                for (const MshContent* file : {&parts.files[r], &merged, &old})
                    ASSERT_EQ(file->entities.at(file->elements.at(tag).entity).physicals,
                              std::vector<std::int32_t>{patches + body + 1});
            }
        }
    }
}

// What binary files say, and so all that is tested of them.
TEST(Msh, TextSaysWhatBinaryFilesSay) {
    for (const test::ExportCase& each : test::export_cases()) {
        SCOPED_TRACE(each.name);
        const MshParts& parts = parts_of(each);
        ExportFiles written(parts.folder.file("text"), "", {}, {.msh_ascii = true});
        write_format(find_format("msh"), parts.run, written);
        ASSERT_EQ(written.list().size(), parts.files.size());
        for (std::size_t i = 0; i < parts.files.size(); ++i) {
            const std::string name = parts.files.size() == 1 ? "mesh.msh" : "mesh_" + std::to_string(i + 1) + ".msh";
            const MshReader text(parts.folder.file("text/" + name));
            EXPECT_TRUE(text.is_ascii());
            EXPECT_TRUE(text.content() == parts.files[i]) << name;
        }
        for (const char* version : {"4.1", "2.2"}) {
            find_format("msh").write_merged(parts.run, {version}, written, "whole");
            const MshReader text(parts.folder.file("text/whole.msh"));
            EXPECT_TRUE(text.is_ascii());
            EXPECT_TRUE(text.content() == parts.merged(version)) << version;
        }
    }
}

// ---- what cannot be written ----

// One tetrahedron in one part, or the outline of more than there is.
class MadeUpParts : public PartSource {
 public:
    explicit MadeUpParts(std::vector<std::string> patch_names) {
        part_.mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
        part_.mesh.boundary_vertex_count = 4;
        part_.mesh.tets = {{0, 1, 2, 3}};
        part_.facets = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
        part_.patch = {0, 0, 0, 0};
        part_.facet = {0, 1, 2, 3};
        part_.neighbour.assign(4, NodeId::none());
        part_.global_id = {0, 1, 2, 3};
        part_.patch_names = patch_names;
        outline_made_up.parts = {{root_node, 4, 1, 4, 0}};
        outline_made_up.vertices = 4;
        outline_made_up.patch_names = std::move(patch_names);
    }

    const MeshOutline& outline() const override { return outline_made_up; }
    Part load(PartIndex) const override { return part_; }

    MeshOutline outline_made_up;

 private:
    Part part_;
};

std::vector<std::string> names_after(const std::vector<std::string>& patch_names) {
    const test::TemporaryFolder folder;
    ExportFiles files(folder.file("msh"));
    write_format(find_format("msh"), MadeUpParts(patch_names), files);
    std::vector<std::string> names;
    for (const auto& [group, name] : read_msh(folder.file("msh/mesh.msh")).names) names.push_back(name);
    names.pop_back();  // "volume"
    return names;
}

TEST(Msh, NamesAreWhatGmshCanRead) {
    EXPECT_EQ(names_after({"a b", "\u00fc$\\\t", "x"}), (std::vector<std::string>{"a b", "\u00fc$\\ ", "x"}));
    EXPECT_EQ(names_after({"a\"", "a'", "a\"", "a' (2)", "line\nend"}),
              (std::vector<std::string>{"a'", "a' (2)", "a' (3)", "a' (2) (4)", "line end"}));
    const std::string longest(251, 'x');
    EXPECT_EQ(names_after({longest, longest + "y"}),
              (std::vector<std::string>{longest, longest.substr(0, 247) + " (2)"}));
    EXPECT_EQ(names_after({longest.substr(1) + "\u00fc"}), std::vector<std::string>{longest.substr(1)});
    EXPECT_EQ(names_after({longest.substr(2) + "\u00fc"}), std::vector<std::string>{longest.substr(2) + "\u00fc"});
}

void expect_refused(const PartSource& parts, const std::string& version, const std::string& word) {
    const test::TemporaryFolder folder;
    ExportFiles files(folder.file("msh"));
    try {
        find_format("msh").write_merged(parts, {version}, files, "whole");
        ADD_FAILURE() << "written";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
    EXPECT_TRUE(folder.names().empty()) << "no byte is written";
}

TEST(Msh, OtherVersionsAreRefused) {
    const MadeUpParts parts({"side"});
    expect_refused(parts, "4.0", "4.1 and 2.2");
    expect_refused(parts, "", "4.1 and 2.2");
}

TEST(Msh, IdsThatDoNotFitAreRefused) {
    MadeUpParts parts({"side"});
    const std::int64_t most = std::numeric_limits<std::int32_t>::max();
    parts.outline_made_up.vertices = most + 1;
    expect_refused(parts, "2.2", "2147483648 nodes");
    parts.outline_made_up.vertices = 4;
    parts.outline_made_up.parts[0].tets = most - 3;
    expect_refused(parts, "2.2", "2147483648 elements");
    parts.outline_made_up.parts.resize(65536);
    parts.outline_made_up.patch_names.resize(65536);
    expect_refused(parts, "4.1", "65536 patches in 65536 parts");
}

}  // namespace
}  // namespace kerf::msh_test

// The laws of formats that hold the mesh in one piece.
#include <map>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/core/error.h"
#include "export/cases.h"
#include "export/merged_readers.h"
#include "export/more_merged_readers.h"
#include "files/export/format.h"
#include "files/export/inside/by_patch.h"
#include "files/export/inside/word_names.h"
#include "files/export/whole_mesh.h"
#include "files/io/surface_reader.h"
#include "files/part/bodies.h"
#include "files/part/run_parts.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

using test::GlobalTet;
using test::GlobalTriangle;
using test::MergedMesh;

using Read = MergedMesh (*)(const std::string&);

// How a format names the part of rank r and the patch p.
struct MergedFormat {
    const char* name;
    Read read;
    bool has_parts, has_bodies;
    std::int64_t (*part)(const MeshOutline& outline, std::size_t rank);
    std::vector<std::string> (*patches)(const MeshOutline& outline);
};

std::int64_t rank_from_one(const MeshOutline&, std::size_t rank) { return static_cast<std::int64_t>(rank) + 1; }
std::int64_t leaf(const MeshOutline& outline, std::size_t rank) { return outline.parts[rank].id.value(); }

template <int first>
std::vector<std::string> numbers(const MeshOutline& outline) {
    std::vector<std::string> names;
    for (std::size_t p = 0; p < outline.patch_names.size(); ++p)
        names.push_back(std::to_string(first + static_cast<int>(p)));
    return names;
}

std::vector<std::string> words(const MeshOutline& outline) { return word_names(outline.patch_names); }
std::vector<std::string> upper_case_words(const MeshOutline& outline) {
    std::vector<std::string> names = words(outline);
    for (std::string& name : names)
        for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return names;
}

std::vector<std::string> unv_words(const MeshOutline& outline) {
    return word_names(outline.patch_names, {.most_characters = 40, .ignores_case = true});
}

const std::vector<MergedFormat> merged_formats = {
    {"medit", test::read_medit, false, true, rank_from_one, numbers<1>},
    {"tetgen", test::read_tetgen, false, true, rank_from_one, numbers<1>},
    {"abaqus", test::read_abaqus, true, true, rank_from_one, upper_case_words},
    {"su2", test::read_su2, false, false, rank_from_one, words},
    {"vtu", test::read_vtu, true, false, leaf, numbers<0>},
    {"vtk", test::read_vtk, true, false, leaf, numbers<0>},
    {"unv", test::read_unv, false, true, rank_from_one, unv_words},
    {"feb", test::read_feb, false, true, rank_from_one, words},
};

double area(const std::vector<Vec3>& points, const GlobalTriangle& corners) {
    const auto at = [&](std::size_t i) -> const Vec3& { return points[static_cast<std::size_t>(corners[i])]; };
    return (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
}

double volume(const std::vector<Vec3>& points, const GlobalTet& corners) {
    const auto at = [&](std::size_t i) -> const Vec3& { return points[static_cast<std::size_t>(corners[i])]; };
    return (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) / 6;
}

template <std::size_t n>
bool are_vertices(const MergedMesh& mesh, const std::array<std::int64_t, n>& cell) {
    return std::all_of(cell.begin(), cell.end(),
                       [&](std::int64_t v) { return v >= 0 && v < static_cast<std::int64_t>(mesh.points.size()); });
}

GlobalTriangle smallest_first(GlobalTriangle corners) {
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return corners;
}

// Faces of tetrahedra that no other one has in opposite orientation, seen from outside.
std::multiset<GlobalTriangle> boundary_of(const MergedMesh& mesh) {
    std::multiset<GlobalTriangle> boundary;
    for (const GlobalTet& t : mesh.tets)
        for (const GlobalTriangle& face :
             {GlobalTriangle{t[1], t[2], t[3]}, {t[0], t[3], t[2]}, {t[0], t[1], t[3]}, {t[0], t[2], t[1]}}) {
            const auto other = boundary.find(smallest_first({face[0], face[2], face[1]}));
            if (other == boundary.end())
                boundary.insert(smallest_first(face));
            else
                boundary.erase(other);
        }
    return boundary;
}

// What the parts have on each patch, by the name that the format gives it.
std::map<std::string, double> areas_of(const PartSource& parts, const std::vector<std::string>& names) {
    std::map<std::string, double> areas;
    for (std::size_t rank = 0; rank < parts.outline().parts.size(); ++rank) {
        const Part part = parts.load(PartIndex(rank));
        for (std::size_t f = 0; f < part.facets.size(); ++f) {
            const Triangle& corners = part.facets[f];
            if (part.patch[f] >= 0)
                areas[names[static_cast<std::size_t>(part.patch[f])]] +=
                    area(part.mesh.vertices, {corners[0], corners[1], corners[2]});
        }
    }
    return areas;
}

void check_vertices(const PartSource& parts, const MergedMesh& mesh) {
    ASSERT_EQ(static_cast<std::int64_t>(mesh.points.size()), parts.outline().vertices);
    for (std::size_t rank = 0; rank < parts.outline().parts.size(); ++rank) {
        const Part part = parts.load(PartIndex(rank));
        for (std::size_t v = 0; v < part.global_id.size(); ++v) {
            const Vec3 moved = mesh.points[static_cast<std::size_t>(part.global_id[v])] - part.mesh.vertices[v];
            EXPECT_LE(moved.norm(), 1e-13 * part.mesh.vertices[v].norm()) << "vertex " << part.global_id[v];
        }
    }
}

void check_tets(const PartSource& parts, const MergedFormat& format, const MergedMesh& mesh) {
    const MeshOutline& outline = parts.outline();
    ASSERT_EQ(static_cast<std::int64_t>(mesh.tets.size()), outline.tets());
    for (const GlobalTet& tet : mesh.tets) {
        ASSERT_TRUE(are_vertices(mesh, tet));
        EXPECT_GT(volume(mesh.points, tet), 0);
    }
    ASSERT_EQ(mesh.part.size(), format.has_parts ? mesh.tets.size() : 0);
    std::map<std::int64_t, std::int64_t> expected, found;
    for (const std::int64_t part : mesh.part) ++found[part];
    for (std::size_t rank = 0; rank < outline.parts.size(); ++rank)
        expected[format.part(outline, rank)] = outline.parts[rank].tets;
    if (format.has_parts) {
        EXPECT_EQ(found, expected);
    }
    std::vector<std::int64_t> bodies;  // in the order of the parts, as the tetrahedra are
    for (std::size_t r = 0; r < outline.parts.size() && format.has_bodies; ++r) {
        const auto rank = static_cast<std::int32_t>(r);
        for (const std::int32_t body : parts.bodies().of_tets(PartIndex(rank), parts.load(PartIndex(rank))))
            bodies.push_back(body + 1);
    }
    if (format.read == test::read_unv || format.read == test::read_feb)  // body by body
        std::stable_sort(bodies.begin(), bodies.end());
    EXPECT_EQ(mesh.body, bodies);
}

void check_patches(const PartSource& parts, const MergedFormat& format, const MergedMesh& mesh) {
    std::multiset<GlobalTriangle> triangles;
    std::map<std::string, double> areas;
    std::map<std::string, std::set<std::int64_t>> nodes;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        ASSERT_TRUE(are_vertices(mesh, mesh.triangles[f]));
        triangles.insert(smallest_first(mesh.triangles[f]));
        areas[mesh.patch[f]] += area(mesh.points, mesh.triangles[f]);
        nodes[mesh.patch[f]].insert(mesh.triangles[f].begin(), mesh.triangles[f].end());
    }
    EXPECT_EQ(triangles, boundary_of(mesh)) << "the triangles are the boundary, and parts are joined";
    const std::map<std::string, double> expected = areas_of(parts, format.patches(parts.outline()));
    ASSERT_EQ(areas.size(), expected.size());
    for (const auto& [patch, wanted] : expected) {
        ASSERT_TRUE(areas.contains(patch)) << patch;
        EXPECT_NEAR(areas[patch], wanted, 1e-9 * wanted) << patch;
    }
    if (!mesh.nodes.empty()) {
        EXPECT_EQ(mesh.nodes, nodes);
    }
}

TEST(Merged, IsTheMeshOfAllParts) {
    for (const test::ExportCase& each : test::export_cases()) {
        const RunParts parts(test::run_of(each));
        for (const MergedFormat& format : merged_formats) {
            SCOPED_TRACE(each.name + " as " + format.name);
            const test::TemporaryFolder folder;
            ExportFiles files(folder.file("out"));
            const Format& written = find_format(format.name);
            written.write_merged(parts, {}, files, "whole");
            const MergedMesh mesh = format.read(folder.file("out/whole") + written.ending);
            check_vertices(parts, mesh);
            check_tets(parts, format, mesh);
            check_patches(parts, format, mesh);
        }
    }
}

TEST(Merged, SurfaceIsThatOfAllParts) {
    for (const test::ExportCase& each : test::export_cases()) {
        SCOPED_TRACE(each.name);
        const RunParts parts(test::run_of(each));
        const test::TemporaryFolder folder;
        ExportFiles files(folder.file("out"));
        find_format("vtp").write_merged(parts, {}, files, "whole");
        const Soup surface = read_surface(folder.file("out/whole.vtp"));
        EXPECT_EQ(std::ssize(surface.facets), parts.outline().patch_facets());
        std::map<std::string, double> areas;
        double enclosed = 0, filled = 0;
        for (std::size_t f = 0; f < surface.facets.size(); ++f) {
            const auto& [a, b, c] = surface.facets[f];
            areas[surface.patch_names[static_cast<std::size_t>(surface.patch[f])]] += area(surface.vertices, {a, b, c});
            const auto at = [&](std::int32_t v) { return surface.vertices[static_cast<std::size_t>(v)]; };
            enclosed += at(a).dot(at(b).cross(at(c))) / 6;
        }
        for (const PartIndex index : parts.outline().parts.ids()) {
            const Part part = parts.load(index);
            for (const auto& [a, b, c, d] : part.mesh.tets) filled += volume(part.mesh.vertices, {a, b, c, d});
        }
        EXPECT_NEAR(enclosed, filled, 1e-9 * filled) << "closed, and seen from outside";
        for (const auto& [patch, wanted] : areas_of(parts, parts.outline().patch_names))
            EXPECT_NEAR(areas[patch], wanted, 1e-9 * wanted) << patch;
    }
}

// Parts that are made up by the tests.
class MadeParts : public PartSource {
 public:
    explicit MadeParts(const std::vector<Part>& parts) : parts_(parts.begin(), parts.end()) {
        for (const Part& part : parts_) {
            outline_.parts.push_back(
                {part.id, part.vertex_count(), part.tet_count(), static_cast<std::int64_t>(part.facets.size())});
            for (const std::int64_t id : part.global_id) outline_.vertices = std::max(outline_.vertices, id + 1);
            outline_.patch_names = part.patch_names.names();
        }
    }
    const MeshOutline& outline() const override { return outline_; }
    MeshOutline& outline() { return outline_; }
    Part load(PartIndex index) const override { return parts_[index]; }

 private:
    Array<PartIndex, Part> parts_;
    MeshOutline outline_;
};

Part one_tet(const std::array<Vec3, 4>& corners, const std::vector<std::string>& names) {
    Part part;
    part.mesh.vertices.assign(corners.begin(), corners.end());
    part.mesh.boundary_vertex_count = 4;
    part.mesh.tets = {{0, 1, 2, 3}};
    part.facets = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
    for (std::size_t f = 0; f < 4; ++f) {
        part.patch.push_back(static_cast<std::int32_t>(f % names.size()));
        part.facet.push_back(static_cast<std::int32_t>(f));
        part.neighbour.push_back(NodeId::none());
        part.tet_at_facet.push_back(0);
        part.global_id.push_back(static_cast<std::int64_t>(f));
    }
    part.patch_names = names;
    return part;
}

TEST(Merged, NumbersThatAFormatCannotHoldAreRefusedBeforeAByte) {
    const test::TemporaryFolder folder;
    MadeParts parts({one_tet({Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}, {"all"})});
    const std::map<std::string, std::int64_t> limits = {
        {"medit", 2147483647}, {"tetgen", 2147483647}, {"abaqus", 999999999}, {"vtk", 2147483647}, {"unv", 499999999},
        {"feb", 2147483647},   {"med", 2147483647},    {"cgns", 1073741823},  {"vtp", 2147483647}};
    const auto refuses = [&](const std::string& name, std::int64_t& count, std::int64_t value) {
        const std::int64_t before = std::exchange(count, value);
        ExportFiles files(folder.file("out"));
        try {
            // What is not refused is not written either: such a mesh has no such parts.
            require_numbers_fit(parts.outline(), name, limits.at(name));
            EXPECT_EQ(value, limits.at(name)) << name;
        } catch (const Error& e) {
            EXPECT_EQ(value, limits.at(name) + 1) << name;
            EXPECT_THROW(find_format(name).write_merged(parts, {}, files, "whole"), Error);
            EXPECT_EQ(e.code(), ErrorCode::usage);
            EXPECT_FALSE(std::filesystem::exists(folder.file("out"))) << name;
        }
        count = before;
    };
    for (const auto& [name, limit] : limits)
        for (const std::int64_t value : {limit, limit + 1}) {
            refuses(name, parts.outline().vertices, value);
            refuses(name, parts.outline().parts[0].tets, value);
            refuses(name, parts.outline().parts[0].patch_facets, value);
        }
}

TEST(Merged, CoordinatesKeepTheirDigits) {
    const std::vector<Vec3> points = {Vec3(-1.2345678901234567e-5, 0.1 + 0.2, -1.7976931348623157e300),
                                      Vec3(-0.012345678901234567, 123456.78901234567, 5e-324),
                                      Vec3(-2.2250738585072014e-308, -9.999999999999999e22, 1.0 / 3),
                                      Vec3(-1234567890123456.7, 1e21, -0.0)};
    const MadeParts parts({one_tet({points[0], points[1], points[2], points[3]}, {"all"})});
    for (const MergedFormat& format : merged_formats) {
        const test::TemporaryFolder folder;
        ExportFiles files(folder.file("out"));
        const Format& written = find_format(format.name);
        written.write_merged(parts, {}, files, "whole");
        const std::string path = folder.file("out/whole") + written.ending;
        if (format.read == test::read_medit || format.read == test::read_su2 || format.read == test::read_tetgen) {
            const std::string text = test::bytes_of_file(path);
            for (const Vec3& p : points)
                for (int i = 0; i < 3; ++i) EXPECT_NE(text.find(fmt::format("{}", p[i])), text.npos) << text;
            continue;  // streams read no denormal numbers
        }
        if (format.read != test::read_abaqus) continue;
        std::ifstream file(path);
        std::string line;
        std::getline(file, line);
        for (const Vec3& p : points) {
            std::getline(file, line);
            std::istringstream fields(line);
            std::string field;
            std::getline(fields, field, ',');
            for (int i = 0; i < 3; ++i) {
                std::getline(fields, field, ',');
                EXPECT_LE(field.size(), 20U) << field;
                const double x = std::strtod(field.c_str(), nullptr);
                EXPECT_LE(std::abs(x - p[i]), 1e-12 * std::abs(p[i])) << field;
            }
        }
    }
}

TEST(Merged, VerticesComeInTheOrderOfTheirNumbers) {
    // More than are held at once, in parts whose numbers alternate.
    constexpr std::int64_t count = (std::int64_t{1} << 21) + 1001;
    std::vector<Part> made(2);
    for (std::int64_t id = 0; id < count; ++id) {
        Part& part = made[static_cast<std::size_t>(id % 2)];
        part.mesh.vertices.emplace_back(static_cast<double>(id), 0, 0);
        part.global_id.push_back(id);
    }
    made[0].mesh.boundary_vertex_count = 500;
    const MadeParts parts(std::move(made));
    std::int64_t next = 0, misplaced = 0, calls = 0;
    for_each_node(parts, [&](std::int64_t first, std::span<const Vec3> points) {
        EXPECT_EQ(first, next);
        for (const Vec3& p : points) misplaced += p.x() != static_cast<double>(next++);
        ++calls;
    });
    EXPECT_EQ(next, count);
    EXPECT_EQ(misplaced, 0);
    EXPECT_EQ(calls, 2);
}

TEST(Merged, PatchesComeOneAfterTheOther) {
    struct Item {
        std::int32_t patch;
        std::int64_t number;
    };
    const std::vector<std::int64_t> sizes = {3, (std::int64_t{1} << 20) + 5, 2, 0, 4};
    const auto visit = [&](const auto& add) {
        for (std::int64_t number = 0; number < sizes[1]; ++number)
            for (std::size_t patch = sizes.size(); patch-- > 0;)
                if (number < sizes[patch]) add(Item{static_cast<std::int32_t>(patch), number});
    };
    std::vector<std::int64_t> taken(sizes.size(), 0);
    std::int32_t last = 0;
    for_each_by_patch<Item>(sizes, visit, [&](std::int32_t patch, std::span<const Item> items) {
        EXPECT_LE(last, patch);
        EXPECT_LE(items.size(), std::size_t{1} << 20);
        last = patch;
        for (const Item& item : items) {
            ASSERT_EQ(item.patch, patch);
            ASSERT_EQ(item.number, taken[static_cast<std::size_t>(patch)]++);
        }
    });
    EXPECT_EQ(taken, sizes);
}

using Words = std::vector<std::string>;

TEST(Merged, NamesBecomeWords) {
    const auto words_of = [](const Words& names, const WordRules& rules) { return word_names(names, rules); };
    EXPECT_EQ(words_of({"inlet", "Wall-2", "a_b"}, {}), (Words{"inlet", "Wall-2", "a_b"}));
    EXPECT_EQ(words_of({"inlet pipe, left (1)", "K\u00f6rper \"zwei\" <&> 2'", "", "\u00fc", "_x", "12", "a\nb"}, {}),
              (Words{"inlet_pipe_left_1", "K_rper_zwei_2", "patch", "patch_2", "x", "patch_12", "a_b"}));
    EXPECT_EQ(words_of({"a b", "a_b", "a,b", "a_b", "a_b_3"}, {}), (Words{"a_b_2", "a_b", "a_b_4", "a_b_5", "a_b_3"}));
    EXPECT_EQ(words_of({"wall", "Wall"}, {}), (Words{"wall", "Wall"}));
    EXPECT_EQ(words_of({"wall", "Wall", "NALL", "nall"}, {.ignores_case = true, .taken = {"NALL"}}),
              (Words{"wall", "Wall_2", "NALL_2", "nall_3"}));
    EXPECT_EQ(words_of({"abcdef", "abcdeg", "abc"}, {.most_characters = 5}), (Words{"abcde", "abc_2", "abc"}));
    const Words many(2000, "x y");
    const Words different = word_names(many);
    EXPECT_EQ(std::set<std::string>(different.begin(), different.end()).size(), many.size());
}

}  // namespace
}  // namespace kerf

// Laws of what comes out of CAD files: closed, turned outwards, of the right volume, with a patch for each face.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "cad/cad_files.h"
#include "files/cad/cad_import.h"
#include "files/io/file_bytes.h"
#include "run/prepare/cad_input.h"
#include "run/prepare/input.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

using std::numbers::pi;

struct Case {
    const char* name;
    std::function<test::CadShape()> make;
    double volume;  // cubic millimetres
    int faces;
    int sharp_curves;  // edges of the model at which faces are not tangent
    bool is_planar;
};

std::vector<Case> cases() {
    const double cap = 1;  // radius of the fillets of the rounded box
    const double rounded = 1000 - 3 * (4 - pi) * cap * cap * (10 - 2 * cap) - (8 - 4 * pi / 3) * cap * cap * cap;
    return {
        {"box",
         [] {
             return test::box({1, 2, 3}, {1, 2, 3});
         },
         6, 6, 12, true},
        {"far_box",
         [] {
             return test::box({1e5, 2e5, -3e5}, {1, 2, 3});
         },
         6, 6, 12, true},
        {"hollow_cube", [] { return test::hollow_cube(4, 2); }, 56, 12, 24, true},
        {"cylinder", [] { return test::cylinder(3, 5); }, 45 * pi, 3, 2, false},
        {"cone", [] { return test::cone(3, 5); }, 15 * pi, 2, 1, false},
        {"sphere", [] { return test::sphere(2); }, 32 * pi / 3, 1, 0, false},
        {"torus", [] { return test::torus(5, 1); }, 10 * pi * pi, 1, 0, false},
        {"rounded_box", [] { return test::rounded_box(10, 1); }, rounded, 26, 0, false},
        {"two_boxes",
         [] {
             return test::together({test::box({0, 0, 0}, {1, 1, 1}), test::box({3, 0, 0}, {1, 1, 2})});
         },
         3, 12, 24, true},
        {"located_cylinder",
         [] {
             return test::moved(test::cylinder(1, 1), {7, 8, 9});
         },
         pi, 3, 2, false},
    };
}

struct CaseInFormat {
    Case shape;
    std::string ending;
};

std::vector<CaseInFormat> cases_in_formats() {
    std::vector<CaseInFormat> all;
    for (const Case& shape : cases())
        for (const char* ending : {".step", ".igs", ".brep"}) {
            // Faces of IGES are loose: a void cannot be told from a second body.
            if (ending == std::string_view(".igs") && shape.name == std::string_view("hollow_cube")) continue;
            all.push_back({shape, ending});
        }
    return all;
}

CadBody import_file(const std::string& path, const CadOptions& options = {}) {
    return import_cad(read_file(path), path, options);
}

std::string error_of(const std::string& path, ErrorCode code, const CadOptions& options = {}) {
    try {
        import_file(path, options);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), code) << error.what();
        EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
        return error.what();
    }
    ADD_FAILURE() << path << " was not refused";
    return "";
}

Bytes bytes_of(const CadBody& body) { return to_cad_bytes({0, "", body}); }

// Curves are chains of model edges between corners; counted by their ends: a closed curve without a corner is one.
int count_sharp_curves(const Soup& soup) {
    std::vector<UndirectedEdge> sharp;
    for (const ModelEdge& edge : soup.model_edges)
        if (edge.sharp) sharp.push_back(edge.vertices);
    std::vector<int> degree(soup.vertices.size());
    for (const UndirectedEdge& e : sharp)
        for (const std::int32_t v : e) ++degree[v];
    const auto ends =
        std::accumulate(degree.begin(), degree.end(), 0, [](int sum, int d) { return sum + (d > 2 ? d : 0); });
    // Without corners every chain is closed: as many edges as vertices, in as many loops as there are components.
    if (ends > 0) return ends / 2;
    int loops = 0;
    std::vector<char> seen(soup.vertices.size());
    for (const UndirectedEdge& start : sharp) {
        if (seen[start[0]]) continue;
        ++loops;
        std::vector<std::int32_t> stack = {start[0]};
        while (!stack.empty()) {
            const std::int32_t v = stack.back();
            stack.pop_back();
            if (std::exchange(seen[v], 1)) continue;
            for (const UndirectedEdge& e : sharp)
                for (const int i : {0, 1})
                    if (e[i] == v && !seen[e[1 - i]]) stack.push_back(e[1 - i]);
        }
    }
    return loops;
}

class CadLaws : public testing::TestWithParam<CaseInFormat> {
 protected:
    std::string written() const {
        const std::string path = folder_.file("part" + GetParam().ending);
        test::write_cad(path, GetParam().shape.make());
        return path;
    }
    test::TemporaryFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Shapes, CadLaws, testing::ValuesIn(cases_in_formats()), [](const auto& test) {
    return std::string(test.param.shape.name) + "_" + test.param.ending.substr(1);
});

TEST_P(CadLaws, SoupIsTheSolid) {
    const Case& shape = GetParam().shape;
    const std::string path = written();
    const CadBody body = import_file(path);
    EXPECT_NEAR(body.exact_volume, shape.volume, 5e-5 * shape.volume) << "IGES has other curves in its faces";
    const double tolerance = shape.is_planar ? 1e-12 : CadOptions::volume_tolerance;
    EXPECT_NEAR(body.volume, body.exact_volume, tolerance * body.exact_volume);
    const CheckedSoup checked = check_soup(body.soup);
    EXPECT_TRUE(checked.diagnosis.clean()) << checked.diagnosis.summary(checked.soup);
    EXPECT_EQ(checked.tidied.dropped_facets + checked.tidied.welded_vertices + checked.tidied.unused_vertices, 0);
    for (const DefectKind kind : {DefectKind::inverted_shell, DefectKind::inconsistent_orientation})
        EXPECT_EQ(checked.diagnosis.count(kind), 0);
    EXPECT_EQ(bytes_of(body), bytes_of(import_file(path))) << "not deterministic";
}

TEST_P(CadLaws, PatchesAreTheFaces) {
    const CadBody body = import_file(written());
    EXPECT_EQ(body.soup.patch_names.size(), static_cast<std::size_t>(GetParam().shape.faces));
    EXPECT_EQ(body.faces, GetParam().shape.faces);
    const std::set<std::string> names(body.soup.patch_names.begin(), body.soup.patch_names.end());
    EXPECT_EQ(names.size(), body.soup.patch_names.size());
    for (const std::string& name : names) EXPECT_NE(name.find("/face "), std::string::npos) << name;
    const std::set<std::int32_t> used(body.soup.patch.begin(), body.soup.patch.end());
    EXPECT_EQ(used.size(), names.size());
}

TEST_P(CadLaws, EdgesOfTheModelAreEdgesOfFacets) {
    const Soup soup = import_file(written()).soup;
    std::set<UndirectedEdge> edges;
    std::set<UndirectedEdge> between_patches;
    std::map<UndirectedEdge, std::int32_t> patch_beside;
    for (std::size_t f = 0; f < soup.facets.size(); ++f)
        for (std::size_t i = 0; i < 3; ++i) {
            const UndirectedEdge edge = undirected(soup.facets[f][i], soup.facets[f][(i + 1) % 3]);
            if (!edges.insert(edge).second && patch_beside[edge] != soup.patch[f]) between_patches.insert(edge);
            patch_beside[edge] = soup.patch[f];
        }
    std::set<UndirectedEdge> of_model;
    for (const ModelEdge& edge : soup.model_edges) {
        EXPECT_TRUE(edges.contains(edge.vertices));
        EXPECT_TRUE(of_model.insert(edge.vertices).second) << "twice";
    }
    EXPECT_TRUE(std::includes(of_model.begin(), of_model.end(), between_patches.begin(), between_patches.end()));
    EXPECT_EQ(count_sharp_curves(soup), GetParam().shape.sharp_curves);
}

class CadFile : public testing::Test {
 protected:
    std::string write(const std::string& name, const test::CadShape& shape, const std::string& unit = "MM") const {
        test::write_cad(folder_.file(name), shape, unit);
        return folder_.file(name);
    }
    std::string write_text(const std::string& name, const std::string& text) const {
        std::ofstream(folder_.file(name), std::ios::binary) << text;
        return folder_.file(name);
    }
    test::TemporaryFolder folder_;
};

TEST_F(CadFile, VolumeIsRightAndPlanesStayPlanar) {
    const CadBody body = import_file(write("cylinder.step", test::cylinder(3, 5)));
    const CadBody rough = import_file(write("cylinder.step", test::cylinder(3, 5)), {.deflection = 1e-3});
    EXPECT_GT(std::abs(rough.volume / rough.exact_volume - 1), 10 * CadOptions::volume_tolerance);
    EXPECT_NEAR(body.volume, body.exact_volume, 1e-6 * body.exact_volume);
    EXPECT_LT(body.soup.facets.size(), 3 * rough.soup.facets.size()) << "by vertices, not by finer chords";
    for (const Vec3& p : body.soup.vertices) {
        EXPECT_LT(std::min(std::abs(p.z()), std::abs(p.z() - 5)), 1e-12) << "all are on the edges of the caps";
        EXPECT_NEAR(std::hypot(p.x(), p.y()), 3, 0.03);
    }
}

TEST_F(CadFile, SolidsOfASmallGapStayApart) {
    const std::string path =
        write("two.step", test::together({test::cylinder(1, 1), test::moved(test::cylinder(1, 1), {2.001, 0, 0})}));
    const CadBody body = import_file(path);
    EXPECT_EQ(body.solids, 2);
    EXPECT_NEAR(body.volume, body.exact_volume, CadOptions::volume_tolerance * body.exact_volume);
}

TEST_F(CadFile, UnitsAreReadAndConverted) {
    for (const char* ending : {".step", ".igs"})
        for (const auto& [unit, said] : {std::pair("MM", "mm"), std::pair("INCH", "inch"), std::pair("M", "m")}) {
            SCOPED_TRACE(std::string(unit) + ending);
            const std::string path = write(std::string("box") + ending, test::box({0, 0, 0}, {254, 508, 25.4}), unit);
            const CadBody in_mm = import_file(path), in_inch = import_file(path, {.unit = LengthUnit::inch});
            EXPECT_EQ(in_mm.file_unit, said);
            EXPECT_EQ(in_mm.unit, "mm");
            EXPECT_NEAR(in_mm.volume, 254 * 508 * 25.4, 1e-9 * in_mm.volume);
            EXPECT_NEAR(in_inch.volume, 200, 1e-9 * 200);
            EXPECT_NE(in_inch.soup.notes.front().find(std::string("unit ") + said + " -> inch, 1 solid, 6 faces"),
                      std::string::npos)
                << in_inch.soup.notes.front();
        }
    const CadBody without = import_file(write("box.brep", test::box({0, 0, 0}, {1, 2, 3})), {.unit = LengthUnit::m});
    EXPECT_NEAR(without.volume, 6, 1e-12) << "a file without a unit keeps its numbers";
    EXPECT_EQ(without.soup.notes.back(), "The file names no unit: its numbers stay, whatever unit is asked for.");
}

TEST_F(CadFile, AssemblyGivesNamesAndColours) {
    const std::string path = folder_.file("assembly.step");
    test::write_assembly(path, "Gehäuse",
                         {{"Flügel/links", test::box({0, 0, 0}, {1, 1, 1}), {0.2, 0.4, 0.6}},
                          {"Flügel/links", test::box({2, 0, 0}, {1, 1, 1})},
                          {"", test::box({4, 0, 0}, {1, 1, 1})}});
    const CadBody body = import_file(path);
    EXPECT_EQ(body.solids, 3);
    const std::vector<std::string>& names = body.soup.patch_names;
    ASSERT_EQ(names.size(), 18u);
    EXPECT_EQ(names[0], "Gehäuse/Flügel_links/face 1");
    EXPECT_EQ(names[6], "Gehäuse/Flügel_links (2)/face 1");
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), 18u);
    ASSERT_EQ(body.soup.patch_colours.size(), 18u);
    EXPECT_EQ(body.soup.patch_colours[0], (std::array<std::uint8_t, 4>{51, 102, 153, 255}));
    EXPECT_EQ(body.soup.patch_colours[6][3], 0);
}

TEST_F(CadFile, SolidIsChosenByItsNumber) {
    const std::string path =
        write("two.step", test::together({test::box({0, 0, 0}, {1, 1, 1}), test::box({1, 0, 0}, {1, 1, 2})}));
    EXPECT_NEAR(import_file(path, {.solid = 1}).volume, 1, 1e-12);
    EXPECT_NEAR(import_file(path, {.solid = 2}).volume, 2, 1e-12);
    EXPECT_NE(error_of(path, ErrorCode::usage, {.solid = 3}).find("2 solids"), std::string::npos);
}

TEST_F(CadFile, TouchingSolidsAreNamedAndUnited) {
    for (const double overlap : {0.0, 0.25}) {
        const std::string path =
            write("touching.step",
                  test::together({test::box({0, 0, 0}, {1, 1, 1}), test::box({1 - overlap, 0.2, 0.2}, {1, 0.5, 0.5})}));
        const std::string message = error_of(path, ErrorCode::input, {.no_imprint = true});
        EXPECT_NE(message.find("--unite"), std::string::npos) << message;
        EXPECT_NE(message.find("solid 2"), std::string::npos) << message;
        const CadBody united = import_file(path, {.unite = true});
        EXPECT_NEAR(united.volume, 1 + 0.25 * (1 - overlap), 1e-12);
        EXPECT_EQ(united.solids, 1);
        EXPECT_EQ(united.faces, 11) << "of 12 one lies inside; the face with a hole stays one patch";
        EXPECT_TRUE(check_soup(united.soup).diagnosis.clean());
        EXPECT_EQ(bytes_of(united), bytes_of(import_file(path, {.unite = true})));
    }
}

TEST_F(CadFile, LooseFacesAreSewn) {
    for (const char* name : {"loose.igs", "loose.step", "loose.brep"}) {
        const CadBody body = import_file(write(name, test::loose_faces(test::cylinder(3, 5))));
        EXPECT_NEAR(body.volume, 45 * pi, 2e-4 * 45 * pi) << name;
        EXPECT_EQ(body.faces, 3);
        EXPECT_TRUE(std::any_of(body.soup.notes.begin(), body.soup.notes.end(),
                                [](const std::string& note) { return note.find("sewn") != std::string::npos; }));
    }
}

TEST_F(CadFile, FacesBesideSolidsAreLeftOutWithANote) {
    const CadBody body = import_file(write(
        "beside.step",
        test::together({test::box({0, 0, 0}, {1, 1, 1}), test::loose_faces(test::box({5, 5, 5}, {1, 1, 1}), 4)})));
    EXPECT_EQ(body.faces, 6);
    EXPECT_TRUE(std::find(body.soup.notes.begin(), body.soup.notes.end(), "2 faces of no solid were ignored.") !=
                body.soup.notes.end());
}

TEST_F(CadFile, DeflectionIsObeyed) {
    const std::string path = write("sphere.step", test::sphere(1));
    const auto facets = [&](double deflection) {
        return import_file(path, {.deflection = deflection}).soup.facets.size();
    };
    EXPECT_LT(facets(1e-2), facets(1e-3));
    EXPECT_LT(facets(1e-3), facets(1e-4));
    for (const double deflection : {1e-2, 1e-3, 1e-4}) {
        const CadBody body = import_file(path, {.deflection = deflection});
        // A chord's distance is a share of the diagonal, 2 sqrt 3; the volume changes by the area times that, at most.
        EXPECT_LT(std::abs(body.volume - body.exact_volume), 4 * pi * 2 * std::sqrt(3.0) * deflection * 1.5);
    }
}

TEST_F(CadFile, OpenShellsAreRefusedWithFacesAndPlace) {
    for (const char* name : {"open.step", "open.igs", "open.brep"}) {
        const std::string message =
            error_of(write(name, test::open_shell(test::box({0, 0, 0}, {1, 1, 1}))), ErrorCode::input);
        EXPECT_NE(message.find("open: 4 edges"), std::string::npos) << message;
        EXPECT_NE(message.find("/face "), std::string::npos) << message;
    }
}

TEST_F(CadFile, WithoutFacesThereIsNothingToMesh) {
    for (const char* name : {"line.step", "line.igs", "line.brep"})
        EXPECT_NE(error_of(write(name, test::line()), ErrorCode::input).find("no faces"), std::string::npos);
}

TEST_F(CadFile, DamagedFilesAreRefused) {
    for (const char* name : {"box.step", "box.igs", "box.brep"}) {
        const std::string whole = read_file(write(name, test::box({0, 0, 0}, {1, 1, 1})));
        for (const double share : {0.0, 0.3, 0.6, 0.9, 0.99}) {
            SCOPED_TRACE(std::string(name) + " " + std::to_string(share));
            error_of(
                write_text(name, whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size())))),
                ErrorCode::input);
        }
    }
    error_of(write_text("text.step", "This is a letter, and no STEP file.\n"), ErrorCode::input);
    error_of(write_text("head.step", "ISO-10303-21;\nnonsense\nEND-ISO-10303-21;\n"), ErrorCode::input);
    error_of(write_text("head.brep", "DBRep_DrawableShape\n\nCASCADE Topology V1\nnonsense"), ErrorCode::input);
}

// Bytes that differ give a body or a sentence. OpenCASCADE may crash on them, which only ends kerf-cad.
TEST_F(CadFile, FlippedBytesAreReadOrRefused) {
    constexpr std::size_t count = 8, flipped = 10;
    constexpr double timeout_seconds = 20;
    std::size_t refused = 0;
    for (const char* name : {"box.step", "box.igs", "box.brep"}) {
        const std::string whole = read_file(write(name, test::box({0, 0, 0}, {1, 1, 1})));
        for (std::size_t i = 0; i < count; ++i) {
            std::string damaged = whole;
            for (std::size_t k = 0; k < flipped; ++k)
                damaged[(i * 7919 + k * 104729) % whole.size()] = "0x,'#(9 -\n"[(i + k) % flipped];
            const std::string path = write_text(name, damaged);
            try {
                const CadBody body = read_cad(path, digest_of(damaged), {}, test::cad_program(), timeout_seconds);
                EXPECT_TRUE(check_soup(body.soup).diagnosis.clean());
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ErrorCode::input) << error.what();
                EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
                ++refused;
            }
        }
    }
    EXPECT_GT(refused, count);
}

}  // namespace
}  // namespace kerf

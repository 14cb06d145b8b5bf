// Real surfaces beyond the project's own, where a folder with them is at hand. All `good` ones are found to be clean
// and decompose; the well-shaped ones among them, and some of CAD programs, are meshed and every law is checked. `bad`
// ones are refused with a code and a message.
#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <set>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "run/prepare/remeshing.h"
#include "support/damage.h"
#include "support/decomposition_laws.h"
#include "support/places.h"
#include "support/program.h"
#include "support/run_in_process.h"
#include "support/run_laws.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

namespace fs = std::filesystem;

bool readable(const fs::path& path) {
    constexpr std::array<const char*, 7> types = {".stl", ".obj", ".ply", ".off", ".mesh", ".smesh", ".poly"};
    return std::find(types.begin(), types.end(), path.extension()) != types.end();
}

std::vector<std::string> surfaces(const std::string& folder) {
    std::vector<std::string> paths;
    for (const auto& entry : fs::directory_iterator(fs::path(test::corpus_folder()) / folder))
        if (readable(entry.path())) paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    return paths;
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
    std::string name = fs::path(info.param).filename();
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
    return name;
}

TEST(Corpus, IsNotEmpty) {
    EXPECT_FALSE(surfaces("good").empty());
    EXPECT_FALSE(surfaces("bad").empty());
}

class GoodSurface : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Corpus, GoodSurface, testing::ValuesIn(surfaces("good")), test_name);

TEST_P(GoodSurface, IsReadAndClean) {
    const CheckedSoup checked = check_input(GetParam());
    EXPECT_TRUE(checked.diagnosis.clean()) << checked.diagnosis.summary(checked.soup);
    const Input input = read_input(GetParam());
    EXPECT_GT(input.volume, 0);
    EXPECT_EQ(input.facets, input.complex.facet_count());
}

TEST_P(GoodSurface, DecomposesIntoEveryNumberOfParts) {
    constexpr std::int32_t facets_for_a_part = 300;
    const Surface surface = read_input(GetParam()).complex.surface_of(RegionIndex(0));
    for (const std::int32_t parts : {2, 8, 32}) {
        SCOPED_TRACE(testing::Message() << parts << " parts");
        DecomposeOptions options;
        options.parts = parts;
        options.threads = 2;
        const Decomposition whole = test::decompose_whole(surface, options);
        EXPECT_EQ(test::broken_laws(whole, surface.arrays()), "");
        const bool all_wanted = surface.facet_count() >= facets_for_a_part * parts;
        EXPECT_GE(whole.leaves.size(), all_wanted ? static_cast<std::size_t>(parts) : 1u);
    }
}

std::vector<std::string> well_shaped_surfaces() {
    std::vector<std::string> paths;
    for (const char* name : {"mesh2hrtf_head.ply", "openfoam_flange.stl", "openfoam_DTC-scaled.stl",
                             "openscad_far-out-ring.stl", "cfmesh_asmo.stl"})
        paths.push_back(fs::path(test::corpus_folder()) / "good" / name);
    return paths;
}

class WellShapedSurface : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Corpus, WellShapedSurface, testing::ValuesIn(well_shaped_surfaces()), test_name);

TEST_P(WellShapedSurface, IsMeshedAndVerifiedWithoutAFailedCut) {
    const SurfaceArrays surface = read_input(GetParam()).complex.arrays();
    for (const std::int32_t parts : {2, 8, 32}) {
        SCOPED_TRACE(testing::Message() << parts << " parts");
        const test::TemporaryFolder folder;
        const RunReport report = test::run_parts(GetParam(), folder.file("out"), parts);
        EXPECT_EQ(report.exit_code, 0);
        EXPECT_TRUE(report.verification.passed);
        EXPECT_EQ(report.parts.size(), static_cast<std::size_t>(parts));
        EXPECT_EQ(test::broken_laws(test::read_parts(folder.file("out")), surface), "") << "every facet stays";
    }
}

// Triangles as long as the part, with sides down to a thousandth of that. Of the aerofoil and the filter housing,
// TetGen leaves parts undone, after minutes or with facets missing.
std::vector<std::string> cad_surfaces() {
    std::vector<std::string> paths;
    for (const char* name : {"netgen_hinge.stl", "trimesh_featuretype.ply", "openfoam_shield.obj",
                             "prusa_y-motor-holder.stl", "windtunnel_honeycomb_round.stl", "openfoam_tank.obj"})
        paths.push_back(fs::path(test::corpus_folder()) / "good" / name);
    return paths;
}

class CadSurface : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Corpus, CadSurface, testing::ValuesIn(cad_surfaces()), test_name);

TEST_P(CadSurface, IsMeshedInEightPartsByTheLaws) {
    const test::TemporaryFolder folder;
    RunRequest as_it_is;
    as_it_is.remeshing = Remeshing::never;
    const RunReport report = test::run_parts(GetParam(), folder.file("out"), 8, as_it_is);
    EXPECT_EQ(report.exit_code, 0);
    EXPECT_TRUE(report.verification.passed);
    EXPECT_EQ(report.parts.size(), 8u);
    EXPECT_EQ(test::broken_laws(test::read_parts(folder.file("out")), read_input(GetParam()).complex.arrays()), "");
}

// Needles, few or many: whoever asks for nothing gets cells that are of use.
class SliveredSurface : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Corpus, SliveredSurface,
                         testing::Values("netgen_hinge.stl", "trimesh_plate_holes.stl", "openfoam_shield.obj",
                                         "prusa_y-motor-holder.stl", "elmer_femur.off"),
                         test_name);

TEST_P(SliveredSurface, GetsUsefulCellsByDefault) {
    const std::string path = fs::path(test::corpus_folder()) / "good" / GetParam();
    const test::TemporaryFolder folder;
    const RunReport report = test::run_parts(path, folder.file("out"), 8);
    EXPECT_EQ(report.exit_code, 0);
    ASSERT_TRUE(report.input.remeshed);
    EXPECT_LE(report.input.facets, 12 * report.input.remeshed->facets_before);
    const Distribution& angles = report.mesh.quality.all.measures[0];
    EXPECT_GE(angles.min(), 3);
    EXPECT_GE(angles.percentile(0.01), 20);
    const SurfaceArrays remeshed = remesh_where_asked(read_input(path), {}).complex.arrays();
    EXPECT_EQ(test::broken_laws(test::read_parts(folder.file("out")), remeshed), "");
}

struct KindCount {
    DefectKind kind;
    Severity severity;
    std::int64_t count;
    auto operator<=>(const KindCount&) const = default;
};

// What kerf check says about a file; warnings aside.
struct BadFile {
    std::string name;
    std::vector<KindCount> found;
    std::vector<std::string> lines = {};  ///< some of test::lines()
    std::size_t open_edges = 0;           ///< of all loops
};

const std::vector<BadFile>& bad_files() {
    using Kind = DefectKind;
    constexpr Severity error = Severity::error, repaired = Severity::repaired;
    static const std::vector<BadFile> files = {
        {"VALID_odd_ascii_spacing_crlf_uppercase__derived_hinge.stl", {}},
        {"ambiguous_cavity_oriented_outward__derived_projection.stl",
         {{Kind::ambiguous_shell, error, 1}},
         {"error ambiguous shell: facets 0; vertices 0 1 2"}},
        {"coincident_duplicate_body__derived_hinge.stl", {{Kind::coincident_shell, error, 1}}},
        {"degenerate_2_zero_area__openscad_adns2610.stl",
         {{Kind::degenerate_facet, error, 2}, {Kind::self_intersection, error, 34}},
         {"error degenerate facet: facets 751; vertices 398 270 267",
          "error degenerate facet: facets 856; vertices 383 288 285"}},
        {"duplicate_triangles__meshlab_conrod.stl",
         {{Kind::duplicate_facet, repaired, 3},
          {Kind::inconsistent_orientation, repaired, 1},
          {Kind::self_intersection, error, 13}},
         {"repaired duplicate facet: facets 534 535; vertices 115 310 311",
          "repaired duplicate facet: facets 1396 1397; vertices 633 810 807",
          "repaired duplicate facet: facets 1403 1405; vertices 667 812 813"}},
        {"flipped_triangles__admesh_hourglass.stl",
         {{Kind::inconsistent_orientation, repaired, 1}},
         {"repaired inconsistent orientation: facets 2145; vertices "}},
        {"nan_coordinate__derived_unit_sphere.stl",
         {{Kind::non_finite, error, 1}, {Kind::open_edge, error, 1}},
         {"error non-finite vertex: facets 100; vertices 72"},
         4},
        {"nonmanifold_1_pinched_vertex_only__geometrycentral_hourglass.obj",
         {{Kind::non_manifold_vertex, error, 1}},
         {"error non-manifold vertex: facets 0 1 2 3 4 35 36 37 38 39; vertices 22"}},
        {"nonmanifold_edge_two_cubes__openscad.stl",
         {{Kind::non_manifold_edge, error, 1}},
         {"error non-manifold edge: facets 7 10 12 20; vertices 5 6"}},
        {"open_cracks_when_welded_exactly__trimesh_featuretype.stl",
         {{Kind::open_edge, error, 16}, {Kind::self_intersection, error, 1216}},
         {},
         576},
        {"open_nonorientable_moebius__geometrycentral.obj",
         {{Kind::unfit_polygon, error, 224}, {Kind::open_edge, error, 2}, {Kind::one_sided, error, 1}},
         {},
         112},
        {"selfint_37_pairs__meshlab_block.off", {{Kind::self_intersection, error, 37}}},
        {"degenerate_commonmodels_ogre.obj",
         {{Kind::degenerate_facet, error, 4}, {Kind::open_edge, error, 5}, {Kind::self_intersection, error, 9138}},
         {},
         200},
        {"duplicate_sofa_truthcylinder.obj",
         {{Kind::duplicate_facet, repaired, 5},
          {Kind::duplicate_facet, error, 2},
          {Kind::open_edge, error, 45},
          {Kind::non_manifold_edge, error, 20},
          {Kind::non_manifold_vertex, error, 5},
          {Kind::self_intersection, error, 112}},
         {},
         191},
        {"nonmanifold_prusaslicer_xl_gantry.stl",
         {{Kind::non_manifold_vertex, error, 1243}, {Kind::self_intersection, error, 10000}}},
        {"open_occt_video_part.stl",
         {{Kind::open_edge, error, 79},
          {Kind::inconsistent_orientation, repaired, 1},
          {Kind::self_intersection, error, 292}},
         {},
         244},
        {"selfint_vtk_gears.stl", {{Kind::self_intersection, error, 110}}},
        {"manifold_openscad-nonmanifold-crash.obj",
         {{Kind::degenerate_facet, error, 1},
          {Kind::duplicate_facet, repaired, 3},
          {Kind::non_manifold_edge, error, 11},
          {Kind::non_manifold_vertex, error, 34},
          {Kind::one_sided, error, 1},
          {Kind::self_intersection, error, 7522}}},
        // Odd, but other programs write so.
        {"parse_VALID_end_solid_circle_knot.stl", {}},
        {"parse_VALID_tristrips_igea.ply", {}},
        {"parse_VALID_zbrush_raptor_8kp.obj",
         {{Kind::unfit_polygon, error, 8512}, {Kind::self_intersection, error, 72}}},
        {"parse_no_endfacet_ringmesh.stl", {}},  // walls of several regions
    };
    return files;
}

struct UnreadableFile {
    std::string name, words;
};

const std::vector<UnreadableFile>& unreadable_files() {
    static const std::vector<UnreadableFile> files = {
        {"empty_0_bytes__openscad.stl", "the file is empty"},
        {"parse_index_out_of_range__assimp.obj",
         "line 23: a facet names vertex number 11 (counted from 0), but there are 8 vertices"},
        {"parse_word_instead_of_number__openscad.stl", "line 89: a number is expected, not \"blah\""},
        {"truncated_binary_solid_header__derived_plate_holes.stl",
         "truncated: its header claims 1252 facets, but it ends in facet 750"},
    };
    return files;
}

std::string bad_path(const std::string& name) { return fs::path(test::corpus_folder()) / "bad" / name; }

std::vector<KindCount> count_kinds(const Diagnosis& diagnosis) {
    std::vector<KindCount> found;
    for (const Defect& defect : diagnosis.defects) {
        if (defect.severity == Severity::warning) continue;
        auto its = std::find_if(found.begin(), found.end(), [&](const KindCount& other) {
            return other.kind == defect.kind && other.severity == defect.severity;
        });
        if (its == found.end()) its = found.insert(its, {defect.kind, defect.severity, 0});
        ++its->count;
    }
    return found;
}

std::size_t open_edges(const Diagnosis& diagnosis) {
    std::size_t count = 0;
    for (const Defect& defect : diagnosis.defects)
        if (defect.kind == DefectKind::open_edge) count += defect.facets.size();
    return count;
}

// The folder grows without this repository: a file that no table has is read, or refused in words, and nothing more.
TEST(BadFiles, AreInTheTablesOrReadOrRefused) {
    std::set<std::string> known;
    for (const BadFile& file : bad_files()) known.insert(bad_path(file.name));
    for (const UnreadableFile& file : unreadable_files()) known.insert(bad_path(file.name));
    for (const std::string& path : surfaces("bad")) {
        if (known.erase(path) > 0) continue;
        std::cout << "no table has " << path << '\n';
        try {
            check_input(path);
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()), "") << path;
        }
    }
    EXPECT_EQ(known, std::set<std::string>()) << "are not there";
}

TEST(BadFiles, AreCheckedWithTheRightKindsAndNumbers) {
    for (const BadFile& file : bad_files()) {
        SCOPED_TRACE(file.name);
        const CheckedSoup checked = check_input(bad_path(file.name));
        const Diagnosis& diagnosis = checked.diagnosis;
        EXPECT_EQ(count_kinds(diagnosis), file.found);
        EXPECT_EQ(open_edges(diagnosis), file.open_edges);
        const std::vector<std::string> lines = test::lines(checked.soup, checked.diagnosis);
        for (const std::string& line : file.lines)
            EXPECT_TRUE(std::binary_search(lines.begin(), lines.end(), line)) << line;
        const bool any_error = std::any_of(file.found.begin(), file.found.end(),
                                           [](const KindCount& found) { return found.severity == Severity::error; });
        EXPECT_EQ(test::run_kerf({"check", bad_path(file.name)}).exit_code, any_error ? 3 : 0);
    }
}

TEST(BadFiles, ThatCannotBeReadAreRefusedWithThePlace) {
    for (const UnreadableFile& file : unreadable_files()) {
        SCOPED_TRACE(file.name);
        const ChildResult result = test::run_kerf({"check", bad_path(file.name)});
        EXPECT_EQ(result.exit_code, 3);
        EXPECT_NE(test::output_of(result).find(file.words), std::string::npos) << test::output_of(result);
    }
}

TEST(BadFiles, CracksAndCavitiesAreMendedOnRequest) {
    InputOptions options;
    options.voids = Voids::parity;
    const std::string cavity = bad_path("ambiguous_cavity_oriented_outward__derived_projection.stl");
    EXPECT_TRUE(check_input(cavity, options).diagnosis.clean());
    options.repairs.weld_tolerance = 1e-5;
    const CheckedSoup welded =
        check_input(bad_path("open_cracks_when_welded_exactly__trimesh_featuretype.stl"), options);
    EXPECT_TRUE(welded.diagnosis.clean()) << welded.diagnosis.summary(welded.soup);
    EXPECT_EQ(welded.soup.vertices.size(), 1722u) << "as in the same part without cracks";
}

class BadSurface : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Corpus, BadSurface, testing::ValuesIn(surfaces("bad")), test_name);

// Some are odd but valid, or are repaired and counted; then the laws hold.
TEST_P(BadSurface, IsRefusedWithAMessageOrMeshedByTheLaws) {
    const test::TemporaryFolder folder;
    try {
        const RunReport report = test::run_parts(GetParam(), folder.file("out"), 1);
        EXPECT_EQ(report.exit_code, 0);
        const Input meshed = remesh_where_asked(read_input(GetParam()), {});
        EXPECT_EQ(test::broken_laws(test::read_parts(folder.file("out")), meshed.complex), "");
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::input) << error.what();
        EXPECT_NE(std::string(error.what()).find(fs::path(GetParam()).filename()), std::string::npos) << error.what();
        EXPECT_TRUE(folder.names().empty());
    }
}

}  // namespace
}  // namespace kerf

#include "run/work/part_job.h"

#include <filesystem>
#include <numeric>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/core/bytes.h"
#include "base/core/error.h"
#include "base/geometry/predicates.h"
#include "base/geometry/tetrahedron.h"
#include "files/io/file_bytes.h"
#include "files/part/vtu_writer.h"
#include "run/report/report.h"
#include "run/report/totals.h"
#include "run/work/failed_part.h"
#include "run/work/journal.h"
#include "support/file_contents.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"
#include "support/voxels.h"
#include "surface/size/mean_edge.h"

namespace kerf {
namespace {

PartJob job_of(const Soup& soup) {
    PartJob job;
    job.surface = test::to_arrays(soup);
    job.boundary_id.assign(job.surface.vertices.size(), 0);
    job.neighbour.assign(job.surface.facets.size(), NodeId::none());
    job.length_scale = 1;
    return job;
}

TEST(PartJob, CountsAndHasAQualityWhenDone) {
    const test::TemporaryFolder folder;
    const PartResult result = run_part_job(job_of(test::box()), {}, folder.file("part"));
    EXPECT_EQ(result.code, 0) << result.message;
    EXPECT_GT(result.tets, 0);
    EXPECT_EQ(result.quality.all.measures.size(), quality_measures.size());
}

// The report says of each part and of all what it was before, whether it is filled as a whole or in two.
TEST(PartJob, SaysHowMuchBetterItsCellsHaveBecome) {
    const test::TemporaryFolder folder;
    MesherCall call, unimproved;
    call.options.size = unimproved.options.size = SizeField(1e-2);
    unimproved.options.improve = false;
    for (const bool cut_first : {false, true}) {
        call.cut_first = unimproved.cut_first = cut_first;
        const PartJob job = job_of(test::icosphere(3));
        const PartResult raw = run_part_job(job, unimproved, folder.file("raw"));
        const PartResult better = run_part_job(job, call, folder.file("better"));
        EXPECT_FALSE(raw.angles.known());
        EXPECT_TRUE(raw.improvement.is_empty());
        EXPECT_EQ(better.improvement.smallest_before.count(), raw.tets);
        const Distribution &was = raw.quality.all.measures[0], &is = better.quality.all.measures[0];
        EXPECT_NEAR(better.angles.min_before_deg, was.min(), 1e-6);
        EXPECT_NEAR(better.angles.p1_before_deg, was.percentile(0.01), 0.2);
        EXPECT_EQ(better.angles.min_after_deg, is.min());
        EXPECT_EQ(better.angles.p1_after_deg, is.percentile(0.01));
        EXPECT_GE(is.min(), was.min() - 1e-6);
        EXPECT_GT(is.percentile(0.01), 1.5 * was.percentile(0.01));
        EXPECT_GT(better.improve_seconds, 0);
        EXPECT_LE(better.improve_seconds, better.mesh_seconds);
        const auto again = from_bytes<PartResult>(to_bytes(better));
        EXPECT_EQ(again.improvement.removed_edges, better.improvement.removed_edges);
        EXPECT_EQ(again.angles.p1_before_deg, better.angles.p1_before_deg);
    }
}

TEST(ReportOfParts, SaysWhatImprovementHasGained) {
    const test::TemporaryFolder folder;
    RunReport report;
    report.input.path = "ball.stl";
    report.mesh.quality = PartQuality(1);
    EXPECT_TRUE(nlohmann::json::parse(to_json(report)).at("improvement").is_null());
    report.parts.resize(2);
    report.parts[1].result = run_part_job(job_of(test::icosphere(3)), {}, folder.file("part"));
    report.mesh.quality.add(report.parts[1].result.quality);
    report.mesh.improvement.add(report.parts[1].result.improvement);
    const nlohmann::json json = nlohmann::json::parse(to_json(report));
    EXPECT_FALSE(json.at("parts")[0].contains("improvement"));
    const nlohmann::json &part = json.at("parts")[1].at("improvement"), &all = json.at("improvement");
    for (const char* key :
         {"removed_edges", "moved_vertices", "new_vertices", "bad_cells_before", "bad_cells_after",
          "min_dihedral_deg_before", "min_dihedral_deg_after", "p1_dihedral_deg_before", "p1_dihedral_deg_after"})
        EXPECT_EQ(part.at(key), all.at(key)) << key;
    EXPECT_GT(part.at("p1_dihedral_deg_after").get<double>(), part.at("p1_dihedral_deg_before").get<double>());
    EXPECT_NEAR(part.at("p1_dihedral_deg_per_second").get<double>() * part.at("seconds").get<double>(),
                part.at("p1_dihedral_deg_after").get<double>() - part.at("p1_dihedral_deg_before").get<double>(),
                1e-3);  // six digits
}

TEST(ReportOfParts, SaysWhichCellsTheSurfaceForces) {
    const test::TemporaryFolder folder;
    RunReport report;
    report.input.path = "plate.stl";
    const auto told = [&](const Soup& body, ReportDetail detail) {
        report.mesh.quality = run_part_job(job_of(body), {}, folder.file("part")).quality;
        return to_text(report, detail).find("forced      by the surface: ") != std::string::npos;
    };
    const Soup plate = test::box(Vec3(-5, -5, 0), Vec3(5, 5, 0.1), std::array{8, 8, 1});
    for (const ReportDetail detail : {ReportDetail::brief, ReportDetail::all}) {
        EXPECT_TRUE(told(plate, detail));
        EXPECT_GT(nlohmann::json::parse(to_json(report)).at("forced").at("tets"), 0);
        EXPECT_FALSE(told(test::box(Vec3::Zero(), Vec3::Ones(), 4), detail));
    }
}

// The remedy that fills two halves: what others see of the part is the same, and the vertices of the cut are inside.
TEST(PartJob, IsTheSameFromOutsideWhenCutInTwo) {
    const test::TemporaryFolder folder;
    MesherCall whole, in_two;
    whole.options.size = in_two.options.size = SizeField(1e-2);
    in_two.cut_first = true;
    for (const Soup& soup : {test::icosphere(3), test::torus(3, 1, 30, 20), test::nested_boxes(2, 5)}) {
        SCOPED_TRACE(soup.patch_names.front());
        const PartJob job = job_of(soup);
        const PartResult a = run_part_job(job, whole, folder.file("whole"));
        const PartResult b = run_part_job(job, in_two, folder.file("halves"));
        ASSERT_EQ(b.code, 0) << b.message;
        EXPECT_TRUE(b.laws.hold());
        EXPECT_EQ(b.vertices - b.interior_vertices, a.vertices - a.interior_vertices);
        EXPECT_NEAR(b.laws.volume, a.laws.volume, 1e-12 * a.laws.volume);
        EXPECT_NE(b.hash, a.hash);
        EXPECT_EQ(digest_of(read_file(folder.file("halves"))), b.file_hash);
    }
}

// Whole and in two: a cut may leave copies of a vertex in one half, which are one again before it is filled.
TEST(PartJob, FillsBodiesThatTouchThemselves) {
    const test::TemporaryFolder folder;
    int cut = 0;
    for (const test::Voxels& voxels :
         {test::Voxels{{0, 0, 0}, {1, 1, 1}}, test::Voxels{{0, 0, 0}, {1, 1, 0}},
          test::Voxels{{0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}}, test::notched_voxels()})
        for (const bool cut_first : {false, true}) {
            const PartJob job = job_of(test::voxel_surface(voxels, 4));
            MesherCall call;
            call.options.size = SizeField(1e-2);
            call.cut_first = cut_first;
            const PartResult result = run_part_job(job, call, folder.file("part"));
            if (cut_first && result.code == static_cast<int>(ErrorCode::subdomain)) continue;  // no contour
            ASSERT_EQ(result.code, 0) << result.message;
            cut += cut_first;
            EXPECT_TRUE(result.laws.hold());
            EXPECT_NEAR(result.laws.volume, static_cast<double>(voxels.size()), 1e-9);
            EXPECT_EQ(result.vertices - result.interior_vertices, static_cast<std::int64_t>(job.boundary_id.size()));
        }
    EXPECT_GE(cut, 3);
}

// A part file holds all that the store does with what the job says.
TEST(PartJob, IsStoredAgainAsItWasFromItsPartFile) {
    const test::TemporaryFolder folder;
    MesherCall call;
    call.options.size = SizeField(1e-2);
    PartJob job = job_of(test::box());
    job.patch_names = {"a", "b"};
    for (std::size_t v = 0; v < job.boundary_id.size(); ++v) job.boundary_id[v] = static_cast<std::int64_t>(v * v);
    job.neighbour[1] = NodeId(7);
    job.surface.facet_key[1] = make_key(NodeId(3), 5);
    job.surface.patch[1] = -1;
    job.shared = {{{root_node, NodeId(7)}, {0, 1, 2}}};
    job.shared_edges = {{{root_node, NodeId(7)}, {{0, 1}}}};
    const std::string stored = folder.file("part"), again = folder.file("again"), vtu = folder.file("vtu");
    const PartResult result = run_part_job(job, call, stored);
    ASSERT_EQ(result.code, 0) << result.message;
    write_part(vtu, read_stored_part(stored, 1000), {{}, 1});
    restore_stored_part(again, vtu, job);
    EXPECT_EQ(read_file(again), read_file(stored));

    Part of_order_2 = read_stored_part(stored, 1000);
    of_order_2.edge_nodes.edges = EdgeTable(of_order_2.mesh.tets, of_order_2.mesh.vertices.size());
    of_order_2.edge_nodes.points.assign(of_order_2.edge_nodes.edges.size(), Vec3(1, 2, 3));
    of_order_2.edge_nodes.global_id.assign(of_order_2.edge_nodes.edges.size(), 77);
    write_part(vtu, of_order_2);
    std::filesystem::remove(again);
    restore_stored_part(again, vtu, job);
    EXPECT_EQ(read_file(again), read_file(stored));

    std::filesystem::remove(again);
    std::filesystem::resize_file(vtu, std::filesystem::file_size(vtu) - 1);
    for (const std::string& lost : {vtu, folder.file("missing")}) {
        restore_stored_part(again, lost, job);
        EXPECT_FALSE(std::filesystem::exists(again));
    }
}

// Each edge with an end inside counts once, by the definition.
TEST(SizeRatios, CountEveryEdgeOnce) {
    std::mt19937 random(11);
    for (const int vertices : {4, 7, 30, 400})
        for (const int count : {1, 20, 3000}) {
            TetMesh mesh;
            for (int v = 0; v < vertices; ++v) mesh.vertices.emplace_back(v, std::sqrt(v), random() % 5);
            mesh.boundary_vertex_count = vertices / 2;
            std::set<UndirectedEdge> edges;
            std::vector<std::int32_t> numbers(mesh.vertices.size());
            std::iota(numbers.begin(), numbers.end(), 0);
            for (int t = 0; t < count; ++t) {
                for (std::size_t i = 0; i < 4; ++i) std::swap(numbers[i], numbers[i + random() % (numbers.size() - i)]);
                const Tetrahedron& tet =
                    mesh.tets.emplace_back(Tetrahedron{numbers[0], numbers[1], numbers[2], numbers[3]});
                for (std::size_t i = 0; i < 4; ++i)
                    for (std::size_t j = 0; j < i; ++j)
                        if (std::max(tet[i], tet[j]) >= mesh.boundary_vertex_count)
                            edges.insert(undirected(tet[i], tet[j]));
            }
            const SizeRatios ratios = measure_sizes(mesh, {}, SizeField(1));
            EXPECT_EQ(ratios.inside.count(), static_cast<std::int64_t>(edges.size())) << vertices << ", " << count;
        }
}

TEST(SizeRatios, CellsAreCountedInEachSolid) {
    TetMesh mesh;
    for (std::int32_t v = 0; v < 40; ++v) mesh.vertices.emplace_back(v, v % 2, v % 3);
    for (std::int32_t v = 0; v + 3 < 40; ++v) mesh.tets.push_back({v, v + 1, v + 2, v + 3});
    SizeSources sources;
    sources.growth = 0.3;
    sources.spheres.push_back({Vec3(20, 0, 0), 1e-3, 0.1});
    sources.boxes.push_back({Vec3(-1, -1, -1), Vec3(11, 4, 4), 0.5});
    const SizeField field(0, sources);
    EXPECT_EQ(field.solids(), (std::vector<std::string>{"box:-1,-1,-1,11,4,4", "sphere:20,0,0,0.001"}));
    SizeRatios ratios = measure_sizes(mesh, {}, field);
    EXPECT_EQ(ratios.cells_in_solids, (std::vector<std::int64_t>{10, 0})) << "centroids at 1.5, 2.5, ..., 10.5";
    ratios.add(ratios);
    EXPECT_EQ(ratios.cells_in_solids, (std::vector<std::int64_t>{20, 0}));
}

// A sample tells of a large mesh what all edges would. Those of a chain of cells are 1, 2 and 3 long.
TEST(SizeRatios, AreSampledOfLargeMeshes) {
    for (const std::int32_t vertices : {300'000, 600'000}) {
        TetMesh mesh;
        for (std::int32_t v = 0; v < vertices; ++v) mesh.vertices.emplace_back(v, 0, 0);
        for (std::int32_t v = 0; v + 3 < vertices; ++v) mesh.tets.push_back({v, v + 1, v + 2, v + 3});
        const SizeRatios ratios = measure_sizes(mesh, {}, SizeField(largest_volume_for(1.5)));
        EXPECT_NEAR(static_cast<double>(ratios.inside.count()), 3.0 * vertices, 0.001 * vertices);
        EXPECT_NEAR(ratios.inside.share_obeyed(), 1.0 / 3, 1e-3);
    }
}

// What a limit of time has shaped is not taken over by who has another one; everything else is by everybody.
TEST(Journal, FindsAPartThatNoOtherTimeLimitHasShaped) {
    const test::TemporaryFolder folder;
    const std::string part = folder.file("part"), journal = folder.file("1");
    PartOutcome outcome;
    outcome.result = run_part_job(job_of(test::box()), {}, part);
    const FileHash job = {3, 4}, other = {3, 5};
    EXPECT_FALSE(find_finished_part(journal, part, job, 0));
    for (const double shaped_by : {0.0, 5.0})
        for (const double limit : {0.0, 4.0, 5.0, 600.0}) {
            SCOPED_TRACE(testing::Message() << shaped_by << ", " << limit);
            outcome.timed_out = shaped_by > 0;
            write_journal_entry(journal, {job, shaped_by, outcome});
            const auto found = find_finished_part(journal, part, job, limit);
            EXPECT_EQ(found.has_value(), shaped_by == 0 || limit == shaped_by);
            EXPECT_TRUE(!found || found->timed_out == outcome.timed_out);
            EXPECT_FALSE(find_finished_part(journal, part, other, limit));
        }
}

// Boxes that touch in a point: TetGen returns tetrahedra, but not with these facets. A mesh that is thrown away must
// not be counted.
TEST(PartJob, HasNoTetrahedraWhenTheLawsAreBroken) {
    const test::TemporaryFolder folder;
    const Soup touching = test::join(test::box(), test::translated(test::box(), Vec3::Ones()));
    const PartResult result = run_part_job(job_of(touching), {}, folder.file("part"));
    EXPECT_EQ(result.code, static_cast<int>(ErrorCode::subdomain));
    EXPECT_FALSE(result.laws.hold());
    EXPECT_EQ(result.tets, 0);
    EXPECT_EQ(result.vertices, 0);
    EXPECT_EQ(result.interior_vertices, 0);
}

// A body as thin as rounding has no other cell than itself.
TEST(PartJob, HasNoTetrahedraWhereOneHasNoVolume) {
    const test::TemporaryFolder folder;
    const unsigned seed = 1;
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.1, 0.9);
    MesherCall call;
    call.options.radius_edge = 0;
    int bodies = 0;
    for (int i = 0; i < 1000; ++i) {
        Soup soup = test::tetrahedron();
        for (Vec3& p : soup.vertices) p = Vec3(share(random), share(random), share(random));
        std::vector<Vec3>& p = soup.vertices;
        p[3] = p[0] + share(random) * (p[1] - p[0]) + share(random) * (p[2] - p[0]);
        if (orientation(p[0], p[1], p[2], p[3]) <= 0 || has_volume_in_any_order(p[0], p[1], p[2], p[3])) continue;
        const PartResult result = run_part_job(job_of(soup), call, folder.file("part"));
        EXPECT_EQ(result.code, static_cast<int>(ErrorCode::subdomain));
        EXPECT_EQ(result.tets, 0);
        bodies += result.message.find("1 tetrahedron has no volume but for rounding") != std::string::npos;
    }
    EXPECT_GT(bodies, 20);
}

// What a filling says of its recovery comes back from the worker, and from a part in two halves the sum: each half has
// facets on faces that many Delaunay triangulations of cospherical points share.
TEST(PartJob, CountsTheFacetsThatWereRecovered) {
    const test::TemporaryFolder folder;
    MesherCall whole, in_two;
    in_two.cut_first = true;
    const Soup soup = test::uv_sphere(12, 17);
    const FacetRecoveryCounts of_whole = mesh_volume(test::to_arrays(soup), whole.options).recovery;
    const PartResult result = run_part_job(job_of(soup), whole, folder.file("whole"));
    const PartResult halves = run_part_job(job_of(soup), in_two, folder.file("halves"));
    ASSERT_EQ(result.code + halves.code, 0) << result.message << halves.message;
    EXPECT_EQ(to_bytes(result.recovery), to_bytes(of_whole));
    for (const PartResult& found : {result, halves}) {
        EXPECT_GT(found.recovery.missing, 0);
        EXPECT_LE(found.recovery.by_flips + found.recovery.split, found.recovery.missing);
        EXPECT_EQ(to_bytes(from_bytes<PartResult>(to_bytes(found)).recovery), to_bytes(found.recovery));
    }
}

// The sums are those of parts that were filled, and TetGen is named where it was not asked for.
TEST(ReportOfParts, AddsUpWaysAndRecoveries) {
    const test::TemporaryFolder folder;
    RunReport report;
    report.input.path = "box.stl";
    report.input.volume = 1;
    report.request.workers.count = 1;
    report.mesh.quality = run_part_job(job_of(test::box()), {}, folder.file("part")).quality;
    report.parts.resize(6);
    const auto set = [&](std::size_t i, const char* mesher, const std::string& strategy,
                         const FacetRecoveryCounts& recovery) {
        PartReport& part = report.parts[i];
        part.id = NodeId(8 + i);
        part.result.mesher = mesher;
        part.result.strategy = strategy;
        part.result.recovery = recovery;
    };
    set(0, "lattice", "core and shell", {7, 4, 3, 2});
    set(1, "lattice", "core and shell", {1, 1, 0, 0});
    set(2, "lattice", std::string(way_by_tetgen), {});
    set(3, "lattice", "shell alone, " + std::string(way_by_tetgen), {1, 1, 0, 0});
    set(4, "tetgen", "", {});
    set(5, "lattice", "", {});
    report.parts[2].result.reason = "1 of 9 facets is lost.";
    report.parts[3].result.reason = "It hangs.";
    report.parts[4].failures = {"Out of luck."};
    report.parts[5].result.code = 4;
    add_up_parts(report);
    const nlohmann::json totals = nlohmann::json::parse(to_json(report)).at("totals");
    EXPECT_EQ(totals.at("parts_by_way"), (nlohmann::json{{"core and shell", 2},
                                                         {std::string(way_by_tetgen), 1},
                                                         {"shell alone, " + std::string(way_by_tetgen), 1},
                                                         {"tetgen", 1}}));
    EXPECT_EQ(totals.at("parts_by_tetgen"), 3);
    EXPECT_EQ(totals.at("recovery"),
              (nlohmann::json{{"missing", 9}, {"by_flips", 6}, {"split", 3}, {"added_vertices", 2}}));
    const std::string text = to_text(report, ReportDetail::brief);
    EXPECT_NE(text.find("has filled 3 of 6 parts"), std::string::npos) << text;
    EXPECT_NE(text.find("part 10: 1 of 9 facets is lost; part 11: It hangs; part 12: Out of luck\n"),
              std::string::npos);
    EXPECT_NE(
        to_text(report).find("9 facets that were not Delaunay: 6 by flips, 3 split for a while; 2 vertices added"),
        std::string::npos);
    report.request.mesher.name = "tetgen";
    EXPECT_EQ(to_text(report, ReportDetail::brief).find("TetGen"), std::string::npos);
}

// A part that has not been meshed goes to the mesher that was asked for.
TEST(ReportOfParts, SaysWhichMesherFilledEachAndWhichWayItWent) {
    const test::TemporaryFolder folder;
    RunReport report;
    report.input.path = "box.stl";
    report.parts.resize(3);
    MesherCall tetgen;
    tetgen.options.name = "tetgen";
    report.parts[1].result = run_part_job(job_of(test::box()), tetgen, folder.file("part"));
    report.parts[2].result.mesher = "another";
    report.parts[2].result.strategy = "by a detour";
    report.parts[2].result.core_tets = 5;
    const nlohmann::json parts = nlohmann::json::parse(to_json(report)).at("parts");
    EXPECT_EQ(parts[0].at("mesher"), report.request.mesher.name);
    EXPECT_EQ(parts[1].at("mesher"), "tetgen");
    for (const int i : {0, 1}) {
        EXPECT_FALSE(parts[i].contains("way"));
        EXPECT_FALSE(parts[i].contains("core_tets"));
    }
    EXPECT_EQ(parts[2].at("mesher"), "another");
    EXPECT_EQ(parts[2].at("way"), "by a detour");
    EXPECT_EQ(parts[2].at("core_tets"), 5);
    const PartResult copy = from_bytes<PartReport>(to_bytes(report.parts[2])).result;
    EXPECT_EQ(copy.strategy, "by a detour");
    EXPECT_EQ(copy.core_tets, 5);
}

// The command of tetgen has a bound of the volume where one says it all, else the file says what it lacks.
TEST(FailedPart, IsKeptWithTheCommandThatRepeatsIt) {
    const test::TemporaryFolder folder;
    const SurfaceArrays surface = test::to_arrays(test::box());
    const auto told = [&](const SizeField& size) {
        MesherOptions mesher;
        mesher.name = "tetgen";
        mesher.size = size;
        write_failed_part(folder.file("failed"), NodeId(3), surface, mesher, "It hangs.");
        return test::bytes_of_file(folder.file("failed/part_0003.txt"));
    };
    const auto has = [](const std::string& text, const char* words) { return text.find(words) != std::string::npos; };
    SizeSources sphere;
    sphere.spheres.push_back({Vec3::Zero(), 0.1, 0.01});
    const std::string plain = told(SizeField()), constant = told(SizeField(0.5)),
                      varying = told(SizeField(0.5, sphere));
    EXPECT_TRUE(has(plain, "It hangs.") && has(plain, "part_0003.smesh") && !has(plain, "a0.5"));
    EXPECT_TRUE(has(constant, "a0.5 part_0003.smesh") && !has(constant, "leaves them out"));
    EXPECT_TRUE(!has(varying, "a0.5") && has(varying, "leaves them out"));
    EXPECT_TRUE(has(plain, "paraview ../parts/part_0003.surface.vtu"));
    write_failed_part(folder.file("failed"), NodeId(4123), surface, {}, "It hangs.");
    EXPECT_TRUE(has(test::bytes_of_file(folder.file("failed/4000/part_4123.txt")),
                    "paraview ../../parts/4000/part_4123.surface.vtu"));
}

}  // namespace
}  // namespace kerf

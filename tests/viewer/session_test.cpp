// What the session says of surfaces, traces and runs, against what the kernel says.
#include "viewer/model/session.h"

#include <sys/stat.h>

#include <cmath>
#include <cstring>
#include <map>

#include <gtest/gtest.h>

#include "fill/mesh/quality.h"
#include "run/report/event_log.h"
#include "run/work/journal.h"
#include "support/assets.h"
#include "support/places.h"
#include "support/program.h"
#include "support/shapes.h"
#include "support/stamped_part.h"
#include "support/started_run.h"
#include "support/temporary_folder.h"
#include "support/trace_options.h"
#include "support/write_off.h"
#include "surface/complex/mass_properties.h"
#include "viewer/model/file_kind.h"
#include "viewer/model/inside/loader.h"
#include "viewer/model/inside/node_surface.h"
#include "viewer/model/inside/part_files.h"
#include "viewer/model/inside/replayer.h"
#include "viewer/model/inside/run_events.h"
#include "viewer/model/inside/run_process.h"
#include "viewer/model/inside/store.h"

namespace kerf::view {
namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;

// Polls until the condition holds, at most 60 s.
template <class Condition>
bool reach(Session& session, Condition condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        session.wait(0.1);
    }
    return true;
}

bool settle(Session& session) {
    return reach(session, [&] { return !session.busy() && !session.pending(); });
}

// Asks until it is there.
template <class Ask>
auto get(Session& session, Ask ask) {
    auto result = ask();
    reach(session, [&] {
        result = ask();
        return result || (!session.pending() && !session.busy());
    });
    return result;
}

std::string failures_of(const Session& session) {
    std::string all;
    for (const std::string& failure : session.failures()) all += failure + "\n";
    return all;
}

double volume_of(const NodeSurface& surface) { return enclosed_volume(surface.vertices, surface.facets); }

// Each edge once in either direction.
bool is_closed(const NodeSurface& surface) {
    return find_manifold_defects(surface.vertices.size(), surface.facets).empty();
}

std::vector<std::string> scratch_folders() {
    std::vector<std::string> names;
    const std::string prefix = "kerf-view-" + std::to_string(::getpid()) + "-";
    for (const auto& entry : fs::directory_iterator(fs::temp_directory_path()))
        if (entry.path().filename().string().starts_with(prefix)) names.push_back(entry.path());
    return names;
}

class SessionTest : public testing::Test {
 protected:
    void open(const std::string& path) {
        session_.open(path);
        ASSERT_TRUE(settle(session_));
    }
    const Document& document() const { return session_.document(); }
    RunRequest options(std::int32_t parts) const {
        RunRequest options;
        options.parts = parts;
        options.workers.count = 2;
        return options;
    }
    // Runs kerf to its end.
    void run(const std::string& asset, std::vector<std::string> more) const {
        std::vector<std::string> arguments = {
            "mesh", test::asset_path(asset), "-o", folder_.file("run"), "--workers", "2", "-q"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ChildResult result = test::run_kerf(arguments);
        ASSERT_EQ(result.exit_code, 0) << result.log;
    }

    test::TemporaryFolder folder_;
    Session session_{test::kerf_program()};
};

// --- surfaces ---

TEST_F(SessionTest, OpensASurfaceAndChecksIt) {
    session_.open(test::asset_path("cube"));
    EXPECT_TRUE(session_.busy());
    EXPECT_TRUE(session_.pending());
    EXPECT_EQ(document().title, "cube.stl");
    ASSERT_TRUE(reach(session_, [&] { return document().soup != nullptr; }));
    EXPECT_TRUE(session_.fetched().surface(root_node)) << "the first picture does not wait for the check";
    EXPECT_EQ(document().kind, Document::Kind::surface);
    EXPECT_EQ(document().error, "");
    EXPECT_NEAR(document().box.diagonal().norm(), std::sqrt(3.0), 1e-6);
    EXPECT_EQ(document().input_facets, 4660);
    ASSERT_TRUE(settle(session_));
    ASSERT_TRUE(document().checked);
    EXPECT_TRUE(document().checked->diagnosis.clean());
    EXPECT_FALSE(document().has_problems());
    EXPECT_NEAR(document().volume, 1, 1e-6);
    ASSERT_EQ(document().tree.rows.size(), 1u);
    ASSERT_TRUE(document().tree.rows[0].centroid);
    EXPECT_LT((*document().tree.rows[0].centroid - document().box.center()).norm(), 0.1);

    const auto surface = get(session_, [&] { return session_.fetched().surface(root_node); });
    ASSERT_TRUE(surface);
    EXPECT_EQ(surface->facets, document().soup->facets);
    EXPECT_EQ(surface->vertices, document().soup->vertices);
    EXPECT_EQ(session_.fetched().surface(NodeId(2)), nullptr);
    EXPECT_EQ(session_.fetched().cells(root_node), nullptr);
    EXPECT_EQ(failures_of(session_), "");
    EXPECT_FALSE(session_.poll());
}

TEST_F(SessionTest, SaysWhyAFileCannotBeOpened) {
    const std::string bad = folder_.file("bad.stl");
    std::ofstream(bad) << "this is no surface";
    for (const std::string& path : {bad, folder_.file("missing.stl"), folder_.file("."), std::string()}) {
        SCOPED_TRACE(path);
        open(path);
        EXPECT_EQ(document().kind, Document::Kind::none);
        EXPECT_NE(document().error, "");
        EXPECT_TRUE(document().has_problems());
        EXPECT_FALSE(document().soup);
        session_.start_run({}, true);
        EXPECT_FALSE(document().progress.running);
        EXPECT_NE(document().progress.message, "");
    }
    open(test::asset_path("cube"));
    EXPECT_EQ(document().error, "");
    session_.close();
    EXPECT_EQ(document().kind, Document::Kind::none);
    EXPECT_EQ(session_.fetched().surface(root_node), nullptr);
}

TEST_F(SessionTest, ShowsASurfaceWithDefects) {
    Soup soup = test::box();
    soup.facets.pop_back();
    test::write_off(folder_.file("open.off"), soup.vertices, soup.facets);
    open(folder_.file("open.off"));
    EXPECT_TRUE(document().soup);
    ASSERT_TRUE(document().checked);
    EXPECT_FALSE(document().checked->diagnosis.clean());
    EXPECT_TRUE(document().has_problems());
    EXPECT_EQ(document().error, "");
    EXPECT_TRUE(get(session_, [&] { return session_.fetched().surface(root_node); }));

    session_.start_run(options(2), true);
    ASSERT_TRUE(settle(session_));
    EXPECT_NE(document().progress.message.find("open"), std::string::npos) << document().progress.message;
    EXPECT_TRUE(document().folder.empty());
}

TEST_F(SessionTest, OpeningAnotherFileForgetsTheFirst) {
    for (int i = 0; i < 5; ++i) {
        session_.open(test::asset_path("knee_femoral"));
        session_.wait(0.02 * i);
        session_.open(test::asset_path("hollow_box"));
        ASSERT_TRUE(settle(session_));
        EXPECT_EQ(document().input_facets, 3786);
        EXPECT_EQ(document().checked->soup.facets.size(), 3786u);
        session_.reload();
        ASSERT_TRUE(settle(session_));
        EXPECT_EQ(document().title, "hollow_box.stl");
    }
    EXPECT_EQ(failures_of(session_), "");
}

// --- runs of its own ---

class OwnRun : public SessionTest {
 protected:
    void start(const std::string& asset, const RunRequest& options, bool volume) {
        open(test::asset_path(asset));
        session_.start_run(options, volume);
        ASSERT_TRUE(document().progress.running) << document().progress.message;
        EXPECT_TRUE(document().progress.ours);
        EXPECT_TRUE(session_.busy());
    }
    void finish() {
        ASSERT_TRUE(settle(session_));
        EXPECT_EQ(document().progress.message, "");
        EXPECT_FALSE(document().progress.running);
        EXPECT_EQ(failures_of(session_), "");
    }
};

TEST_F(OwnRun, FillsTheDocumentAsItGoes) {
    start("hollow_box", options(4), true);
    ASSERT_TRUE(reach(session_, [&] { return document().trace != nullptr; }));
    EXPECT_EQ(document().tree.rows.size(), 7u);
    EXPECT_EQ(document().tree.parts_below(root_node),
              (std::vector<NodeId>{NodeId(4), NodeId(5), NodeId(6), NodeId(7)}));
    finish();
    const Document& d = document();
    EXPECT_EQ(d.kind, Document::Kind::surface);
    ASSERT_TRUE(d.trace);
    EXPECT_TRUE(fs::exists(d.folder + "/report.json"));
    EXPECT_EQ(d.tree.rows.size(), 7u);
    EXPECT_EQ(d.tree.levels(), 3);
    EXPECT_EQ(d.options.parts, 4);
    EXPECT_TRUE(d.options.output.empty());
    EXPECT_EQ(d.progress.parts_done, 4);
    for (const TreeRow& row : d.tree.rows) {
        SCOPED_TRACE(row.id.value());
        const int level = level_of(row.id);
        EXPECT_EQ(row.state, level < 2 ? NodeState::divided : NodeState::done);
        EXPECT_EQ(row.plane() != nullptr, level < 2);
        EXPECT_EQ(row.tets > 0, level == 2);
        EXPECT_GT(row.facets, 0);
        EXPECT_GT(row.volume, 0);
        EXPECT_TRUE(row.centroid);
        EXPECT_EQ(row.leaves, 4 >> level);
    }
    for (const auto& histogram : d.histograms) {
        ASSERT_TRUE(histogram);
        EXPECT_EQ(histogram->edges.size(), histogram->all.size() + 1);
        std::int64_t all = 0, both = 0, tets = 0;
        for (std::size_t i = 0; i < histogram->all.size(); ++i) {
            all += histogram->all[i];
            both += histogram->interface[i] + histogram->interior[i];
        }
        for (const NodeId part : d.tree.parts_below(root_node)) tets += d.tree.find(part)->tets;
        EXPECT_EQ(all, tets);
        EXPECT_EQ(both, tets);
    }
    EXPECT_EQ(session_.other_document(), nullptr);
    EXPECT_EQ(scratch_folders().size(), 1u);
    session_.close();
    EXPECT_TRUE(scratch_folders().empty());
}

TEST_F(OwnRun, TheRunBeforeIsKeptForComparison) {
    start("hollow_box", options(4), true);
    finish();
    session_.start_run(options(3), true);
    finish();
    ASSERT_TRUE(session_.other_document());
    EXPECT_EQ(session_.other_document()->tree.parts_below(root_node).size(), 4u);
    EXPECT_EQ(document().tree.parts_below(root_node).size(), 3u);
    EXPECT_EQ(scratch_folders().size(), 2u);
    session_.start_run(options(1000000), true);  // too many
    ASSERT_TRUE(settle(session_));
    EXPECT_NE(document().progress.message.find("too few"), std::string::npos) << document().progress.message;
    EXPECT_EQ(document().tree.parts_below(root_node).size(), 3u);
    for (const NodeId part : document().tree.parts_below(root_node))
        EXPECT_TRUE(get(session_, [&] { return session_.fetched().cells(part); }));
}

TEST_F(OwnRun, WithoutTetrahedra) {
    RunRequest given = options(5);
    given.output = folder_.file("surfaces");
    start("pipe_with_holes", given, false);
    finish();
    EXPECT_EQ(document().folder, folder_.file("surfaces"));
    EXPECT_EQ(document().tree.parts_below(root_node).size(), 5u);
    for (const NodeId part : document().tree.parts_below(root_node)) {
        EXPECT_EQ(document().tree.find(part)->state, NodeState::waiting);
        EXPECT_TRUE(get(session_, [&] { return session_.fetched().part_surface(part); }));
        EXPECT_EQ(session_.fetched().cells(part), nullptr);
    }
    EXPECT_EQ(session_.fetched().worst_cells(ColorBy::shape, 3), nullptr);
    EXPECT_FALSE(document().histograms[0]);
}

TEST_F(OwnRun, CanBeCancelled) {
    RunRequest fine = options(6);
    fine.sizes.size = 0.8;
    fine.workers.count = 1;
    fine.output = folder_.file("fine");
    start("bearing_cap_52k", fine, true);
    ASSERT_TRUE(reach(session_, [&] { return document().progress.stage == "volume"; }));
    ASSERT_TRUE(reach(session_, [&] {
        for (const TreeRow& row : document().tree.rows)
            if (row.state == NodeState::meshing) return true;
        return false;
    }));
    session_.cancel_run();
    ASSERT_TRUE(settle(session_));
    EXPECT_FALSE(document().progress.running);
    EXPECT_FALSE(document().progress.ours);
    EXPECT_NE(document().progress.message.find("cancelled"), std::string::npos) << document().progress.message;
    EXPECT_FALSE(fs::exists(folder_.file("fine")));
    EXPECT_TRUE(document().trace);
    for (const TreeRow& row : document().tree.rows) EXPECT_NE(row.state, NodeState::meshing);
    EXPECT_TRUE(get(session_, [&] { return session_.fetched().surface(NodeId(2)); }));
    session_.cancel_run();  // there is none
}

TEST_F(OwnRun, EndsWithTheSession) {
    {
        Session session{test::kerf_program()};
        session.open(test::asset_path("bearing_cap_52k"));
        ASSERT_TRUE(settle(session));
        RunRequest fine = options(6);
        fine.sizes.size = 0.8;
        session.start_run(fine, true);
        ASSERT_TRUE(reach(session, [&] { return session.document().progress.stage == "volume"; }));
        EXPECT_EQ(scratch_folders().size(), 1u);
    }
    EXPECT_TRUE(scratch_folders().empty());
    EXPECT_TRUE(test::descendants_of(::getpid(), "kerf").empty());
}

TEST_F(OwnRun, OfATraceWhoseSurfaceIsGone) {
    const std::string copy = folder_.file("copy.stl"), trace = folder_.file("run.trace");
    fs::copy_file(test::asset_path("hollow_box"), copy);
    ASSERT_EQ(
        test::run_kerf({"decompose", copy, "-q", "-o", folder_.file("run"), "-n", "3", "--trace", trace}).exit_code, 0);
    fs::remove(copy);
    open(trace);
    EXPECT_EQ(document().kind, Document::Kind::trace);
    const std::shared_ptr<const Trace> before = document().trace;
    session_.start_run(options(4), true);
    finish();
    EXPECT_EQ(document().tree.parts_below(root_node).size(), 4u);
    EXPECT_TRUE(to_bytes(document().trace->surface) == to_bytes(before->surface));
    EXPECT_NEAR(document().volume, 22, 1e-6);
}

// --- data ---

// A run folder and its trace, opened in three ways.
class Data : public SessionTest {
 protected:
    void SetUp() override { run("knee_femoral", {"-n", "5", "--trace", folder_.file("trace")}); }
    Session by_trace_{test::kerf_program()};
    Session by_folder_{test::kerf_program()};

    void open_apart() {
        by_trace_.open(folder_.file("trace"));
        ASSERT_TRUE(settle(by_trace_));
        fs::rename(folder_.file("trace"), folder_.file("moved"));
        by_folder_.open(folder_.file("run"));
        ASSERT_TRUE(settle(by_folder_));
        ASSERT_FALSE(by_folder_.document().trace);
        ASSERT_TRUE(by_trace_.document().folder.empty());
    }
};

TEST_F(Data, SurfacesOfTraceAndFolderAgree) {
    open_apart();
    const Tree& tree = by_folder_.document().tree;
    ASSERT_EQ(tree.rows.size(), 9u);
    ASSERT_EQ(by_trace_.document().tree.rows.size(), 9u);
    EXPECT_TRUE(by_trace_.document().box.isApprox(by_folder_.document().box));
    for (const TreeRow& row : tree.rows) {
        SCOPED_TRACE(row.id.value());
        const auto a = get(by_trace_, [&] { return by_trace_.fetched().surface(row.id); });
        const auto b = get(by_folder_, [&] { return by_folder_.fetched().surface(row.id); });
        ASSERT_TRUE(a) << failures_of(by_trace_);
        ASSERT_TRUE(b) << failures_of(by_folder_);
        EXPECT_EQ(a->facets.size(), b->facets.size());
        EXPECT_EQ(a->vertices.size(), b->vertices.size());
        EXPECT_EQ(static_cast<std::int64_t>(a->facets.size()), row.facets);
        EXPECT_EQ(static_cast<std::int64_t>(a->vertices.size()), row.vertices);
        EXPECT_NEAR(volume_of(*a), row.volume, 1e-9 * row.volume);
        EXPECT_NEAR(volume_of(*b), row.volume, 1e-9 * row.volume);
        EXPECT_TRUE(is_closed(*a));
        EXPECT_TRUE(is_closed(*b));
        std::map<NodeId, int> of_a, of_b;
        for (const NodeId id : a->interface_of) ++of_a[id];
        for (const NodeId id : b->interface_of) ++of_b[id];
        EXPECT_EQ(of_a, of_b);
        std::vector<std::int32_t> numbers_a = a->facet_number, numbers_b = b->facet_number;
        std::sort(numbers_a.begin(), numbers_a.end());
        std::sort(numbers_b.begin(), numbers_b.end());
        EXPECT_EQ(numbers_a, numbers_b);
        // The rows of the trace get what the report says.
        const TreeRow* other = by_trace_.document().tree.find(row.id);
        ASSERT_TRUE(other && other->centroid && row.centroid);
        EXPECT_EQ(other->facets, row.facets);
        EXPECT_LT((*other->centroid - *row.centroid).norm(), 1e-9);
        EXPECT_LT((other->axes - row.axes).norm(), 1e-9);
        EXPECT_EQ(other->plane() != nullptr, row.plane() != nullptr);
        ASSERT_EQ(other->cut.has_value(), row.cut.has_value());
        if (row.cut) {
            EXPECT_EQ(other->cut->strategy, row.cut->strategy);
            EXPECT_EQ(other->cut->interface_faces, row.cut->interface_faces);
        }
        EXPECT_EQ(other->leaves, row.leaves);
    }
    // The facets of the input are shared out; each interface is there twice.
    std::int64_t facets = 0, interfaces = 0;
    for (const NodeId part : tree.parts_below(root_node)) facets += tree.find(part)->facets;
    for (const TreeRow& row : tree.rows) interfaces += row.leaf() ? 0 : row.cut->interface_faces;
    EXPECT_EQ(facets, by_folder_.document().input_facets + 2 * interfaces);
}

// Interfaces of straight cuts are triangulated anew after the last cut, and facets of neighbours are split then.
TEST_F(SessionTest, SurfacesOfStraightCutsAreClosed) {
    const Soup soup = test::prism(7, 1, 5);
    test::write_off(folder_.file("prism.off"), soup.vertices, soup.facets);
    open(folder_.file("prism.off"));
    RunRequest as_it_is = options(6);
    as_it_is.remeshing = Remeshing::never;
    session_.start_run(as_it_is, true);
    ASSERT_TRUE(settle(session_));
    ASSERT_TRUE(document().trace) << document().progress.message;
    ASSERT_EQ(document().tree.parts_below(root_node).size(), 6u);
    EXPECT_EQ(document().tree.find(root_node)->cut->strategy, CutStrategy::straight);
    Session folder{test::kerf_program()};
    folder.open(document().folder);
    ASSERT_TRUE(settle(folder));
    for (const TreeRow& row : document().tree.rows) {
        SCOPED_TRACE(row.id.value());
        for (Session* session : {&session_, &folder}) {
            const auto surface = get(*session, [&] { return session->fetched().surface(row.id); });
            ASSERT_TRUE(surface) << failures_of(*session);
            EXPECT_TRUE(is_closed(*surface));
            EXPECT_NEAR(volume_of(*surface), row.volume, 1e-9 * document().volume);
        }
    }
}

TEST_F(Data, ATraceGivesTheNumbersThatItsCutsReferTo) {
    open_apart();
    const Trace& trace = *by_trace_.document().trace;
    Replayer replayer(by_trace_.document().trace, 0);
    for (const TreeRow& row : by_trace_.document().tree.rows) {
        const Surface expected = replay(trace, row.id);
        EXPECT_TRUE(to_bytes(replayer.surface(row.id)->arrays()) == to_bytes(expected.arrays())) << row.id.value();
        const auto surface = get(by_trace_, [&] { return by_trace_.fetched().surface(row.id); });
        EXPECT_EQ(surface->vertices, expected.arrays().vertices);
        EXPECT_EQ(surface->facets, expected.arrays().facets);
    }
}

TEST_F(Data, PartsHaveTheirSurfacesAndCells) {
    open_apart();
    for (const NodeId part : by_folder_.document().tree.parts_below(root_node)) {
        SCOPED_TRACE(part.value());
        const TreeRow& row = *by_folder_.document().tree.find(part);
        const auto surface = get(by_folder_, [&] { return by_folder_.fetched().part_surface(part); });
        const auto cells = get(by_folder_, [&] { return by_folder_.fetched().cells(part); });
        ASSERT_TRUE(surface && cells) << failures_of(by_folder_);
        EXPECT_EQ(static_cast<std::int64_t>(surface->facets.size()), row.facets);
        EXPECT_EQ(static_cast<std::int64_t>(cells->tets.size()), row.tets);
        EXPECT_EQ(cells->part, part);
        EXPECT_EQ(static_cast<std::size_t>(cells->boundary_vertex_count), surface->vertices.size());
        EXPECT_EQ(cells->tet_at_facet.size(), surface->facets.size());
        EXPECT_TRUE(std::equal(surface->vertices.begin(), surface->vertices.end(), cells->vertices.begin()));
        EXPECT_TRUE(
            std::equal(surface->vertex_number.begin(), surface->vertex_number.end(), cells->vertex_number.begin()));
        double volume = 0;
        for (const auto& [a, b, c, d] : cells->tets)
            volume +=
                tet_quality(cells->vertices[a], cells->vertices[b], cells->vertices[c], cells->vertices[d]).volume;
        EXPECT_NEAR(volume, row.volume, 1e-9 * row.volume);
        for (std::size_t f = 0; f < surface->facets.size(); ++f) {
            EXPECT_EQ(surface->neighbour[f].is_valid(), surface->interface_of[f] != no_node);
            const auto& tet = cells->tets.at(static_cast<std::size_t>(cells->tet_at_facet[f]));
            for (const std::int32_t v : surface->facets[f])
                EXPECT_TRUE(std::find(tet.begin(), tet.end(), v) != tet.end());
            if (surface->neighbour[f].is_valid()) {
                EXPECT_TRUE(cells->at_interface[static_cast<std::size_t>(cells->tet_at_facet[f])]);
                EXPECT_TRUE(lies_below(part, surface->interface_of[f]));
                EXPECT_TRUE(lies_below(surface->neighbour[f], surface->interface_of[f]));
            }
        }
    }
    EXPECT_EQ(by_folder_.fetched().cells(root_node), nullptr);
    EXPECT_EQ(by_folder_.fetched().part_surface(NodeId(2)), nullptr);
    EXPECT_FALSE(by_folder_.pending());
}

float measured(const PartCells& cells, std::size_t i, ColorBy color) {
    const auto& [a, b, c, d] = cells.tets[i];
    const TetQuality q = tet_quality(cells.vertices[a], cells.vertices[b], cells.vertices[c], cells.vertices[d]);
    switch (color) {
        case ColorBy::min_dihedral:
            return static_cast<float>(q.min_dihedral_deg);
        case ColorBy::radius_edge:
            return static_cast<float>(q.radius_edge);
        case ColorBy::aspect:
            return static_cast<float>(q.aspect);
        case ColorBy::shape:
            return static_cast<float>(q.shape);
        case ColorBy::volume:
            return static_cast<float>(q.volume);
        case ColorBy::edge_length:
            return static_cast<float>(q.max_edge);
        case ColorBy::origin:
            return static_cast<float>(CellOrigin::other);
        default:
            return static_cast<float>(cells.at_interface[i]);
    }
}

TEST_F(Data, ValuesAreThoseOfTheCells) {
    by_folder_.open(folder_.file("run"));
    ASSERT_TRUE(settle(by_folder_));
    ASSERT_TRUE(by_folder_.document().trace) << "the report says where the trace is";
    const std::vector<NodeId> parts = by_folder_.document().tree.parts_below(root_node);
    for (const ColorBy color : {ColorBy::kind, ColorBy::origin, ColorBy::min_dihedral, ColorBy::radius_edge,
                                ColorBy::aspect, ColorBy::shape, ColorBy::volume, ColorBy::edge_length}) {
        SCOPED_TRACE(name(color));
        std::vector<WorstCell> all;
        for (const NodeId part : parts) {
            const auto values = get(by_folder_, [&] { return by_folder_.fetched().cell_values(part, color); });
            const auto at_facets = get(by_folder_, [&] { return by_folder_.fetched().facet_values(part, color); });
            const auto cells = get(by_folder_, [&] { return by_folder_.fetched().cells(part); });
            ASSERT_TRUE(values && at_facets && cells) << failures_of(by_folder_);
            ASSERT_EQ(values->size(), cells->tets.size());
            for (std::size_t i = 0; i < values->size(); ++i) {
                ASSERT_EQ((*values)[i], measured(*cells, i, color)) << i;
                const auto& p = cells->vertices;
                const auto& [a, b, c, d] = cells->tets[i];
                all.push_back({part, static_cast<std::int32_t>(i), (*values)[i], (p[a] + p[b] + p[c] + p[d]) / 4});
            }
            ASSERT_EQ(at_facets->size(), cells->tet_at_facet.size());
            for (std::size_t f = 0; f < at_facets->size(); ++f)
                ASSERT_EQ((*at_facets)[f], (*values)[static_cast<std::size_t>(cells->tet_at_facet[f])]);
        }
        if (is_kind(color)) {
            EXPECT_EQ(by_folder_.fetched().worst_cells(color, 10), nullptr);
            continue;
        }
        const bool small = color == ColorBy::min_dihedral || color == ColorBy::shape;
        std::stable_sort(all.begin(), all.end(), [&](const WorstCell& a, const WorstCell& b) {
            return small ? a.value < b.value : a.value > b.value;
        });
        for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{100}, all.size() + 1}) {
            const auto worst = get(by_folder_, [&] { return by_folder_.fetched().worst_cells(color, count); });
            ASSERT_TRUE(worst) << failures_of(by_folder_);
            ASSERT_EQ(worst->size(), std::min(count, all.size()));
            for (std::size_t i = 0; i < worst->size(); ++i) {
                ASSERT_EQ((*worst)[i].value, all[i].value);
                ASSERT_EQ((*worst)[i].part, all[i].part);
                ASSERT_EQ((*worst)[i].cell, all[i].cell);
                ASSERT_LT(((*worst)[i].center - all[i].center).norm(), 1e-9);
            }
        }
    }
}

TEST_F(SessionTest, CellsAreOfTheCoreTheShellOrAnotherMesher) {
    constexpr std::int64_t core_tets = 100;
    run("hollow_box", {"-n", "2", "--mesher", "tetgen"});
    test::stamp_first_part(folder_.file("run"), core_tets);
    open(folder_.file("run"));
    const auto check = [&](NodeId part, const std::vector<float>& origins, const PartCells& cells) {
        for (std::size_t i = 0; i < origins.size(); ++i) {
            const CellOrigin expected = part == NodeId(3)                 ? CellOrigin::other
                                        : static_cast<int>(i) < core_tets ? CellOrigin::core
                                                                          : CellOrigin::shell;
            ASSERT_EQ(origins[i], static_cast<float>(expected)) << i;
        }
        const auto at_facets = get(session_, [&] { return session_.fetched().facet_values(part, ColorBy::origin); });
        ASSERT_TRUE(at_facets);
        for (std::size_t f = 0; f < at_facets->size(); ++f)
            ASSERT_EQ((*at_facets)[f], origins[static_cast<std::size_t>(cells.tet_at_facet[f])]);
    };
    for (const NodeId part : {NodeId(2), NodeId(3)}) {
        SCOPED_TRACE(part.value());
        // Without the cells, and with them.
        const auto origins = get(session_, [&] { return session_.fetched().cell_values(part, ColorBy::origin); });
        const auto cells = get(session_, [&] { return session_.fetched().cells(part); });
        ASSERT_TRUE(origins && cells) << failures_of(session_);
        EXPECT_EQ(*origins, values_of_cells(*cells, ColorBy::origin));
        ASSERT_EQ(origins->size(), cells->tets.size());
        check(part, *origins, *cells);
    }
    EXPECT_EQ(document().tree.find(NodeId(2))->filled_by, "core and shell");
    EXPECT_EQ(document().tree.find(NodeId(3))->filled_by, "TetGen");
}

TEST_F(Data, WhatCannotBeReadIsSaidOnce) {
    open_apart();
    const NodeId part = by_folder_.document().tree.parts_below(root_node).front();
    fs::resize_file(part_file_of(folder_.file("run"), part), 1000);
    EXPECT_EQ(get(by_folder_, [&] { return by_folder_.fetched().cells(part); }), nullptr);
    EXPECT_EQ(get(by_folder_, [&] { return by_folder_.fetched().cells(part); }), nullptr);
    ASSERT_EQ(by_folder_.failures().size(), 1u);
    EXPECT_NE(by_folder_.failures()[0].find("part_"), std::string::npos);
    EXPECT_TRUE(get(by_folder_, [&] { return by_folder_.fetched().part_surface(part); }));
}

TEST_F(Data, AnotherTraceInThePlaceOfItsOwnIsNotTaken) {
    ASSERT_EQ(test::run_kerf({"decompose", test::asset_path("knee_femoral"), "-q", "-o", folder_.file("other"), "-n",
                              "5", "--cut", "volume", "--trace", folder_.file("trace")})
                  .exit_code,
              0);
    open(folder_.file("run"));
    EXPECT_FALSE(document().trace);
    EXPECT_EQ(document().tree.rows.size(), 9u);
}

// --- cuts made again ---

Bytes without_time(Cut cut) {
    cut.seconds = 0;
    return to_bytes(cut);
}

TEST_F(Data, ACutMadeAgainWithTheSameOptionsIsTheSame) {
    by_folder_.open(folder_.file("run"));
    ASSERT_TRUE(settle(by_folder_));
    const std::shared_ptr<const Trace> old = by_folder_.document().trace;
    ASSERT_TRUE(old);
    EXPECT_EQ(by_folder_.other_document(), nullptr);
    by_folder_.pair().redo_cut(NodeId(2), test::request_of(*old));
    by_folder_.pair().redo_cut(root_node, test::request_of(*old));
    ASSERT_TRUE(settle(by_folder_));
    EXPECT_EQ(failures_of(by_folder_), "");
    const Document& d = by_folder_.document();
    EXPECT_NE(d.trace, old);
    ASSERT_TRUE(d.trace->find(root_node));
    EXPECT_TRUE(without_time(*d.trace->find(root_node)) == without_time(*old->find(root_node)));
    EXPECT_EQ(d.trace->cuts.size(), 1u) << "those below are gone";
    ASSERT_TRUE(by_folder_.other_document());
    EXPECT_TRUE(to_bytes(*by_folder_.other_document()->trace->find(root_node)) == to_bytes(*old->find(root_node)));
    EXPECT_EQ(d.tree.parts_below(root_node), (std::vector<NodeId>{NodeId(2), NodeId(3)}));
    EXPECT_EQ(d.tree.find(root_node)->leaves, 2);
    EXPECT_EQ(by_folder_.fetched().cells(NodeId(4)), nullptr);
    EXPECT_EQ(by_folder_.fetched().cells(NodeId(2)), nullptr);
    EXPECT_EQ(by_folder_.fetched().part_surface(NodeId(2)), nullptr);
    const auto surface = get(by_folder_, [&] { return by_folder_.fetched().surface(NodeId(3)); });
    ASSERT_TRUE(surface);
    EXPECT_EQ(surface->facets, replay(*old, NodeId(3)).arrays().facets);
}

TEST_F(Data, ACutMadeAgainWithOtherOptionsTakesItsPlace) {
    by_folder_.open(folder_.file("run"));
    ASSERT_TRUE(settle(by_folder_));
    const std::shared_ptr<const Trace> old = by_folder_.document().trace;
    ASSERT_TRUE(old && old->find(NodeId(2)));
    const std::size_t nodes = by_folder_.document().tree.rows.size();
    RunRequest other = test::request_of(*old);
    other.cut.criterion = Criterion::volume;
    other.cut.axis = 2;
    by_folder_.pair().redo_cut(NodeId(2), other);
    ASSERT_TRUE(settle(by_folder_));
    EXPECT_EQ(failures_of(by_folder_), "");
    const Document& d = by_folder_.document();
    ASSERT_TRUE(d.trace->find(NodeId(2)) && d.trace->find(NodeId(2))->made());
    EXPECT_EQ(d.trace->find(NodeId(2))->plane.normal.cwiseAbs().z(), 1);
    EXPECT_NE(d.trace->find(NodeId(2))->plane.normal, old->find(NodeId(2))->plane.normal);
    ASSERT_TRUE(by_folder_.other_document());
    EXPECT_EQ(by_folder_.other_document()->trace, old);
    EXPECT_LE(d.tree.rows.size(), nodes);
    EXPECT_EQ(d.tree.find(NodeId(2))->plane()->normal, d.trace->find(NodeId(2))->plane.normal);
    double volume = 0;
    for (const NodeId half : {NodeId(4), NodeId(5)}) {
        const auto surface = get(by_folder_, [&] { return by_folder_.fetched().surface(half); });
        ASSERT_TRUE(surface);
        EXPECT_TRUE(is_closed(*surface));
        EXPECT_EQ(static_cast<std::int64_t>(surface->facets.size()), d.tree.find(half)->facets);
        volume += volume_of(*surface);
    }
    EXPECT_NEAR(volume, d.tree.find(NodeId(2))->volume, 1e-9 * volume);
    for (const NodeId part : d.tree.parts_below(NodeId(3)))  // the others are as they were
        EXPECT_TRUE(get(by_folder_, [&] { return by_folder_.fetched().cells(part); }));
    // A part may be cut, too, also by a straight cut.
    other.cut.contour = ContourMethod::straight;
    by_folder_.pair().redo_cut(NodeId(4), other);
    ASSERT_TRUE(settle(by_folder_));
    EXPECT_EQ(failures_of(by_folder_), "");
    ASSERT_TRUE(d.trace->find(NodeId(4)));
    EXPECT_EQ(d.trace->find(NodeId(4))->strategy, CutStrategy::straight);
    const auto split = get(by_folder_, [&] { return by_folder_.fetched().surface(NodeId(4)); });
    EXPECT_EQ(split->facets, d.trace->find(NodeId(4))->split_parent.facets);
    volume = 0;
    for (const NodeId half : {NodeId(8), NodeId(9)})
        volume += volume_of(*get(by_folder_, [&] { return by_folder_.fetched().surface(half); }));
    EXPECT_NEAR(volume, volume_of(*split), 1e-9 * volume);
}

TEST_F(SessionTest, ACutIsMadeAgainOnlyInATrace) {
    open(test::asset_path("cube"));
    session_.pair().redo_cut(root_node, {});
    ASSERT_TRUE(settle(session_));
    EXPECT_EQ(session_.failures().size(), 1u);
}

// --- runs of others ---

TEST_F(SessionTest, FollowsTheFolderOfARunUnderWay) {
    const std::string output = folder_.file("run");
    test::StartedRun run(test::kerf_program(), {"mesh", test::asset_path("bearing_cap_52k"), "-q", "-o", output, "-n",
                                                "6", "--size", "1.2", "--workers", "2"});
    ASSERT_TRUE(test::await([&] { return test::finished_parts(output) >= 1; }));
    // It stands still, so that it is under way for as long as it is looked at, whatever the machine does.
    ASSERT_GT(run.process(), 0);
    ASSERT_EQ(::kill(run.process(), SIGSTOP), 0);
    session_.open(output);
    EXPECT_TRUE(reach(session_, [&] { return document().progress.running && document().progress.parts_done > 0; }));
    EXPECT_FALSE(document().progress.ours);
    EXPECT_EQ(document().kind, Document::Kind::run);
    EXPECT_TRUE(document().soup);
    EXPECT_EQ(document().tree.parts_below(root_node).size(), 6u);
    EXPECT_LT(document().progress.parts_done, 6);
    ::kill(run.process(), SIGCONT);
    ASSERT_TRUE(reach(session_, [&] { return !document().progress.running; }));
    EXPECT_EQ(document().progress.message, "");
    EXPECT_EQ(run.wait().exit_code, 0);
    EXPECT_EQ(document().folder, output);
    EXPECT_EQ(document().tree.parts_below(root_node).size(), 6u);
    for (const NodeId part : document().tree.parts_below(root_node))
        EXPECT_TRUE(get(session_, [&] { return session_.fetched().cells(part); })) << failures_of(session_);
    const auto whole = get(session_, [&] { return session_.fetched().surface(root_node); });
    ASSERT_TRUE(whole);
    EXPECT_EQ(whole->facets.size(), 51840u);
}

// As if a part were being written at this moment.
TEST_F(SessionTest, OpensARunOfWhichAPartIsHalfWritten) {
    const std::string output = folder_.file("run");
    test::StartedRun run(test::kerf_program(), {"mesh", test::asset_path("cube"), "-q", "-o", output, "-n", "4",
                                                "--workers", "1", "--max-volume", "4e-6"});
    ASSERT_TRUE(test::await([&] { return test::finished_parts(output) >= 1; }));
    ::kill(run.process(), SIGKILL);
    run.wait();
    const std::string surface = output + ".kerf-partial/parts/part_0004.surface.vtu";
    fs::resize_file(surface, fs::file_size(surface) / 2);
    open(output);
    EXPECT_EQ(document().error, "");
    EXPECT_EQ(document().kind, Document::Kind::run);
}

TEST_F(SessionTest, ShowsAnInterruptedRun) {
    const std::string output = folder_.file("run");
    const std::vector<std::string> arguments = {"mesh",
                                                test::asset_path("bearing_cap_52k"),
                                                "-q",
                                                "-o",
                                                output,
                                                "-n",
                                                "12",
                                                "--size",
                                                "1.2",
                                                "--trace",
                                                folder_.file("trace"),
                                                "--workers",
                                                "1"};
    test::StartedRun run(test::kerf_program(), arguments);
    ASSERT_TRUE(test::await([&] { return test::finished_parts(output) >= 2; }));
    ::kill(run.process(), SIGINT);
    EXPECT_EQ(run.wait().exit_code, 130);
    const std::string journal = output + ".kerf-partial/work/journal";
    const std::string file = fs::directory_iterator(journal)->path();
    std::optional<JournalEntry> entry = read_journal_entry(file);
    ASSERT_TRUE(entry);
    entry->outcome.result.core_tets = 5;  // as if its mesher had stamped some
    write_journal_entry(file, *entry);
    open(output + ".kerf-partial");
    const TreeRow& with_core = *document().tree.find(NodeId(std::stoi(fs::path(file).filename())));
    EXPECT_EQ(with_core.core_tets, 5);
    EXPECT_EQ(with_core.filled_by, "core and shell");
    EXPECT_FALSE(document().progress.running);
    EXPECT_NE(document().progress.message.find("--resume"), std::string::npos);
    EXPECT_EQ(document().options.outputs.trace_file, "") << "another run shall not write over it";
    EXPECT_GE(document().progress.parts_done, 2);
    EXPECT_EQ(document().tree.parts_below(root_node).size(), 12u);
    EXPECT_TRUE(document().trace);
    EXPECT_TRUE(document().tree.find(root_node)->plane());
    int done = 0;
    for (const NodeId part : document().tree.parts_below(root_node)) {
        EXPECT_TRUE(get(session_, [&] { return session_.fetched().part_surface(part); }));
        if (document().tree.find(part)->state != NodeState::done) continue;
        ++done;
        const auto cells = get(session_, [&] { return session_.fetched().cells(part); });
        ASSERT_TRUE(cells) << failures_of(session_);
        EXPECT_EQ(static_cast<std::int64_t>(cells->tets.size()), document().tree.find(part)->tets);
    }
    EXPECT_EQ(done, document().progress.parts_done);
}

TEST_F(SessionTest, FollowsAnEventsFile) {
    const std::string events = folder_.file("events");
    run("hollow_box", {"-n", "4", "--events", events, "--trace", folder_.file("trace")});
    // As it was at every moment: what is there so far.
    const std::string whole = test::bytes_of_file(events);
    const std::string growing = folder_.file("growing");
    std::ofstream out(growing, std::ios::binary);
    const std::size_t first = whole.find('\n') + 1;
    out << whole.substr(0, first) << std::flush;
    session_.open(growing);
    ASSERT_TRUE(reach(session_, [&] { return document().soup != nullptr; })) << document().error;
    EXPECT_EQ(document().kind, Document::Kind::run);
    EXPECT_TRUE(document().progress.running);
    EXPECT_FALSE(document().trace);
    const std::size_t half = whole.find("\"event\":\"part\"");
    out << whole.substr(first, half - first) << std::flush;
    ASSERT_TRUE(reach(session_, [&] { return document().trace != nullptr; }));
    EXPECT_EQ(document().progress.stage, "volume");
    EXPECT_EQ(document().progress.parts, 4);
    EXPECT_EQ(document().tree.parts_below(root_node).size(), 4u);
    EXPECT_GT(document().tree.find(NodeId(4))->load, 0);
    const std::size_t end = whole.find("{\"event\":\"end\"");
    out << whole.substr(half, end - half) << std::flush;
    ASSERT_TRUE(reach(session_, [&] { return document().progress.parts_done == 4; }));
    EXPECT_TRUE(document().progress.running);
    for (const NodeId part : document().tree.parts_below(root_node))
        EXPECT_EQ(document().tree.find(part)->state, NodeState::done);
    out << whole.substr(end) << std::flush;
    ASSERT_TRUE(reach(session_, [&] { return !document().progress.running; }));
    EXPECT_EQ(document().folder, folder_.file("run"));
    EXPECT_TRUE(document().trace);
    EXPECT_TRUE(document().histograms[0]);
    EXPECT_TRUE(get(session_, [&] { return session_.fetched().cells(NodeId(5)); }));
    EXPECT_EQ(failures_of(session_), "");

    open(events);  // the whole at once
    ASSERT_TRUE(reach(session_, [&] { return !document().progress.running; }));
    EXPECT_EQ(document().folder, folder_.file("run"));
    EXPECT_TRUE(document().trace);
}

TEST_F(SessionTest, EventsOfAFailedRunSayWhy) {
    std::ofstream(folder_.file("events")) << R"({"event":"run","input":"/nowhere.stl","output":"/nowhere","trace":""})"
                                          << "\nno event\n{\"event\":\"stage\",\"stage\":\"read\",\"seconds\":1}\n"
                                          << R"({"event":"parts","parts":[{"id":2,"load":1},{"id":3,"load":1}]})"
                                          << "\n{\"event\":\"end\",\"exit_code\":3,\"message\":\"It is open.\"}\n"
                                          << "{\"event\":\"incom";
    open(folder_.file("events"));
    EXPECT_FALSE(document().progress.running);
    EXPECT_EQ(document().progress.message, "It is open.");
    EXPECT_EQ(document().tree.parts_below(root_node), (std::vector<NodeId>{NodeId(2), NodeId(3)}));
    EXPECT_EQ(session_.fetched().surface(root_node), nullptr);
}

TEST_F(SessionTest, EventsSayWhatHasFilledAPart) {
    std::ofstream(folder_.file("events"))
        << R"({"event":"run","input":"/nowhere.stl","output":"/nowhere","trace":""})" << '\n'
        << R"({"event":"parts","parts":[{"id":2},{"id":3}]})" << '\n'
        << R"({"event":"part","id":2,"state":"done","mesher":"a","way":"core and shell","core_tets":7,"parts_done":1,)"
        << R"("parts":2,"load_done":0.5})" << '\n'
        << R"({"event":"part","id":3,"state":"done","mesher":"tetgen","parts_done":2,"parts":2,"load_done":1})" << '\n';
    open(folder_.file("events"));
    const Tree& tree = document().tree;
    ASSERT_TRUE(tree.find(NodeId(2)) && tree.find(NodeId(3))) << document().error;
    EXPECT_EQ(std::pair(tree.find(NodeId(2))->core_tets, tree.find(NodeId(2))->filled_by),
              std::pair(std::int64_t{7}, "core and shell"s));
    EXPECT_EQ(std::pair(tree.find(NodeId(3))->core_tets, tree.find(NodeId(3))->filled_by),
              std::pair(std::int64_t{0}, "TetGen"s));
}

// --- parts of it ---

TEST(StoreTest, KeepsTheLimitButWhatIsInUse) {
    Store store(100);
    const auto value = std::make_shared<const int>(7);
    const auto key = [](int node) { return Store::Key{Store::Kind::cells, NodeId(node)}; };
    for (int node = 1; node <= 5; ++node) {
        store.next_frame();
        store.next_frame();
        store.insert(key(node), value, 30);
    }
    EXPECT_EQ(store.bytes(), 90u);
    EXPECT_FALSE(store.holds(key(2)));
    EXPECT_EQ(store.find<int>(key(2)), nullptr);
    EXPECT_EQ(*store.find<int>(key(3)), 7);
    store.next_frame();
    store.next_frame();
    EXPECT_EQ(*store.find<int>(key(3)), 7);
    store.insert(key(6), value, 30);
    EXPECT_TRUE(store.holds(key(3))) << "used since";
    EXPECT_FALSE(store.holds(key(4)));
    for (int node = 10; node < 20; ++node) store.insert(key(node), value, 30);  // all in one frame
    EXPECT_TRUE(store.is_full());
    EXPECT_TRUE(store.holds(key(10)));
    EXPECT_GE(store.bytes(), 300u);
    store.next_frame();
    store.next_frame();
    EXPECT_FALSE(store.is_full());
    store.insert(key(30), value, 30);
    EXPECT_LE(store.bytes(), 100u);
    store.insert(key(30), value, 10);  // replaced
    store.erase_if([](const Store::Key& k) { return k.node != NodeId(30); });
    EXPECT_EQ(store.bytes(), 10u);
    store.clear();
    EXPECT_EQ(store.bytes(), 0u);
}

TEST(FileKind, IsToldOfPipesAndLinksThatLeadNowhere) {
    const test::TemporaryFolder folder;
    ASSERT_EQ(::mkfifo(folder.file("pipe").c_str(), 0600), 0);
    EXPECT_EQ(tell_kind(folder.file("pipe")).kind, OpenedPath::Kind::surface) << "whose reader refuses it";
    fs::create_symlink("report.json", folder.file("report.json"));
    EXPECT_THROW(tell_kind(folder.file("")), Error);
}

TEST(LoaderTest, DropsWhatNobodyWants) {
    Loader loader;
    const auto wanted = std::make_shared<Scope>(), unwanted = std::make_shared<Scope>();
    int done = 0, failed = 0;
    std::string message;
    loader.post({unwanted, [&]() -> Loader::Completion { return [&] { done += 100; }; }, {}});
    loader.post({wanted, [&]() -> Loader::Completion { throw Error(ErrorCode::io, "no such file"); },
                 [&](const Error& error) { ++failed, message = error.what(); }});
    for (int i = 0; i < 10; ++i) loader.post({wanted, [&]() -> Loader::Completion { return [&] { ++done; }; }, {}});
    loader.post_idle({wanted, [] { return Loader::Completion(); }, {}});
    unwanted->end();
    for (int i = 0; i < 1000 && done + failed < 11; ++i) {
        loader.wait(0.05);
        loader.take_over();
    }
    EXPECT_EQ(done, 10);
    EXPECT_EQ(failed, 1);
    EXPECT_EQ(message, "no such file");
}

TEST(CommandLine, HoldsWhatDiffersFromTheDefaults) {
    RunRequest options;
    options.input = "/a b.stl";
    options.output = "/out";
    EXPECT_EQ(command_line_of(options, true),
              (std::vector<std::string>{"mesh", "/a b.stl", "--output=/out", "--quiet"}));
    options.parts = 8;
    options.sizes.size = 0.1;
    options.cut.axis = 2;
    options.outputs.stl = true;
    options.workers.count = 3;
    options.mesher.improve = false;
    options.mesher.tetgen.switches = "q1.2";
    EXPECT_EQ(command_line_of(options, false),
              (std::vector<std::string>{"decompose", "/a b.stl", "--output=/out", "--quiet", "--parts=8", "--size=0.1",
                                        "--axis=z", "--no-improve", "--workers=3", "--tetgen-switches=q1.2", "--stl"}));
}

TEST(TreeTest, FindsAndOrders) {
    Tree tree;
    for (const NodeId id : {root_node, NodeId(2), NodeId(3), NodeId(6), NodeId(7), NodeId(13), NodeId(12)}) tree.at(id);
    for (const NodeId id : {root_node, NodeId(3), NodeId(6)}) tree.find(id)->state = NodeState::divided;
    EXPECT_EQ(tree.find(NodeId(5)), nullptr);
    EXPECT_EQ(tree.levels(), 4);
    EXPECT_EQ(tree.parts_below(root_node), (std::vector<NodeId>{NodeId(2), NodeId(7), NodeId(12), NodeId(13)}));
    EXPECT_EQ(tree.parts_below(NodeId(6)), (std::vector<NodeId>{NodeId(12), NodeId(13)}));
    EXPECT_EQ(tree.parts_below(NodeId(7)), (std::vector<NodeId>{NodeId(7)}));
    std::vector<NodeId> order;
    for (const TreeRow* row : tree.in_order()) order.push_back(row->id);
    EXPECT_EQ(order,
              (std::vector<NodeId>{root_node, NodeId(2), NodeId(3), NodeId(6), NodeId(12), NodeId(13), NodeId(7)}));
    EXPECT_EQ(common_ancestor(NodeId(12), NodeId(7)), NodeId(3));
    EXPECT_EQ(common_ancestor(NodeId(2), NodeId(13)), root_node);
    EXPECT_EQ(common_ancestor(NodeId(6), NodeId(13)), NodeId(6));
}

}  // namespace
}  // namespace kerf::view

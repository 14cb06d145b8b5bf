// A trace gives back what the run had: surfaces of all nodes, cuts, options.
#include "run/run/trace.h"

#include <map>
#include <random>

#include <gtest/gtest.h>

#include "run/run/pipeline.h"
#include "support/assets.h"
#include "support/file_contents.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"
#include "support/trace_options.h"
#include "surface/diagnosis/intersections.h"

namespace kerf {
namespace {

// Keeps what the run itself has at hand for each cut.
class Witness : public RunListener {
 public:
    void on_progress(const char*, std::size_t, std::size_t) override {}
    bool wants_cuts() const override { return true; }
    void on_cut(const Surface& parent, const Cut& cut) override {
        parents[cut.node] = to_bytes(parent.arrays());
        cuts[cut.node] = cut;
    }
    std::map<NodeId, Bytes> parents;
    std::map<NodeId, Cut> cuts;
};

class TracedRun : public testing::TestWithParam<std::string> {
 protected:
    void SetUp() override {
        RunRequest options;
        options.input = test::asset_path(GetParam());
        options.output = folder_.file("out");
        options.outputs.trace_file = path_;
        options.volume = false;
        options.sizes.size = 2;
        options.parts = parts;
        options.workers.count = 2;  // threads that write parts
        SingleRank rank;
        ASSERT_EQ(run(options, 2, rank, &witness_).exit_code, 0);
        trace_ = read_trace(path_);
    }

    static constexpr std::int32_t parts = 7;
    test::TemporaryFolder folder_;
    const std::string path_ = folder_.file("run.trace");
    Witness witness_;
    Trace trace_;
};
INSTANTIATE_TEST_SUITE_P(Assets, TracedRun, testing::Values("hollow_box", "knee_femoral", "pipe_with_holes"),
                         [](const auto& param) { return param.param; });

TEST_P(TracedRun, HoldsTheInputAndEveryCut) {
    EXPECT_EQ(trace_.input, test::asset_path(GetParam()));
    EXPECT_TRUE(to_bytes(trace_.surface) == to_bytes(test::asset_surface(GetParam()).arrays()));
    ASSERT_EQ(trace_.cuts.size(), witness_.cuts.size());
    auto traced = trace_.cuts.begin();
    for (auto& [node, cut] : witness_.cuts) {
        SCOPED_TRACE(node.value());
        EXPECT_GT(cut.seconds, 0);
        cut.seconds = 0;
        EXPECT_TRUE(to_bytes(*traced++) == to_bytes(cut));
        ASSERT_NE(trace_.find(node), nullptr);
        EXPECT_EQ(trace_.find(node)->node, node);
    }
    EXPECT_EQ(trace_.find(NodeId(1 << 20)), nullptr);
}

TEST_P(TracedRun, EveryCutSurfaceIsReplayed) {
    ASSERT_FALSE(witness_.parents.empty());
    for (const auto& [node, parent] : witness_.parents)
        EXPECT_TRUE(to_bytes(replay(trace_, node).arrays()) == parent) << node.value();
}

// Both that the options are those of the run and that leaves are replayed.
TEST_P(TracedRun, TheSamePartsCanBeMadeAgain) {
    const DecomposeOptions options = test::options_of(trace_);
    EXPECT_EQ(options.parts, parts);
    EXPECT_FALSE(options.cut.size.is_empty());
    const Decomposition again = decompose(Surface(trace_.surface), options, {0, parts});
    EXPECT_EQ(again.leaves.size(), static_cast<std::size_t>(parts));
    for (const Leaf& leaf : again.leaves)
        EXPECT_TRUE(to_bytes(replay(trace_, leaf.id).arrays()) == to_bytes(leaf.surface)) << leaf.id.value();
}

TEST_P(TracedRun, WrittenAgainItHasTheSameBytes) {
    write_trace(folder_.file("again"), trace_);
    EXPECT_TRUE(test::bytes_of_file(folder_.file("again")) == test::bytes_of_file(path_));
}

TEST_P(TracedRun, NodesThatTheTreeDoesNotHaveAreNamed) {
    for (const int node : {0, -1, -7, 1 << 20}) {
        SCOPED_TRACE(node);
        try {
            replay(trace_, NodeId(node));
            ADD_FAILURE() << "no error";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage);
            EXPECT_NE(std::string(error.what()).find(" " + std::to_string(node)), std::string::npos) << error.what();
        }
    }
}

bool has_places(Refusal refusal) {
    return refusal != Refusal::none && refusal != Refusal::empty_side && refusal != Refusal::flow_limit;
}

// Corners in one place are one vertex.
bool do_collide(const Collision& pair) {
    Triangle second;
    for (std::int32_t i = 0; i < 3; ++i) {
        const auto same = std::find(pair.first.begin(), pair.first.end(), pair.second[i]);
        second[i] = same == pair.first.end() ? 3 + i : static_cast<std::int32_t>(same - pair.first.begin());
    }
    return triangles_intersect(pair.first, {0, 1, 2}, pair.second, second);
}

TEST(TracedTries, SayWhereTheyFailedAndOnWhichContour) {
    Witness witness;
    DecomposeOptions options;
    options.parts = 16;
    decompose(test::asset_surface("wing_in_box"), options, {0, options.parts}, &witness);
    int refused = 0;
    for (const auto& [node, cut] : witness.cuts)
        for (const CutTry& attempt : from_bytes<Cut>(to_bytes(cut)).tries) {
            if (!has_places(attempt.refusal)) continue;
            ++refused;
            EXPECT_FALSE(attempt.places.empty()) << node.value() << " " << name(attempt.refusal);
            EXPECT_FALSE(attempt.contour.empty()) << node.value() << " " << name(attempt.refusal);
            EXPECT_EQ(attempt.collisions.empty(), attempt.refusal != Refusal::intersection) << node.value();
            for (const Collision& pair : attempt.collisions) EXPECT_TRUE(do_collide(pair)) << node.value();
        }
    EXPECT_GT(refused, 0) << "choose an asset with a refused try";
}

// A trace of a few kilobytes.
class TraceFile : public testing::Test {
 protected:
    void SetUp() override {
        Trace trace;
        trace.input = "sphere.off";
        trace.surface = test::to_arrays(test::icosphere(2));
        const Surface surface(trace.surface);
        trace.cuts.push_back(bisect(surface, mass_properties(surface), root_node, {}, {}, true).cut);
        trace.options = {{"parts", "2"}};
        write_trace(path_, trace);
        good_ = test::bytes_of_file(path_);
    }
    void expect_refused(const std::string& bytes, const std::string& words) const {
        std::ofstream(path_, std::ios::binary) << bytes;
        try {
            read_trace(path_);
            ADD_FAILURE() << "no error";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::io);
            EXPECT_EQ(std::string(error.what()).find(path_ + ": "), 0u) << error.what();
            EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
        }
    }

    test::TemporaryFolder folder_;
    const std::string path_ = folder_.file("sphere.trace");
    std::string good_;
};

TEST_F(TraceFile, TruncatedFilesAreRefused) {
    constexpr std::size_t header = 28;
    for (std::size_t size = 0; size < header; ++size)
        expect_refused(good_.substr(0, size), std::to_string(size) + " bytes, within the header");
    for (std::size_t size = header; size < good_.size(); size += 97) expect_refused(good_.substr(0, size), "truncated");
    expect_refused(good_.substr(0, good_.size() - 1), "truncated");
    expect_refused(good_ + ' ', "damaged");
}

TEST_F(TraceFile, ForeignFilesAreRefused) {
    expect_refused(test::bytes_of_file(test::asset_path("cube")), "no trace of Kerf");
    expect_refused(std::string(1000, '\0'), "no trace of Kerf");
    std::string newer = good_;
    ++newer[sizeof(std::uint64_t)];
    expect_refused(newer, "reads format 6");
    std::filesystem::remove(path_);
    EXPECT_THROW(read_trace(path_), Error);
}

TEST_F(TraceFile, EveryChangedByteIsNoticed) {
    constexpr unsigned seed = 11;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    for (int i = 0; i < 300; ++i) {
        std::string bytes = good_;
        bytes[random() % bytes.size()] ^= static_cast<char>(1 + random() % 255);
        expect_refused(bytes, "");
    }
}

TEST_F(TraceFile, UnknownOptionsAreNamed) {
    Trace trace = read_trace(path_);
    EXPECT_EQ(test::options_of(trace).parts, 2);
    trace.options.push_back({"frobnicate", "1"});
    EXPECT_THROW(test::options_of(trace), Error);
    trace.options.back() = {"balance", "luck"};
    EXPECT_THROW(test::options_of(trace), Error);
}

// Files of an older layout must not be read as if they were new.
TEST(TraceLayout, NeedsANewVersionWhenItChanges) {
    Trace trace;
    trace.cuts.resize(1);
    trace.cuts[0].tries.resize(1);
    EXPECT_EQ(to_bytes(trace).size(), 605u) << "raise trace_version in run/run/trace.cpp, then correct this number";
}

}  // namespace
}  // namespace kerf

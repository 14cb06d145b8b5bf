// One whole cut on every asset: valid halves, whatever the remedy was.
#include "cut/cut/bisect.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <thread>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "base/core/bytes.h"
#include "base/core/error.h"
#include "base/core/threads.h"
#include "cut/cut/inside/plane.h"
#include "cut/cut/place.h"
#include "cut/decompose/decomposition.h"
#include "support/assets.h"
#include "support/shapes.h"
#include "support/slice.h"

namespace kerf {
namespace {

class Bisections : public testing::TestWithParam<std::string> {
 protected:
    Bisections() : surface_(test::asset_surface(GetParam())), mass_(mass_properties(surface_)) {}

    Bisection cut(double fraction, const CutOptions& options, bool record = false) const {
        return bisect(surface_, mass_, NodeId(3), {fraction}, options, record);
    }
    void expect_valid(const Bisection& result) const;

    Surface surface_;
    MassProperties mass_;
};
INSTANTIATE_TEST_SUITE_P(Assets, Bisections, testing::ValuesIn(test::asset_names()),
                         [](const auto& param) { return param.param; });

void Bisections::expect_valid(const Bisection& result) const {
    const Cut& cut = result.cut;
    ASSERT_TRUE(cut.made());
    EXPECT_EQ(cut.node, NodeId(3));
    double volume = 0;
    std::int64_t facets = 0;
    for (const Surface& half : result.halves) {
        const SurfaceArrays arrays = half.arrays();
        EXPECT_TRUE(find_manifold_defects(arrays.vertices.size(), arrays.facets).empty());
        volume += enclosed_volume(half);
        facets += half.facet_count();
    }
    const auto interface = static_cast<std::int64_t>(cut.interface.triangles.size());
    EXPECT_NEAR(volume, mass_.volume, 1e-12 * mass_.volume);
    EXPECT_EQ(facets, surface_.facet_count() + 2 * interface);
    const std::size_t contour = std::accumulate(cut.loops.begin(), cut.loops.end(), std::size_t{0},
                                                [](std::size_t n, const auto& loop) { return n + loop.size(); });
    EXPECT_EQ(contour, static_cast<std::size_t>(cut.contour_edges));
    EXPECT_EQ(contour, cut.interface.contour.size());
    EXPECT_FALSE(cut.tries.empty());
}

TEST(Bisect, IsTheSameOnAnyNumberOfThreads) {
    const Surface surface = test::to_surface(test::icosphere(5));  // more facets than one thread takes at once
    CutOptions options;
    std::vector<FileHash> hashes;
    for (const double max_volume : {0.0, 0.001}) {  // loads without and with volume
        options.size = SizeField(max_volume);
        for (const int threads : {1, 2, 7}) {
            set_thread_limit(threads);
            const Bisection result = bisect(surface, mass_properties(surface), root_node, {0.4}, options, false);
            ASSERT_TRUE(result.cut.made());
            hashes.push_back(result.cut.hash);
            EXPECT_EQ(hashes.back(), hashes[hashes.size() < 4 ? 0 : 3]) << threads;
        }
    }
    set_thread_limit(static_cast<int>(std::thread::hardware_concurrency()));
}

// Who puts a plane where the kernel would, gets the kernel's cut.
TEST_P(Bisections, PlaceOfAPlaneIsThatOfItsCut) {
    for (const Criterion criterion : {Criterion::inertia, Criterion::equidistant})
        for (const double fraction : {0.2, 0.5, 0.7}) {
            CutOptions options;
            options.criterion = criterion;
            const std::vector<Vec3> directions = cut_directions(surface_, mass_, options);
            for (std::size_t axis = 0; axis < directions.size(); ++axis) {
                const auto rank = static_cast<std::int32_t>(axis);
                Plane plane = PlaneSequence(surface_, mass_, directions[axis], rank, fraction, options).at(0)->plane;
                if (axis == 1) plane.normal = -plane.normal;  // whichever way it looks
                const CutPlace place = place_of(plane, surface_, mass_, options);
                EXPECT_EQ(place.axis, rank);
                EXPECT_NEAR(place.fraction, fraction, 1e-3) << static_cast<int>(criterion) << " " << axis;
            }
        }
    Plane beyond;
    beyond.origin = 1e6 * Vec3::UnitX();
    EXPECT_LT(place_of(beyond, surface_, mass_, {}).fraction, 1) << "a cut leaves something on both sides";
}

TEST_P(Bisections, HalvesAreClosedAndAddUp) {
    for (const double fraction : {1 / 3.0, 0.5}) {
        SCOPED_TRACE(fraction);
        expect_valid(cut(fraction, {}));
    }
}

TEST_P(Bisections, CutsOfMajorityAndFixedAxesAreValid) {
    CutOptions edges, along_z;
    edges.contour = ContourMethod::edges;
    along_z.criterion = Criterion::equidistant;
    along_z.axis = 2;
    for (const CutOptions& options : {edges, along_z}) {
        const Bisection result = cut(0.5, options);
        if (!result.cut.made()) continue;  // both may fail; whatever they return is valid
        expect_valid(result);
        EXPECT_TRUE(options.axis < 0 || result.cut.plane.normal == Vec3::UnitZ());
    }
}

// Steps of the contour along slanted edges run back on themselves where the wall is steep.
TEST(Bisect, GoesAgainstTheGrainOfEdges) {
    for (int i = 0; i < 40; i += test::in_slices() ? 8 : 2) {
        SCOPED_TRACE(testing::Message() << "tilt and twist number " << i);
        Soup soup = test::twisted_cylinder(48, 64, 1, 8, 0.1 * (i % 10));
        const Eigen::AngleAxisd tilt(0.05 + 0.02 * i, Vec3(1, 0.3, 0).normalized());
        for (Vec3& v : soup.vertices) v = tilt * v;
        const Surface surface = test::to_surface(soup);
        CutOptions across_z;
        across_z.axis = 2;
        const Cut cut = bisect(surface, mass_properties(surface), root_node, {0.5}, across_z, false).cut;
        EXPECT_TRUE(cut.strategy == CutStrategy::first_try || cut.strategy == CutStrategy::local_repair)
            << name(cut.strategy);
        EXPECT_LE(cut.tries.size(), 3U);
        EXPECT_GE(cut.quality.dihedral_deg, across_z.good_dihedral_deg);
        EXPECT_GE(cut.quality.angle_deg, across_z.good_angle_deg);
    }
}

TEST_P(Bisections, LoadIsNearTheWantedOne) {
    const Bisection result = cut(0.5, {});
    ASSERT_TRUE(result.cut.made());
    const double below = result.halves[0].facet_count(), above = result.halves[1].facet_count();
    EXPECT_NEAR(below / (below + above), 0.5, 0.15);
}

// All but what the record and the clock fill.
Bytes bytes_of(Bisection& result) {
    result.cut.side.clear();
    result.cut.stages = {};
    for (CutTry& attempt : result.cut.tries) {
        attempt.contour.clear();
        attempt.collisions.clear();
    }
    result.cut.seconds = 0;
    Bytes bytes = to_bytes(result.cut);
    for (const Surface& half : result.halves) {
        const Bytes more = to_bytes(half.arrays());
        bytes.insert(bytes.end(), more.begin(), more.end());
    }
    return bytes;
}

TEST_P(Bisections, RecordChangesNothingElse) {
    Bisection with = cut(0.5, {}, true), without = cut(0.5, {}, false);
    EXPECT_EQ(with.cut.side.size(), static_cast<std::size_t>(surface_.facet_count()));
    for (const auto stage :
         {&ContourStages::crossed_edges, &ContourStages::hanging_edges_removed, &ContourStages::closed_loops,
          &ContourStages::multiple_paths_removed, &ContourStages::smoothed}) {
        EXPECT_FALSE((with.cut.stages.*stage).empty());
        EXPECT_TRUE((without.cut.stages.*stage).empty());
    }
    EXPECT_EQ(with.cut.stages.smoothed.size(), static_cast<std::size_t>(with.cut.contour_edges));
    EXPECT_TRUE(without.cut.side.empty());
    bool contour_was_used = false;
    for (const CutTry& attempt : with.cut.tries) {
        const bool has_none = attempt.refusal == Refusal::empty_side || attempt.refusal == Refusal::flow_limit;
        EXPECT_EQ(attempt.contour.empty(), has_none) << name(attempt.refusal);
        contour_was_used |= attempt.contour == with.cut.stages.smoothed;
    }
    EXPECT_TRUE(contour_was_used);
    for (const CutTry& attempt : without.cut.tries) EXPECT_TRUE(attempt.contour.empty());
    EXPECT_TRUE(bytes_of(with) == bytes_of(without));
}

TEST(Bisect, BodyThatCannotBeCutStaysWhole) {
    const Surface tetrahedron(test::to_arrays(test::tetrahedron()));
    const Bisection result = bisect(tetrahedron, mass_properties(tetrahedron), root_node, {}, {}, false);
    EXPECT_EQ(result.cut.strategy, CutStrategy::whole);
    EXPECT_FALSE(result.cut.tries.empty());
    for (const CutTry& attempt : result.cut.tries) EXPECT_NE(attempt.refusal, Refusal::none);
}

// The plane touches the upper box from below and crosses no edge, so no length of edges says how wide the band is.
TEST(Bisect, PlaneInAGapThatTouchesABodyParts) {
    const Surface surface =
        test::to_surface(test::join(test::box({0, 0, 0}, {1, 1, 1}, 3), test::box({2, 0, 0}, {4, 2, 2}, 3)));
    CutOptions options;
    options.criterion = Criterion::equidistant;
    options.axis = 0;
    const Bisection result = bisect(surface, mass_properties(surface), root_node, {}, options, false);
    EXPECT_EQ(result.cut.strategy, CutStrategy::first_try);
    EXPECT_TRUE(result.cut.loops.empty());
    EXPECT_DOUBLE_EQ(enclosed_volume(result.halves[0]), 1);
    EXPECT_DOUBLE_EQ(enclosed_volume(result.halves[1]), 8);
}

TEST(Decompose, RangeOfLeavesIsThatOfTheWhole) {
    DecomposeOptions options;
    options.parts = 7;
    const Surface surface = test::asset_surface("pipe_with_holes");
    const Decomposition whole = decompose(surface, options, {0, 7});
    ASSERT_EQ(whole.leaves.size(), 7u);
    EXPECT_EQ(whole.nodes.size(), 13u);
    for (std::int32_t first = 0; first < 7; first += 3) {
        const LeafRange range = {first, std::min(first + 3, 7)};
        const Decomposition some = decompose(surface, options, range);
        ASSERT_EQ(some.leaves.size(), static_cast<std::size_t>(range.last - range.first));
        EXPECT_LT(some.nodes.size(), whole.nodes.size());
        for (std::size_t i = 0; i < some.leaves.size(); ++i) {
            EXPECT_EQ(some.leaves[i].id, whole.leaves[first + i].id);
            EXPECT_TRUE(to_bytes(some.leaves[i].surface) == to_bytes(whole.leaves[first + i].surface));
        }
    }
}

// All but the clock.
Bytes bytes_of(Decomposition& result) {
    for (TreeNode& node : result.nodes) node.seconds = 0;
    Bytes bytes = to_bytes(result.nodes);
    const Bytes more = to_bytes(result.leaves);
    bytes.insert(bytes.end(), more.begin(), more.end());
    return bytes;
}

// Counts itself in and out: a call during another would see two.
class OrderChecker : public CutListener {
 public:
    void on_cut(const Surface&, const Cut& cut) override {
        EXPECT_EQ(++inside_, 1);
        EXPECT_TRUE(cut.node == root_node || std::find(nodes.begin(), nodes.end(), parent_of(cut.node)) != nodes.end());
        nodes.push_back(cut.node);
        --inside_;
    }
    std::vector<NodeId> nodes;

 private:
    std::atomic<int> inside_ = 0;
};

TEST(Decompose, ThreadsChangeNothing) {
    for (const std::string asset : {"cylinder", "hollow_box", "wing_in_box"}) {
        const Surface surface = test::asset_surface(asset);
        for (const LeafRange range : {LeafRange{0, 9}, LeafRange{2, 5}}) {
            SCOPED_TRACE(asset + " from leaf " + std::to_string(range.first));
            DecomposeOptions options;
            options.parts = 9;
            Decomposition one = decompose(surface, options, range);
            for (const std::int32_t threads : {2, 3, 16}) {
                options.threads = threads;
                OrderChecker listener;
                Decomposition many = decompose(surface, options, range, &listener);
                EXPECT_TRUE(bytes_of(many) == bytes_of(one)) << threads << " threads";
                EXPECT_EQ(static_cast<std::ptrdiff_t>(listener.nodes.size()),
                          std::count_if(one.nodes.begin(), one.nodes.end(), [](auto& n) { return n.cut_tried; }));
            }
        }
    }
}

TEST(Decompose, ErrorsOfListenersReachTheCaller) {
    class Thrower : public CutListener {
        void on_cut(const Surface&, const Cut& cut) override {
            if (cut.node == NodeId(2)) throw Error(ErrorCode::cancelled, "Enough.");
        }
    } thrower;
    DecomposeOptions options;
    for (const std::int32_t threads : {1, 2, 4}) {
        options.threads = threads;
        EXPECT_THROW(decompose(test::asset_surface("cylinder"), options, {0, options.parts}, &thrower), Error);
    }
}

TEST(Decompose, ChildrenAreNumberedAsInABinaryTree) {
    DecomposeOptions options;
    options.parts = 5;
    const Decomposition result = decompose(test::asset_surface("cylinder"), options, {0, 5});
    for (const TreeNode& tree_node : result.nodes) {
        const bool leaf = std::any_of(result.leaves.begin(), result.leaves.end(),
                                      [&](const Leaf& l) { return l.id == tree_node.id; });
        EXPECT_NE(leaf, tree_node.cut_made);
        if (tree_node.id == root_node) continue;
        EXPECT_TRUE(std::any_of(result.nodes.begin(), result.nodes.end(), [&](const TreeNode& parent) {
            return parent.id == parent_of(tree_node.id) && parent.cut_made && parent.leaves > tree_node.leaves;
        }));
    }
}

}  // namespace
}  // namespace kerf

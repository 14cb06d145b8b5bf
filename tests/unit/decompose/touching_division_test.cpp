// Bodies that touch themselves are cut elsewhere: no contour passes a place where they do, and no plane crosses one.
#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "base/core/bytes.h"
#include "cut/cut/inside/facet_split.h"
#include "cut/decompose/straight_division.h"
#include "support/decomposition_laws.h"
#include "support/slice.h"
#include "support/voxels.h"
#include "surface/complex/touching.h"

namespace kerf {
namespace {

struct DividedBody {
    std::string name;
    SurfaceArrays welded;
    Surface surface() const { return to_surface(separate_touching(welded)); }
};

DividedBody divided_body(const std::string& name, const test::Voxels& voxels, int n) {
    return {name + " in " + std::to_string(n), test::to_arrays(test::voxel_surface(voxels, n))};
}

std::vector<DividedBody> bodies_to_divide() {
    test::Voxels stairs;  // in pairs, each at an edge of the next
    for (int i = 0; i < 4; ++i) stairs.insert({{i, i, 0}, {i, i, 1}});
    test::Voxels ring;  // touches itself at one edge, else it hangs together
    for (int i = 0; i < 3; ++i) ring.insert({{i, 0, 0}, {i, 3, 0}, {0, i, 0}});
    ring.insert({{0, 3, 0}, {3, 2, 0}, {2, 1, 0}, {3, 3, 0}});
    std::vector<DividedBody> bodies;
    for (const int n : {1, 4}) {
        bodies.push_back(divided_body("cubes at a vertex", {{0, 0, 0}, {1, 1, 1}}, n));
        bodies.push_back(divided_body("cubes at an edge", {{0, 0, 0}, {1, 1, 0}}, n));
        bodies.push_back(divided_body("stairs", stairs, n));
        bodies.push_back(divided_body("ring", ring, n));
        bodies.push_back(divided_body("notch with a double edge", test::notched_voxels(), n));
        for (std::uint64_t seed = 1; seed <= test::slice(8); ++seed) {
            test::SeededNumbers random(seed);
            const test::Voxels voxels = test::random_voxels(3, random.between(0.4, 0.8), random);
            bodies.push_back(divided_body("voxels of seed " + std::to_string(seed), voxels, n));
        }
    }
    return bodies;
}

// Places where the welded surface has an edge of more than two facets, or a vertex with several fans.
std::set<std::array<double, 3>> touching_places(const SurfaceArrays& welded) {
    std::set<std::array<double, 3>> places;
    for (const ManifoldDefect& defect : find_manifold_defects(welded.vertices.size(), welded.facets))
        for (const std::int32_t v : defect.vertices) {
            const Vec3& p = welded.vertices[v];
            places.insert({p.x(), p.y(), p.z()});
        }
    return places;
}

class TouchingDivision : public testing::TestWithParam<ContourMethod> {
 protected:
    static DecomposeOptions options(std::int32_t parts) {
        DecomposeOptions options = test::in_parts(parts);
        options.cut.contour = GetParam();
        return options;
    }
};
INSTANTIATE_TEST_SUITE_P(Contours, TouchingDivision,
                         testing::Values(ContourMethod::min_cut, ContourMethod::edges, ContourMethod::straight),
                         [](const auto& instance) { return std::string(name(instance.param)).substr(0, 3); });

TEST_P(TouchingDivision, ObeysEveryLaw) {
    int cut = 0, wanted = 0;
    for (const DividedBody& body : bodies_to_divide())
        for (const std::int32_t parts : {2, 5, 8}) {
            SCOPED_TRACE(testing::Message() << body.name << ", " << parts << " parts");
            const Decomposition whole = test::decompose_whole(body.surface(), options(parts));
            EXPECT_EQ(test::broken_laws(whole, body.welded), "");
            cut += static_cast<int>(whole.leaves.size()) - 1;
            wanted += parts - 1;
            for (const Leaf& leaf : whole.leaves) EXPECT_TRUE(is_well_formed(joined_by_key(leaf.surface)));
        }
    EXPECT_GT(cut, wanted * 8 / 10);
}

TEST_P(TouchingDivision, DoesNotDependOnThreads) {
    for (const DividedBody& body : bodies_to_divide()) {
        DecomposeOptions one = options(5), four = one;
        four.threads = 4;
        const Decomposition a = test::decompose_whole(body.surface(), one),
                            b = test::decompose_whole(body.surface(), four);
        EXPECT_TRUE(to_bytes(a.leaves) == to_bytes(b.leaves)) << body.name;
    }
}

class ContourWatch : public CutListener {
 public:
    explicit ContourWatch(std::set<std::array<double, 3>> places) : places_(std::move(places)) {}
    void on_cut(const Surface& parent, const Cut& cut) override {
        for (const auto& loop : cut.loops)
            for (const Vertex v : loop) {
                const Vec3& p = parent.point(v);
                passed_ += places_.contains({p.x(), p.y(), p.z()});
            }
        ++cuts_;
    }
    int cuts_ = 0, passed_ = 0;

 private:
    std::set<std::array<double, 3>> places_;
};

// One copy alone may lie on a contour, in a part without the others.
TEST_P(TouchingDivision, PassesNoPlaceWhereTheBodyTouchesItself) {
    for (const DividedBody& body : bodies_to_divide()) {
        ContourWatch watch(touching_places(body.welded));
        test::decompose_whole(body.surface(), options(2), &watch);
        EXPECT_GT(watch.cuts_, 0) << body.name;
        EXPECT_EQ(watch.passed_, 0) << body.name;
    }
}

TEST(SplitAtPlane, RefusesToCrossAnEdgeWhereTheBodyTouchesItself) {
    const Surface cubes = divided_body("cubes", {{0, 0, 0}, {1, 1, 0}}, 1).surface();
    EXPECT_FALSE(split_at_plane(cubes, 2, 0.5, root_node));
    EXPECT_TRUE(split_at_plane(cubes, 0, 0.5, root_node));
    const Surface notch = divided_body("notch", test::notched_voxels(), 1).surface();
    EXPECT_FALSE(split_at_plane(notch, 2, 1.5, root_node));
    EXPECT_TRUE(split_at_plane(notch, 2, 0.5, root_node));
}

}  // namespace
}  // namespace kerf

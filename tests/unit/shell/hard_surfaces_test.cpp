// Every facet of surfaces whose facets no Delaunay triangulation has is recovered. tests/bench/recovery_bench.cpp asks
// the same of ten thousand.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "fill/mesh/verification.h"
#include "fill/shell/shell.h"
#include "support/hard_surfaces.h"
#include "support/shapes.h"
#include "support/slice.h"

namespace kerf {
namespace {

constexpr unsigned surfaces_by_seed = 66;  // six of each family
constexpr int most_facets_wanted = 80;

// Whether all facets are recovered; then all laws hold.
bool is_filled(const SurfaceArrays& surface, const RefinementBounds& bounds) {
    try {
        const MeshLaws laws = verify_mesh(fill_shell(surface, {}, bounds).mesh, surface);
        for (const MeshLaw& law : mesh_laws) EXPECT_EQ(laws.*law.count, 0) << law.broken;
        EXPECT_NEAR(laws.volume, laws.surface_volume, laws.volume_error);
        return true;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::subdomain) << error.what();
        return false;
    }
}

// Recovery is not complete: of one in a hundred it loses some.
TEST(HardSurfaces, AreFilledWithAllTheirFacets) {
    int lost = 0;
    for (std::uint64_t seed = 0; seed < test::slice(surfaces_by_seed); ++seed) {
        const auto hard = test::hard_surface(seed, most_facets_wanted);
        if (!hard) continue;
        SCOPED_TRACE(testing::Message() << "seed " << seed << ": " << hard->family << ", "
                                        << hard->surface.facets.size() << " facets");
        lost += !is_filled(hard->surface, seed % 3 == 0 ? RefinementBounds{SizeField(), 1.4} : RefinementBounds{});
    }
    EXPECT_LE(lost, 1);
}

TEST(HardSurfaces, AreOfEveryFamilyAndTheSameAgain) {
    const std::size_t families = test::hard_families().size();
    int skipped = 0;
    for (std::uint64_t seed = 0; seed < 3 * families; ++seed) {
        const auto hard = test::hard_surface(seed, most_facets_wanted),
                   again = test::hard_surface(seed, most_facets_wanted);
        ASSERT_EQ(hard.has_value(), again.has_value());
        if (!hard) {
            ++skipped;
            continue;
        }
        EXPECT_EQ(test::hard_family_number(hard->family), seed % families);
        EXPECT_EQ(hard->surface.vertices, again->surface.vertices);
        EXPECT_EQ(hard->surface.facets, again->surface.facets);
        EXPECT_TRUE(is_well_formed(hard->surface));
    }
    EXPECT_LE(skipped, 1);
    EXPECT_THROW(test::hard_family_number("easy"), Error);
}

struct SmallSurface {
    std::string name;
    std::vector<Vec3> vertices;
    std::vector<Triangle> facets;
};

// Smallest surfaces whose facets flips and points beside them did not recover.
std::vector<SmallSurface> surfaces_once_lost() {
    return {{"cube without two corners",
             {{0, 1, 0}, {0, 1, 1}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}},
             {{2, 3, 5}, {3, 4, 5}, {2, 5, 1}, {4, 3, 0}, {1, 4, 0}, {2, 1, 0}, {3, 2, 0}, {4, 1, 5}}},
            {"twisted needle",
             {{1e-5, 0, 0},
              {1e-5, 0, 0.38523},
              {-1e-5, 1e-5, 0},
              {-1e-5, 1e-5, 0.38523},
              {-1e-5, -1e-5, 0},
              {-1e-5, -1e-5, 0.38523}},
             {{5, 1, 3}, {4, 2, 0}, {0, 2, 1}, {2, 3, 1}, {3, 2, 4}, {3, 4, 5}, {0, 1, 5}, {0, 5, 4}}},
            {"tip under a wedge",
             {{0, 0, 0},
              {0.2515, 0.0357, -0.03},
              {0.2617, 0.0678, 0.0934},
              {0.2095, 0.2808, -0.0904},
              {0.2197, 0.3129, 0.033},
              {0.0524, 0.1941, 0.0979},
              {0.0587, 0.2344, 0.0869},
              {0.0827, 0.2305, 0.086},
              {0.066, 0.2074, 0.0733}},
             {{1, 0, 3},
              {0, 1, 2},
              {1, 3, 2},
              {3, 4, 2},
              {2, 4, 0},
              {4, 3, 0},
              {5, 6, 8},
              {6, 7, 8},
              {7, 5, 8},
              {6, 5, 7}}},
            {"two bodies side by side",
             {{-0.05, 0.06, 0.33},
              {-0.05, 0, 0.2},
              {-0.05, 0.13, 0.14},
              {0.45, 0.19, 0.17},
              {0.47, 0.06, 0.23},
              {0.44, 0, 0.1},
              {-0.12, 0.09, 0.11},
              {0.01, 0.09, -0.04},
              {-0.13, 0.09, -0.03},
              {-0.05, 0.59, 0.14}},
             {{0, 4, 3},
              {0, 1, 5},
              {0, 5, 4},
              {0, 2, 1},
              {3, 4, 5},
              {3, 5, 1},
              {2, 0, 3},
              {2, 3, 1},
              {9, 6, 7},
              {6, 8, 7},
              {9, 7, 8},
              {9, 8, 6}}}};
}

TEST(HardSurfaces, OnceLostAreFilled) {
    for (const auto& [name, vertices, facets] : surfaces_once_lost()) {
        SCOPED_TRACE(name);
        const Soup soup{vertices, facets, std::vector<std::int32_t>(facets.size(), 0), {"surface"}};
        EXPECT_TRUE(is_filled(test::to_arrays(soup), {}));
    }
}

}  // namespace
}  // namespace kerf

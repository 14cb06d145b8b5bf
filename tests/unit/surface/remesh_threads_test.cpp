// The remesher gives the same on any number of threads, which take blocks of a surface large enough to have some.
#include <gtest/gtest.h>

#include "base/core/thread_limit.h"
#include "support/shapes.h"
#include "surface/remesh/remesh.h"

namespace kerf {
namespace {

TEST(RemeshOnThreads, IsTheSameForAnyNumber) {
    const ThreadLimitGuard guard;
    const SurfaceArrays surface = test::to_arrays(test::torus(1, 0.3, 160, 52));
    const auto on_threads = [&](int threads) {
        set_thread_limit(threads);
        return remesh(surface, {.deviation = 1e-3, .longest = 0.2});
    };
    const Remeshed alone = on_threads(1);
    EXPECT_NE(alone.surface.facets, surface.facets);
    for (const int threads : {2, 7}) {
        const Remeshed together = on_threads(threads);
        EXPECT_EQ(alone.surface.vertices, together.surface.vertices);
        EXPECT_EQ(alone.surface.facets, together.surface.facets);
        EXPECT_EQ(alone.report.distance_to_input, together.report.distance_to_input);
        EXPECT_EQ(alone.report.distance_from_input, together.report.distance_from_input);
    }
}

}  // namespace
}  // namespace kerf

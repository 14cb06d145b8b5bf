#include "surface/soup/ray_parity.h"

#include <random>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace kerf {
namespace {

Shell shell_of(const Soup& soup) {
    return collect_shells(soup.vertices, soup.facets, std::vector<std::int32_t>(soup.facets.size(), 0), 1).front();
}

// A shell that is asked often answers by a tree of its facets, a new one by looking at all of them.
TEST(Encloses, AnswersTheSameHoweverOftenItIsAsked) {
    for (const Soup& soup : {test::torus(3, 1, 24, 12), test::box(Vec3(-4, -4, -1), Vec3(4, 4, 1), 5)}) {
        SCOPED_TRACE(soup.patch_names.front());
        std::mt19937 random(5);
        const auto uniform = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
        const Shell shell = shell_of(soup);
        int inside = 0;
        for (int i = 0; i < 400; ++i) {
            // A quarter of the points are in special places: in the planes of vertices, or on the shell.
            const Vec3 point = i % 4 ? Vec3(5 * uniform(), 5 * uniform(), 1.5 * uniform())
                                     : Vec3(soup.vertices[random() % soup.vertices.size()] / (1 + i % 8));
            const std::optional<bool> answer = encloses(soup.vertices, shell, point);
            EXPECT_EQ(answer, encloses(soup.vertices, shell_of(soup), point)) << point.transpose();
            inside += answer.value_or(false);
        }
        EXPECT_TRUE(shell.memory->tree);
        EXPECT_GT(inside, 50);
        EXPECT_LT(inside, 350);
    }
}

}  // namespace
}  // namespace kerf

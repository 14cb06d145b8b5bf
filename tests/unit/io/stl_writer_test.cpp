// What the writer writes, the reader reads.
#include "files/io/stl_writer.h"

#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "base/core/error.h"
#include "files/io/surface_reader.h"
#include "support/file_contents.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

Vec3 rounded(const Vec3& p) { return p.cast<float>().cast<double>(); }

void expect_read_back(const Soup& soup) {
    const test::TemporaryFolder folder;
    write_stl(folder.file("part.stl"), soup.vertices, soup.facets);
    const Soup read = read_surface(folder.file("part.stl"));
    ASSERT_EQ(read.facets.size(), soup.facets.size());
    for (std::size_t f = 0; f < soup.facets.size(); ++f)
        for (int i = 0; i < 3; ++i)
            EXPECT_EQ(read.vertices[read.facets[f][i]], rounded(soup.vertices[soup.facets[f][i]]));
}

TEST(StlWriter, FacetsAreReadBackInTheirOrder) {
    constexpr unsigned seed = 5;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(-1e3, 1e3);
    for (const int level : {0, 1, 3}) {
        Soup soup = test::icosphere(level);
        for (Vec3& p : soup.vertices) p = Vec3(coordinate(random), coordinate(random), coordinate(random));
        expect_read_back(soup);
    }
    expect_read_back(test::nested_boxes(2, 3));
}

TEST(StlWriter, NormalsPointOutAndHaveUnitLength) {
    const test::TemporaryFolder folder;
    const Soup soup = test::icosphere(2);
    write_stl(folder.file("sphere.stl"), soup.vertices, soup.facets);
    const std::string bytes = test::bytes_of_file(folder.file("sphere.stl"));
    ASSERT_EQ(bytes.size(), 84 + 50 * soup.facets.size());
    EXPECT_NE(bytes.substr(0, 5), "solid");
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        std::array<float, 6> values;  // the normal and the first corner
        std::memcpy(values.data(), bytes.data() + 84 + 50 * f, sizeof values);
        const Eigen::Vector3f normal(values.data()), corner(values.data() + 3);
        EXPECT_NEAR(normal.norm(), 1, 1e-6);
        EXPECT_GT(normal.dot(corner), 0.9);
    }
}

TEST(StlWriter, FacetWithoutAreaHasNoNormal) {
    const test::TemporaryFolder folder;
    write_stl(folder.file("flat.stl"), {Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(2, 2, 2)}, {{0, 1, 2}});
    EXPECT_EQ(test::bytes_of_file(folder.file("flat.stl")).substr(84, 12), std::string(12, '\0'));
}

TEST(StlWriter, PlaceThatCannotBeWrittenIsNamed) {
    const test::TemporaryFolder folder;
    try {
        write_stl(folder.file("no/part.stl"), {}, {});
        ADD_FAILURE() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::io);
        EXPECT_NE(std::string(error.what()).find("no/part.stl"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace kerf

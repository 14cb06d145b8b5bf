// Any unit and any place: surfaces at scales of 1e-12 to 1e12, and a thousand times their size away from the origin,
// are divided, meshed and verified, and the parts have the coordinates of the input bit for bit.
#include <gtest/gtest.h>

#include "files/io/surface_reader.h"
#include "run/prepare/input.h"
#include "support/assets.h"
#include "support/face.h"
#include "support/program.h"
#include "support/run_laws.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"

namespace kerf {
namespace {

struct Placement {
    double scale = 1;
    Vec3 offset = Vec3::Zero();  ///< in sizes of the surface
};

std::vector<Placement> placements() {
    std::vector<Placement> all;
    for (const double scale : {1e-12, 1e-6, 1e6, 1e12}) {
        all.push_back({scale, Vec3::Zero()});
        all.push_back({scale, Vec3(1e3, -1e3, 1e3)});
    }
    all.push_back({1, Vec3(1e3, 1e3, 1e3)});
    return all;
}

Soup placed(Soup soup, const Placement& placement) {
    Vec3 low = soup.vertices[0], high = low;
    for (const Vec3& p : soup.vertices) low = low.cwiseMin(p), high = high.cwiseMax(p);
    const double size = (high - low).maxCoeff();
    for (Vec3& p : soup.vertices) p = placement.scale * (p + size * placement.offset);
    return soup;
}

void expect_laws(const std::string& command, const std::string& asset, const Placement& placement) {
    SCOPED_TRACE(testing::Message() << command << ' ' << asset << " * " << placement.scale << " from "
                                    << placement.offset.transpose());
    const test::TemporaryFolder folder;
    const std::string path = folder.file("placed.off"), out = folder.file("out");
    const Soup soup = placed(read_surface(test::asset_path(asset)), placement);
    test::write_off(path, soup.vertices, soup.facets);
    const ChildResult run = test::run_kerf({command, path, "-o", out, "-n", "4", "-q"});
    ASSERT_EQ(run.exit_code, 0) << run.log;

    const bool is_meshed = command == "mesh";
    const std::vector<Part> parts = is_meshed ? test::read_parts(out) : test::read_part_surfaces(out);
    EXPECT_EQ(parts.size(), 4u);
    std::vector<char> found(soup.vertices.size(), 0);
    for (const Part& part : parts)
        for (std::size_t v = 0; v < part.global_id.size(); ++v) {
            const auto id = static_cast<std::size_t>(part.global_id[v]);
            if (id >= soup.vertices.size()) continue;  // made by a cut or by the mesher
            found[id] = 1;
            EXPECT_TRUE(test::same_bits(part.mesh.vertices[v], soup.vertices[id])) << "vertex " << id;
        }
    EXPECT_EQ(std::count(found.begin(), found.end(), char{0}), 0) << "vertices of the input are missing";
    if (is_meshed) {
        EXPECT_EQ(test::run_kerf({"verify", out}).exit_code, 0);
        EXPECT_EQ(test::broken_laws(parts, read_input(path).complex.arrays()), "");
    }
}

TEST(Scale, SurfacesOfAnySizeAndPlaceAreDivided) {
    for (const Placement& placement : placements()) expect_laws("decompose", "bearing_cap_14k", placement);
}

TEST(Scale, SurfacesOfAnySizeAndPlaceAreMeshed) {
    for (const char* asset : {"cube", "hollow_box"})
        for (const Placement& placement : placements()) expect_laws("mesh", asset, placement);
}

// Powers of two change no digit of a coordinate, and no decision.
TEST(Scale, PowersOfTwoChangeNothingButTheCoordinates) {
    const test::TemporaryFolder folder;
    const Soup soup = read_surface(test::asset_path("cube"));
    std::vector<std::vector<Part>> runs;
    for (const double scale : {1.0, std::ldexp(1, -40), std::ldexp(1, 40)}) {
        const Soup scaled = placed(soup, {scale, Vec3::Zero()});
        test::write_off(folder.file("cube.off"), scaled.vertices, scaled.facets);
        const ChildResult run =
            test::run_kerf({"decompose", folder.file("cube.off"), "-o", folder.file("out"), "-n", "4", "-q"});
        ASSERT_EQ(run.exit_code, 0) << run.log;
        runs.push_back(test::read_part_surfaces(folder.file("out")));
        ASSERT_EQ(runs.back().size(), 4u);
        for (std::size_t p = 0; p < runs.back().size(); ++p) {
            const Part &part = runs.back()[p], &original = runs.front()[p];
            EXPECT_EQ(part.facets, original.facets) << scale;
            EXPECT_EQ(part.global_id, original.global_id) << scale;
            for (std::size_t v = 0; v < part.mesh.vertices.size(); ++v)
                EXPECT_TRUE(test::same_bits(part.mesh.vertices[v], scale * original.mesh.vertices[v]))
                    << scale << ' ' << v;
        }
    }
}

}  // namespace
}  // namespace kerf

// What the mesher makes of a field, in one piece and in a run of many parts.
#include <gtest/gtest.h>

#include "fill/mesh/verification.h"
#include "fill/volume/mesher.h"
#include "support/places.h"
#include "support/run_in_process.h"
#include "support/size_fields.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"

namespace kerf {
namespace {

using namespace test;

// Lengths of edges over the size wanted in their middle, ascending; each edge once. `counts` chooses the edges.
template <class Counts>
std::vector<double> got_over_asked(const std::vector<Vec3>& vertices, const std::vector<Tetrahedron>& tets,
                                   const SizeField& field, const Counts& counts) {
    std::vector<std::array<std::int32_t, 2>> edges;
    for (const Tetrahedron& t : tets)
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = i + 1; j < 4; ++j)
                if (counts(t[i], t[j])) edges.push_back({std::min(t[i], t[j]), std::max(t[i], t[j])});
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    std::vector<double> ratios;
    for (const auto& [a, b] : edges)
        ratios.push_back((vertices[a] - vertices[b]).norm() / field.at((vertices[a] + vertices[b]) / 2));
    std::sort(ratios.begin(), ratios.end());
    return ratios;
}

double share_obeyed(const std::vector<double>& ratios) {
    const auto low = std::lower_bound(ratios.begin(), ratios.end(), 0.7);
    const auto high = std::upper_bound(ratios.begin(), ratios.end(), 1.4);
    return static_cast<double>(high - low) / static_cast<double>(ratios.size());
}

struct Case {
    std::string name;
    Soup soup;
    SizeOptions options;
    std::optional<SizedMesh> background;
};

// A pyramid without its tip, whose facets grow from 0.2 there, a patch, to 2 at the base; at rate 0.2.
Soup frustum() {
    Soup soup = box(Vec3(0, -0.5, -0.5), Vec3(13, 0.5, 0.5), {13, 5, 5});
    soup.patch_names = {"sides", "tip"};
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        double layer = 0;
        for (const std::int32_t v : soup.facets[f]) layer += soup.vertices[v].x();
        soup.patch[f] = layer == 0;
    }
    for (Vec3& p : soup.vertices) {
        const double scale = std::pow(1.2, p.x());
        p = Vec3(scale, scale * p.y(), scale * p.z());
    }
    return soup;
}

// Surfaces as fine as the field wants them, so that nothing but the field is asked of the inside.
std::vector<Case> cases() {
    std::vector<Case> all(4);
    all[0] = {"a fine sphere in a box", box(Vec3::Zero(), Vec3(10, 10, 10), 10), {}, {}};
    all[0].options.size = 1;
    all[0].options.inside = {"sphere:5,5,5,1=0.2"};
    all[1] = {"a patch at a tenth of the size", frustum(), {}, {}};
    all[1].options.size = 2;
    all[1].options.on = {"tip=0.2"};
    all[2] = {"a ball finer on one side", icosphere(4, 5), {}, {}};
    all[2].options.size = 0.8;
    all[2].options.growth = 0.2;
    all[2].options.inside = {"box:-9,-9,-9,-2,9,9=0.4"};
    all[3] = {"a background mesh", box(Vec3::Zero(), Vec3(10, 10, 10), 20), {}, {}};
    all[3].background = sized_grid(Vec3::Zero(), Vec3(10, 10, 10), 10,
                                   [](const Vec3& p) { return 0.5 + 0.2 * std::min(p.minCoeff(), 10 - p.maxCoeff()); });
    return all;
}

TEST(MesherOfSizes, ObeysTheField) {
    for (const Case& c : cases()) {
        SCOPED_TRACE(c.name);
        const SurfaceArrays surface = to_arrays(c.soup);
        MesherOptions options;
        options.size = make_size_field(c.options, surface, c.soup.patch_names, c.background);
        options.tetgen.shuffle = 1;  // as given, TetGen fails on the frustum
        const TetMesh mesh = mesh_volume(surface, options).mesh;
        EXPECT_TRUE(verify_mesh(mesh, surface).hold());
        const auto is_inside = [&](std::int32_t a, std::int32_t b) {
            return std::max(a, b) >= mesh.boundary_vertex_count;
        };
        const std::vector<double> ratios = got_over_asked(mesh.vertices, mesh.tets, options.size, is_inside);
        EXPECT_GT(share_obeyed(ratios), 0.9);
        EXPECT_NEAR(ratios[ratios.size() / 2], 1, 0.1);
    }
}

RunReport run_sized(const TemporaryFolder& folder, const Soup& soup, const SizeOptions& sizes, std::int32_t parts) {
    write_off(folder.file("input.off"), soup.vertices, soup.facets);
    RunRequest options;
    options.input = folder.file("input.off");
    options.output = folder.file("out");
    options.workers.program = test::worker_program();
    options.workers.count = 2;
    options.parts = parts;
    options.sizes = sizes;
    SingleRank rank;
    return run(options, 2, rank);
}

// Parts of equal work, the same on both sides of interfaces, and all obey the field.
TEST(RunOfSizes, ObeysTheFieldInOnePartAndInMany) {
    const TemporaryFolder folder;
    const Case sphere = cases().front();
    std::vector<std::int64_t> tets;
    for (const std::int32_t parts : {1, 8}) {
        SCOPED_TRACE(parts);
        const RunReport report = run_sized(folder, sphere.soup, sphere.options, parts);
        ASSERT_EQ(report.exit_code, 0);
        EXPECT_EQ(report.parts.size(), static_cast<std::size_t>(parts));
        EXPECT_TRUE(report.verification.passed);
        EXPECT_GT(report.mesh.sizes.inside.share_obeyed(), 0.9);
        EXPECT_EQ(report.mesh.sizes.by_patch.size(), 1U);
        if (parts > 1) {
            EXPECT_GT(report.mesh.sizes.interfaces.share_obeyed(), 0.85);
        }
        tets.push_back(report.mesh.tets);
        const auto [least, most] =
            std::minmax_element(report.parts.begin(), report.parts.end(),
                                [](const PartReport& a, const PartReport& b) { return a.result.tets < b.result.tets; });
        EXPECT_LT(static_cast<double>(most->result.tets), 2.5 * static_cast<double>(least->result.tets));
    }
    EXPECT_NEAR(static_cast<double>(tets[1]) / static_cast<double>(tets[0]), 1, 0.2);
}

}  // namespace
}  // namespace kerf

// Which body a tetrahedron belongs to.
#include "files/part/bodies.h"

#include <gtest/gtest.h>

#include "export/cases.h"
#include "files/part/joined_parts.h"
#include "files/part/run_parts.h"

namespace kerf {
namespace {

double volume_of(const TetMesh& mesh, const Tetrahedron& tet) {
    const auto corner = [&](std::size_t i) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(tet[i])]; };
    return (corner(1) - corner(0)).cross(corner(2) - corner(0)).dot(corner(3) - corner(0)) / 6;
}

std::vector<double> volumes_of_bodies(const PartSource& parts) {
    std::vector<double> volumes(static_cast<std::size_t>(parts.bodies().count()), 0);
    std::vector<std::int64_t> sizes(volumes.size(), 0);
    for (std::size_t r = 0; r < parts.outline().parts.size(); ++r) {
        const Part part = parts.load(PartIndex(r));
        const std::vector<std::int32_t> bodies = parts.bodies().of_tets(PartIndex(r), part);
        for (std::size_t t = 0; t < bodies.size(); ++t) {
            const auto body = static_cast<std::size_t>(bodies[t]);
            volumes[body] += volume_of(part.mesh, part.mesh.tets[t]);
            ++sizes[body];
        }
    }
    EXPECT_EQ(sizes, parts.bodies().sizes());
    return volumes;
}

// Two boxes of volume 1 and 2, in the order of the file; all others are one body, also in parts that meet nowhere, and
// with voids.
TEST(Bodies, HangTogetherWhateverThePartsAre) {
    for (const test::ExportCase& each : test::export_cases()) {
        SCOPED_TRACE(each.name);
        const RunParts run(test::run_of(each));
        const JoinedParts joined(run, (each.parts + 2) / 3), whole(run, 1);
        for (const PartSource* parts : {static_cast<const PartSource*>(&run), static_cast<const PartSource*>(&joined),
                                        static_cast<const PartSource*>(&whole)}) {
            const std::vector<double> volumes = volumes_of_bodies(*parts);
            if (each.name != "two_solids") {
                EXPECT_EQ(volumes.size(), 1U);
                continue;
            }
            ASSERT_EQ(volumes.size(), 2U);
            EXPECT_NEAR(volumes[0], 1, 1e-9);
            EXPECT_NEAR(volumes[1], 2, 1e-9);
        }
    }
}

// A part of two tetrahedra that do not touch, of which the second has the first facets of the input.
class TwoTets : public PartSource {
 public:
    TwoTets() {
        for (std::int32_t t = 0; t < 2; ++t) {
            const std::int32_t v = 4 * t;
            const Vec3 at(3.0 * t, 0, 0);
            for (const Vec3& step : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
                part_.mesh.vertices.push_back(at + step);
            part_.mesh.tets.push_back({v, v + 1, v + 2, v + 3});
            for (const auto& [a, b, c] : tet_faces) part_.facets.push_back({v + a, v + b, v + c});
            for (std::int32_t f = 0; f < 4; ++f) part_.facet.push_back(4 * (1 - t) + f);
        }
        part_.mesh.boundary_vertex_count = 8;
        part_.patch.assign(8, 0);
        part_.neighbour.assign(8, NodeId::none());
        for (std::int64_t v = 0; v < 8; ++v) part_.global_id.push_back(v);
        outline_.parts = {{root_node, 8, 2, 8, 0}};
        outline_.patch_names = {"all"};
    }
    const MeshOutline& outline() const override { return outline_; }
    Part load(PartIndex) const override { return part_; }

 private:
    Part part_;
    MeshOutline outline_;
};

TEST(Bodies, AreNumberedAsTheirFacetsAre) {
    const TwoTets parts;
    EXPECT_EQ(parts.bodies().of_tets(PartIndex(0), parts.load(PartIndex(0))), (std::vector<std::int32_t>{1, 0}));
}

}  // namespace
}  // namespace kerf

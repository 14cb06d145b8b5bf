// Facets that are coarser than sizes are divided where they lie.
#include "run/prepare/inside/facet_division.h"

#include <numeric>

#include <gtest/gtest.h>

#include "base/geometry/triangle.h"
#include "run/prepare/remeshing.h"
#include "support/shapes.h"
#include "support/size_fields.h"
#include "surface/complex/mass_properties.h"
#include "surface/size/mean_edge.h"

namespace kerf {
namespace {

// Each facet is a patch of its own, so that its pieces are known.
SurfaceArrays with_a_patch_each(SurfaceArrays surface) {
    std::iota(surface.patch.begin(), surface.patch.end(), 0);
    return surface;
}

double longest_edge_over_size(const SurfaceArrays& surface, const SizeField& wanted) {
    double most = 0;
    for (const Triangle& t : surface.facets)
        for (int i = 0; i < 3; ++i) {
            const Vec3 &a = surface.vertices[t[i]], &b = surface.vertices[t[(i + 1) % 3]];
            most = std::max(most, (b - a).norm() / wanted.at((a + b) / 2));
        }
    return most;
}

// Twice the area over the square of the longest edge: 0.87 of an equilateral triangle.
double least_shape(const SurfaceArrays& surface) {
    double least = 1;
    for (const Triangle& t : surface.facets) {
        const Vec3 &a = surface.vertices[t[0]], &b = surface.vertices[t[1]], &c = surface.vertices[t[2]];
        const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
        least = std::min(least, 2 * triangle_area(a, b, c) / (longest * longest));
    }
    return least;
}

// Pieces cover their facet, each once, and lie in it.
void expect_same_shape(const SurfaceArrays& before, const SurfaceArrays& after) {
    std::vector<double> area(before.facets.size(), 0);
    for (std::size_t f = 0; f < after.facets.size(); ++f) {
        const Triangle& parent = before.facets[after.patch[f]];
        const Vec3 &a = before.vertices[parent[0]], &b = before.vertices[parent[1]], &c = before.vertices[parent[2]];
        const Vec3 normal = (b - a).cross(c - a).normalized();
        const double reach = (b - a).norm() + (c - a).norm();
        Vec3 corners[3];
        for (int i = 0; i < 3; ++i) {
            corners[i] = after.vertices[after.facets[f][i]];
            EXPECT_NEAR(normal.dot(corners[i] - a), 0, 1e-14 * reach);
            for (const auto& [p, q] : {std::pair(a, b), {b, c}, {c, a}})
                EXPECT_GE(normal.dot((q - p).cross(corners[i] - p)), -1e-14 * reach * reach);
        }
        EXPECT_GT(normal.dot((corners[1] - corners[0]).cross(corners[2] - corners[0])), 0);
        area[after.patch[f]] += triangle_area(corners[0], corners[1], corners[2]);
    }
    for (std::size_t f = 0; f < area.size(); ++f) {
        const double whole = triangle_area(before.vertices, before.facets[f]);
        EXPECT_NEAR(area[f], whole, 1e-12 * whole);
    }
    for (std::size_t v = 0; v < before.vertices.size(); ++v) EXPECT_EQ(after.vertices[v], before.vertices[v]);
}

std::vector<SizeField> fields() {
    std::vector<SizeField> all;
    for (const double size : {0.3, 0.11, 0.04}) all.emplace_back(largest_volume_for(size));
    for (unsigned seed = 0; seed < 3; ++seed)
        for (SizeSources& sources : test::random_sources(seed)) {
            sources.growth = std::min(sources.growth, 0.5);
            if (sources.smallest() > 0.03 && sources.backgrounds.empty()) all.emplace_back(0, std::move(sources));
        }
    return all;
}

TEST(FacetDivision, KeepsTheShapeAndHasEdgesAsWanted) {
    const Soup bodies[] = {test::tetrahedron(), test::icosphere(2), test::box(Vec3::Zero(), Vec3(2, 1, 0.5), {3, 1, 2}),
                           test::torus(1, 0.3, 16, 8), test::nested_boxes(2)};
    for (const Soup& body : bodies)
        for (const SizeField& wanted : fields()) {
            const SurfaceArrays before = with_a_patch_each(test::to_arrays(body));
            const DividedSurface after = divide_facets(before, wanted);
            EXPECT_EQ(after.kept < static_cast<std::int64_t>(before.facets.size()),
                      has_facets_to_divide(Complex(Surface(before)), wanted));
            expect_same_shape(before, after.surface);
            EXPECT_TRUE(std::holds_alternative<Surface>(Surface::build(after.surface))) << "closed";
            if (!wanted.is_constant()) continue;
            EXPECT_LT(longest_edge_over_size(after.surface, wanted), 2);
            EXPECT_GE(least_shape(after.surface), std::min(0.3, 0.7 * least_shape(before)));
            const auto facets = static_cast<double>(after.surface.facets.size());
            if (facets > 10 * static_cast<double>(before.facets.size())) {
                EXPECT_NEAR(facets / forecast_divided_facets(before, wanted), 1, 0.2);
            }
            EXPECT_FALSE(has_facets_to_divide(Complex(Surface(after.surface)), wanted.coarser(8)));
        }
}

// Needles and flat triangles have a triangulation, too, if no good one.
TEST(FacetDivision, LeavesNoFacetWithoutTriangles) {
    for (const double height : {1e-3, 1e-9, 1e-17, 0.}) {
        Soup body = test::tetrahedron();
        for (Vec3& p : body.vertices) p.z() *= height;
        const SurfaceArrays after = divide_facets(test::to_arrays(body), SizeField(largest_volume_for(0.1))).surface;
        EXPECT_TRUE(std::holds_alternative<Surface>(Surface::build(after))) << height;
        EXPECT_GT(after.facets.size(), 100U);
    }
    Soup body = test::tetrahedron();
    for (Vec3& p : body.vertices) p = Vec3(p.x() + 2 * p.y() + 3 * p.z(), 0, 0);  // all facets are segments
    const DividedSurface after = divide_facets(test::to_arrays(body), SizeField(largest_volume_for(0.1)));
    EXPECT_TRUE(std::holds_alternative<Surface>(Surface::build(after.surface)));
}

TEST(FacetDivision, IsDoneByDefaultAndForbiddenByKeptFacets) {
    const Soup body = test::box(Vec3::Zero(), Vec3(2, 1, 0.5), {4, 2, 1});
    RunRequest options;
    options.sizes.size = 0.1;
    for (const bool are_kept : {false, true}) {
        const Input before = make_input(body.vertices, body.facets);
        options.remeshing = are_kept ? Remeshing::never : Remeshing::where_needed;
        EXPECT_EQ(surface_change(before, options), are_kept ? SurfaceChange::none : SurfaceChange::division);
        const double forecast = forecast_changed_facets(before, options);
        const Input after = remesh_where_asked(before, options);
        EXPECT_NEAR(static_cast<double>(after.facets), forecast, are_kept ? 0 : 0.2 * forecast);
        EXPECT_EQ(after.remeshed.has_value(), !are_kept);
        EXPECT_TRUE(after.notes.empty());
        if (are_kept) continue;
        EXPECT_TRUE(after.remeshed->only_divided);
        EXPECT_EQ(after.remeshed->facets_before, before.facets);
        EXPECT_EQ(after.remeshed->facets_kept, 0);
        EXPECT_NEAR(after.volume, before.volume, 1e-13);
    }
    options.remeshing = Remeshing::where_needed;
    for (const double coarse : {0., 0.6}) {
        options.sizes.size = coarse;
        EXPECT_EQ(surface_change(make_input(body.vertices, body.facets), options), SurfaceChange::none) << coarse;
    }
}

}  // namespace
}  // namespace kerf

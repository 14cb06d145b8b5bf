#include "run/prepare/inside/thin_layers.h"

#include "base/geometry/triangle.h"
#include "surface/soup/triangle_tree.h"

namespace kerf {

namespace {

constexpr double tangent_of_10 = 0.17632698070846498;
constexpr double rounding = 1e-6;  // of the radius

}  // namespace

std::vector<char> facets_on_thin_layers(const LabelledFacets& facets) {
    std::vector<char> result;
    if (facets.walls.empty()) return result;
    const SurfaceArrays& surface = facets.surface;
    const TriangleTree tree(surface.vertices, surface.facets);
    const auto any = [](std::int32_t) { return true; };
    for (std::size_t f = 0; f < surface.facets.size(); ++f) {
        const auto& [a, b, c] = surface.facets[f];
        const InscribedCircle circle = inscribed_circle(surface.vertices[a], surface.vertices[b], surface.vertices[c]);
        const auto is_thin = [&](const Vec3& way) {
            return tree.first_hit(circle.centre, way, rounding, tangent_of_10, any) < tangent_of_10;
        };
        result.push_back(is_thin(-circle.normal) || (facets.walls[f] != 0 && is_thin(circle.normal)) ? 1 : 0);
    }
    return result;
}

}  // namespace kerf

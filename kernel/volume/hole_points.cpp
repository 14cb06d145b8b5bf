// A candidate is the centroid of a facet of the void shell, moved a little along the normal, which points out of the
// material and so into the void. It is proven by the shells around it, found by the parity of crossings of a ray with
// each shell: they must be the shells around the void shell and the void shell itself, and outward and inward ones must
// cancel.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "core/error.h"
#include "geometry/triangle.h"
#include "surface/mass_properties.h"
#include "surface/ray_parity.h"
#include "volume/mesher.h"

namespace kerf {

namespace {

struct NestedShells {
    std::vector<Shell> shells;
    std::vector<char> is_void;
    BoxTree boxes;
};

NestedShells split_into_shells(const SurfaceArrays& surface) {
    const Components components = find_shells(Surface(surface));
    std::vector<Shell> shells = collect_shells(surface.vertices, surface.facets, components.of, components.count);
    std::vector<char> is_void;
    for (const Shell& shell : shells) is_void.push_back(!is_outward(surface.vertices, shell.facets));
    BoxTree boxes = boxes_of(shells);
    return {std::move(shells), std::move(is_void), std::move(boxes)};
}

// The shells around the point, ascending. Shell `self` is taken for one, because the point may lie on it.
std::optional<std::vector<std::int32_t>> shells_around(const SurfaceArrays& surface, const NestedShells& nested,
                                                       const Vec3& point, std::int32_t self) {
    std::vector<std::int32_t> around = {self};
    for (const std::int32_t s : nested.boxes.around(Eigen::AlignedBox3d(point, point))) {
        if (s == self) continue;
        const std::optional<bool> inside = encloses(surface.vertices, nested.shells[s], point);
        if (!inside) return std::nullopt;
        if (*inside) around.push_back(s);
    }
    std::sort(around.begin(), around.end());
    return around;
}

int winding_number(const NestedShells& nested, const std::vector<std::int32_t>& around) {
    int winding = 0;
    for (const std::int32_t s : around) winding += nested.is_void[s] ? -1 : 1;
    return winding;
}

// Twice the area vector of a facet; it points out of the material.
Vec3 normal(const SurfaceArrays& surface, const Triangle& t) { return doubled_area_vector(surface.vertices, t); }

std::vector<Triangle> largest_facets(const SurfaceArrays& surface, const Shell& shell, std::size_t count) {
    std::vector<double> area_sq(shell.facets.size());
    for (std::size_t f = 0; f < area_sq.size(); ++f) area_sq[f] = normal(surface, shell.facets[f]).squaredNorm();
    std::vector<std::size_t> order(shell.facets.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    count = std::min(count, order.size());
    std::partial_sort(
        order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
        [&](std::size_t f, std::size_t g) { return area_sq[f] != area_sq[g] ? area_sq[f] > area_sq[g] : f < g; });
    std::vector<Triangle> largest;
    for (std::size_t i = 0; i < count; ++i) largest.push_back(shell.facets[order[i]]);
    return largest;
}

Vec3 hole_point(const SurfaceArrays& surface, const NestedShells& nested, std::int32_t void_shell) {
    const Shell& shell = nested.shells[void_shell];
    const Vec3& on_shell = surface.vertices[shell.facets[0][0]];
    const auto wanted = shells_around(surface, nested, on_shell, void_shell);
    if (wanted && winding_number(nested, *wanted) == 0)
        for (const double step : {1e-3, 1e-5, 1e-7, 1e-9})
            for (const Triangle& t : largest_facets(surface, shell, 32)) {
                const Vec3 n = normal(surface, t);
                const Vec3 centroid = (surface.vertices[t[0]] + surface.vertices[t[1]] + surface.vertices[t[2]]) / 3;
                const Vec3 candidate = centroid + step * std::sqrt(n.norm()) * n.normalized();
                if (encloses(surface.vertices, shell, candidate) == true &&
                    shells_around(surface, nested, candidate, void_shell) == wanted)
                    return candidate;
            }
    throw Error(
        ErrorCode::subdomain,
        fmt::format("No point was found inside the void whose shell of {} facets passes through vertex {} "
                    "({:.17g}, {:.17g}, {:.17g}). The void may be thinner than the rounding of its coordinates, "
                    "or it may not lie inside of the material: check the nesting of the shells.",
                    shell.facets.size(), shell.facets[0][0], on_shell.x(), on_shell.y(), on_shell.z()));
}

}  // namespace

std::vector<Vec3> hole_points(const SurfaceArrays& surface) {
    const NestedShells nested = split_into_shells(surface);
    std::vector<Vec3> points;
    for (std::size_t s = 0; s < nested.shells.size(); ++s)
        if (nested.is_void[s]) points.push_back(hole_point(surface, nested, static_cast<std::int32_t>(s)));
    return points;
}

}  // namespace kerf

// A candidate is the centroid of a facet of the void shell, moved a little along the normal, which points out of the
// material and so into the void. It is proven by the shells around it, found by the parity of crossings of a ray with
// each shell: they must be the shells around the void shell and the void shell itself, and outward and inward ones must
// cancel. A crossing is decided by the signs of determinants that exceed their rounding error; where one does not (a
// ray through an edge, a point on a facet), the ray is cast again in another direction.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "core/error.h"
#include "surface/mass_properties.h"
#include "volume/mesher.h"

namespace kerf {

namespace {

struct Shell {
    std::vector<Triangle> facets;
    Eigen::AlignedBox3d box;
    bool is_void = false;
};

std::vector<Shell> split_into_shells(const SurfaceArrays& surface) {
    const Shells components = find_shells(Surface(surface));
    std::vector<Shell> shells(components.count);
    for (std::size_t f = 0; f < surface.facets.size(); ++f) {
        Shell& shell = shells[components.of_facet[f]];
        shell.facets.push_back(surface.facets[f]);
        for (std::int32_t v : surface.facets[f]) shell.box.extend(surface.vertices[v]);
    }
    for (Shell& shell : shells) shell.is_void = enclosed_volume(surface.vertices, shell.facets) < 0;
    return shells;
}

// Sign of det[a, b, c], 0 where rounding could have changed it. The relative bound covers the rounding of the product
// and of the differences from which the vectors come.
int certain_sign(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double det = a.dot(b.cross(c));
    if (std::abs(det) <= 1e-14 * a.norm() * b.norm() * c.norm()) return 0;
    return det > 0 ? 1 : -1;
}

// Whether the ray from the origin meets triangle abc; nothing if rounding leaves it open.
std::optional<bool> ray_meets(const Vec3& direction, const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto [low, high] =
        std::minmax({certain_sign(direction, a, b), certain_sign(direction, b, c), certain_sign(direction, c, a)});
    if (low < 0 && high > 0) return false;
    const int side = certain_sign(a, b, c);
    if (low * high == 0 || side == 0) return std::nullopt;
    return low == side;
}

std::optional<bool> encloses_along(const SurfaceArrays& surface, const Shell& shell, const Vec3& point,
                                   const Vec3& direction) {
    bool inside = false;
    for (const auto& [a, b, c] : shell.facets) {
        const std::optional<bool> meets =
            ray_meets(direction, surface.vertices[a] - point, surface.vertices[b] - point, surface.vertices[c] - point);
        if (!meets) return std::nullopt;
        inside ^= *meets;
    }
    return inside;
}

// Nothing if no direction decides: the point lies on the shell.
std::optional<bool> encloses(const SurfaceArrays& surface, const Shell& shell, const Vec3& point) {
    if (!shell.box.contains(point)) return false;
    static const std::array<Vec3, 5> directions = {Vec3(0.819, 0.403, 0.409), Vec3(-0.287, 0.911, 0.297),
                                                   Vec3(0.173, -0.541, 0.823), Vec3(-0.613, -0.337, -0.715),
                                                   Vec3(0.521, 0.127, -0.844)};
    for (const Vec3& direction : directions)
        if (const std::optional<bool> inside = encloses_along(surface, shell, point, direction)) return inside;
    return std::nullopt;
}

// For each shell whether the point lies inside of it; shell `self` is taken as given, because the point may lie on it.
std::optional<std::vector<bool>> shells_around(const SurfaceArrays& surface, const std::vector<Shell>& shells,
                                               const Vec3& point, std::size_t self) {
    std::vector<bool> around(shells.size(), true);
    for (std::size_t s = 0; s < shells.size(); ++s) {
        if (s == self) continue;
        const std::optional<bool> inside = encloses(surface, shells[s], point);
        if (!inside) return std::nullopt;
        around[s] = *inside;
    }
    return around;
}

int winding_number(const std::vector<Shell>& shells, const std::vector<bool>& around) {
    int winding = 0;
    for (std::size_t s = 0; s < shells.size(); ++s)
        if (around[s]) winding += shells[s].is_void ? -1 : 1;
    return winding;
}

// Twice the area vector of a facet; it points out of the material.
Vec3 normal(const SurfaceArrays& surface, const Triangle& t) {
    const Vec3& a = surface.vertices[t[0]];
    return (surface.vertices[t[1]] - a).cross(surface.vertices[t[2]] - a);
}

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

Vec3 hole_point(const SurfaceArrays& surface, const std::vector<Shell>& shells, std::size_t void_shell) {
    const Shell& shell = shells[void_shell];
    const Vec3& on_shell = surface.vertices[shell.facets[0][0]];
    const auto wanted = shells_around(surface, shells, on_shell, void_shell);
    if (wanted && winding_number(shells, *wanted) == 0)
        for (const double step : {1e-3, 1e-5, 1e-7, 1e-9})
            for (const Triangle& t : largest_facets(surface, shell, 32)) {
                const Vec3 n = normal(surface, t);
                const Vec3 centroid = (surface.vertices[t[0]] + surface.vertices[t[1]] + surface.vertices[t[2]]) / 3;
                const Vec3 candidate = centroid + step * std::sqrt(n.norm()) * n.normalized();
                if (encloses(surface, shell, candidate) == true &&
                    shells_around(surface, shells, candidate, void_shell) == wanted)
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
    const std::vector<Shell> shells = split_into_shells(surface);
    std::vector<Vec3> points;
    for (std::size_t s = 0; s < shells.size(); ++s)
        if (shells[s].is_void) points.push_back(hole_point(surface, shells, s));
    return points;
}

}  // namespace kerf

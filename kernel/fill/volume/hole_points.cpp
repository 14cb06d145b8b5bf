// A candidate is the centroid of a facet of the void shell, moved a little along the normal, which points out of the
// material and so into the void. It is proven by the shells around it, found by the parity of crossings of a ray with
// each shell: they must be the shells around the void shell and the void shell itself, and outward and inward ones must
// cancel. Where the body touches itself, a shell is the boundary of one room outside of it, because the meshers fill
// rooms that meet only at an edge or a vertex.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "base/core/error.h"
#include "base/geometry/triangle.h"
#include "fill/volume/mesher.h"
#include "surface/complex/mass_properties.h"
#include "surface/complex/touching.h"
#include "surface/soup/ray_parity.h"

namespace kerf {

namespace {

struct NestedShells {
    std::vector<Shell> shells;
    std::vector<char> is_void;
    BoxTree boxes;
    std::vector<char> is_touching;  // per vertex: other shells may be there, too; empty if none are
};

std::vector<char> touching_vertices(const SeparatedSurface& separated, std::size_t vertex_count) {
    if (!separated.touches()) return {};
    std::vector<char> is_touching(vertex_count, 0);
    for (std::size_t copy = vertex_count; copy < separated.original.size(); ++copy)
        is_touching[separated.original[copy]] = 1;
    return is_touching;
}

NestedShells split_into_shells(const SurfaceArrays& surface) {
    SurfaceArrays inside_out = surface;  // wedges of the body are those of the room outside of it
    for (Triangle& t : inside_out.facets) std::swap(t[1], t[2]);
    const SeparatedSurface rooms = separate_touching(std::move(inside_out));
    UnionFind facets(surface.facets.size());
    for (std::size_t c = 0; c < rooms.partner.size(); ++c) facets.join(c / 3, rooms.partner[c] / 3);
    const Components components = facets.take();
    std::vector<Shell> shells = collect_shells(surface.vertices, surface.facets, components.of, components.count);
    std::vector<char> is_void;
    for (const Shell& shell : shells) is_void.push_back(!is_outward(surface.vertices, shell.facets));
    BoxTree boxes = boxes_of(shells);
    return {std::move(shells), std::move(is_void), std::move(boxes), touching_vertices(rooms, surface.vertices.size())};
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
    std::partial_sort(order.begin(), order.begin() + count, order.end(), [&](std::size_t f, std::size_t g) {
        return area_sq[f] != area_sq[g] ? area_sq[f] > area_sq[g] : f < g;
    });
    std::vector<Triangle> largest;
    for (std::size_t i = 0; i < count; ++i) largest.push_back(shell.facets[order[i]]);
    return largest;
}

Vec3 centroid_of(const SurfaceArrays& surface, const Triangle& t) {
    return (surface.vertices[t[0]] + surface.vertices[t[1]] + surface.vertices[t[2]]) / 3;
}

// Returns a point of the shell that lies on no other one: a vertex, or, where all of them may be on others, the middle
// of a facet.
Vec3 point_of(const SurfaceArrays& surface, const NestedShells& nested, const Shell& shell) {
    for (const Triangle& t : shell.facets)
        for (const std::int32_t v : t)
            if (nested.is_touching.empty() || !nested.is_touching[v]) return surface.vertices[v];
    return centroid_of(surface, largest_facets(surface, shell, 1)[0]);
}

Vec3 hole_point(const SurfaceArrays& surface, const NestedShells& nested, std::int32_t void_shell) {
    const Shell& shell = nested.shells[void_shell];
    const Vec3 on_shell = point_of(surface, nested, shell);
    const auto wanted = shells_around(surface, nested, on_shell, void_shell);
    if (wanted && winding_number(nested, *wanted) == 0)
        for (const double step : {1e-3, 1e-5, 1e-7, 1e-9})
            for (const Triangle& t : largest_facets(surface, shell, 32)) {
                const Vec3 n = normal(surface, t);
                const Vec3 candidate = centroid_of(surface, t) + step * std::sqrt(n.norm()) * n.normalized();
                if (encloses(surface.vertices, shell, candidate) == true &&
                    shells_around(surface, nested, candidate, void_shell) == wanted)
                    return candidate;
            }
    throw Error(
        ErrorCode::subdomain,
        fmt::format("No point was found inside the void whose shell of {} facets passes through "
                    "({:.17g}, {:.17g}, {:.17g}). The void may be thinner than the rounding of its coordinates, "
                    "or it may not lie inside of the material: check the nesting of the shells.",
                    shell.facets.size(), on_shell.x(), on_shell.y(), on_shell.z()));
}

}  // namespace

std::vector<Vec3> hole_points(const SurfaceArrays& surface) {
    const NestedShells nested = split_into_shells(surface);
    std::vector<Vec3> points;
    for (std::size_t s = 0; s < nested.shells.size(); ++s)
        if (nested.is_void[s]) points.push_back(hole_point(surface, nested, s));
    return points;
}

}  // namespace kerf

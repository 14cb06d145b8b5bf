// Around each point, the body has the winding number w = 0 or 1, and those of the halves add up to it, because they
// have the interface in opposite directions. Along a shell of a half, w behind the shell is the same everywhere, and in
// front of it one less, because nothing crosses it. Above the half below, that half has w = 0 and the other one that of
// the body: a shell that reaches there is in its place. So only shells between the highest point of the half below and
// the lowest one of the half above remain to be checked.
#include "cut/cut/inside/shell_placement.h"

#include <algorithm>
#include <optional>

#include "base/core/check.h"
#include "surface/complex/mass_properties.h"
#include "surface/complex/touching.h"
#include "surface/soup/ray_parity.h"

namespace kerf {

namespace {

bool contains(const HeightSpan& span, double low, double high) { return low >= span.low && high <= span.high; }

constexpr std::size_t most_centroids = 16;

// Points of a shell that lie on no other one: a vertex without copies, or where there is none the middle of facets.
std::vector<Vec3> points_of(const SurfaceArrays& arrays, const Array<Vertex, char>& copied, const Shell& shell) {
    for (const Triangle& t : shell.facets)
        for (const std::int32_t v : t)
            if (copied.empty() || !copied[v]) return {arrays.vertices[v]};
    std::vector<Vec3> points;
    for (std::size_t f = 0; f < std::min(most_centroids, shell.facets.size()); ++f) {
        const Triangle& t = shell.facets[f];
        points.push_back((arrays.vertices[t[0]] + arrays.vertices[t[1]] + arrays.vertices[t[2]]) / 3);
    }
    return points;
}

// Returns the number of other shells around the point; nothing if it lies on one.
std::optional<int> depth_of(const Vec3& point, const SurfaceArrays& arrays, const std::vector<Shell>& shells,
                            const BoxTree& boxes, std::int32_t self) {
    int depth = 0;
    for (const std::int32_t s : boxes.around(Eigen::AlignedBox3d(point, point))) {
        if (s == self) continue;
        const std::optional<bool> inside = encloses(arrays.vertices, shells[s], point);
        if (!inside) return std::nullopt;
        depth += *inside;
    }
    return depth;
}

// Per shell whether all of it lies within the heights.
std::vector<char> shells_within(const Surface& half, const Components& shells, const Plane& plane,
                                const HeightSpan& span) {
    std::vector<char> is_within(shells.count, 1);
    for (const Facet f : half.facets())
        for (const Vertex v : half.corners(f)) {
            const double height = plane.distance(half.point(v));
            if (!contains(span, height, height)) is_within[shells.of[f.value()]] = 0;
        }
    return is_within;
}

}  // namespace

HeightSpan shared_heights(const Band& band, const Array<Facet, Side>& side, const Interface& interface) {
    double low = 0, high = 0;  // facets off the band lie on their side of the plane
    for (const SlabFacet& facet : band.slab) {
        if (band.index_of[facet.facet] < 0) continue;
        if (side[facet.facet] == Side::below)
            high = std::max(high, facet.high);
        else
            low = std::min(low, facet.low);
    }
    for (const Vec3& point : interface.points) {
        low = std::min(low, band.plane.distance(point));
        high = std::max(high, band.plane.distance(point));
    }
    return {low - band.rounding, high + band.rounding};
}

bool may_misplace_shells(const Surface& surface, const Band& band, const Array<Facet, Side>& side,
                         const HeightSpan& shared) {
    KERF_CHECK(band.fits(surface) && fit(side, surface));
    if (shared.low <= -band.half_width || shared.high >= band.half_width) return true;
    const auto is_within = [&](Facet facet) {
        const SlabFacet own = band.reach_of(surface, facet);
        return contains(shared, own.low, own.high);
    };
    std::vector<char> is_seen(band.facets.size(), 0);
    std::vector<std::int32_t> patch;  // of equal labels
    for (std::int32_t seed = 0; seed < count_of(is_seen); ++seed) {
        if (is_seen[seed] || !is_within(band.facets[seed])) continue;
        bool reaches_out = false;
        is_seen[seed] = 1;
        patch.assign(1, seed);
        for (std::size_t i = 0; i < patch.size(); ++i)
            for (const HalfEdge h : band.half_edges[patch[i]]) {
                const Facet neighbour = surface.facet_of(Surface::opposite(h));
                const std::int32_t j = band.index_of[neighbour];
                if (side[neighbour] != side[band.facets[patch[i]]]) continue;
                if (j < 0 || !is_within(neighbour)) {
                    reaches_out = true;
                } else if (!is_seen[j]) {
                    is_seen[j] = 1;
                    patch.push_back(j);
                }
            }
        if (!reaches_out) return true;
    }
    return false;
}

Vertex find_misplaced_shell(const Surface& half, const Plane& plane, const HeightSpan& within) {
    KERF_CHECK(half.facet_count() > 0);
    const Components components = find_shells(half);
    const std::vector<char> is_asked = shells_within(half, components, plane, within);
    if (std::find(is_asked.begin(), is_asked.end(), 1) == is_asked.end()) return Vertex::none();
    if (components.count == 1) return enclosed_volume(half) > 0 ? Vertex::none() : Vertex(0);
    const SurfaceArrays arrays = half.arrays();
    const std::vector<Shell> shells = collect_shells(arrays.vertices, arrays.facets, components.of, components.count);
    const BoxTree boxes = boxes_of(shells);
    const Array<Vertex, char> copied = copied_vertices(half);
    for (std::int32_t i = 0; i < count_of(shells); ++i) {
        if (!is_asked[i]) continue;
        const Vertex vertex(shells[i].facets[0][0]);
        std::optional<int> depth;
        for (const Vec3& point : points_of(arrays, copied, shells[i]))
            if (!depth) depth = depth_of(point, arrays, shells, boxes, i);
        if (!depth) return vertex;  // it touches another shell
        const bool is_void = *depth % 2 == 1;
        if (is_outward(arrays.vertices, shells[i].facets) == is_void) return vertex;
    }
    return Vertex::none();
}

}  // namespace kerf

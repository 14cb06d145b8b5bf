// Scan conversion without any predicate. In a plane z = k through sites, every edge of the surface that runs from below
// to above has a point, the same for both of its facets because it depends on the two ends alone; so a facet in the
// plane is a segment between two such points, and the segments form closed polygons. A line of sites in the plane
// crosses a facet if its y is in the half-open interval of the segment: an even number of times, since the ends are
// shared. Rounding moves points along edges, and polygons on the surface; a site that is not on the surface stays on
// its side.
#include "fill/lattice/inside/sites_inside.h"

#include <algorithm>
#include <cmath>
#include <compare>

#include <Eigen/Geometry>

#include "base/core/error.h"
#include "base/geometry/box.h"

namespace kerf {

namespace {

// A line of sites enters or leaves the body: between site x - 2 and site x.
struct LineCrossing {
    std::int32_t z, y, x;
    auto operator<=>(const LineCrossing&) const = default;
};

// Returns the first site on a line of this parity that is not before `at`.
std::int32_t first_site(double at, std::int32_t parity) {
    const std::int32_t site = std::ceil(at);
    return site + ((site ^ parity) & 1);
}

// Returns the point at a part of the way from a to b, never beyond, for any rounding.
double between(double a, double b, double part) {
    const double x = a + part * (b - a);
    return std::clamp(x, std::min(a, b), std::max(a, b));
}

struct PlanePoint {
    double y, x;
};

// Returns the point at which the edge crosses the plane. Requires low[2] <= z < high[2].
PlanePoint edge_in_plane(const Vec3& low, const Vec3& high, double z) {
    const double part = (z - low[2]) / (high[2] - low[2]);
    return {between(low[1], high[1], part), between(low[0], high[0], part)};
}

// Finds the points of the two edges of a facet that run from below the plane to above; false if there are none.
bool facet_in_plane(const std::array<Vec3, 3>& corners, double z, std::array<PlanePoint, 2>& segment) {
    int found = 0;
    for (int i = 0; i < 3; ++i) {
        const Vec3 &a = corners[i], &b = corners[(i + 1) % 3];
        if ((a[2] <= z) == (b[2] <= z)) continue;
        segment[found++] = a[2] <= z ? edge_in_plane(a, b, z) : edge_in_plane(b, a, z);
    }
    if (found > 0 && segment[1].y < segment[0].y) std::swap(segment[0], segment[1]);
    return found > 0;
}

void add_crossings(const std::array<Vec3, 3>& corners, std::vector<LineCrossing>& crossings) {
    const double lowest = std::min({corners[0][2], corners[1][2], corners[2][2]});
    const double highest = std::max({corners[0][2], corners[1][2], corners[2][2]});
    for (std::int32_t z = std::ceil(lowest); z < highest; ++z) {
        std::array<PlanePoint, 2> segment;
        if (!facet_in_plane(corners, z, segment)) continue;
        const auto& [p, q] = segment;
        for (std::int32_t y = first_site(p.y, z); y < q.y; y += 2)
            crossings.push_back({z, y, first_site(between(p.x, q.x, (y - p.y) / (q.y - p.y)), z)});
    }
}

// Returns the coordinates of all vertices in the units of sites.
std::vector<Vec3> in_half_edges(const std::vector<Vec3>& vertices, const BccLattice& lattice) {
    std::vector<Vec3> coordinates;
    coordinates.reserve(vertices.size());
    for (const Vec3& p : vertices) coordinates.push_back(lattice.coordinates(p));
    return coordinates;
}

constexpr int half_edges_per_block = 2 * block_edge;

std::int32_t block_of(std::int32_t half_edges) { return half_edges >> 4; }

// Returns the index, still without blocks. No block holds sites outside of the bounding box.
BlockIndex index_for(const std::vector<Vec3>& coordinates) {
    const Box box = box_around(coordinates);
    if (box.isEmpty()) return {};
    constexpr double furthest = BccLattice::most_half_edges - 2.0 * half_edges_per_block;
    constexpr double largest = half_edges_per_block * (BlockIndex::most_blocks - 2.0);
    if (!(box.max().maxCoeff() < furthest && box.min().minCoeff() > -furthest && box.sizes().maxCoeff() < largest))
        throw Error(ErrorCode::usage,
                    "The volume bound is too small for the coordinates of the surface: the edges of the lattice would "
                    "be too short to be told apart. Choose a larger bound, or move the surface to the origin.");
    BlockCoordinates lowest;
    for (int axis = 0; axis < 3; ++axis) lowest[axis] = block_of(std::floor(box.min()[axis]));
    return BlockIndex(lowest);
}

// Blocks in a row along x.
struct BlockSpan {
    std::int32_t y, first_x, last_x;
    auto operator<=>(const BlockSpan&) const = default;
};

// The sites of a line between two crossings.
struct LineSpan {
    std::int32_t first_x, end_x;  // cubes
    bool empty() const { return first_x == end_x; }
};

LineSpan span_between(const LineCrossing& in, const LineCrossing& out) { return {in.x >> 1, out.x >> 1}; }

// Returns the end of the crossings of one layer of blocks, from `begin` on. They come in pairs.
std::size_t end_of_layer(const std::vector<LineCrossing>& crossings, std::size_t begin) {
    std::size_t end = begin;
    while (end < crossings.size() && block_of(crossings[end].z) == block_of(crossings[begin].z)) ++end;
    return end;
}

void append_blocks(std::vector<BlockSpan> spans, std::int32_t z, BlockIndex& blocks) {
    std::sort(spans.begin(), spans.end());
    std::int32_t y = 0, next = 0;
    for (std::size_t i = 0; i < spans.size(); ++i) {
        const BlockSpan& span = spans[i];
        if (i == 0 || span.y != y) y = span.y, next = span.first_x;
        for (next = std::max(next, span.first_x); next <= span.last_x; ++next) blocks.append({next, y, z});
    }
}

// Appends all blocks with sites between the crossings.
void append_blocks(const std::vector<LineCrossing>& crossings, BlockIndex& blocks) {
    for (std::size_t begin = 0, end = 0; begin < crossings.size(); begin = end) {
        end = end_of_layer(crossings, begin);
        std::vector<BlockSpan> spans;
        for (std::size_t i = begin; i < end; i += 2) {
            const LineSpan span = span_between(crossings[i], crossings[i + 1]);
            if (span.empty()) continue;
            spans.push_back({block_of(crossings[i].y), span.first_x >> 3, (span.end_x - 1) >> 3});
        }
        append_blocks(std::move(spans), block_of(crossings[begin].z), blocks);
    }
}

void set_bits(const LineCrossing& in, const LineSpan& span, SiteSet& sites) {
    const int row = row_number(in.z & 1, in.y >> 1 & (block_edge - 1), in.z >> 1 & (block_edge - 1));
    std::int32_t x = span.first_x >> 3;
    std::int32_t block = sites.blocks.lower_bound({x, block_of(in.y), block_of(in.z)});
    for (; x <= (span.end_x - 1) >> 3; ++x, ++block) {
        const int first = std::max(span.first_x - block_edge * x, 0);
        const int end = std::min(span.end_x - block_edge * x, block_edge);
        // Bits from `first` to before `end`; a line may come through a block more than once.
        sites.bits[block][row] |= (1U << end) - (1U << first);
    }
}

std::vector<LineCrossing> sorted_crossings(const SurfaceArrays& surface, const std::vector<Vec3>& coordinates) {
    std::vector<LineCrossing> crossings;
    for (const Triangle& t : surface.facets)
        add_crossings({coordinates[t[0]], coordinates[t[1]], coordinates[t[2]]}, crossings);
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i < crossings.size(); i += 2)
        if (i + 1 == crossings.size() || crossings[i].y != crossings[i + 1].y || crossings[i].z != crossings[i + 1].z)
            throw Error(ErrorCode::internal, "The surface of a part that shall get a lattice is not closed.");
    return crossings;
}

}  // namespace

SiteSet sites_inside(const SurfaceArrays& surface, const BccLattice& lattice) {
    const std::vector<Vec3> coordinates = in_half_edges(surface.vertices, lattice);
    SiteSet sites;
    sites.blocks = index_for(coordinates);
    const std::vector<LineCrossing> crossings = sorted_crossings(surface, coordinates);
    append_blocks(crossings, sites.blocks);
    sites.bits.resize(sites.blocks.size());
    for (std::size_t i = 0; i < crossings.size(); i += 2) {
        const LineSpan span = span_between(crossings[i], crossings[i + 1]);
        if (!span.empty()) set_bits(crossings[i], span, sites);
    }
    return sites;
}

}  // namespace kerf

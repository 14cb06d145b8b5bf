// Vertices are clustered on a grid (Rossignac and Borrel 1993, rossignac1993). A cell is known by its code along
// Morton's curve, and eight that are joined have codes that follow each other: joining is a shift by three bits, and
// sorted cells stay sorted. A corner of a triangle is a place in the sorted cells of its part; after a join it is
// looked up again, triangles with two equal corners go, and of equal ones all but one. Each cell sums up its vertices
// over all parts, so that both sides of an interface get the same places. Parts are coarsened as soon as the limit is
// passed, while others are still to come: the result depends on their order, and memory on the limit.
#include "files/html/inside/page_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/geometry/morton_order.h"

namespace kerf {

namespace {

constexpr int grid_bits = 16;
constexpr std::int64_t last_step = (1 << grid_bits) - 1;

// morton_code() has 21 bits a coordinate: the middle of a step is far enough from its ends for the rounding of floats.
std::uint64_t code_of(const PageSurface::GridPoint& point) {
    constexpr int more_bits = 21 - grid_bits;
    constexpr float most = (1 << 21) - 1, half = 1 << (more_bits - 1);
    std::array<float, 3> scaled;
    for (int i = 0; i < 3; ++i) scaled[i] = ((point[i] << more_bits) + half) / most;
    return morton_code(scaled) >> (3 * more_bits);
}

void keep_each_once(std::vector<std::uint64_t>& codes) {
    codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
}

std::int32_t number_in(const std::vector<std::uint64_t>& codes, std::uint64_t code) {
    return std::lower_bound(codes.begin(), codes.end(), code) - codes.begin();
}

// Adds up values and counts of finer cells, or of vertices, in the cells of a part; none if there are no fields.
template <class NumberOf>
void take_values(const VertexValues& values, const std::vector<std::int64_t>& counts, const NumberOf& number_of,
                 PagePart& part) {
    if (values.empty()) return;
    VertexValues sums(values.size(), std::vector<double>(part.cells.size(), 0));
    std::vector<std::int64_t> count(part.cells.size(), 0);
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const std::int32_t cell = number_of(i);
        count[cell] += counts[i];
        for (std::size_t k = 0; k < values.size(); ++k) sums[k][cell] += values[k][i];
    }
    part.value_sums = std::move(sums);
    part.vertex_counts = std::move(count);
}

bool has_two_equal(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

}  // namespace

PageSurface::PageSurface(const Box& box, std::int64_t limit)
    : low_(box.min()),
      step_(std::max(box.sizes().maxCoeff() / last_step, std::numeric_limits<double>::min())),
      limit_(limit) {}

PageSurface::GridPoint PageSurface::grid_point(const Vec3& point) const {
    GridPoint steps;
    for (int i = 0; i < 3; ++i)
        steps[i] = std::clamp<std::int64_t>(std::llround((point[i] - low_[i]) / step_), 0, last_step);
    return steps;
}

void PageSurface::add(const Part& part, const VertexValues& values) {
    PagePart added{part.id, part.region_of(0), {}, {}};
    const std::int64_t vertex_count = part.mesh.boundary_vertex_count;
    std::vector<std::uint64_t> cell_of_vertex(vertex_count);
    for (std::int64_t v = 0; v < vertex_count; ++v) {
        const GridPoint point = grid_point(part.mesh.vertices[v]);
        cell_of_vertex[v] = code_of(point) >> (3 * joins_);
        cells_.push_back({cell_of_vertex[v], point, 1});
    }
    join_equal_cells();
    added.cells = cell_of_vertex;
    std::sort(added.cells.begin(), added.cells.end());
    keep_each_once(added.cells);
    const std::vector<std::int64_t> each_once(cell_of_vertex.size(), 1);
    take_values(
        values, each_once, [&](std::size_t v) { return number_in(added.cells, cell_of_vertex[v]); }, added);
    std::vector<PageTriangle> triangles(part.facets.size());
    for (std::size_t f = 0; f < triangles.size(); ++f) {
        triangles[f] = {part.neighbour[f], part.patch[f], {}};
        for (int i = 0; i < 3; ++i) triangles[f].corners[i] = number_in(added.cells, cell_of_vertex[part.facets[f][i]]);
    }
    triangles_of_run_ += std::ssize(triangles);
    take_triangles(std::move(triangles), added);
    parts_.push_back(std::move(added));
    while (triangles_ > limit_ && joins_ < grid_bits) coarsen();
}

void PageSurface::join_equal_cells() {
    std::sort(cells_.begin(), cells_.end(), [](const Cell& a, const Cell& b) { return a.code < b.code; });
    std::size_t count = 0;
    for (const Cell& cell : cells_) {
        if (count == 0 || cells_[count - 1].code != cell.code) {
            cells_[count++] = cell;
            continue;
        }
        Cell& last = cells_[count - 1];
        for (int i = 0; i < 3; ++i) last.sum[i] += cell.sum[i];
        last.count += cell.count;
    }
    cells_.resize(count);
}

void PageSurface::take_triangles(std::vector<PageTriangle> triangles, PagePart& part) {
    std::erase_if(triangles, [](const PageTriangle& t) { return has_two_equal(t.corners); });
    for (PageTriangle& t : triangles)
        std::rotate(t.corners.begin(), std::min_element(t.corners.begin(), t.corners.end()), t.corners.end());
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    triangles_ += std::ssize(triangles);
    part.triangles = std::move(triangles);
}

void PageSurface::coarsen() {
    ++joins_;
    for (Cell& cell : cells_) cell.code >>= 3;
    join_equal_cells();
    triangles_ = 0;
    for (PagePart& part : parts_) {
        for (std::uint64_t& code : part.cells) code >>= 3;
        const std::vector<std::uint64_t> finer = part.cells;
        keep_each_once(part.cells);
        const VertexValues values = std::move(part.value_sums);
        const std::vector<std::int64_t> counts = std::move(part.vertex_counts);
        take_values(
            values, counts, [&](std::size_t i) { return number_in(part.cells, finer[i]); }, part);
        for (PageTriangle& t : part.triangles)
            for (std::int32_t& corner : t.corners) corner = number_in(part.cells, finer[corner]);
        take_triangles(std::move(part.triangles), part);
    }
}

PageSurface::GridPoint PageSurface::place_of(std::uint64_t code) const {
    const auto cell = std::lower_bound(cells_.begin(), cells_.end(), code,
                                       [](const Cell& c, std::uint64_t other) { return c.code < other; });
    GridPoint place;
    for (int i = 0; i < 3; ++i) place[i] = (cell->sum[i] + cell->count / 2) / cell->count;
    return place;
}

}  // namespace kerf

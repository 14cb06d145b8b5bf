// The surfaces of all parts of a run, coarse enough to be sent with a page.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/core/ids.h"
#include "base/geometry/box.h"
#include "files/part/part.h"

namespace kerf {

/// A boundary triangle of a part in a page.
struct PageTriangle {
    NodeId neighbour = NodeId::none();  ///< part on the other side, none on the outer surface
    std::int32_t patch = -1;            ///< patch of the user's surface, -1 on interfaces
    Triangle corners{0, 0, 0};          ///< numbers of PagePart::cells

    auto operator<=>(const PageTriangle&) const = default;
};

/// The values of a solution at the boundary vertices of a part: a list for each field.
using VertexValues = std::vector<std::vector<double>>;

/// The boundary of a part in a page.
struct PagePart {
    NodeId id = root_node;
    RegionIndex region;
    std::vector<std::uint64_t> cells;              ///< #V; cells that hold vertices of the part, ascending
    std::vector<PageTriangle> triangles;           ///< #F; ascending, each once, seen from outside
    VertexValues value_sums = {};                  ///< of each field #V; the sum over the part's vertices in each cell
    std::vector<std::int64_t> vertex_counts = {};  ///< #V; number of these vertices

    /// Returns the mean of a field in a cell.
    double value(std::size_t field, std::size_t cell) const { return value_sums[field][cell] / vertex_counts[cell]; }
};

/// Boundaries of parts on a grid of 2^16 cells along the longest side of the run's box. Where the triangles of all
/// parts are more than a limit, cells are joined by eights until they are not (vertex clustering, rossignac1993),
/// in all parts alike, so that interfaces still fit: a triangle with two corners in one cell goes away, and a corner
/// lies in the middle of the vertices of its cell. Depends on the parts and their order alone. Memory: the limit and a
/// part.
class PageSurface {
 public:
    using GridPoint = std::array<std::int64_t, 3>;

    /// Takes a box with all vertices of all parts, and the most triangles that are kept, `limit` > 0.
    PageSurface(const Box& box, std::int64_t limit);

    /// Takes the boundary of a part, with values of so many fields at its boundary vertices. O(#F log #F + cells of all
    /// parts before).
    void add(const Part& part, const VertexValues& values = {});

    const std::vector<PagePart>& parts() const { return parts_; }
    std::int64_t triangles() const { return triangles_; }
    std::int64_t triangles_of_run() const { return triangles_of_run_; }
    /// Returns the number of times that cells were joined: 0 if each vertex has its own place.
    int joins() const { return joins_; }
    /// Returns the middle of the vertices of a cell of parts(), in steps from low(). O(log cells).
    GridPoint place_of(std::uint64_t cell) const;
    const Vec3& low() const { return low_; }
    double step() const { return step_; }

 private:
    // The sum of the vertices of a cell, for their middle.
    struct Cell {
        std::uint64_t code = 0;
        GridPoint sum{0, 0, 0};
        std::int64_t count = 0;
    };
    GridPoint grid_point(const Vec3& point) const;
    void join_equal_cells();
    void take_triangles(std::vector<PageTriangle> triangles, PagePart& part);
    void coarsen();

    Vec3 low_;
    double step_;
    std::int64_t limit_;
    int joins_ = 0;
    std::int64_t triangles_ = 0, triangles_of_run_ = 0;
    std::vector<Cell> cells_;  // of all parts, ascending
    std::vector<PagePart> parts_;
};

}  // namespace kerf

// Tests whether a point is inside of a closed shell, by exact counting of crossings.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "base/core/types.h"
#include "base/geometry/box_tree.h"

namespace kerf {

/// A closed set of facets over shared vertices, with its bounding box.
struct Shell {
    std::vector<Triangle> facets;
    Box box;

    // The state that encloses() keeps between calls: a shell that is asked often gets a tree of its facets.
    struct Memory {
        std::atomic<std::int32_t> questions = 0;
        std::once_flag is_built;
        std::unique_ptr<const BoxTree> tree;
    };
    std::shared_ptr<Memory> memory = std::make_shared<Memory>();
};

/// Groups facets by their shell number in [0, count), in ascending order of facets. `shell_of_facet`: #F.
std::vector<Shell> collect_shells(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                  const std::vector<std::int32_t>& shell_of_facet, std::int32_t count);

/// Returns a tree of the boxes of the shells, each of which must have facets.
BoxTree boxes_of(const std::vector<Shell>& shells);

/// Returns the numbers of the shells by their boxes, the largest first: a shell that contains another one comes before
/// it. Rounding cannot break this, as the computed size is monotone; for equal sizes the sides decide.
std::vector<std::int32_t> by_falling_boxes(const std::vector<Shell>& shells);

/// Whether the point lies inside of the shell: a segment from it to the outside crosses the shell an odd number of
/// times. Exact predicates decide about crossings; a segment that touches an edge or a vertex decides nothing and is
/// replaced by the next of a fixed sequence. Returns nothing if no segment decides, as for a point on the shell. O(#F);
/// after some questions, all of which must pass the same vertices, O(log #F) and the facets near the segment. Several
/// threads may ask.
std::optional<bool> encloses(const std::vector<Vec3>& vertices, const Shell& shell, const Vec3& point);

}  // namespace kerf

// The comparison of a remeshed surface with its input, as a whole.
#pragma once

#include <vector>

#include "base/core/cancellation.h"
#include "surface/complex/surface.h"
#include "surface/diagnosis/nearness.h"

namespace kerf {

/// A surface on its way from the input to the result.
struct ChangedSurface {
    SurfaceArrays surface;
    std::vector<std::int32_t> near;  ///< #F: a facet of the input near each, where a search may begin
    std::vector<char> is_kept;       ///< #F: whether it is a facet of the input that was to stay
};

struct Inspection {
    std::vector<char> refused;                              ///< #F of the input: whether the result is refused there
    double distance_to_input = 0, distance_from_input = 0;  ///< proven, of all that is not refused

    bool has_passed() const;
};

/// The input, with what searches and proofs need.
struct InspectedInput {
    const SurfaceArrays& surface;
    const TriangleTree& tree;
    const Nearness& nearness;
};

/// Finds facets of a result that meet, and points of either surface further than `deviation` from the other. `kept` (#F
/// of the input) marks facets that are in the result as they were; empty: none. O(#F log #F), on threads, with the same
/// result for any number of them.
Inspection inspect(const InspectedInput& input, const std::vector<char>& kept, double deviation,
                   const ChangedSurface& result, const CancellationCheck& check_cancelled);

/// Returns, for each facet of the input, whether facets of a surface meet near it. O(#F log #F), on threads.
std::vector<char> find_meeting(const InspectedInput& input, double deviation, const SurfaceArrays& surface);

/// Calls visit(point) for the points of a lattice in the facet that divides each of its edges in six.
template <class Visit>
void for_each_sample(const std::vector<Vec3>& vertices, const Triangle& t, Visit visit) {
    constexpr int samples_per_edge = 6;
    for (int i = 0; i <= samples_per_edge; ++i)
        for (int j = 0; i + j <= samples_per_edge; ++j)
            visit(Vec3((i * vertices[t[0]] + j * vertices[t[1]] + (samples_per_edge - i - j) * vertices[t[2]]) /
                       samples_per_edge));
}

}  // namespace kerf

#include "solve/space/space_bodies.h"

#include <algorithm>
#include <numeric>

#include "base/geometry/union_find.h"

namespace kerf {

SpaceBodies find_bodies(const FeSpace& space) {
    UnionFind sets(space.node_count());
    for_all_tets(space, [&](std::size_t p, std::size_t t) {
        const auto nodes = space.nodes_of(p, t);
        for (int i = 1; i < element_nodes(space.order()); ++i) sets.join(nodes[0], nodes[i]);
    });
    // The smallest row of each set goes from rank to rank until all agree.
    const std::int32_t nodes = space.node_count();
    std::vector<std::int64_t> least(space.node_count());
    for (std::int32_t n = 0; n < nodes; ++n) least[n] = space.row_of(n);
    for (int changed = 1; changed != 0;) {
        const std::vector<std::int64_t> before = least;
        for (std::int32_t n = 0; n < nodes; ++n) {
            std::int64_t& of_set = least[sets.root(n)];
            of_set = std::min(of_set, least[n]);
        }
        for (std::int32_t n = 0; n < nodes; ++n) least[n] = least[sets.root(n)];
        space.ownership().smallest_over_ranks(std::span(least), 1);
        changed = space.ranks().all_reduce(least == before ? 0 : 1, Reduction::largest);
    }
    std::vector<std::int64_t> labels;
    for (std::int32_t n = 0; n < space.owned_count(); ++n)
        if (least[n] == space.row_of(n)) labels.push_back(least[n]);
    std::vector<std::int64_t> all = gather_items(space.ranks(), labels);
    std::sort(all.begin(), all.end());
    SpaceBodies bodies;
    bodies.count = std::ssize(all);
    for (const std::int64_t label : least)
        bodies.of_node.push_back(std::lower_bound(all.begin(), all.end(), label) - all.begin());
    return bodies;
}

}  // namespace kerf

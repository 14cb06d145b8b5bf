#include "solve/node_bodies.h"

#include <algorithm>
#include <numeric>

#include "geometry/union_find.h"

namespace kerf {

NodeBodies find_bodies(const NodeSpace& space) {
    UnionFind sets(space.node_count());
    for_all_tets(space, [&](std::size_t p, std::size_t t) {
        const auto nodes = space.nodes_of(p, t);
        for (int i = 1; i < element_nodes(space.order()); ++i) sets.join(nodes[0], nodes[static_cast<std::size_t>(i)]);
    });
    // The smallest row of each set goes from rank to rank until all agree.
    const auto nodes = static_cast<std::int32_t>(space.node_count());
    std::vector<std::int64_t> least(space.node_count());
    for (std::int32_t n = 0; n < nodes; ++n) least[static_cast<std::size_t>(n)] = space.row_of(n);
    for (int changed = 1; changed != 0;) {
        const std::vector<std::int64_t> before = least;
        for (std::int32_t n = 0; n < nodes; ++n) {
            std::int64_t& of_set = least[static_cast<std::size_t>(sets.root(n))];
            of_set = std::min(of_set, least[static_cast<std::size_t>(n)]);
        }
        for (std::int32_t n = 0; n < nodes; ++n)
            least[static_cast<std::size_t>(n)] = least[static_cast<std::size_t>(sets.root(n))];
        space.exchange().share_smallest(std::span(least), 1);
        changed = space.ranks().all_reduce(least == before ? 0 : 1, Reduction::largest);
    }
    std::vector<std::int64_t> labels;
    for (std::size_t n = 0; n < space.owned_count(); ++n)
        if (least[n] == space.row_of(static_cast<std::int32_t>(n))) labels.push_back(least[n]);
    std::vector<std::int64_t> all = gather_items(space.ranks(), labels);
    std::sort(all.begin(), all.end());
    NodeBodies bodies{static_cast<std::int32_t>(all.size()), std::vector<std::int32_t>(space.node_count())};
    for (std::size_t n = 0; n < least.size(); ++n)
        bodies.of_node[n] = static_cast<std::int32_t>(std::lower_bound(all.begin(), all.end(), least[n]) - all.begin());
    return bodies;
}

}  // namespace kerf

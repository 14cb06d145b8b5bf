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
        changed = least == before ? 0 : 1;
        MPI_Allreduce(MPI_IN_PLACE, &changed, 1, MPI_INT, MPI_MAX, space.comm());
    }
    std::vector<std::int64_t> labels;
    for (std::size_t n = 0; n < space.owned_count(); ++n)
        if (least[n] == space.row_of(static_cast<std::int32_t>(n))) labels.push_back(least[n]);
    int ranks = 1;
    MPI_Comm_size(space.comm(), &ranks);
    std::vector<int> counts(static_cast<std::size_t>(ranks)), offsets(static_cast<std::size_t>(ranks));
    const int own = static_cast<int>(labels.size());
    MPI_Allgather(&own, 1, MPI_INT, counts.data(), 1, MPI_INT, space.comm());
    std::exclusive_scan(counts.begin(), counts.end(), offsets.begin(), 0);
    std::vector<std::int64_t> all(static_cast<std::size_t>(offsets.back() + counts.back()));
    MPI_Allgatherv(labels.data(), own, MPI_INT64_T, all.data(), counts.data(), offsets.data(), MPI_INT64_T,
                   space.comm());
    std::sort(all.begin(), all.end());
    NodeBodies bodies{static_cast<std::int32_t>(all.size()), std::vector<std::int32_t>(space.node_count())};
    for (std::size_t n = 0; n < least.size(); ++n)
        bodies.of_node[n] = static_cast<std::int32_t>(std::lower_bound(all.begin(), all.end(), least[n]) - all.begin());
    return bodies;
}

}  // namespace kerf

#include "solve/space/largest_place.h"

namespace kerf {

std::optional<Extreme> LargestPlace::of_all(MpiRanks& ranks) const {
    std::array<double, 4> most = found_;
    for (const std::array<double, 4>& of_rank : all_gather(ranks, found_))
        if (of_rank[0] > most[0]) most = of_rank;
    if (most[0] == nothing) return std::nullopt;
    return Extreme{most[0], Vec3(most[1], most[2], most[3])};
}

Extreme largest_displacement(const FeSpace& space, const std::vector<double>& displacement) {
    LargestPlace most;
    for (std::int32_t n = 0; n < space.owned_count(); ++n)
        most.tell(Eigen::Map<const Vec3>(&displacement[3 * n]).norm(), space.points()[n]);
    return most.of_all(space.ranks()).value_or(Extreme{});
}

}  // namespace kerf

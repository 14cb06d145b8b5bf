#include "fill/shell/inside/steiner_points.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "fill/improve/cell_shape.h"
#include "fill/shell/inside/vertex_star.h"

namespace kerf {

namespace {

constexpr int most_visits = 3;
constexpr double least_step = 1e-3;     // share of the way to the middle of the neighbours
constexpr double good_enough_deg = 10;  // cells this good may always replace a vertex

struct Place {
    Vec3 at;
    double badness;
};

// Returns the place towards the middle of a vertex's neighbours that makes the worst of its cells best.
Place best_place(const VertexStar& star, const std::vector<Vec3>& points) {
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t u : star.neighbours()) middle += points[u];
    middle /= static_cast<double>(star.neighbours().size());
    const Vec3& from = star.at();
    const Vec3 way = middle - from;
    Place best{from, star.badness_at(from)};
    for (double step = 1; step > least_step; step /= 2) {
        const Vec3 p = from + step * way;
        const double badness = star.badness_at(p);
        if (badness < best.badness) best = {p, badness};
    }
    return best;
}

// Merges or moves a vertex; true if it is gone.
bool settle(EditableTets& tets, std::int32_t v) {
    VertexStar star(tets, v);
    const Place place = best_place(star, tets.points());
    const auto merged = star.best_merged(std::max(place.badness, square_from_degrees(good_enough_deg)));
    if (merged.cells.empty())
        star.move_to(place.at);
    else
        star.replace_by(merged);
    return !merged.cells.empty();
}

}  // namespace

std::int64_t settle_steiner_points(EditableTets& tets, std::int32_t first) {
    std::vector<std::int32_t> left(tets.points().size() - static_cast<std::size_t>(first));
    std::iota(left.begin(), left.end(), first);
    std::erase_if(left, [&](std::int32_t v) { return tets.cell_at(v) == EditableTets::none; });
    for (int visit = 0; visit < most_visits; ++visit)
        std::erase_if(left, [&](std::int32_t v) { return settle(tets, v); });
    return static_cast<std::int64_t>(left.size());
}

}  // namespace kerf

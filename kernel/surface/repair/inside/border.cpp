#include "surface/repair/inside/border.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/core/ids.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

constexpr std::size_t most_border_steps = 64;  // along a border

}  // namespace

Border::Border(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
               const std::vector<char>& is_left_out)
    : points_(vertices), facets_(facets), place_(vertices.size(), -1) {
    std::vector<std::int32_t> partner;  // EdgeCorners looks at those below 0 alone
    if (!is_left_out.empty()) {
        partner.resize(3 * facets.size());
        for (std::size_t c = 0; c < partner.size(); ++c) partner[c] = is_left_out[c / 3] ? 0 : -1;
    }
    EdgeCorners(facets, partner).for_each_edge([&](std::int32_t, std::span<const EdgeCorners::Corner> corners) {
        if (corners.size() == 1) corners_.push_back(corners[0].corner);
    });
    std::sort(corners_.begin(), corners_.end());
    for (const std::int32_t c : corners_)
        place_[start_vertex(facets, c)] = place_[start_vertex(facets, next_corner(c))] = 0;
    for (std::int32_t v = 0; v < count_of(place_); ++v)
        if (place_[v] == 0) {
            place_[v] = count_of(vertices_);
            vertices_.push_back(v);
        }
    collect_facets(is_left_out);
    collect_neighbours();
}

void Border::collect_facets(const std::vector<char>& is_left_out) {
    const auto is_in = [&](std::size_t f) { return is_left_out.empty() || !is_left_out[f]; };
    first_facet_.assign(vertices_.size() + 1, 0);
    for (std::size_t f = 0; f < facets_.size(); ++f)
        for (const std::int32_t v : facets_[f])
            if (place_[v] >= 0 && is_in(f)) ++first_facet_[place_[v] + 1];
    for (std::size_t i = 1; i < first_facet_.size(); ++i) first_facet_[i] += first_facet_[i - 1];
    facets_at_.resize(first_facet_.back());
    std::vector<std::int32_t> next(first_facet_.begin(), first_facet_.end() - 1);
    for (std::int32_t f = 0; f < count_of(facets_); ++f)
        for (const std::int32_t v : facets_[f])
            if (place_[v] >= 0 && is_in(f)) facets_at_[next[place_[v]]++] = f;
}

void Border::collect_neighbours() {
    std::vector<std::pair<std::int32_t, std::int32_t>> ends;
    for (const std::int32_t c : corners_) {
        const std::int32_t a = start_vertex(facets_, c), b = start_vertex(facets_, next_corner(c));
        ends.emplace_back(place_[a], b);
        ends.emplace_back(place_[b], a);
    }
    std::sort(ends.begin(), ends.end());
    first_neighbour_.assign(vertices_.size() + 1, 0);
    for (const auto& [place, other] : ends) {
        neighbours_.push_back(other);
        first_neighbour_[place + 1] = count_of(neighbours_);
    }
}

double Border::length_between(std::int32_t from, std::int32_t to, double limit) const {
    std::vector<std::pair<std::int32_t, double>> reached = {{from, 0.0}};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < reached.size() && i < most_border_steps; ++i) {
        const auto [v, length] = reached[i];
        if (v == to) least = std::min(least, length);
        if (length + (points_[to] - points_[v]).norm() >= limit) continue;
        for (const std::int32_t w : row(neighbours_, first_neighbour_, place_[v])) {
            const double beyond = length + (points_[w] - points_[v]).norm();
            const bool is_known = std::any_of(reached.begin(), reached.end(),
                                              [&](const auto& other) { return other.first == w && w != to; });
            if (beyond < limit && !is_known) reached.emplace_back(w, beyond);
        }
    }
    return least < limit ? least : std::numeric_limits<double>::infinity();
}

}  // namespace kerf

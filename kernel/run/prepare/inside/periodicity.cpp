// Vertices are sorted into columns along an axis, of those that agree in the other two coordinates: within a column
// each pair that lies far enough apart votes for its distance. The period is the largest distance with at least half as
// many votes as any other. Facets are paired afterwards: corners are moved by a period to their partners, and the facet
// with these corners must have the opposite orientation.
#include "run/prepare/inside/periodicity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <numeric>

#include "base/core/threads.h"
#include "base/geometry/box.h"

namespace kerf {

namespace {

constexpr double tolerance_share = 1e-6;  // of the diagonal
constexpr double least_share_of_extent = 0.5;
constexpr std::size_t most_in_a_column = 64;  // longer ones vote for nothing
constexpr std::size_t least_pairs = 10, vertices_per_pair = 50;

// The vertices of a surface in columns along one axis, upwards in each.
class Columns {
 public:
    Columns(const std::vector<Vec3>& vertices, int axis, double tolerance)
        : tolerance_(tolerance), order_(vertices.size()) {
        for_ranges_on_threads(vertices.size(), std::size_t{1} << 14, [&](const IndexRange& range) {
            for (std::size_t v = range.first; v < range.last; ++v) {
                const auto place = [&](int i) { return std::llround(vertices[v][(axis + i) % 3] / tolerance); };
                order_[v] = {{place(1), place(2)}, vertices[v][axis], static_cast<std::int32_t>(v)};
            }
        });
        sort_on_threads(order_);
    }

    // The largest distance, of those above `least`, that has at least half as many pairs as any; 0 if these are too
    // few.
    double period(double least) const {
        std::vector<double> distances;
        for_each_column([&](std::size_t first, std::size_t last) {
            if (last - first > most_in_a_column) return;
            for (std::size_t i = first; i < last; ++i)
                for (std::size_t j = i + 1; j < last; ++j)
                    if (const double d = order_[j].height - order_[i].height; d > least) distances.push_back(d);
        });
        std::sort(distances.begin(), distances.end());
        std::vector<std::size_t> ends;  // of those that agree with the first of them
        std::size_t most = 0;
        for (std::size_t first = 0, last = 0; first < distances.size(); ++first) {
            while (last < distances.size() && distances[last] - distances[first] <= tolerance_) ++last;
            ends.push_back(last);
            most = std::max(most, last - first);
        }
        const std::size_t wanted = std::max({least_pairs, order_.size() / vertices_per_pair, (most + 1) / 2});
        for (std::size_t first = distances.size(); first-- > 0;)
            if (ends[first] - first >= wanted) return distances[(first + ends[first]) / 2];
        return 0;
    }

    // Returns for each vertex the one that lies a period above it, or -1.
    std::vector<std::int32_t> partners_above(double period) const {
        std::vector<std::int32_t> partner(order_.size(), -1);
        for_each_column([&](std::size_t first, std::size_t last) {
            for (std::size_t i = first, j = first; i < last; ++i) {
                const double wanted = order_[i].height + period;
                while (j < last && order_[j].height < wanted - tolerance_) ++j;
                if (j < last && order_[j].height <= wanted + tolerance_) partner[order_[i].vertex] = order_[j].vertex;
            }
        });
        return partner;
    }

 private:
    struct Entry {
        std::array<long long, 2> column{};
        double height = 0;
        std::int32_t vertex = -1;
        auto operator<=>(const Entry&) const = default;
    };
    template <class Visit>
    void for_each_column(const Visit& visit) const {
        for (std::size_t first = 0, last = 0; first < order_.size(); first = last) {
            while (last < order_.size() && order_[last].column == order_[first].column) ++last;
            visit(first, last);
        }
    }

    double tolerance_;
    std::vector<Entry> order_;
};

Triangle sorted(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
}

// Whether the triangle has the edge in this direction.
bool has_edge(const Triangle& t, std::int32_t from, std::int32_t to) {
    return (t[0] == from && t[1] == to) || (t[1] == from && t[2] == to) || (t[2] == from && t[0] == to);
}

// Facets with their corners in order, to be looked up.
class FacetsByCorners {
 public:
    explicit FacetsByCorners(const std::vector<Triangle>& facets) : order_(facets.size()) {
        std::iota(order_.begin(), order_.end(), 0);
        for (const Triangle& t : facets) corners_.push_back(sorted(t));
        std::sort(order_.begin(), order_.end(), [&](std::int32_t f, std::int32_t g) {
            return corners_[f] != corners_[g] ? corners_[f] < corners_[g] : f < g;
        });
    }
    // -1 if there is none.
    std::int32_t find(const Triangle& corners) const {
        const Triangle wanted = sorted(corners);
        const auto at = std::lower_bound(order_.begin(), order_.end(), wanted,
                                         [&](std::int32_t f, const Triangle& t) { return corners_[f] < t; });
        return at != order_.end() && corners_[*at] == wanted ? *at : -1;
    }

 private:
    std::vector<Triangle> corners_;
    std::vector<std::int32_t> order_;
};

}  // namespace

std::int64_t Periodicity::paired_facets() const { return std::count(is_paired.begin(), is_paired.end(), char{1}); }

std::optional<Periodicity> find_periodicity(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets) {
    const Box box = box_around(vertices);
    const double tolerance = tolerance_share * box.diagonal().norm();
    if (!(tolerance > 0)) return std::nullopt;
    Periodicity found;
    found.is_paired.assign(facets.size(), 0);
    std::array<std::vector<std::int32_t>, 3> partners;
    for (int axis = 0; axis < 3; ++axis) {
        const Columns columns(vertices, axis, tolerance);
        found.period[axis] = columns.period(least_share_of_extent * box.diagonal()[axis]);
        if (found.period[axis] == 0) return std::nullopt;
        partners[axis] = columns.partners_above(found.period[axis]);
    }
    const FacetsByCorners by_corners(facets);
    for (const std::vector<std::int32_t>& partner : partners) {
        std::size_t pairs = 0;
        for (std::size_t f = 0; f < facets.size(); ++f) {
            const auto& [a, b, c] = facets[f];
            if (partner[a] < 0 || partner[b] < 0 || partner[c] < 0) continue;
            const std::int32_t other = by_corners.find({partner[a], partner[b], partner[c]});
            if (other < 0 || has_edge(facets[other], partner[a], partner[b])) continue;
            found.is_paired[f] = found.is_paired[other] = 1;
            ++pairs;
        }
        if (pairs < least_pairs) return std::nullopt;
    }
    return found;
}

}  // namespace kerf

// Pairs of rims are tested in the order of cost: the distance of their boxes, then the mean distance of a few vertices,
// each times half of the longer rim as an estimate of the band's area, and only then the band itself. The share of a
// band is its area over that of the two lids; the bands with the smallest shares are taken first, and each rim once. A
// band may stand off the surface by hardly more than the flatter lid: otherwise two holes beside each other would be
// joined by a tunnel.
#include "surface/openings/rim_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "base/geometry/box.h"
#include "base/geometry/triangle.h"

namespace kerf {

namespace {

struct RimPair {
    double share;  // area of the band over that of the two lids
    std::size_t one, two;
    RimOpening band;
};

double area_of(const OpenRims& all, const RimOpening& opening) {
    std::vector<Vec3> points;
    for (const Rim* rim : opening.rims)
        for (const std::int32_t v : rim->vertices) points.push_back(all.soup().vertices[v]);
    double sum = 0;
    for (const Triangle& t : opening.triangles) sum += triangle_area(points, t);
    return sum;
}

std::vector<std::size_t> longest(const std::vector<RimOpening>& openings) {
    constexpr std::size_t most = 2000;
    std::vector<std::size_t> order(openings.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return openings[a].length() > openings[b].length(); });
    order.resize(std::min(order.size(), most));
    std::sort(order.begin(), order.end());
    return order;
}

// The mean distance of a few vertices of a rim from the nearest ones of another.
double mean_gap(const std::vector<Vec3>& rim, const std::vector<Vec3>& other) {
    constexpr std::size_t few = 8;
    const std::size_t count = std::min(few, rim.size());
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3& p = rim[i * rim.size() / count];
        double nearest = std::numeric_limits<double>::infinity();
        for (const Vec3& q : other) nearest = std::min(nearest, (p - q).squaredNorm());
        sum += std::sqrt(nearest);
    }
    return sum / count;
}

std::vector<RimPair> find_pairs(const OpenRims& all, const std::vector<RimOpening>& openings,
                                const std::function<void()>& check_cancelled) {
    const std::vector<std::size_t> tried = longest(openings);
    std::vector<std::vector<Vec3>> points;
    std::vector<Box> boxes;
    std::vector<double> areas;
    for (const std::size_t i : tried) {
        points.push_back(openings[i].rims[0]->points(all.soup()));
        boxes.push_back(box_around(points.back()));
        areas.push_back(area_of(all, openings[i]));
    }
    std::vector<RimPair> pairs;
    for (std::size_t i = 0; i < tried.size(); ++i) {
        check_cancelled();
        for (std::size_t j = i + 1; j < tried.size(); ++j) {
            const RimOpening &one = openings[tried[i]], &two = openings[tried[j]];
            const double lids = areas[i] + areas[j], length = std::max(one.length(), two.length());
            if (boxes[i].exteriorDistance(boxes[j]) * length / 2 >= lids) continue;
            const std::size_t shorter = one.length() <= two.length() ? i : j;
            if (mean_gap(points[shorter], points[i + j - shorter]) * length / 2 >= lids) continue;
            RimOpening band = make_opening(all, {one.rims[0], two.rims[0]});
            const double share = area_of(all, band) / lids;
            constexpr double hardly_more = 20;
            if (share < 1 && band.bend <= std::min(one.bend, two.bend) + hardly_more)
                pairs.push_back({share, tried[i], tried[j], std::move(band)});
        }
    }
    std::stable_sort(pairs.begin(), pairs.end(), [](const RimPair& a, const RimPair& b) { return a.share < b.share; });
    return pairs;
}

}  // namespace

std::vector<RimOpening> join_facing(const OpenRims& all, std::vector<RimOpening> openings,
                                    const std::function<void()>& check_cancelled) {
    std::vector<char> is_joined(openings.size(), 0), is_second(openings.size(), 0);
    for (RimPair& pair : find_pairs(all, openings, check_cancelled)) {
        if (is_joined[pair.one] || is_joined[pair.two]) continue;
        is_joined[pair.one] = is_joined[pair.two] = is_second[pair.two] = 1;
        openings[pair.one] = std::move(pair.band);
    }
    std::vector<RimOpening> left;
    for (std::size_t i = 0; i < openings.size(); ++i)
        if (!is_second[i]) left.push_back(std::move(openings[i]));
    return left;
}

}  // namespace kerf

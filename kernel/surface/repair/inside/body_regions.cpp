// Regions of bodies that may overlap. All facets, each once, divide space into cells (surface/regions/divided_space.h);
// a "single" facet stands for all copies of one, and its `times` say how often it is there, turned copies subtracted. A
// cell belongs to a body if the winding number of the body there, averaged by area over the largest facets of the cell,
// is above 1/2 (surface/arrange/winding_number.h), and of several bodies the one of least volume gets it. A facet of
// the body itself has no winding number of its own: half of its times is added behind it and taken away in front.
//
// Winding numbers, not the cells alone, decide because bodies may have small holes. find_bodies() makes a body of each
// piece that hangs together over edges; a piece of negative volume is a void, and goes to the smallest body around it.
#include "surface/repair/inside/body_regions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "base/core/elements.h"
#include "base/core/ids.h"
#include "base/geometry/triangle.h"
#include "base/geometry/union_find.h"
#include "surface/arrange/winding_number.h"
#include "surface/complex/mass_properties.h"
#include "surface/regions/divided_space.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

// Closed facets, their winding number and their volume.
struct WindingBody {
    WindingNumber winding;
    Box box;
    double volume;

    WindingBody(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                const std::vector<std::int32_t>& times = {})
        : winding(vertices, facets, times), volume(facets.empty() ? 0 : enclosed_volume(vertices, facets)) {
        for (const Triangle& t : facets) box.extend(box_around(vertices, t));
    }
};

// Gives voids the number of the smallest body around them.
void join_voids(const Soup& soup, std::vector<std::int32_t>& piece, std::int32_t count,
                const std::function<void()>& check_cancelled) {
    std::vector<std::vector<Triangle>> facets(count);
    for (std::size_t f = 0; f < piece.size(); ++f)
        if (!has_repeated_vertex(soup.facets[f])) facets[piece[f]].push_back(soup.facets[f]);
    std::vector<WindingBody> bodies;
    for (const std::vector<Triangle>& own : facets) bodies.emplace_back(soup.vertices, own);
    std::vector<std::int32_t> body_of(count);
    for (std::int32_t p = 0; p < count; ++p) {
        check_cancelled();
        body_of[p] = p;
        if (bodies[p].volume >= 0) continue;
        const auto& [a, b, c] = facets[p].front();
        const Vec3 point = (soup.vertices[a] + soup.vertices[b] + soup.vertices[c]) / 3;
        for (std::int32_t around = 0; around < count; ++around) {
            const WindingBody& other = bodies[around];
            if (around == p || !(other.volume > 0) || !other.box.contains(point)) continue;
            const bool is_smaller = body_of[p] == p || other.volume < bodies[body_of[p]].volume;
            if (is_smaller && other.winding.at(point) > 0.5) body_of[p] = around;
        }
    }
    for (std::int32_t& own : piece) own = body_of[own];
}

class RegionMaker {
 public:
    RegionMaker(Soup& soup, const GivenBodies& bodies, DividedSpace space, const std::function<void()>& check_cancelled)
        : soup_(soup), given_(bodies), space_(std::move(space)), check_cancelled_(check_cancelled) {}

    BodyRegions run() {
        collect_bodies();
        name_cells();
        tell_bodies();
        space_.names = given_.names;
        give_sides(soup_, std::move(space_));
        if (soup_.region_names.size() <= 1) {
            soup_.sides.clear();
            soup_.region_names.clear();
        }
        return std::move(done_);
    }

 private:
    // A facet of a body, with the number of its copies, turned ones subtracted.
    struct Member {
        std::int32_t body, facet, times;
    };

    void collect_bodies() {
        const SingleFacets& single = space_.single;
        std::vector<Member> all;
        for (std::size_t f = 0; f < soup_.facets.size(); ++f)
            if (single.single_of[f] >= 0)
                all.push_back({given_.of_facet[f], single.single_of[f], single.is_turned[f] ? -1 : 1});
        const auto key = [](const Member& m) { return std::pair(m.body, m.facet); };
        std::sort(all.begin(), all.end(), [&](const Member& a, const Member& b) { return key(a) < key(b); });
        first_.assign(1, 0);
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (i > 0 && key(all[i]) == key(all[i - 1]))
                members_.back().times += all[i].times;
            else
                members_.push_back(all[i]);
        }
        auto member = members_.begin();
        for (std::int32_t body = 0; body < std::ssize(given_.names); ++body) {
            check_cancelled_();
            std::vector<Triangle> facets;
            std::vector<std::int32_t> times;
            for (; member != members_.end() && member->body == body; ++member) {
                facets.push_back(single.facets[member->facet]);
                times.push_back(member->times);
            }
            bodies_.emplace_back(soup_.vertices, facets, times);
            bodies_.back().volume = volume_of(facets, times);
            first_.push_back(member - members_.begin());
        }
    }
    double volume_of(std::vector<Triangle> facets, const std::vector<std::int32_t>& times) const {
        std::vector<Triangle> counted;
        for (std::size_t i = 0; i < facets.size(); ++i) {
            if (times[i] < 0) std::swap(facets[i][1], facets[i][2]);
            counted.insert(counted.end(), std::abs(times[i]), facets[i]);
        }
        return counted.empty() ? 0 : enclosed_volume(soup_.vertices, counted);
    }

    // Returns the winding number of a body in the space beside a facet. `sign`: 1 behind it, -1 in front.
    double winding_beside(std::int32_t body, std::int32_t facet, const Vec3& centroid, int sign) const {
        const auto begin = members_.begin() + first_[body], end = members_.begin() + first_[body + 1];
        const auto found =
            std::lower_bound(begin, end, facet, [](const Member& m, std::int32_t f) { return m.facet < f; });
        if (found == end || found->facet != facet) return bodies_[body].winding.at(centroid);
        return bodies_[body].winding.beside(found - begin) + sign * found->times / 2.0;
    }

    // Returns the largest facets of each cell, which lies behind them or in front.
    std::vector<std::vector<std::int32_t>> samples_of_cells() const {
        constexpr std::size_t most_samples = 8;
        std::vector<std::vector<std::int32_t>> of(space_.cells.count);
        for (std::int32_t u = 0; u < count_of(space_.single.facets); ++u) {
            const auto [front, back] = space_.cells.sides[u];
            if (front == back) continue;
            for (const std::int32_t cell : {front, back})
                if (cell >= 0) of[cell].push_back(u);
        }
        std::vector<double> area;
        for (const Triangle& t : space_.single.facets) area.push_back(triangle_area(soup_.vertices, t));
        for (std::vector<std::int32_t>& own : of) {
            const auto last = own.begin() + std::min(most_samples, own.size());
            std::partial_sort(own.begin(), last, own.end(), [&](std::int32_t f, std::int32_t g) {
                return area[f] != area[g] ? area[f] > area[g] : f < g;
            });
            own.erase(last, own.end());
        }
        return of;
    }

    void name_cells() {
        const std::vector<double> volumes = cell_volumes(soup_.vertices, space_.single.facets, space_.cells);
        const auto samples = samples_of_cells();
        for (std::int32_t cell = 0; cell < space_.cells.count; ++cell) {
            check_cancelled_();
            const std::vector<std::int32_t> around = bodies_around(cell, samples[cell]);
            if (around.empty()) continue;
            const auto smallest = std::min_element(around.begin(), around.end(), [&](std::int32_t a, std::int32_t b) {
                return std::pair(std::abs(bodies_[a].volume), a) < std::pair(std::abs(bodies_[b].volume), b);
            });
            space_.region_of_cell[cell] = RegionIndex(*smallest);
            if (around.size() > 1) done_.overlaps.add(place_of(samples[cell], volumes[cell]));
        }
    }
    std::vector<std::int32_t> bodies_around(std::int32_t cell, const std::vector<std::int32_t>& samples) const {
        std::vector<std::int32_t> around;
        double total = 0;
        for (const std::int32_t u : samples) total += triangle_area(soup_.vertices, space_.single.facets[u]);
        for (std::int32_t body = 0; body < std::ssize(bodies_); ++body) {
            double inside = 0;
            for (const std::int32_t u : samples) {
                const Vec3 centroid = centroid_of(u);
                if (!bodies_[body].box.contains(centroid)) continue;
                const int sign = space_.cells.sides[u].back == cell ? 1 : -1;
                inside += triangle_area(soup_.vertices, space_.single.facets[u]) *
                          std::clamp(winding_beside(body, u, centroid, sign), 0.0, 1.0);
            }
            if (inside > 0.5 * total) around.push_back(body);
        }
        return around;
    }
    Vec3 centroid_of(std::int32_t facet) const {
        const auto& [a, b, c] = space_.single.facets[facet];
        return (soup_.vertices[a] + soup_.vertices[b] + soup_.vertices[c]) / 3;
    }
    RepairPlace place_of(const std::vector<std::int32_t>& samples, double measure) const {
        RepairPlace place{samples.empty() ? Vec3(Vec3::Zero()) : centroid_of(samples[0]), {}, measure};
        for (const std::int32_t u : samples) place.facets.push_back(space_.single.first[u]);
        std::sort(place.facets.begin(), place.facets.end());
        place.facets = soup_.file_facets(place.facets);
        return place;
    }

    void tell_bodies() {
        Array<RegionIndex, char> has_cell(bodies_.size(), 0);
        for (const RegionIndex region : space_.region_of_cell)
            if (region.is_valid()) has_cell[region] = 1;
        for (std::int32_t body = 0; body < std::ssize(bodies_); ++body) {
            if (first_[body] == first_[body + 1]) continue;
            const std::int32_t u = members_[first_[body]].facet;
            (has_cell[body] ? done_.made : done_.hidden)
                .add({centroid_of(u), soup_.file_facets({space_.single.first[u]})});
        }
    }

    Soup& soup_;
    const GivenBodies& given_;
    DividedSpace space_;
    const std::function<void()>& check_cancelled_;
    std::vector<Member> members_;        // by bodies, then facets
    std::vector<std::ptrdiff_t> first_;  // of a body, in members_
    std::vector<WindingBody> bodies_;
    BodyRegions done_;
};

}  // namespace

GivenBodies find_bodies(const Soup& soup, const std::function<void()>& check_cancelled) {
    GivenBodies bodies = closed_patches(soup);
    if (!bodies.names.empty()) return bodies;
    UnionFind joined(soup.facets.size());
    EdgeCorners(soup.facets).for_each_edge([&](std::int32_t, std::span<const EdgeCorners::Corner> corners) {
        for (const auto& c : corners) joined.join(corners[0].corner / 3, c.corner / 3);
    });
    Components pieces = joined.take();
    join_voids(soup, pieces.of, pieces.count, check_cancelled);
    std::vector<std::int32_t> number(pieces.count, -1);
    for (const std::int32_t piece : pieces.of) {
        if (number[piece] < 0) {
            number[piece] = count_of(bodies.names);
            bodies.names.push_back(fmt::format("body_{}", bodies.names.size() + 1));
        }
        bodies.of_facet.push_back(number[piece]);
    }
    return bodies;
}

std::optional<BodyRegions> make_regions(Soup& soup, const GivenBodies& bodies,
                                        const std::function<void()>& check_cancelled) {
    std::optional<DividedSpace> space = divide_space(soup);
    if (!space) return std::nullopt;
    return RegionMaker(soup, bodies, std::move(*space), check_cancelled).run();
}

}  // namespace kerf

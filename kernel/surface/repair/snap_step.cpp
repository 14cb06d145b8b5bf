// Walls of two bodies that nearly coincide (surface/arrange/near_walls.h) are divided alike, with the same vertices
// (arrange_walls()), so that they are copies of each other. Where that would turn facets over, the walls at their
// vertices are left out, and it is tried again, a few times. Where vertices would move farther than allowed, as those
// of a chain along which each is near the next, or where bodies would open, all walls stay.
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "base/core/ids.h"
#include "base/geometry/triangle.h"
#include "surface/arrange/arrangement.h"
#include "surface/arrange/divided_soup.h"
#include "surface/arrange/near_walls.h"
#include "surface/repair/inside/body_regions.h"
#include "surface/repair/inside/rims.h"
#include "surface/repair/repair_step.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

constexpr int most_snap_tries = 4;

// The length of edges that facets have more often in one direction than in the other; 0: all is closed.
double unbalanced_length(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets) {
    double length = 0;
    EdgeCorners(facets).for_each_edge([&](std::int32_t low, std::span<const EdgeCorners::Corner> corners) {
        int sum = 0;
        for (const auto& c : corners) sum += start_vertex(facets, c.corner) == low ? 1 : -1;
        if (sum != 0) length += (vertices[corners[0].high] - vertices[low]).norm();
    });
    return length;
}

class WallSnapping {
 public:
    WallSnapping(Soup& soup, const StepRequest& request, StepReport& report)
        : soup_(soup), request_(request), report_(report), tolerance_(std::min(request.amount, request.bound)) {}

    void run() {
        const GivenBodies bodies = find_bodies(soup_, request_.check_cancelled);
        if (bodies.names.size() < 2 || !(tolerance_ > 0)) return;
        walls_ = find_near_walls(soup_.vertices, soup_.facets, bodies.of_facet, tolerance_, nothing(),
                                 request_.check_cancelled);
        tell_thin();
        for (int tries = 0; tries < most_snap_tries && has_unlike(); ++tries) {
            Arrangement divided =
                arrange_walls(soup_.vertices, soup_.facets, walls_.is_wall, tolerance_, request_.check_cancelled);
            if (divided.facets == soup_.facets) break;
            if (leave_out_turned(divided)) continue;
            if (divided.largest_move <= request_.bound && stays_closed(divided))
                put(std::move(divided));
            else
                refuse_all("vertices would move farther than allowed, or closed bodies would open");
            break;
        }
        for (RepairAction* action : {&snapped_, &thin_, &turned_, &unlike_, &refused_})
            report_.actions.push_back(std::move(*action));
    }

 private:
    // Walls that differ by less are the same to an arrangement.
    double nothing() const {
        constexpr double roundings = 16;
        double extent = 0;
        for (const Vec3& p : soup_.vertices) extent = std::max(extent, p.cwiseAbs().maxCoeff());
        return roundings * std::numeric_limits<double>::epsilon() * extent;
    }
    bool has_unlike() const {
        for (std::size_t f = 0; f < walls_.is_wall.size(); ++f)
            if (walls_.is_wall[f] && walls_.apart[f] > 0) return true;
        return false;
    }
    RepairPlace place_of(std::int32_t f) const {
        const auto& [a, b, c] = soup_.facets[f];
        const std::vector<Vec3>& p = soup_.vertices;
        return {(p[a] + p[b] + p[c]) / 3, soup_.file_facets({f}), walls_.apart[f]};
    }
    void tell_thin() {
        thin_.refused_because = "their body is as thin there, and would be flat";
        for (const std::int32_t f : walls_.thin)
            if (walls_.apart[f] > 0) thin_.add(place_of(f));
    }
    void refuse_all(const char* because) {
        refused_.refused_because = because;
        for (std::int32_t f = 0; f < count_of(walls_.is_wall); ++f)
            if (walls_.is_wall[f] && walls_.apart[f] > 0) refused_.add(place_of(f));
    }

    bool stays_closed(const Arrangement& divided) const {
        constexpr double bent = 1.01;  // open edges may lead over vertices beside them
        return unbalanced_length(divided.vertices, divided.facets) <=
               bent * unbalanced_length(soup_.vertices, soup_.facets);
    }

    // Whether facets would turn over: walls with a vertex of these are left out then.
    bool leave_out_turned(const Arrangement& divided) {
        turned_.refused_because = "facets would turn over there";
        std::vector<char> is_at_turned(soup_.vertices.size(), 0);
        bool is_any = false;
        for (std::size_t piece = 0; piece < divided.facets.size(); ++piece) {
            const Triangle& parent = soup_.facets[divided.parent[piece]];
            if (divided.facets[piece] == parent) continue;
            const Vec3 before = doubled_area_vector(soup_.vertices, parent);
            if (before.dot(doubled_area_vector(divided.vertices, divided.facets[piece])) >= 0) continue;
            is_any = true;
            for (const std::int32_t v : parent) is_at_turned[v] = 1;
        }
        for (std::size_t f = 0; is_any && f < soup_.facets.size(); ++f) {
            const Triangle& t = soup_.facets[f];
            const bool is_left_out = walls_.is_wall[f] && std::any_of(t.begin(), t.end(), [&](std::int32_t v) {
                                         return is_at_turned[v] != 0;
                                     });
            if (!is_left_out) continue;
            walls_.is_wall[f] = 0;
            if (walls_.apart[f] > 0) turned_.add(place_of(f));
        }
        return is_any;
    }

    void put(Arrangement divided) {
        for (std::int32_t f = 0; f < count_of(walls_.is_wall); ++f)
            if (walls_.is_wall[f] && walls_.apart[f] > 0) snapped_.add(place_of(f));
        report_.largest_move = std::max(report_.largest_move, divided.largest_move);
        unlike_.refused_because = "their facets could not be made alike; they are bent too much for the tolerance";
        for (const UnresolvedCrossing& left : divided.unresolved)
            unlike_.add({left.where, soup_.file_facets({divided.parent[left.facets[0]]})});
        const std::vector<char> all(divided.facets.size(), 1), none(divided.facets.size(), 0);
        take_divided_facets(soup_, std::move(divided), all, none);
        drop_unused_vertices(soup_);
    }

    Soup& soup_;
    const StepRequest& request_;
    StepReport& report_;
    const double tolerance_;
    NearWalls walls_;
    RepairAction snapped_{"facet made one with those of another body", "facets made one with those of other bodies",
                          "apart"},
        thin_{"facet near another body", "facets near other bodies", "apart"},
        turned_{"facet near another body", "facets near other bodies", "apart"},
        unlike_{"facet near another body", "facets near other bodies"},
        refused_{"facet near another body", "facets near other bodies", "apart"};
};

}  // namespace

void snap_step(Soup& soup, const StepRequest& request, StepReport& report) {
    if (has_ordinary_facets(soup))
        WallSnapping(soup, request, report).run();
    else
        refuse_odd_facets(report);
}

}  // namespace kerf

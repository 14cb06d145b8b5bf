// Borders are joined at distances that grow up to the tolerance, so that the best fit is joined first: a vertex on an
// edge before another vertex farther away. At each distance there are rounds, until nothing is joined any more: near
// vertices of borders become one (surface/repair/inside/border_merger.h), then vertices near an edge go onto it
// (surface/repair/inside/border_points.h). Only changes stay by which two facets share an edge.
#include <algorithm>

#include "base/geometry/closest_point.h"
#include "surface/repair/inside/border_merger.h"
#include "surface/repair/inside/border_points.h"
#include "surface/repair/inside/rims.h"
#include "surface/repair/repair_step.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

constexpr int few_stitch_rounds = 2, most_stitch_rounds = 5;
constexpr double stitch_shares[] = {0x1p-10, 0x1p-8, 0x1p-6, 0x1p-4, 0x1p-2, 1};  // of the tolerance, in turn

class Stitching {
 public:
    Stitching(Soup& soup, const StepRequest& request, StepReport& report)
        : soup_(soup), request_(request), report_(report), reach_(soup.vertices.size(), 0.0) {}

    void run() {
        const double tolerance = std::min(request_.amount, request_.bound);
        for (const double share : stitch_shares)
            join(share * tolerance, tolerance, share < 1 ? few_stitch_rounds : most_stitch_rounds);
        join(tolerance, 0, most_stitch_rounds);
        refused_.refused_because = "facets would turn over there, or three would share an edge";
        const bool is_any = joined_.count + placed_.count > 0;
        for (RepairAction* action : {&joined_, &placed_, &refused_}) report_.actions.push_back(std::move(*action));
        if (is_any) drop_unused_vertices(soup_);
    }

 private:
    void join(double tolerance, double near_end, int rounds) {
        for (int round = 0; round < rounds && join_once(tolerance, near_end); ++round) request_.check_cancelled();
    }
    bool join_once(double tolerance, double near_end) {
        const Border border(soup_.vertices, soup_.facets);
        if (border.corners().empty()) return false;
        BorderMerging merging = merge_border(soup_.vertices, soup_.facets, border, tolerance, request_.bound, reach_);
        const std::vector<Triangle> before = soup_.facets;
        for (Triangle& t : soup_.facets)
            for (std::int32_t& v : t) v = merging.representative[v];
        const std::vector<SidePoint> points =
            find_border_points(soup_.vertices, soup_.facets, Border(soup_.vertices, soup_.facets), tolerance, near_end);
        say_placed(points);
        const Soup numbers{{}, {}, {}, {}, soup_.polygon};
        const std::vector<std::int32_t> parent = divide_at(soup_, points);
        undo_useless(before, parent, merging, soup_.facets);
        for (const VertexPair& pair : merging.merged) {
            const std::vector<std::int32_t> facet = numbers.file_facets({border.facets_at(pair.gone)[0]});
            joined_.add({soup_.vertices[pair.stays], facet, pair.apart});
            report_.largest_move = std::max(report_.largest_move, reach_[merging.representative[pair.gone]]);
        }
        refused_.count = 0;
        refused_.places.clear();
        for (const VertexPair& pair : merging.refused)
            refused_.add(
                {soup_.vertices[pair.stays], numbers.file_facets({border.facets_at(pair.gone)[0]}), pair.apart});
        return !merging.merged.empty() || !points.empty();
    }
    void say_placed(const std::vector<SidePoint>& points) {
        for (const SidePoint& point : points) {
            const Vec3& p = soup_.vertices[point.vertex];
            const Vec3& a = soup_.vertices[start_vertex(soup_.facets, point.corner)];
            const Vec3& b = soup_.vertices[start_vertex(soup_.facets, next_corner(point.corner))];
            placed_.add({p, soup_.file_facets({point.corner / 3}), (closest_on_segment(p, a, b) - p).norm()});
        }
    }

    Soup& soup_;
    const StepRequest& request_;
    StepReport& report_;
    std::vector<double> reach_;
    RepairAction joined_{"vertex of a border joined to another", "vertices of borders joined", "apart"},
        placed_{"vertex of a border put on an edge", "vertices of borders put on edges", "apart"},
        refused_{"vertex of a border near another", "vertices of borders near others", "apart"};
};

}  // namespace

void stitch_step(Soup& soup, const StepRequest& request, StepReport& report) {
    if (has_ordinary_facets(soup)) Stitching(soup, request, report).run();
}

}  // namespace kerf

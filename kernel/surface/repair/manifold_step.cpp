// First sheets go that bound nothing. Then each fan of facets at a vertex gets a vertex of its own, and moves a little
// into itself, so that the fans are apart: equal coordinates would be welded again. Where both ends of an edge have one
// fan, the pairs of its facets get middles of their own. Where facets are to be divided at crossings by a later step,
// places are opened only behind that, because bodies that touch would come apart by a crack; the borders of openings
// are an exception, since openings are filled before.
#include <algorithm>
#include <numeric>
#include <utility>

#include "surface/repair/inside/loose_sheets.h"
#include "surface/repair/inside/rims.h"
#include "surface/repair/inside/touching_fans.h"
#include "surface/repair/repair_step.h"

namespace kerf {

namespace {

class ManifoldOpening {
 public:
    ManifoldOpening(Soup& soup, const StepRequest& request, StepReport& report)
        : soup_(soup), request_(request), report_(report) {}

    void run() {
        if (has_walls(soup_, request_)) return;
        drop_loose();
        request_.check_cancelled();
        FanSeparation separation = separate_fans(soup_, request_.bound, request_.is_divided_later);
        report_.largest_move = std::max(report_.largest_move, separation.largest_move);
        for (RepairAction& action : separation.actions) report_.actions.push_back(std::move(action));
    }

 private:
    void drop_loose() {
        const bool with_walls = request_.bodies != BodyRepair::regions;
        const LooseSheets loose = find_loose_sheets(soup_.vertices, soup_.facets, with_walls);
        if (loose.fins.empty() && loose.membranes.empty() && loose.walls.empty()) return;
        std::vector<char> drop(soup_.facets.size(), 0);
        RepairAction membranes{"facet with the same material on both sides removed",
                               "facets with the same material on both sides removed"},
            walls{"facet of a wall between bodies removed", "facets of walls between bodies removed"};
        membranes.is_loss = walls.is_loss = true;
        mark(loose.fins, {"facet of a fin removed", "facets of fins removed"}, drop);
        mark(loose.membranes, std::move(membranes), drop);
        mark(loose.walls, std::move(walls), drop);
        drop_facets(soup_, drop);
        drop_unused_vertices(soup_);
    }
    void mark(const std::vector<std::int32_t>& facets, RepairAction action, std::vector<char>& drop) {
        for (const std::int32_t f : facets) {
            action.add({soup_.vertices[soup_.facets[f][0]], soup_.file_facets({f})});
            drop[f] = 1;
        }
        report_.actions.push_back(std::move(action));
    }

    Soup& soup_;
    const StepRequest& request_;
    StepReport& report_;
};

}  // namespace

void manifold_step(Soup& soup, const StepRequest& request, StepReport& report) {
    if (has_ordinary_facets(soup))
        ManifoldOpening(soup, request, report).run();
    else
        refuse_odd_facets(report);
}

}  // namespace kerf

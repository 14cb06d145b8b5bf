#include "base/geometry/triangle.h"
#include "surface/openings/thickening.h"
#include "surface/repair/repair_step.h"

namespace kerf {

void thicken_step(Soup& soup, const StepRequest& request, StepReport& report) {
    RepairAction walls{"sheet became a wall", "sheets became walls"};
    RepairAction turned{"facet is turned over by a sharp bend", "facets are turned over by sharp bends"};
    RepairAction infinite{"sheet", "sheets"};
    RepairAction unordered{"edge at which sheets lie on one another", "edges at which sheets lie on one another"};
    turned.changes_surface = unordered.changes_surface = false;
    infinite.refused_because = "a vertex has no finite coordinates";
    const Soup before = soup;
    const Thickening done = thicken(soup, request.amount);
    const auto tell = [&](RepairAction& action, const std::vector<std::int32_t>& facets) {
        for (const std::int32_t f : facets) {
            const Triangle& t = before.facets[f];
            const Vec3 where = (before.vertices[t[0]] + before.vertices[t[1]] + before.vertices[t[2]]) / 3;
            action.add({where, before.file_facets({f})});
        }
        report.actions.push_back(std::move(action));
    };
    tell(walls, done.sheets);
    tell(turned, done.turned_over);
    tell(infinite, done.infinite);
    tell(unordered, done.unordered);
    report.largest_move = done.largest_move;
}

}  // namespace kerf

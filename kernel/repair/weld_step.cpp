#include "repair/repair_step.h"

namespace kerf {

void weld_step(Soup& soup, const StepRequest& request, StepReport& report) {
    RepairAction merged{"vertex merged", "vertices merged"};
    merged.count = weld_within(soup, request.amount);
    if (merged.count > 0) drop_unused_vertices(soup);
    report.largest_move = merged.count > 0 ? request.amount : 0;
    report.actions.push_back(std::move(merged));
}

}  // namespace kerf

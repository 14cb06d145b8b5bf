#include "repair/repair.h"

#include <algorithm>

#include "core/error.h"
#include "geometry/box.h"
#include "repair/repair_step.h"

namespace kerf {

namespace {

class Ladder {
 public:
    Ladder(Soup& soup, const RepairPlan& plan, const std::function<void()>& poll) : soup_(soup), plan_(plan) {
        const Box box = box_around_finite(soup.vertices);
        report_.diagonal = box.isEmpty() ? 0 : box.diagonal().norm();
        report_.bound = plan.bound.of(report_.diagonal);
        if (poll) poll_ = poll;
    }

    RepairReport climb() {
        for (const RepairStepRow& row : repair_step_rows()) {
            apply(row);
            const bool is_filled =
                row.kind == RepairKind::holes && plan_.find(row.kind) != nullptr && report_.steps.back().changed();
            if (is_filled) apply(repair_step_rows()[static_cast<std::size_t>(RepairKind::manifold)]);
        }
        if (!report_.steps.empty() && report_.steps.back().kind == RepairKind::intersections &&
            report_.steps.back().changed() && soup_.sides.empty())
            for (const RepairKind again : {RepairKind::clean, RepairKind::manifold})
                apply(repair_step_rows()[static_cast<std::size_t>(again)]);
        return std::move(report_);
    }

 private:
    void apply(const RepairStepRow& row) {
        const RepairStep* step = plan_.find(row.kind);
        if (step == nullptr) return;
        poll_();
        StepRequest request{.bound = report_.bound,
                            .diagonal = report_.diagonal,
                            .bodies = plan_.bodies,
                            .poll = poll_,
                            .plan = &plan_};
        request.amount = step->amount.value_or(row.usual).of(report_.diagonal);
        StepReport& done = report_.steps.emplace_back(StepReport{row.kind, {}});
        row.apply(soup_, request, done);
        std::erase_if(done.actions, [](const RepairAction& action) { return action.count == 0; });
    }

    Soup& soup_;
    const RepairPlan& plan_;
    std::function<void()> poll_ = [] {};
    RepairReport report_;
};

}  // namespace

RepairReport repair(Soup& soup, const RepairPlan& plan, const std::function<void()>& poll) {
    if (plan.empty()) return {};
    if (!soup.sides.empty())
        throw Error(ErrorCode::usage,
                    "--repair is for facets that do not say what they bound, but this surface has regions that share "
                    "walls. Leave it out.");
    return Ladder(soup, plan, poll).climb();
}

}  // namespace kerf

// The ladder is climbed once in the order of the table of steps, with the repetitions that repair.h names; apply()
// gives each step its request and a report, and passes over steps that the plan does not have. The preparations are
// done first and reported apart, and the lengths of the other steps are measured behind them. Later steps rely on
// earlier ones: `is_divided_later_` tells steps before `intersections` to leave contacts of bodies alone.
//
// renew() then climbs from `manifold` on again in rounds. A round is a transaction: the soup and the list of reports
// are put back unless fewer defects remain and at least nine tenths of the area that it began with. Round 0 takes
// nothing out, and only tries longer holes; each further round cuts out more around the defects.
#include "surface/repair/repair.h"

#include <algorithm>

#include "base/core/error.h"
#include "base/geometry/box.h"
#include "base/geometry/triangle.h"
#include "surface/repair/inside/remaining_defects.h"
#include "surface/repair/inside/rims.h"
#include "surface/repair/repair_step.h"

namespace kerf {

namespace {

const RepairStepRow& row_of(RepairKind kind) { return repair_step_rows()[static_cast<std::size_t>(kind)]; }

class Ladder {
 public:
    Ladder(Soup& soup, const RepairPlan& plan, const std::function<void()>& check_cancelled)
        : soup_(soup), plan_(plan) {
        if (check_cancelled) check_cancelled_ = check_cancelled;
    }

    RepairReport climb() {
        for (const RepairKind kind : {RepairKind::merge, RepairKind::largest, RepairKind::span}) apply(kind);
        if (plan_.only_prepares()) return std::move(report_);
        refuse_regions();
        measure();
        for (const RepairStepRow& row : rows_with_words()) {
            if (row.kind == RepairKind::renew) continue;
            if (row.kind == RepairKind::intersections) apply(RepairKind::renew);
            apply(row.kind);
            if (row.kind == RepairKind::intersections) is_divided_later_ = false;
            if (row.kind == RepairKind::holes && has_changed(row.kind)) apply(RepairKind::manifold);
        }
        if (plan_.find(RepairKind::intersections) != nullptr) tidy(has_changed(RepairKind::intersections));
        renew();
        return std::move(report_);
    }

 private:
    void refuse_regions() const {
        if (soup_.sides.empty()) return;
        throw Error(ErrorCode::usage,
                    "Repairs are for facets that do not say what they bound, but this surface has regions that share "
                    "walls. Mesh it as it is, without --repair, or mend it where it was made.");
    }
    double diagonal_now() const {
        const Box box = box_around_finite(soup_.vertices);
        return box.isEmpty() ? 0 : box.diagonal().norm();
    }
    void measure() {
        report_.diagonal = diagonal_now();
        report_.bound = plan_.bound.of(report_.diagonal);
    }

    void apply(RepairKind kind, int round = 0) {
        const RepairStep* step = plan_.find(kind);
        if (step == nullptr) return;
        check_cancelled_();
        const RepairStepRow& row = row_of(kind);
        const bool prepares = is_preparation(kind);
        StepRequest request{.bound = report_.bound,
                            .diagonal = prepares ? diagonal_now() : report_.diagonal,
                            .bodies = plan_.bodies,
                            .are_walls = plan_.are_walls,
                            .voids_are_parity = plan_.voids_are_parity,
                            .outside_is_meshed = plan_.outside_is_meshed,
                            .check_cancelled = check_cancelled_,
                            .plan = &plan_,
                            .round = round,
                            .is_last_round = round == most_renewals - 1,
                            .is_divided_later = is_divided_later_};
        request.amount = step->amount.value_or(usual_amount(row)).of(request.diagonal);
        StepReport& done = (prepares ? report_.preparations : report_.steps).emplace_back(StepReport{kind, {}});
        done.amount = request.amount;
        row.apply(soup_, request, done);
        std::erase_if(done.actions, [](const RepairAction& action) { return action.count == 0; });
    }
    // Holes that are left at last may be longer, where nobody says how long.
    Length usual_amount(const RepairStepRow& row) const {
        const RepairStep* last = plan_.find(RepairKind::renew);
        if (row.kind != RepairKind::holes || !is_renewing_ || last == nullptr) return row.usual;
        return last->amount.value_or(row_of(RepairKind::renew).usual);
    }
    // Whether the last step was of this kind, and did something.
    bool has_changed(RepairKind kind) const {
        return !report_.steps.empty() && report_.steps.back().kind == kind && report_.steps.back().changed();
    }
    // Behind intersections: divided facets may touch themselves and leave specks, and contacts from before wait for it.
    void tidy(bool was_divided) {
        if (!soup_.sides.empty()) return;
        if (was_divided) apply(RepairKind::clean);
        apply(RepairKind::manifold);
        if (was_divided) apply(RepairKind::specks);
    }

    // Goes up the rest of the ladder again: first with all that is left, then without facets that are still defective,
    // each time with more around them. A round that leaves as many defects as before, or too little of the area, is
    // undone.
    void renew() {
        const RepairStep* step = plan_.find(RepairKind::renew);
        if (step == nullptr || !soup_.sides.empty() || has_regions()) return;
        is_renewing_ = true;
        const double most_edges = step->amount.value_or(row_of(RepairKind::renew).usual).number();
        const double least_area = (1 - largest_loss) * surface_area(soup_);
        std::size_t defects = find_remaining_defects(soup_, most_edges).size();
        for (int round = 0; round < most_renewals && defects > 0; ++round) {
            const Soup before = soup_;
            const std::size_t steps_before = report_.steps.size();
            if (round > 0) apply(RepairKind::renew, round);
            if (round > 0 && !has_changed(RepairKind::renew)) {
                report_.steps.pop_back();
                continue;
            }
            if (!close_again()) {
                report_.steps.resize(steps_before, StepReport{RepairKind::renew, {}});
                continue;
            }
            const std::size_t left = find_remaining_defects(soup_, most_edges).size();
            if (left >= defects || surface_area(soup_) < least_area) {
                soup_ = before;
                report_.steps.resize(steps_before, StepReport{RepairKind::renew, {}});
                continue;
            }
            defects = left;
        }
    }
    // Whether there are walls, to which find_remaining_defects() would object.
    bool has_regions() const {
        return has_ordinary_facets(soup_) && has_walls(soup_, {.bodies = plan_.bodies, .are_walls = plan_.are_walls});
    }
    // Whether anything was done.
    bool close_again() {
        bool is_any = has_changed(RepairKind::renew);
        for (const RepairKind again : {RepairKind::manifold, RepairKind::holes, RepairKind::manifold}) {
            apply(again);
            is_any |= has_changed(again);
        }
        if (!is_any) return false;
        apply(RepairKind::intersections);
        if (has_changed(RepairKind::intersections)) tidy(true);
        return true;
    }
    static double surface_area(const Soup& soup) {
        double area = 0;
        for (const Triangle& t : soup.facets) area += triangle_area(soup.vertices, t);
        return area;
    }

    static constexpr int most_renewals = 5;
    static constexpr double largest_loss = 0.1;  // of the area, over all rounds

    Soup& soup_;
    const RepairPlan& plan_;
    std::function<void()> check_cancelled_ = [] {};
    RepairReport report_;
    bool is_renewing_ = false;
    bool is_divided_later_ = plan_.find(RepairKind::intersections) != nullptr;
};

}  // namespace

RepairReport repair(Soup& soup, const RepairPlan& plan, const std::function<void()>& check_cancelled) {
    return Ladder(soup, plan, check_cancelled).climb();
}

}  // namespace kerf

// The steps of a repair: a row says what one is called and does, and a function does it.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "repair/repair_plan.h"
#include "repair/repair_report.h"
#include "surface/soup.h"

namespace kerf {

/// What a step is told.
struct StepRequest {
    double amount = 0;    ///< of the step, a length in units of the surface
    double bound = 0;     ///< farther no vertex of the input is moved, units of the surface
    double diagonal = 0;  ///< of the bounding box of the surface as it came
    BodyRepair bodies = BodyRepair::as_found;
    bool are_walls = false;              ///< see RepairPlan
    bool voids_are_parity = false;       ///< see RepairPlan
    std::function<void()> poll = [] {};  ///< to be called now and then; may throw
    const RepairPlan* plan = {};         ///< all that is asked for; none: this step alone
    int round = 0;                       ///< of renewing; 0: before facets are divided where they cross
    bool is_last_round = false;
    bool is_divided_later = false;  ///< facets that cross or touch, by a step behind this one

    bool has(RepairKind kind) const { return plan != nullptr && plan->find(kind) != nullptr; }
};

/// Changes the soup, see repair(), and says what it did in `report`.
using ApplyStep = void(Soup& soup, const StepRequest& request, StepReport& report);

/// What can be asked of a step.
enum class AmountKind { none, length, count };

struct RepairStepRow {
    RepairKind kind;
    const char* name;   ///< as users write it
    RepairLevel level;  ///< from which on it belongs to it; none: only by its name
    AmountKind amount;
    Length usual;      ///< of the amount, where nobody says it
    const char* help;  ///< "merge vertices nearer than this"
    ApplyStep* apply;
};

/// In the order of RepairKind.
std::span<const RepairStepRow> repair_step_rows();
const char* name(RepairKind kind);

/// Whether facets part regions, by walls that these share or are said to, which no step may take out or part; never
/// where bodies are to be united. Requires ordinary facets. Cost as is_of_touching_bodies() where edges have more than
/// two facets.
bool has_walls(const Soup& soup, const StepRequest& request);

/// Says that nothing is done to a surface that has facets with a repeated vertex, or without finite coordinates.
void refuse_odd_facets(StepReport& report);

/// intersections_step() refuses, and says, surfaces whose coordinates are not finite, and those of which half of the
/// facets are shorter than doubles as large as the largest coordinate are apart: divided facets would not be theirs.
ApplyStep weld_step, clean_step, stitch_step, orient_step, manifold_step, specks_step, caps_step, holes_step,
    thicken_step, snap_step, intersections_step, renew_step;

}  // namespace kerf

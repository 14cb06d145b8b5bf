// The steps of a repair: a row says what one is called and does, and a function does it.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "surface/repair/repair_plan.h"
#include "surface/repair/repair_report.h"
#include "surface/soup/soup.h"

namespace kerf {

/// The request to a step.
struct StepRequest {
    double amount = 0;    ///< amount of the step: a length in units of the surface, or a count
    double bound = 0;     ///< the largest move of a vertex of the input, units of the surface
    double diagonal = 0;  ///< diagonal of the bounding box: of a preparation now, else behind the preparations
    BodyRepair bodies = BodyRepair::as_found;
    bool are_walls = false;                         ///< see RepairPlan
    bool voids_are_parity = false;                  ///< see RepairPlan
    bool outside_is_meshed = false;                 ///< see RepairPlan
    std::function<void()> check_cancelled = [] {};  ///< to be called now and then; may throw
    const RepairPlan* plan = {};                    ///< the whole plan; none: this step alone
    int round = 0;  ///< the round of renewing; 0: before facets are divided where they cross
    bool is_last_round = false;
    bool is_divided_later = false;  ///< a later step divides facets that cross or touch

    bool has(RepairKind kind) const { return plan != nullptr && plan->find(kind) != nullptr; }
};

/// The function of a step: it changes the soup, see repair(), and adds its actions to `report`.
using ApplyStep = void(Soup& soup, const StepRequest& request, StepReport& report);

/// The kind of amount that a step takes.
enum class AmountKind { none, length, count };

struct RepairStepRow {
    RepairKind kind;
    const char* name;   ///< the word that users write, unless is_preparation()
    RepairLevel level;  ///< the least level that has it; none: it is done only by name or option
    AmountKind amount;
    Length usual;      ///< the amount where nobody gives one
    const char* help;  ///< "merge vertices nearer than this"
    ApplyStep* apply;
};

/// Returns a row for each step, in the order of RepairKind.
std::span<const RepairStepRow> repair_step_rows();
/// Returns the rows of the steps behind the preparations.
std::span<const RepairStepRow> rows_with_words();
const char* name(RepairKind kind);

/// Whether facets part regions, by walls that these share or are said to share, which no step may take out or part;
/// never where bodies are to be united. Requires ordinary facets. Cost as is_of_touching_bodies() where edges have more
/// than two facets.
bool has_walls(const Soup& soup, const StepRequest& request);

/// Reports that nothing is done to a surface that has facets with a repeated vertex, or without finite coordinates.
void refuse_odd_facets(StepReport& report);

/// The functions of the steps. intersections_step() refuses, with a report, surfaces whose coordinates are not finite,
/// and surfaces half of whose facets are shorter than the spacing of doubles at the largest coordinate: divided facets
/// would not be theirs.
ApplyStep merge_step, largest_step, span_step, weld_step, clean_step, stitch_step, orient_step, manifold_step,
    specks_step, caps_step, holes_step, thicken_step, snap_step, intersections_step, renew_step;

}  // namespace kerf

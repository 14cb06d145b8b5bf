#include "surface/repair/repair_step.h"

#include <utility>

#include "surface/repair/inside/rims.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

constexpr RepairLevel by_name_only = RepairLevel::none;

const RepairStepRow step_rows[] = {
    {RepairKind::merge, "merge", by_name_only, AmountKind::length, 0,
     "merge vertices nearer than TOL, wherever they are", merge_step},
    {RepairKind::largest, "largest", by_name_only, AmountKind::none, 0,
     "keep only the connected component of the largest area", largest_step},
    {RepairKind::span, "span", by_name_only, AmountKind::count, 0,
     "span closed loops of at most N edges by facets of their own vertices", span_step},
    {RepairKind::weld, "weld", RepairLevel::near, AmountKind::length, Length::percent(1e-4),
     "merge vertices nearer than TOL", weld_step},
    {RepairKind::clean, "clean", RepairLevel::exact, AmountKind::none, 0,
     "remove copies of facets, facets folded upon each other or without area, and what lies inside of closed bodies "
     "that share facets",
     clean_step},
    {RepairKind::stitch, "stitch", RepairLevel::near, AmountKind::length, Length::percent(0.1),
     "join borders nearer than TOL", stitch_step},
    {RepairKind::orient, "orient", RepairLevel::exact, AmountKind::none, 0, "turn facets to agree", orient_step},
    {RepairKind::manifold, "manifold", RepairLevel::exact, AmountKind::none, 0,
     "open edges of more than two facets and vertices where pieces touch", manifold_step},
    {RepairKind::specks, "specks", RepairLevel::near, AmountKind::length, Length::percent(0.1),
     "remove pieces smaller than TOL", specks_step},
    {RepairKind::caps, "caps", by_name_only, AmountKind::count, 8,
     "close ends of at least N edges by patches cap_1, cap_2, ...", caps_step},
    {RepairKind::holes, "holes", RepairLevel::near, AmountKind::count, 200, "fill openings of at most N edges",
     holes_step},
    {RepairKind::thicken, "thicken", by_name_only, AmountKind::length, Length::percent(1),
     "make open sheets walls of this thickness", thicken_step},
    {RepairKind::snap, "snap", by_name_only, AmountKind::length, Length::percent(0.01),
     "make walls of two bodies nearer than TOL one", snap_step},
    {RepairKind::intersections, "intersections", RepairLevel::full, AmountKind::none, 0,
     "divide facets where they cross and leave out what lies inside", intersections_step},
    {RepairKind::renew, "renew", RepairLevel::full, AmountKind::count, 500,
     "take out what is still defective, holes of at most N edges, too, and fill it again", renew_step},
};

}  // namespace

std::span<const RepairStepRow> repair_step_rows() { return step_rows; }

std::span<const RepairStepRow> rows_with_words() {
    return repair_step_rows().subspan(static_cast<std::size_t>(RepairKind::weld));
}

const char* name(RepairKind kind) { return step_rows[static_cast<std::size_t>(kind)].name; }

bool has_walls(const Soup& soup, const StepRequest& request) {
    if (request.bodies == BodyRepair::unite || !has_edge_of_many(soup.facets)) return false;
    return request.are_walls || is_of_touching_bodies(soup);
}

void refuse_odd_facets(StepReport& report) {
    RepairAction left{"surface", "surfaces"};
    left.refused_because = "it has facets with a repeated vertex or without finite coordinates: clean first";
    left.count = 1;
    report.actions.push_back(std::move(left));
}

}  // namespace kerf

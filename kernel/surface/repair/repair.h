// The repair of a surface by a ladder of steps.
#pragma once

#include <functional>

#include "surface/repair/repair_plan.h"
#include "surface/repair/repair_report.h"
#include "surface/soup/soup.h"

namespace kerf {

/// Does the steps of a plan, in the order of RepairKind, some of them more than once where they are asked for.
/// Percentages of `merge` are of the soup as it comes, those of the other steps of what the preparations leave.
/// `manifold` follows `holes` again, because fins are known once a body is closed. `clean`, `manifold` and `specks`
/// follow `intersections`: places where the surface touches itself are parted only there, so that bodies with other
/// facets at a contact become one without a crack. `renew` takes out loose pieces before `intersections`; at the end it
/// goes up the ladder from `manifold` on again, in a few rounds, each of which is undone unless it leaves fewer
/// defects. A surface in which no step finds anything to do is not changed at all: no vertex, no facet, no order.
///
/// Facets of the file keep their order and numbers (Soup::polygon); pieces of a facet follow each other in its place,
/// and new facets come last, in patches of their own ("filled", "cap_1", ...), with numbers behind those of the file. A
/// step that would move a vertex farther than the bound, or change something that is no defect, leaves it and reports
/// that.
///
/// `soup`: its numbers in range, welded exactly; facets without finite coordinates stay. `check_cancelled`, if given,
/// is called again and again, and ends the work by throwing. Throws Error(usage) for a tolerance of `merge` beyond the
/// diagonal, and, if there are steps behind the preparations, for a soup that says what lies on the sides of its
/// facets: its regions share walls already. Deterministic. 400 k facets take seconds where few cross; 100 k that cross
/// everywhere take minutes, since each round divides all of them again.
RepairReport repair(Soup& soup, const RepairPlan& plan, const std::function<void()>& check_cancelled = {});

}  // namespace kerf

// From a surface with defects to one without, as far as that can be told: a ladder of steps.
#pragma once

#include <functional>

#include "repair/repair_plan.h"
#include "repair/repair_report.h"
#include "surface/soup.h"

namespace kerf {

/// Does the steps of a plan, in the order of RepairKind; `manifold` once more behind `holes`, because fins are known
/// once a body is closed, and `clean`, `manifold` and `specks` behind `intersections`, where they are asked for: what
/// touches is parted only there, so that bodies with other facets at a contact become one without a crack. `renew` goes
/// up the ladder from `manifold` on again, in a few rounds, each of which is undone unless it leaves fewer defects.
/// What no step finds anything to do in is not changed at all: no vertex, no facet, no order.
///
/// Facets of the file keep their order and numbers (Soup::polygon); pieces of a facet follow each other in its place,
/// and new facets come last, in patches of their own ("filled", "cap_1", ...), with numbers behind those of the file. A
/// step that would move a vertex farther than the bound, or change what is no defect, leaves that and reports it.
/// `soup`: its numbers in range, welded exactly; facets without finite coordinates stay. `poll`: called again and again
/// while it lasts, if given; ends the work by what it throws. Throws Error(usage) for a soup that says what lies on the
/// sides of its facets: its regions share walls already. Deterministic. 400 k facets
/// in seconds where few cross; minutes for 100 k that cross everywhere, since each round divides all of them again.
RepairReport repair(Soup& soup, const RepairPlan& plan, const std::function<void()>& poll = {});

}  // namespace kerf

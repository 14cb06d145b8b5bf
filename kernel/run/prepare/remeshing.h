// The decision whether and how the surface of a run is remeshed before it is cut.
#pragma once

#include <optional>
#include <string>

#include "run/prepare/input.h"
#include "run/prepare/stage_listener.h"
#include "run/request/run_request.h"

namespace kerf {

/// The change of a surface before it is cut.
enum class SurfaceChange {
    none,
    division,  ///< coarse facets are divided in their planes (run/prepare/inside/facet_division.h)
    remeshing
};

/// Returns the change that `options` ask for on this input; division also where the size is yet to follow from a number
/// of cells. All forecasts and reports ask here. O(#F).
SurfaceChange surface_change(const Input& input, const RunRequest& options);

/// Returns the deviation where the options ask for none: a twentieth of the shortest length that `wanted` has at a
/// vertex, which is what chords of that length leave out of a circle with a radius of 2.5 of them; if `wanted` is
/// empty, 5e-4 of the diagonal, or 2e-3 for coarse and 1.5e-4 for fine.
double usual_deviation(const SizeField& wanted, const SurfaceArrays& surface, double diagonal,
                       Fineness fineness = Fineness::medium);

/// Returns the deviation that is wanted of a body with this diagonal. Throws Error(usage), naming the option, for one
/// that is too small or too large for it.
double deviation_for(const Length& wanted, double diagonal);

/// Returns about how many facets the surface will have after remesh_where_asked(); it gets more where its shape asks
/// for them. O(#F).
double forecast_changed_facets(const Input& input, const RunRequest& options);

/// Returns the input, remeshed where `options` ask for it, or with a note about slivers. Remeshing that nobody has
/// asked for is noted; where only few facets need it, the others stay (facets_away_from_slivers()), unless sizes are
/// wanted. So do sides that match (run/prepare/inside/periodicity.h), unless more than one in fifty of their facets is
/// a sliver. Where facets are good but coarser than sizes, they are divided, unless the options keep them. Surface,
/// counts, area and volume are the new ones then, and Input::remeshed reports the change. The wanted lengths are those
/// of RunRequest::sizes. `listener`, unless null, is told of the stage "remesh" again and again while it lasts, with
/// the hundredths that are done; where facets are divided, with steps of an unknown total. Throws Error(usage) for a
/// deviation out of range, Error(memory) with the way out for more facets than there is memory for, before the first of
/// them, Error(cancelled). Where the bound cannot be kept, or a volume changes by more than largest_volume_change
/// although no deviation was asked for, the facets stay and are divided, which is noted; that is Error(input) or
/// Error(verification) where remeshing was asked for.
Input remesh_where_asked(Input input, const RunRequest& options, StageListener* listener = nullptr);

}  // namespace kerf

// The edge lengths of the next mesh for the error that is wanted.
#pragma once

#include <vector>

#include "base/parallel/communicator.h"
#include "solve/equations/stress.h"
#include "solve/space/fe_space.h"
#include "surface/size/background_sizes.h"

namespace kerf {

/// Returns the error that the next mesh shall have, given the largest estimated error of the cases: a little less than
/// `target`, but no less than a mesh with about four times the cells can have, since an estimate is not to be trusted
/// further.
double error_of_next_mesh(double relative_error, double target, int order);

/// Returns edge lengths with which the estimated error of each of the fields is about `aim` beside the norm of its
/// solution, with as few tetrahedra as possible: errors of elements fall with the order of the elements, and are left
/// alike per cell (Ladeveze, Coffignal and Pelle 1986, ladeveze1986). Lengths are between a quarter of and twice those
/// of the cells there. The mesh that is returned consists of cubes one to two edges wide, over which lengths are means:
/// about 0.4 tetrahedra for each of those that it stands for. Collective; the same on every rank. Lengths are rounded
/// to steps of 4 percent, so that ranks in other numbers, whose solutions differ in the last digits, ask for the same
/// ones. O(n log n).
SizedMesh sizes_for_error(const FeSpace& space, const std::vector<const StressField*>& fields, double aim,
                          Communicator& ranks);

}  // namespace kerf

// Places of clip planes that lie in no face of a body, where a picture would show crumbs of cells.
#pragma once

#include "viewer/model/document.h"
#include "viewer/model/view_state.h"

namespace kerf::view {

/// Moves the clip plane a little, into the middle of the widest gap nearby, if it lies in or close to faces of the
/// surface that have its direction. `box` is the one that Clip::position is a fraction of. The plane stays where no
/// such face is close, and where it lies at an end of the box.
void keep_off_faces(Clip& clip, const NodeSurface& surface, const Eigen::AlignedBox3d& box);

}  // namespace kerf::view

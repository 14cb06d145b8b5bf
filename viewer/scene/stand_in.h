// A scene with fewer triangles that stands in for a large one while the camera moves.
#pragma once

#include <cstdint>

#include "viewer/scene/layer.h"

namespace kerf::view {

/// Returns the scene with the triangles of large layers joined where they are small in any picture of the whole, and
/// without darker hollows. Other layers, ranges, colours and numbers of layers stay. Nothing in it can be picked.
Scene stand_in_for(const Scene& scene);

}  // namespace kerf::view

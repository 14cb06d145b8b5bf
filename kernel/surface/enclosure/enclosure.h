// The air in a box around bodies, as a surface.
#pragma once

#include <functional>

#include "surface/enclosure/enclosure_options.h"
#include "surface/soup/soup.h"

namespace kerf {

/// Replaces bodies by the air around them: the soup becomes the closed surface of the space that is in the box and not
/// in a body, one region with normals that point out of the air. Patches keep their names, and faces of the box are
/// patches; a sole patch called "surface" is called "body". Where bodies reach beyond the box they are cut off exactly
/// at its faces, and facets that lie in a face are cut out of it. `keeps_bodies`: bodies in the box are regions beside
/// "air", with their names or as "body".
///
/// Air that bodies, or bodies and the box, close off from the rest is left out: the largest space counts, and a note
/// says how much is left out. Sets Enclosure::body_volume.
///
/// Requires bodies without defects, oriented: facets without sides have their body behind them. Throws Error(usage),
/// with the places of both, for a box in which there is no body or no air, and Error(input), naming a place, where
/// facets and box cannot be divided without crossing. `check_cancelled` may throw. Cost as arrange() and find_cells().
/// Deterministic.
void enclose(Soup& soup, Enclosure& enclosure, bool keeps_bodies, const std::function<void()>& check_cancelled = {});

}  // namespace kerf

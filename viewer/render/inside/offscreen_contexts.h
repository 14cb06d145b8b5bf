// The contexts behind offscreen.h; the build compiles those whose libraries are there.
#pragma once

#include <memory>

#include "viewer/render/offscreen.h"

namespace kerf::view {

/// Returns whether the library OSMesa is there; loads it.
bool has_osmesa();
std::unique_ptr<OffscreenContext> make_osmesa_context();
std::unique_ptr<OffscreenContext> make_egl_context();

}  // namespace kerf::view

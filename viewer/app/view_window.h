// The viewer in a window.
#pragma once

#include "viewer/app/command_line.h"

namespace kerf::view {

/// Shows the viewer until the user closes it. Throws Error(io) without a display.
void view_in_window(const ViewCommand& command, const AppOptions& options);

}  // namespace kerf::view

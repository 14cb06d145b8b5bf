// Pictures without a display.
#pragma once

#include "viewer/app/command_line.h"

namespace kerf::view {

/// Opens the input, waits until all that is to be shown is there, and writes the picture or pictures. Throws Error:
/// that of the input if it cannot be shown (a surface with problems can), usage for a node, stage or region that there
/// is not, cancelled if it is interrupted or not ready within command.picture.timeout_seconds.
void take_screenshot(const ViewCommand& command, const AppOptions& options);

}  // namespace kerf::view

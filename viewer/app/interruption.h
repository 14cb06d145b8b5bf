// Ctrl-C, and whoever else ends the program politely.
#pragma once

namespace kerf::view {

/// From now on SIGINT, SIGTERM and SIGHUP only set a mark, so that runs are ended and folders removed as at any end.
void watch_for_interruption();
bool was_interrupted();

}  // namespace kerf::view

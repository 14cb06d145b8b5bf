// A polite end of the program by Ctrl-C and other signals.
#pragma once

namespace kerf::view {

/// Makes SIGINT, SIGTERM and SIGHUP only set a mark from now on, so that runs are ended and folders removed as at any
/// end.
void watch_for_interruption();
bool was_interrupted();

}  // namespace kerf::view

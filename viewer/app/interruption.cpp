#include "viewer/app/interruption.h"

#include <atomic>
#include <csignal>

namespace kerf::view {

namespace {

std::atomic<bool> interrupted = false;

}  // namespace

void watch_for_interruption() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, [](int) { interrupted = true; });
}

bool was_interrupted() { return interrupted; }

}  // namespace kerf::view

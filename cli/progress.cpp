#include "cli/progress.h"

#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>

#include <fmt/format.h>

namespace kerf {

namespace {

volatile std::sig_atomic_t stop_signal = 0;

void note_signal(int signal) { stop_signal = signal; }

std::string time_left(double elapsed, std::size_t done, std::size_t total) {
    if (done == 0) return "--:--";
    const long seconds = std::lround(elapsed * static_cast<double>(total - done) / static_cast<double>(done));
    return fmt::format("{:02}:{:02}", seconds / 60, seconds % 60);
}

}  // namespace

ProgressLine::ProgressLine(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1) {
    stop_signal = 0;
    std::signal(SIGINT, note_signal);
    std::signal(SIGTERM, note_signal);
}

ProgressLine::~ProgressLine() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    if (line_open_) std::fputs("\r\033[K", stderr);
}

bool ProgressLine::cancelled() const { return stop_signal != 0; }

void ProgressLine::on_progress(const char* stage, std::size_t done, std::size_t total) {
    if (quiet_ || total == 0) return;
    if (stage_ != stage) {
        stage_ = stage;
        last_tenth_ = 0;
        stage_start_ = std::chrono::steady_clock::now();
    }
    const std::size_t tenth = 10 * done / total;
    if (!terminal_ && (tenth == last_tenth_ || total == 1)) return;
    last_tenth_ = tenth;
    if (total == 1) {
        print(stage_);
        return;
    }
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - stage_start_).count();
    print(fmt::format("{}  {}/{} parts  {} %  ETA {}", stage_, done, total, 100 * done / total,
                      time_left(elapsed, done, total)));
}

void ProgressLine::print(const std::string& text) {
    std::fputs(terminal_ ? ("\r\033[K" + text).c_str() : (text + "\n").c_str(), stderr);
    std::fflush(stderr);
    line_open_ = terminal_;
}

}  // namespace kerf

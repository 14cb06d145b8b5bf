// Progress of a run on standard error. On a terminal one line is rewritten (\r and the code that clears to its end); in
// a log there is a line for each tenth of the work and, after tell_each_second(), for each second. line_open_ tells
// that the line has to be cleared before anything else is printed. A signal only sets a mark, which the run asks for by
// cancelled(), so that it ends at a place where its folder is whole; an alarm ends the process two seconds later if the
// run is deaf, after which the folder can be continued, too. A mutex guards all members that the second thread uses.
// The time left of parts is the report's, by load; that of a solution follows from the residual, which falls by about
// the same factor in each iteration.
#include "cli/progress.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <string_view>

#include <fmt/format.h>

#include "base/core/number_text.h"
#include "cli/own_ranks.h"
#include "cli/terminal.h"
#include "files/io/standard_streams.h"

namespace kerf {

namespace {

volatile std::sig_atomic_t stop_signal = 0;

// The run ends by itself as soon as it notices the signal. Where it is deaf, in a long computation or a slow disk, it
// is ended: whatever it was doing, its folder can be continued.
constexpr unsigned seconds_to_end = 2;

constexpr double seconds_between_lines = 0.2, seconds_between_logged_lines = 1, seconds_of_silence = 0.9;

void note_signal(int signal) {
    if (stop_signal == 0) ::alarm(seconds_to_end);
    stop_signal = signal;
}

void end_now(int) {
    constexpr std::string_view text =
        "kerf: The run was cancelled in the middle of a step. If it is not complete, kerf mesh --resume goes on.\n";
    (void)!::write(STDERR_FILENO, text.data(), text.size());
    ::_exit(static_cast<int>(ErrorCode::cancelled));
}

std::string time_left(double left) {
    if (left < 0) return "--:--";
    const long seconds = std::lround(left);
    return seconds < 3600 ? fmt::format("{:02}:{:02}", seconds / 60, seconds % 60)
                          : fmt::format("{}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

// A bar "[===== ] " that fills the line beside a text of so many characters; empty where there is little room.
std::string bar(double done, int beside) {
    constexpr int longest = 30, shortest = 5, around = 8 + 4 + 1;  // "volume  ", brackets and blanks, the cursor
    const int length = std::min(longest, terminal_columns() - beside - around);
    if (length < shortest) return "";
    const int full = std::clamp(static_cast<int>(done * length), 0, length);
    return fmt::format("[{:=<{}}{: <{}}]  ", "", full, "", length - full);
}

}  // namespace

ProgressLine::ProgressLine(bool quiet, EventLog* events, bool shows_plan)
    : quiet_(quiet), terminal_(is_error_on_terminal()), shows_plan_(shows_plan), events_(events) {
    stop_signal = 0;
    std::signal(SIGINT, note_signal);
    std::signal(SIGTERM, note_signal);
    std::signal(SIGUSR1, note_signal);  // sent to ranks that this program has started
    std::signal(SIGALRM, end_now);
}

ProgressLine::~ProgressLine() {
    each_second_thread_ = {};
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    std::signal(SIGUSR1, SIG_DFL);
    ::alarm(0);
    clear();
}

void ProgressLine::clear() {
    if (line_open_) tell("\r\033[K");
    line_open_ = false;
}

bool ProgressLine::cancelled() const { return stop_signal != 0; }

void ProgressLine::tell_each_second() {
    each_second_ = true;
    each_second_thread_ = std::jthread([this](const std::stop_token& stop) {
        std::unique_lock lock(mutex_);
        while (!end_.wait_for(lock, stop, std::chrono::milliseconds(100), [&] { return stop.stop_requested(); }))
            if (!stage_.empty() && of_stage_.seconds() > last_seconds_ + seconds_of_silence) tell_that_it_goes_on();
    });
}

void ProgressLine::tell_that_it_goes_on() {
    last_seconds_ = of_stage_.seconds();
    if (events_) events_->on_working(stage_, done_, total_, last_seconds_);
    if (!quiet_)
        tell(terminal_ ? fmt::format("\r\033[K{}  {:.1f} s", text_, last_seconds_)
                       : fmt::format("{}  {:.1f} s\n", text_, last_seconds_));
    line_open_ = !quiet_ && terminal_;
}

bool ProgressLine::is_time_for_a_line() const {
    return of_stage_.seconds() > last_seconds_ + (terminal_ ? seconds_between_lines : seconds_between_logged_lines);
}

void ProgressLine::begin_stage(const char* stage) {
    stage_ = stage;
    of_stage_ = {};
    last_seconds_ = 0;
    text_ = stage_ + unknowns_;
    if (!quiet_ && (terminal_ || each_second_)) print(text_);
}

void ProgressLine::on_equations(std::int64_t unknowns) {
    const std::lock_guard lock(mutex_);
    if (events_) events_->on_equations(unknowns);
    unknowns_ = fmt::format("  {} unknowns", short_number(unknowns));
}

void ProgressLine::on_progress(const char* stage, std::size_t done, std::size_t total) {
    const std::lock_guard lock(mutex_);
    if (events_) events_->on_progress(stage, done, total);
    done_ = done;
    total_ = total;
    if (stage_ != stage) {
        if (std::string_view(stage) == "read") unknowns_.clear();  // the next mesh begins
        begin_stage(stage);
    } else if (!quiet_ && (terminal_ || each_second_) && total != 1 && is_time_for_a_line()) {
        last_seconds_ = of_stage_.seconds();
        print(total == 0 ? fmt::format("{}{}  {:.1f} s", stage_, unknowns_, last_seconds_) : state_text());
    }
    text_ = state_text();
}

// The stage with its progress, which is told as long as there is nothing new.
std::string ProgressLine::state_text() const {
    if (stage_ == "remesh" && total_ == 100) {  // hundredths
        const double left = done_ > 0 ? of_stage_.seconds() * (total_ - done_) / done_ : -1;
        return fmt::format("{}  {} %  ETA {}", stage_, done_, time_left(left));
    }
    return total_ < 2 ? stage_ + unknowns_ : fmt::format("{}{}  {}/{}", stage_, unknowns_, done_, total_);
}

// A residual falls by about the same factor in each iteration.
void ProgressLine::on_iteration(int iteration, double residual, double wanted) {
    const std::lock_guard lock(mutex_);
    if ((quiet_ && !events_) || !(residual > 0) || !(wanted < 1)) return;
    const double done = std::clamp(std::log(residual) / std::log(wanted), 0.0, 1.0);
    const int tenth = static_cast<int>(10 * done + 1e-9);
    if (iteration == 0) last_tenth_ = 0;
    if (iteration == 0 || (!is_time_for_a_line() && (terminal_ || tenth == last_tenth_))) return;
    last_tenth_ = tenth;
    last_seconds_ = of_stage_.seconds();
    const double left = done > 0 ? last_seconds_ * (1 - done) / done : -1;
    if (events_) events_->on_solver_iteration(iteration, residual, wanted, left);
    if (!quiet_)
        print(fmt::format("solve{}  {} iterations  {:.0f} %  residual {:.1e} of {:.1e}  ETA {}", unknowns_, iteration,
                          100 * done, residual, wanted, time_left(left)));
}

void ProgressLine::on_parts(const std::vector<PartReport>& parts, const std::string& plan) {
    if (!quiet_ && shows_plan_) say(plan);
    const std::lock_guard lock(mutex_);
    if (events_) events_->on_parts(parts, plan);
    for (const PartReport& part : parts)
        if (part.resumed) tets_at_start_ += part.result.tets;
}

void ProgressLine::on_part(const PartEvent& event) {
    const std::lock_guard lock(mutex_);
    if (events_) events_->on_part(event);
    const int tenth = static_cast<int>(10 * event.load_done + 1e-9);
    if (quiet_ || event.part->resumed || (!terminal_ && tenth == last_tenth_)) return;
    last_tenth_ = tenth;
    const double elapsed = of_stage_.seconds();
    const double tets = event.tets;
    const double rate = elapsed > 0 ? (tets - tets_at_start_) / elapsed : 0;
    const std::string text = fmt::format(
        "{}/{} parts  {:.0f} %  {} of about {} tets  {}/s  ETA {}", event.done, event.total, 100 * event.load_done,
        short_number(tets), short_number(event.tets_expected), short_number(rate), time_left(event.seconds_left));
    print("volume  " + (terminal_ ? bar(event.load_done, text.size()) : "") + text);
}

void ProgressLine::say(const std::string& text) {
    const std::lock_guard lock(mutex_);
    clear();
    tell(text);
}

void ProgressLine::print(const std::string& text) {
    text_ = text;
    tell(terminal_ ? "\r\033[K" + text : text + "\n");
    line_open_ = terminal_;
}

}  // namespace kerf

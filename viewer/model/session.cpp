#include "viewer/model/session_impl.h"

#include <algorithm>
#include <chrono>

namespace kerf::view {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_until(Clock::time_point end) { return std::chrono::duration<double>(end - Clock::now()).count(); }

}  // namespace

// A run that is asked to end writes what is needed to continue it; one that does not end in time is killed.
Session::Impl::~Impl() {
    constexpr double patience_seconds = 2;
    if (process_) leaving_.push_back(std::move(process_));
    for (const auto& process : leaving_) process->interrupt();
    const auto end =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(patience_seconds));
    for (const auto& process : leaving_) process->wait(std::max(0.0, seconds_until(end)));
    open_.scope->end();
    data_.scope->end();
    mending_.scope->end();
    watch_.scope->end();
}

void Session::Impl::post(Group& group, Loader::Work work, Failed failed) {
    ++group.jobs;
    const auto counted = [&group, work = std::move(work)]() -> Loader::Completion {
        return [&group, completion = work()] {
            --group.jobs;
            if (completion) completion();
        };
    };
    loader_.post({group.scope, counted, [&group, failed = std::move(failed)](const std::string& message) {
                      --group.jobs;
                      failed(message);
                  }});
}

void Session::Impl::note_failure(const std::string& message) {
    constexpr std::size_t limit = 100;
    failures_.push_back(message);
    if (failures_.size() > limit) failures_.erase(failures_.begin());
}

bool Session::Impl::poll() {
    if (asked_) store_.next_frame();
    asked_ = false;
    looks_in_vain_ = 0;
    const std::size_t done = loader_.take_over();
    bool changed = done > looks_in_vain_;
    changed |= poll_run();
    if (is_repairing()) document_.progress.seconds = -seconds_until(mending_since_);
    return changed;
}

bool Session::Impl::wait(double seconds) {
    const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    constexpr double period_of_files = 0.02;  // whose changes nobody tells of
    for (;;) {
        if (poll()) return true;
        const double left = seconds_until(end);
        if (left <= 0) return false;
        loader_.wait(followed_ || !leaving_.empty() ? std::min(left, period_of_files) : left);
    }
}

bool Session::Impl::busy() const { return open_.jobs > 0 || data_.jobs > 0 || document_.progress.ours; }

bool Session::Impl::pending() const { return opening_ || !fetching_.empty(); }

Session::Session(std::string kerf_program) : impl_(std::make_unique<Impl>(std::move(kerf_program))) {}
Session::~Session() = default;

void Session::open(const std::string& path, const RunOptions& options) { impl_->open(path, options); }
void Session::reload() { impl_->reload(); }
void Session::close() { impl_->close(); }
bool Session::poll() { return impl_->poll(); }
bool Session::wait(double seconds) { return impl_->wait(seconds); }
bool Session::busy() const { return impl_->busy(); }
const Document& Session::document() const { return impl_->document(); }
void Session::start_run(RunOptions options, bool volume) { impl_->start_run(std::move(options), volume); }
void Session::cancel_run() { impl_->cancel_run(); }
void Session::redo_cut(NodeId node, const RunOptions& options, const std::optional<Plane>& plane) {
    impl_->redo_cut(node, options, plane);
}
const Document* Session::other_document() const { return impl_->other_document(); }
bool Session::shows_before() const { return impl_->shows_before(); }
bool Session::can_swap_runs() const { return impl_->can_swap_runs(); }
void Session::swap_runs() { impl_->swap_runs(); }
bool Session::can_save_run() const { return impl_->can_save_run(); }
void Session::save_run(const std::string& path) { impl_->save_run(path); }
std::shared_ptr<const NodeSurface> Session::surface(NodeId node) { return impl_->surface(node); }
std::shared_ptr<const NodeSurface> Session::part_surface(NodeId part) { return impl_->part_surface(part); }
std::shared_ptr<const SurfaceValues> Session::values_on(const std::shared_ptr<const NodeSurface>& surface,
                                                        ColorBy color) {
    return impl_->values_on(surface, color);
}
std::shared_ptr<const PartCells> Session::cells(NodeId part) { return impl_->cells(part); }
std::shared_ptr<const std::vector<float>> Session::cell_values(NodeId part, ColorBy color) {
    return impl_->cell_values(part, color);
}
std::shared_ptr<const std::vector<float>> Session::facet_values(NodeId part, ColorBy color) {
    return impl_->facet_values(part, color);
}
std::shared_ptr<const std::vector<WorstCell>> Session::worst_cells(ColorBy color, std::size_t count) {
    return impl_->worst_cells(color, count);
}
std::shared_ptr<const PartSolution> Session::solution(NodeId part, std::size_t number) {
    return impl_->solution(part, number);
}
bool Session::can_repair() const { return impl_->can_repair(); }
void Session::repair(const InputOptions& options) { impl_->repair(options); }
bool Session::is_repairing() const { return impl_->is_repairing(); }
void Session::cancel_repair() { impl_->cancel_repair(); }
bool Session::can_undo_repair() const { return impl_->can_undo_repair(); }
bool Session::can_redo_repair() const { return impl_->can_redo_repair(); }
void Session::undo_repair() { impl_->undo_repair(); }
void Session::redo_repair() { impl_->redo_repair(); }
void Session::save_surface(const std::string& path) { impl_->save_surface(path); }
bool Session::pending() const { return impl_->pending(); }
const std::vector<std::string>& Session::failures() const { return impl_->failures(); }

}  // namespace kerf::view

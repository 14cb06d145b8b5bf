// The session is glue: `Parts` owns the parts of the model, and calls are passed on to them. The order of its members
// is the order of knowledge, as each gets references to some of those before it. Works of the second thread hold such
// references, too, so that the destructor ends our runs and then that thread before any member is destroyed. Results of
// works get into the document in poll() alone, so that a frame sees one state. close() must reset every part that
// remembers something of the document.
#include "viewer/model/session.h"

#include <algorithm>
#include <chrono>

#include "viewer/model/inside/document_loader.h"
#include "viewer/model/inside/own_runs.h"

namespace kerf::view {

// Each part knows some of those before it. The first thread owns them all.
struct Session::Parts {
    explicit Parts(std::string kerf_program) : kerf(std::move(kerf_program)) {}
    ~Parts() {
        own_runs.end();
        background.end();
    }

    std::string kerf;
    Background background;
    ShownPair pair;
    Fetched fetched{background, pair.now};
    Repairs repairs{background, pair, fetched};
    RunFollower follower{background, pair, fetched};
    OwnRuns own_runs{kerf, background, pair.now, repairs, follower};
    Writer writer{kerf};
    RunPair runs{background, pair, fetched, follower};
    DocumentLoader loader{background, pair, fetched, repairs, follower};
};

Session::Session(std::string kerf_program) : parts_(std::make_unique<Parts>(std::move(kerf_program))) {}
Session::~Session() = default;

void Session::open(const std::string& path, const RunRequest& options) {
    close();
    parts_->loader.open(path, options);
}

void Session::reload() {
    const Document& document = parts_->pair.now.document;
    if (document.path.empty()) return;
    RunRequest options = document.options;
    const bool is_result = document.kind == Document::Kind::trace || document.kind == Document::Kind::run;
    if (is_result) options.input_options.more_files.clear();  // of the files that it was made of
    open(std::string(document.path), options);
}

void Session::close() {
    Background& background = parts_->background;
    background.open.reset();
    parts_->own_runs.leave();
    parts_->follower.stop();
    parts_->fetched.forget();
    parts_->repairs.forget();
    ShownPair& pair = parts_->pair;
    pair.now.scratch.reset();
    pair.now.document = {};
    pair.other.reset();
    pair.shows_before = false;
    background.forget_failures();
}

bool Session::poll() {
    parts_->fetched.next_frame();
    bool changed = parts_->background.take_over();
    changed |= parts_->follower.poll();
    changed |= parts_->own_runs.poll();
    changed |= parts_->writer.poll();
    parts_->repairs.next_frame();
    return changed;
}

bool Session::wait(double seconds) {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    constexpr double period_of_files = 0.02;  // whose changes nobody tells of
    for (;;) {
        if (poll()) return true;
        const double left = std::chrono::duration<double>(end - Clock::now()).count();
        if (left <= 0) return false;
        const bool looks_at_files =
            parts_->follower.is_following() || parts_->own_runs.are_leaving() || parts_->writer.is_writing();
        parts_->background.wait(looks_at_files ? std::min(left, period_of_files) : left);
    }
}

bool Session::busy() const {
    const Background& background = parts_->background;
    return background.open.jobs > 0 || background.data.jobs > 0 || background.redo.jobs > 0 || document().progress.ours;
}

bool Session::pending() const { return document().is_opening() || parts_->fetched.pending(); }

const Document& Session::document() const { return parts_->pair.now.document; }
const Document* Session::other_document() const { return parts_->pair.other ? &parts_->pair.other->document : nullptr; }
bool Session::shows_before() const { return parts_->pair.shows_before; }
void Session::start_run(RunRequest options, bool volume) { parts_->own_runs.start(std::move(options), volume); }
void Session::cancel_run() { parts_->own_runs.cancel(); }
void Session::write(const std::vector<std::string>& arguments, const std::string& file) {
    parts_->writer.start(arguments, file, parts_->pair.now.scratch);
}
Writer& Session::writer() { return parts_->writer; }
Fetched& Session::fetched() { return parts_->fetched; }
Repairs& Session::repairs() { return parts_->repairs; }
RunPair& Session::pair() { return parts_->runs; }
const RunPair& Session::pair() const { return parts_->runs; }
const std::vector<std::string>& Session::failures() const { return parts_->background.failures(); }
ErrorCode Session::failure_code() const { return parts_->background.failure_code(); }

}  // namespace kerf::view

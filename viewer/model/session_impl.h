// The inside of Session, in six parts: what is open (session_open.cpp), how it is checked and repaired
// (session_repair.cpp), runs that are followed (session_run.cpp), the run before (session_pair.cpp), what is fetched
// (session_data.cpp), and the calls from outside (session.cpp).
//
// The first thread owns all members. Tasks of the loader get copies and shared constants, and give back a completion,
// which the first thread runs. Tasks belong to a Group; when it is reset, those that wait and all results are dropped.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "viewer/model/checked_surface.h"
#include "viewer/model/file_kind.h"
#include "viewer/model/loader.h"
#include "viewer/model/part_files.h"
#include "viewer/model/partial_run.h"
#include "viewer/model/redo.h"
#include "viewer/model/run_events.h"
#include "viewer/model/run_process.h"
#include "viewer/model/run_report.h"
#include "viewer/model/session.h"
#include "viewer/model/store.h"

namespace kerf::view {

class Session::Impl {
 public:
    explicit Impl(std::string kerf_program) : kerf_program_(std::move(kerf_program)) {}
    ~Impl();

    // session_open.cpp
    void open(const std::string& path, const RunOptions& options);
    void reload();
    void close();

    // session_repair.cpp
    bool can_repair() const;
    void repair(const InputOptions& options);
    bool is_repairing() const { return mending_.jobs > 0; }
    void cancel_repair();
    bool can_undo_repair() const { return can_repair() && history_.can_undo(); }
    bool can_redo_repair() const { return can_repair() && history_.can_redo(); }
    void undo_repair();
    void redo_repair();
    void save_surface(const std::string& path);

    // session_run.cpp
    void start_run(RunOptions options, bool volume);
    void cancel_run();

    // session_pair.cpp
    const Document* other_document() const { return other_ ? &other_->document : nullptr; }
    bool shows_before() const { return shows_before_; }
    bool can_swap_runs() const;
    void swap_runs();
    bool can_save_run() const;
    void save_run(const std::string& path);
    void redo_cut(NodeId node, const RunOptions& options, const std::optional<Plane>& plane);

    // session_data.cpp
    std::shared_ptr<const NodeSurface> surface(NodeId node);
    std::shared_ptr<const NodeSurface> part_surface(NodeId part);
    std::shared_ptr<const SurfaceValues> values_on(const std::shared_ptr<const NodeSurface>& surface, ColorBy color);
    std::shared_ptr<const PartCells> cells(NodeId part);
    std::shared_ptr<const std::vector<float>> cell_values(NodeId part, ColorBy color);
    std::shared_ptr<const std::vector<float>> facet_values(NodeId part, ColorBy color);
    std::shared_ptr<const std::vector<WorstCell>> worst_cells(ColorBy color, std::size_t count);
    std::shared_ptr<const PartSolution> solution(NodeId part, std::size_t number);

    // session.cpp
    bool poll();
    bool wait(double seconds);
    bool busy() const;
    bool pending() const;
    const Document& document() const { return document_; }
    const std::vector<std::string>& failures() const { return failures_; }

 private:
    // Tasks with one fate, and how many of them are under way.
    struct Group {
        std::shared_ptr<Scope> scope = std::make_shared<Scope>();
        int jobs = 0;
        void reset() {
            scope->end();
            scope = std::make_shared<Scope>();
            jobs = 0;
        }
    };
    using Failed = std::function<void(const std::string& message)>;
    void post(Group& group, Loader::Work work, Failed failed);
    void note_failure(const std::string& message);

    // --- what is open ---
    struct OpenedRun {
        RunReportFile report;
        std::optional<Solution> solution;  // on it
        std::string folder, trace;         // the trace: where it is, if there is one
        std::vector<std::string> patch_names;
        Eigen::AlignedBox3d box;
        std::vector<RegionPlace> region_places;
    };
    struct OpenedPartialRun {
        RunOptions options;
        std::string folder, partial, trace;
        PartialRun state;
        std::vector<std::string> patch_names;
        Eigen::AlignedBox3d box;
        std::shared_ptr<const Soup> soup;
    };
    Loader::Completion read_what_is_there(const std::string& path,
                                          const InputOptions& input);  // on the loader's thread
    static OpenedRun read_run(const std::string& folder);
    static OpenedPartialRun read_partial_run(const OpenedPath& path);
    void show_error(ErrorCode code, const std::string& message);
    void show_files(const std::shared_ptr<const InputFiles>& files, const std::shared_ptr<const NodeSurface>& surface);
    void show_trace(std::shared_ptr<const Trace> trace, const RunOptions& options);
    void show_run(OpenedRun run);
    void complete_from_report(OpenedRun run);
    void find_trace_of_run(const std::string& path);
    void show_partial_run(const OpenedPartialRun& run);
    void describe_trace_input(const Trace& trace);
    void add_note(const std::string& note);

    // --- repairs ---
    Loader::Work checking(const InputOptions& options, std::shared_ptr<const Scope> scope);
    void check_files_in_background();
    void take_checked(std::vector<CheckedSurface> states);
    void show_checked();
    void show_its_surface();
    void show_surface_again();

    // --- runs ---
    // A run that the document follows: ours, or that of another process.
    struct Followed {
        enum class TraceState { none, loading, known };
        std::optional<EventTail> tail;  // none: its folder is looked at
        std::string input, output, trace;
        std::vector<RunEvent> events;  // those that tell of parts
        TraceState trace_state = TraceState::none;
        std::optional<RunEvent> end;
        bool is_shown = false;   // the document shows this run and no older result any more
        bool is_ending = false;  // its report is being read
        std::chrono::steady_clock::time_point next_look = {};
        bool is_looking = false;
        std::optional<PartialRun> last_look;
        std::set<NodeId> finished;  // parts whose outcome is known
        // Of ours:
        std::shared_ptr<ScratchFolder> scratch;
        bool has_scratch_output = false;
        RunOptions options;              // as they were asked for
        std::optional<Document> before;  // what was shown; empty: nothing to compare with, or it is in other_

        std::string partial() const { return output + ".kerf-partial"; }
    };
    void follow_events(const std::string& path);
    void launch(const RunOptions& options, bool volume);
    std::string input_of_next_run() const;
    std::optional<Document> document_before_next_run();
    void follow_files_of(RunOptions& options);
    bool poll_run();
    bool poll_events();
    bool poll_process();
    void poll_leaving_processes();
    void apply(const RunEvent& event);
    void show_input_of_run();
    void load_trace_of_run();
    void show_run_under_way(std::shared_ptr<const Trace> trace);
    void use_partial_folder();
    void end_if_complete();
    void read_result();
    void show_result(OpenedRun run);
    void end_without_result(const std::string& message, int exit_code = 1);
    void look_at_folder();
    void apply_state(const PartialRun& state);
    void mark_taken(const std::set<NodeId>& taken);

    static constexpr std::size_t store_bytes = std::size_t{4} << 30, replayer_bytes = std::size_t{1} << 30,
                                 prefetch_bytes = std::size_t{1} << 30, bytes_aside = std::size_t{1} << 30;

    // --- the run before ---
    // All that belongs to one document.
    struct Shown {
        Document document;
        std::shared_ptr<Replayer> replayer;
        std::set<NodeId> folder_parts;
        std::shared_ptr<ScratchFolder> scratch;
        Store store{store_bytes};
    };
    void set_aside(Document before);
    void start_redo();
    void take_redone(NodeId node, RedoneCut redone);

    // --- what is fetched ---
    template <class T>
    struct Fetched {
        T value;
        Loader::Completion also;  // runs when the value is kept; may be empty
    };
    template <class T, class Make>
    std::shared_ptr<const T> fetch(const Store::Key& key, Make make);
    template <class T>
    std::shared_ptr<const T> kept(const Store::Key& key);
    std::shared_ptr<const NodeSurface> compared_with(const std::shared_ptr<const NodeSurface>& surface,
                                                     const std::shared_ptr<const NodeSurface>& whole);
    Loader::Completion fill_row(NodeId node, std::int64_t vertices, std::int64_t facets, const MassProperties& mass);
    bool is_meshed(NodeId part) const;
    PartSource source_of(NodeId part) const;
    // Empty: there are none. A solution may be of higher order than its mesh.
    std::string folder_of_edge_nodes() const {
        if (document_.solution && document_.solution->order > 1) return document_.solution->folder;
        return document_.options.order > 1 ? document_.folder : "";
    }
    void restart_data();
    void use_trace(std::shared_ptr<Replayer> replayer);
    void note_remeshing(bool remeshed);
    void forget_data();
    void describe_cuts();
    void prefetch_surfaces();

    std::string kerf_program_;
    Document document_;
    bool opening_ = false;
    std::shared_ptr<const InputFiles> files_;  // of a surface that was opened; document_.soup is in it
    std::vector<std::string> failures_;

    Group open_, data_;
    RepairHistory history_;   // of files_
    std::string shown_note_;  // of the state that it shows; empty: it has none
    Group mending_;
    std::chrono::steady_clock::time_point mending_since_ = {};
    Group watch_;  // looks at folders of runs now and then: nobody waits for it
    Store store_{store_bytes};
    bool asked_ = false;  // something was, since the last poll()
    bool told_of_full_store_ = false;
    std::set<Store::Key> fetching_, failed_;
    std::shared_ptr<Replayer> replayer_;  // only the loader's thread looks inside
    std::set<NodeId> folder_parts_;       // of which the folder has files that are those of the tree
    struct Redo {
        NodeId node = 1;
        RunOptions options;
        std::optional<Plane> plane;
    };
    std::deque<Redo> redo_queue_;
    bool redoing_ = false;

    std::optional<Shown> other_;
    bool shows_before_ = false;
    std::shared_ptr<ScratchFolder> scratch_;  // that the document's folder is in
    std::size_t looks_in_vain_ = 0;           // completions that have changed nothing
    std::optional<Followed> followed_;
    std::unique_ptr<RunProcess> process_;               // of followed_
    std::vector<std::unique_ptr<RunProcess>> leaving_;  // interrupted ones that nobody follows

    Loader loader_;  // last: it ends first
};

}  // namespace kerf::view

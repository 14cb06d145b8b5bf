// Opens files and folders, starts and follows runs, and fetches what is asked for in the background.
//
// All calls come from one thread; nothing blocks but wait(). A second thread reads and computes. Results depend on the
// files alone; only when they are there depends on time.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "viewer/model/document.h"
#include "viewer/model/view_state.h"

namespace kerf::view {

class Session {
 public:
    /// `kerf_program`: the path of kerf, which makes the runs, in a process of its own; kerf-worker lies beside it.
    explicit Session(std::string kerf_program);
    /// Ends a run that it started, and removes its folder if the user gave it none.
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Opens a surface file, a trace, a run folder, a solution on one (find_solution()), the folder of a run that is
    /// under way (DIR or DIR.kerf-partial), or its events (a file of --events). With InputOptions::more_files these are
    /// opened with it, and all are surfaces. Cancels what was open. Never throws:
    /// what fails is in document().error. `options`: those of the next run of a surface, by which it is read and
    /// checked; a run and a trace bring theirs.
    void open(const std::string& path, const RunOptions& options = {});
    void reload();
    void close();

    /// Takes over what has arrived since the last call; returns whether anything has. Cheap; called once a frame.
    bool poll();
    /// Polls until something arrives, at most `seconds`; false if nothing did.
    bool wait(double seconds);
    /// Something is being fetched, or a run of ours is under way.
    bool busy() const;

    const Document& document() const;

    /// Cuts and, if `volume`, meshes the surface that is open, with options.decompose and so on as given, into
    /// options.output, or into a temporary folder if that is empty. The document fills as it goes.
    void start_run(RunOptions options, bool volume);
    /// Interrupts our run; it ends within two seconds.
    void cancel_run();

    /// Makes the cut of one node again with other options, in the background; needs a trace. The result takes the
    /// place of that cut in document().trace; what lay below it is gone, and so are measures of the whole run.
    /// It is made at the plane if there is one, else where it was (view::redo_cut()).
    void redo_cut(NodeId node, const RunOptions& options, const std::optional<Plane>& plane = {});

    /// Once start_run() or redo_cut() has something to show, what was shown before is kept, whole, to compare with:
    /// the other document, until the next one of these or open(); nullptr if there is none.
    const Document* other_document() const;
    /// document() is the one before, other_document() the one after.
    bool shows_before() const;
    /// Shows the other document. Not while anything is under way.
    void swap_runs();
    bool can_swap_runs() const;

    /// A finished run is open that goes with this session.
    bool can_save_run() const;
    /// Copies it, in the background, to a place where it stays, as kerf mesh would have written it there: only a run
    /// of Kerf is ever replaced. Its trace goes beside it, to its name and ".trace". At the end Document::saved_as is
    /// the folder, or failures() says why not.
    void save_run(const std::string& path);

    /// A surface that was opened from a file is checked: it can be repaired.
    bool can_repair() const;
    /// Checks it again, in the background, as other `input_options` mend it (InputOptions::repair and others), and
    /// shows what they have left; `unrepaired` of the document is what the file has. Always starts from the file, so
    /// that a command with the same options does the same. A run that is shown is kept to compare with, as by
    /// start_run().
    void repair(const InputOptions& options);
    bool is_repairing() const;
    /// Ends that; the document stays as it is.
    void cancel_repair();
    /// The options before the last repair, with what was shown for them, and after it.
    bool can_undo_repair() const;
    bool can_redo_repair() const;
    void undo_repair();
    void redo_repair();
    /// Writes the surface, repaired as it is shown, in the background, as kerf repair does (prepare/repaired_file.h).
    /// At the end Document::surface_saved_as is the file, or failures() says why not.
    void save_surface(const std::string& path);

    // What follows returns what is in memory, or nullptr, and then fetches it: poll() says when it is there. The least
    // recently used leave the memory.

    /// The closed surface of a node: of a trace by its cuts, of a run folder from the surfaces of its parts.
    /// not_remeshed: where Document::remeshed, the surface as the file has it, repaired. not_repaired:
    /// Document::unrepaired.
    std::shared_ptr<const NodeSurface> surface(NodeId node);
    /// The closed surface of a part of the run folder.
    std::shared_ptr<const NodeSurface> part_surface(NodeId part);
    /// The deviation of the facets of a surface that this session has given, or the size at its vertices; nullptr,
    /// too, where the surface was neither remeshed nor repaired, or no size was asked for. What was repaired deviates
    /// from the file, what was remeshed from what it was before.
    std::shared_ptr<const SurfaceValues> values_on(const std::shared_ptr<const NodeSurface>& surface, ColorBy color);
    /// The tetrahedra of a part of the run folder.
    std::shared_ptr<const PartCells> cells(NodeId part);
    /// A measure of every cell of a part. `color` must be a measure, `kind` (1 at an interface, else 0),
    /// or `origin` (the number of the CellOrigin).
    std::shared_ptr<const std::vector<float>> cell_values(NodeId part, ColorBy color);
    /// The same for the cells behind the facets of a part's surface; reads no more than these values of the file where
    /// it holds them.
    std::shared_ptr<const std::vector<float>> facet_values(NodeId part, ColorBy color);
    /// The `count` worst cells of the run by a measure, worst first: the smallest angle and shape, else the largest.
    std::shared_ptr<const std::vector<WorstCell>> worst_cells(ColorBy color, std::size_t count);
    /// What the solution that is open has found in a part, in the case of this number.
    std::shared_ptr<const PartSolution> solution(NodeId part, std::size_t number);
    /// Something that was asked for is being fetched.
    bool pending() const;
    /// What failed to be fetched or made, newest last, since a run or a cut was last started or shown.
    const std::vector<std::string>& failures() const;

 private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace kerf::view

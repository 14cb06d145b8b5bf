// Opens files and folders, starts and follows runs, and fetches what is asked for in the background.
//
// All calls come from one thread; nothing blocks but wait(). A second thread reads and computes. Results depend on the
// files alone; only when they are there depends on time.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "viewer/model/fetched.h"
#include "viewer/model/repairs.h"
#include "viewer/model/run_pair.h"

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

    /// Once start_run(), Repairs::repair() or RunPair::redo_cut() has something to show, what was shown before is kept,
    /// whole, to compare with: the other document, until the next one of these or open(); nullptr if there is none.
    const Document* other_document() const;
    /// document() is the one before, other_document() the one after.
    bool shows_before() const;

    /// What is asked for of the document.
    Fetched& fetched();
    /// Of the surface that is open.
    Repairs& repairs();
    /// What is done with the runs that are shown.
    RunPair& pair();
    const RunPair& pair() const;

    /// Something is being opened, or what was asked for is being fetched.
    bool pending() const;
    /// What failed to be fetched or made, newest last, since a run or a cut was last started or shown.
    const std::vector<std::string>& failures() const;
    /// Of the first of them.
    ErrorCode failure_code() const;

 private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace kerf::view

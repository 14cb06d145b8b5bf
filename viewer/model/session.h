// Opens files and folders, starts and follows runs, and fetches data in the background when they are asked for.
//
// All calls come from one thread; nothing blocks but wait(). A second thread reads and computes. Results depend on the
// files alone, and only their arrival on time.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "viewer/model/inside/fetched.h"
#include "viewer/model/inside/repairs.h"
#include "viewer/model/inside/run_pair.h"
#include "viewer/model/inside/writer.h"

namespace kerf::view {

/// The open document and all that changes it: the model of the viewer.
class Session {
 public:
    /// `kerf_program`: the path of kerf, which makes the runs, in a process of its own; kerf-worker lies beside it.
    explicit Session(std::string kerf_program);
    /// Ends a run that it started, and removes its folder if the user gave it none.
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Opens a surface file, a trace, a run folder, a solution on one (find_solution()), the folder of a run that is
    /// under way (DIR or DIR.kerf-partial), or its events (a file of --events). The files of
    /// InputOptions::more_files are opened with it, and all must be surfaces, or two finished runs: the second one is
    /// shown, the first one is other_document(). Closes the document before, with all work for it. Never throws: errors
    /// are in document().error. `options` are those of the next run of a surface, by which it is read and checked; a
    /// run and a trace bring theirs.
    void open(const std::string& path, const RunRequest& options = {});
    void reload();
    void close();

    /// Takes over all that has arrived since the last call; returns whether anything has. Cheap; called once a frame.
    bool poll();
    /// Polls until something arrives, at most `seconds`; false if nothing did.
    bool wait(double seconds);
    /// Returns whether something is being fetched, or a run of ours is under way.
    bool busy() const;

    const Document& document() const;

    /// Cuts and, if `volume`, meshes the surface that is open, with the options as given, into
    /// options.output, or into a temporary folder if that is empty. The document fills as it goes.
    void start_run(RunRequest options, bool volume);
    /// Interrupts our run or repair. A run is killed if it has not ended after five seconds.
    void cancel_run();

    /// Returns the other document, to compare with, or nullptr: once start_run(), Repairs::repair() or
    /// RunPair::redo_cut() has something to show, the document that was shown before is kept, whole, until the next one
    /// of these or open().
    const Document* other_document() const;
    /// Returns whether document() is the one before, and other_document() the one after.
    bool shows_before() const;

    /// The data of the document that are fetched when they are asked for.
    Fetched& fetched();
    /// The repairs of the surface that is open.
    Repairs& repairs();
    /// Writes a file of the open run by a command of kerf (Writer::start()), whose result poll() brings.
    void write(const std::vector<std::string>& arguments, const std::string& file);
    Writer& writer();
    /// The operations on the run that is shown and the one before.
    RunPair& pair();
    const RunPair& pair() const;

    /// Returns whether a document is being opened, or data that were asked for are being fetched.
    bool pending() const;
    /// Returns messages of failures to fetch or make something, newest last, since a run or a cut was last started or
    /// shown.
    const std::vector<std::string>& failures() const;
    /// Returns the code of the first of these failures.
    ErrorCode failure_code() const;

 private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace kerf::view

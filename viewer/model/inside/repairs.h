// Checks and repairs a surface that was opened from files, in the background and always from the content of the files.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "viewer/model/inside/checked_surface.h"
#include "viewer/model/inside/fetched.h"

namespace kerf::view {

/// The checks and repairs of the surface of a document, with a history.
class Repairs {
 public:
    Repairs(Background& background, ShownPair& pair, Fetched& fetched)
        : background_(background), pair_(pair), document_(pair.now.document), fetched_(fetched) {}

    /// Returns whether a surface is open that can be repaired: it came from a file, is checked, and nothing is under
    /// way.
    bool can_repair() const;
    /// Checks the surface again, in the background, as other `options` mend it (InputOptions::repairs and others), and
    /// shows the result; Document::unrepaired is the surface of the file. Always starts from the file, so that a
    /// command with the same options does the same. A run that is shown is kept to compare with, as by
    /// Session::start_run().
    void repair(const InputOptions& options);
    bool is_repairing() const { return background_.repair.jobs > 0; }
    /// Ends a repair that is under way; the document stays as it is.
    void cancel();
    /// Go back to the options before the last repair, with the surface that was shown for them, and on to those after
    /// it.
    bool can_undo() const { return can_repair() && history_.can_undo(); }
    bool can_redo() const { return can_repair() && history_.can_redo(); }
    void undo();
    void redo();
    /// Returns whether the surface was repaired otherwise since it was opened, and neither it nor a run of it was
    /// saved.
    bool is_unsaved() const;
    /// Writes the surface, repaired as it is shown, in the background, as kerf repair does
    /// (run/prepare/repaired_file.h). At the end Document::surface_saved_as is the file, or Session::failures() has the
    /// error.
    void save(const std::string& path);

    // The functions below are for the other parts of a session.

    /// Checks the files, which the document shows.
    void begin(std::shared_ptr<const InputFiles> files);
    /// Checks the surface again, if it was checked, because the document has got other options.
    void check_again();
    void forget();
    /// Counts the seconds of a repair; called once a frame.
    void next_frame();

 private:
    Loader::Work checking(const InputOptions& options, std::shared_ptr<const Scope> scope);
    void check();
    void take_checked(std::vector<CheckedSurface> states);
    void show_checked();
    void show_its_surface();
    void show_state();
    void show_surface_again();

    Background& background_;
    ShownPair& pair_;
    Document& document_;
    Fetched& fetched_;
    std::shared_ptr<const InputFiles> files_;  // Document::soup is in them, or in a state
    InputOptions opened_with_;                 // options by which they were first checked
    RepairHistory history_;                    // the states of the surface of these files
    std::string shown_note_;                   // note of the shown state that the document has; empty: none
    std::chrono::steady_clock::time_point since_ = {};
};

}  // namespace kerf::view

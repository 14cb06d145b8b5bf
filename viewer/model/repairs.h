// A surface that was opened from files is checked and repaired in the background, always from what its files said.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "viewer/model/checked_surface.h"
#include "viewer/model/fetched.h"

namespace kerf::view {

class Repairs {
 public:
    Repairs(Background& background, ShownPair& pair, Fetched& fetched)
        : background_(background), pair_(pair), document_(pair.now.document), fetched_(fetched) {}

    /// A surface that was opened from a file is checked: it can be repaired.
    bool can_repair() const;
    /// Checks it again, in the background, as other `options` mend it (InputOptions::repair and others), and shows what
    /// they have left; `unrepaired` of the document is what the file has. Always starts from the file, so that a
    /// command with the same options does the same. A run that is shown is kept to compare with, as by
    /// Session::start_run().
    void repair(const InputOptions& options);
    bool is_repairing() const { return background_.repair.jobs > 0; }
    /// Ends that; the document stays as it is.
    void cancel();
    /// The options before the last repair, with what was shown for them, and after it.
    bool can_undo() const { return can_repair() && history_.can_undo(); }
    bool can_redo() const { return can_repair() && history_.can_redo(); }
    void undo();
    void redo();
    /// Writes the surface, repaired as it is shown, in the background, as kerf repair does (prepare/repaired_file.h).
    /// At the end Document::surface_saved_as is the file, or Session::failures() says why not.
    void save(const std::string& path);

    // What follows is for the other parts of a session.

    /// The document shows these: checks them.
    void begin(std::shared_ptr<const InputFiles> files);
    /// The options of the document are others: checks by them what is checked already.
    void check_again();
    void forget();
    /// Counts the seconds of a repair. Once a frame.
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
    RepairHistory history_;                    // of these
    std::string shown_note_;                   // of the state that it shows; empty: it has none
    std::chrono::steady_clock::time_point since_ = {};
};

}  // namespace kerf::view

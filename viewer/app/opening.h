// Files opened, runs started and surfaces repaired, and the view that suits each.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "viewer/app/unsaved.h"

namespace kerf::view {

class Opening : public FileActions, public RunActions, public RepairActions {
 public:
    Opening(View& view, Unsaved& unsaved) : view_(view), unsaved_(unsaved) {}

    void open_files(const std::vector<std::string>& paths) override;
    void reload() override;
    void open_again(const RunRequest& options) override;
    void start_run(const RunRequest& options, bool volume) override;
    void redo_cut(NodeId node, const RunRequest& options, const std::optional<Plane>& plane) override;
    void swap_runs() override;
    void show_other() override;
    void repair(const InputOptions& options) override;
    void undo_repair() override;
    void redo_repair() override;
    void show_before_repair(bool before) override;

    void show(const ViewState& state, const ChosenView& chosen);
    /// Starts the run of a surface that was opened, completes the view, as far as data have arrived, and goes to the
    /// cells at the end of a run, unless a tour is under way.
    void follow(bool leads_tour);

 private:
    void await_document();
    void remember_opened();
    void begin_auto_run();
    void choose_view();
    void show_cells();
    void follow_run(bool leads_tour);
    void follow_repairs();

    View& view_;
    Unsaved& unsaved_;
    std::vector<std::string> to_remember_;        // files that are being opened, for the list of recent ones
    std::string opened_;                          // path for which the automatic run was decided
    std::shared_ptr<const CheckedSoup> checked_;  // checked surface of the document when it was last looked at
    struct KeptScale {
        ColorBy color = ColorBy::part;
        std::optional<ValueRange> range = {};  // range of colours that somebody has given to values of a solution
    };
    KeptScale kept_scale_;                   // scale of the document before
    bool is_view_complete_ = false;          // the choices that nobody has made are made
    bool is_running_ = false;                // a run was under way when the document was last looked at
    std::optional<Camera> camera_at_start_;  // camera that somebody had chosen before that run began
};

}  // namespace kerf::view

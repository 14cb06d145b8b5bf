// Files opened, runs started and surfaces repaired, and the view that suits each.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "viewer/app/view.h"

namespace kerf::view {

class Opening : public FileActions, public RunActions, public RepairActions {
 public:
    explicit Opening(View& view) : view_(view) {}

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
    /// Starts the run of a surface that was opened, and completes the view, as far as data have arrived.
    void follow();

 private:
    void await_document();
    void begin_auto_run();
    void choose_view();
    void follow_repairs();

    View& view_;
    std::string opened_;                          // path for which the automatic run was decided
    std::shared_ptr<const CheckedSoup> checked_;  // checked surface of the document when it was last looked at
    struct KeptScale {
        ColorBy color = ColorBy::part;
        std::optional<ValueRange> range = {};  // range of colours that somebody has given to values of a solution
    };
    KeptScale kept_scale_;           // scale of the document before
    bool is_view_complete_ = false;  // the choices that nobody has made are made
};

}  // namespace kerf::view

// What is opened, run and repaired, and the view that suits it.
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
    void open_again(const RunOptions& options) override;
    void start_run(const RunOptions& options, bool volume) override;
    void redo_cut(NodeId node, const RunOptions& options, const std::optional<Plane>& plane) override;
    void swap_runs() override;
    void show_other() override;
    void repair(const InputOptions& options) override;
    void undo_repair() override;
    void redo_repair() override;
    void show_before_repair(bool before) override;

    void show(const ViewState& state, const ChosenView& chosen);
    /// After something has arrived: runs what is to be run, and completes the view.
    void follow();

 private:
    void await_document();
    void begin_auto_run();
    void choose_view();
    void follow_repairs();

    View& view_;
    std::string opened_;                          // what auto_run has been decided for
    std::shared_ptr<const CheckedSoup> checked_;  // of the document as it was last looked at
    struct KeptScale {
        ColorBy color = ColorBy::part;
        std::optional<ValueRange> range = {};  // that somebody has given to values of a solution
    };
    KeptScale kept_scale_;           // of what was open before
    bool is_view_complete_ = false;  // what nobody has chosen is
};

}  // namespace kerf::view

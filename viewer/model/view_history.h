// The views that were looked at, to which one can go back, and on again.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "viewer/model/view_state.h"

namespace kerf::view {

/// The last hundred views of one document. Panels, theme, selection and the phase of a motion are no part of a view:
/// they stay as they are when one goes back.
class ViewHistory {
 public:
    static constexpr std::size_t most = 100;
    /// Views of which only the camera differs are one if they follow each other within this time, as those of a wheel.
    static constexpr double one_move = 0.7;  ///< seconds

    /// Notes the view of the document of this path once it rests. If it is a new one, the views to which one could go
    /// on are forgotten.
    void note(const ViewState& state, const std::string& document, double seconds);
    bool has_earlier() const { return shown_ > 0; }
    bool has_later() const { return shown_ + 1 < views_.size(); }
    /// Return the view before, or after, the one that is shown, with the rest of the state as in `now`; none if there
    /// is no such view.
    std::optional<ViewState> go_back(const ViewState& now) { return go_to(shown_ - 1, has_earlier(), now); }
    std::optional<ViewState> go_on(const ViewState& now) { return go_to(shown_ + 1, has_later(), now); }

 private:
    std::optional<ViewState> go_to(std::size_t view, bool is_there, const ViewState& now);

    std::vector<ViewState> views_;
    std::size_t shown_ = 0;  // index of the view that is shown
    std::string document_;
    double noted_at_ = 0;
    bool was_chosen_ = false;  // the view that is shown was chosen by go_back() or go_on()
};

}  // namespace kerf::view

// Views that were looked at, to go back to and on again.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "viewer/model/view_state.h"

namespace kerf::view {

/// Of one document, the last hundred. Panels, theme, selection and the phase of a motion are no part of a view: they
/// stay as they are when one goes back.
class ViewHistory {
 public:
    static constexpr std::size_t most = 100;
    /// Views of which only the camera differs are one if they follow each other within this time, as those of a wheel.
    static constexpr double one_move = 0.7;  ///< seconds

    /// The view as it rests, of the document of this path. What one could go on to is forgotten where it is new.
    void note(const ViewState& state, const std::string& document, double seconds);
    bool has_earlier() const { return shown_ > 0; }
    bool has_later() const { return shown_ + 1 < views_.size(); }
    /// The view before, or after, the one that was noted last; none: there is none.
    std::optional<ViewState> go_back(const ViewState& now) { return go_to(shown_ - 1, has_earlier(), now); }
    std::optional<ViewState> go_on(const ViewState& now) { return go_to(shown_ + 1, has_later(), now); }

 private:
    std::optional<ViewState> go_to(std::size_t view, bool is_there, const ViewState& now);

    std::vector<ViewState> views_;
    std::size_t shown_ = 0;  // of the views
    std::string document_;
    double noted_at_ = 0;
    bool was_chosen_ = false;  // the view shown is one that was gone to
};

}  // namespace kerf::view

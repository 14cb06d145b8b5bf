#include "viewer/model/view_history.h"

#include <utility>

namespace kerf::view {

namespace {

ViewState with_rest_of(ViewState view, const ViewState& rest) {
    view.panels = rest.panels;
    view.theme = rest.theme;
    view.selection = rest.selection;
    view.deformation.phase = rest.deformation.phase;
    return view;
}

}  // namespace

void ViewHistory::note(const ViewState& state, const std::string& document, double seconds) {
    if (document != document_) views_.clear();
    document_ = document;
    ViewState view = with_rest_of(state, {});
    if (views_.empty()) {
        shown_ = 0;
        was_chosen_ = true;
        views_.push_back(std::move(view));
        return;
    }
    ViewState& shown = views_[shown_];
    if (view == shown) return;
    ViewState moved = shown;
    moved.camera = view.camera;
    const bool goes_on = !was_chosen_ && moved == view && seconds - noted_at_ < one_move;
    views_.resize(shown_ + 1);
    if (goes_on) {
        views_.back() = std::move(view);
    } else {
        views_.push_back(std::move(view));
        if (views_.size() > most) views_.erase(views_.begin());
        shown_ = views_.size() - 1;
    }
    was_chosen_ = false;
    noted_at_ = seconds;
}

std::optional<ViewState> ViewHistory::go_to(std::size_t view, bool is_there, const ViewState& now) {
    if (!is_there) return {};
    shown_ = view;
    was_chosen_ = true;
    return with_rest_of(views_[view], now);
}

}  // namespace kerf::view

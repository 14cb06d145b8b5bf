// Work is saved one after the other: when the first is, what waits is tried again, and asks for the rest. While a
// question waits, a run may end, and another be shown: work is looked at anew each time.
#include "viewer/app/unsaved.h"

#include <utility>

namespace kerf::view {

bool Unsaved::is_unsaved(UnsavedWork work) const {
    const RunPair& runs = view_.session.pair();
    switch (work) {
        case UnsavedWork::run:
            return runs.is_unsaved();
        case UnsavedWork::other_run:
            return runs.is_other_unsaved();
        case UnsavedWork::surface:
            return view_.session.repairs().is_unsaved();
    }
    return false;
}

std::vector<UnsavedWork> Unsaved::of_all() const {
    std::vector<UnsavedWork> work;
    for (const UnsavedWork one : {UnsavedWork::run, UnsavedWork::other_run, UnsavedWork::surface})
        if (is_unsaved(one)) work.push_back(one);
    return work;
}

// A surface that has no run yet, or whose run is under way, takes no place. A cut that waits to be made again will find
// the shown run in the place of the other one.
std::vector<UnsavedWork> Unsaved::of_change() const {
    const Document& document = view_.session.document();
    const bool takes_place = !document.progress.running && (document.trace || !document.folder.empty());
    std::vector<UnsavedWork> work;
    if (takes_place && is_unsaved(UnsavedWork::other_run)) work.push_back(UnsavedWork::other_run);
    if (takes_place && view_.session.pair().is_redoing() && is_unsaved(UnsavedWork::run))
        work.push_back(UnsavedWork::run);
    return work;
}

bool Unsaved::asks_for(std::vector<UnsavedWork> work, std::function<void()> then) {
    if (is_answered_ || !view_.options.asks_to_save || work.empty()) return false;
    then_ = std::move(then);
    awaited_.reset();
    view_.facts.asks_to_save = true;
    view_.facts.at_stake = std::move(work);
    view_.wake();
    return true;
}

void Unsaved::answer(UnsavedFate answer) {
    view_.facts.asks_to_save = false;
    if (answer == UnsavedFate::save) awaited_ = view_.facts.at_stake.front();
    has_old_failures_ = !view_.session.failures().empty();
    if (answer == UnsavedFate::stay) then_ = nullptr;
    if (answer != UnsavedFate::lose) return;
    is_answered_ = true;
    if (const auto then = std::exchange(then_, nullptr)) then();
    is_answered_ = false;
}

void Unsaved::follow() {
    if (!then_ || !awaited_ || view_.facts.asks_to_save) return;
    const bool has_failed = !view_.session.failures().empty();
    has_old_failures_ &= has_failed;
    if (has_failed && !has_old_failures_) then_ = nullptr;  // it could not be saved
    if (!then_ || is_unsaved(*awaited_)) return;
    const auto then = std::exchange(then_, nullptr);
    then();
}

}  // namespace kerf::view

#include "viewer/app/unsaved.h"

#include <utility>

namespace kerf::view {

bool Unsaved::asks_before(std::function<void()> then) {
    if (is_answered_ || !view_.options.asks_to_save || !view_.session.pair().can_save()) return false;
    then_ = std::move(then);
    view_.facts.asks_to_save = true;
    view_.wake();
    return true;
}

void Unsaved::answer(UnsavedMesh answer) {
    view_.facts.asks_to_save = false;
    if (answer == UnsavedMesh::stay) then_ = nullptr;
    if (answer == UnsavedMesh::lose) go_on();
}

void Unsaved::follow() {
    if (!then_ || view_.facts.asks_to_save) return;
    if (!view_.session.failures().empty()) then_ = nullptr;  // it could not be saved
    if (!view_.session.document().saved_as.empty()) go_on();
}

void Unsaved::go_on() {
    const auto then = std::exchange(then_, nullptr);
    is_answered_ = true;
    if (then) then();
    is_answered_ = false;
}

}  // namespace kerf::view

// The session of the view fetches data of one run at a time, the shown one. The other one is opened a second time, from
// its folder, in a session of its own, which ends as soon as one run is to be seen alone.
#include "viewer/app/beside.h"

#include <cmath>

#include "viewer/model/saving.h"

namespace kerf::view {

namespace {

// A solution stands on the parts of a run, which are in another folder.
std::string place_of(const Document& run) { return run.solution ? run.path : run.folder; }

}  // namespace

// Runs whose files are the same, as after a cut was made again, are not told apart by their place.
void Beside::follow() {
    const Document *shown = &view_.session.document(), *other = view_.session.other_document();
    const bool are_two = other && has_mesh(*other) && has_mesh(*shown) && place_of(*other) != place_of(*shown);
    if (!view_.state.look.beside || !are_two) {
        session_.reset();
        place_.clear();
        view_.beside.reset();
        view_.facts.beside.reset();
        return;
    }
    if (place_ != place_of(*other)) {
        place_ = place_of(*other);
        session_.emplace(view_.options.kerf_program);
        session_->open(place_);
        view_.beside.emplace();
        has_new_data_ = true;
    }
    if (session_->poll()) {
        has_new_data_ = true;
        view_.wake();
    }
    const Document& document = session_->document();
    const std::vector<std::string>& failures = session_->failures();
    view_.facts.beside = RunBeside{view_.beside->area, !document.error.empty() ? document.error
                                                       : failures.empty()      ? ""
                                                                               : failures.back()};
}

void Beside::share(const Rectangle& scene) {
    view_.area = scene;
    if (!view_.beside) return;
    Rectangle left = scene, right = scene;
    left.width = right.width = std::floor(scene.width / 2);
    right.x = scene.x + scene.width - right.width;
    const bool is_left = view_.session.shows_before();
    view_.area = is_left ? left : right;
    view_.beside->area = view_.facts.beside->area = is_left ? right : left;
}

void Beside::build() {
    if (!view_.beside) return;
    BuiltScene& built = view_.beside->built;
    ViewState wanted = of_scene(view_.shown());
    wanted.selection = {};
    if (!session_->document().tree.find(wanted.node)) wanted.node = root_node;
    if (!wanted.coloring.range) wanted.coloring.range = view_.built.legend.values;
    if (!has_new_data_ && wanted == built_for_ && !built.pending) return;
    has_new_data_ = false;
    built = builder_.build(wanted, *session_);
    view_.beside->scenes_built = ++scenes_built_;
    built_for_ = std::move(wanted);
}

bool Beside::is_pending() const {
    return view_.beside && (has_new_data_ || view_.beside->built.pending || session_->busy() || session_->pending());
}

void Beside::wait(double seconds) {
    if (!session_ || !session_->wait(seconds)) return;
    has_new_data_ = true;
    view_.wake();
}

}  // namespace kerf::view

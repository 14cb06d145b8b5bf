// Opening, runs and repairs, and the view that suits them. A document is read in the background, so that all that
// depends on it is done in follow(), each once: a clean surface is run if the options say so, and members of the view
// that nobody has chosen (ChosenView) are set by the kind of document. The path in `opened_` marks that the run was
// decided: a run or repair that a user starts sets it, too, so that his surface is not run once more behind his back.
// Numbers of cells, facets and defects mean others in another run or a repaired surface, so a selection by number is
// dropped there; a selected place stays.
#include "viewer/app/opening.h"

#include <utility>

#include "viewer/app/settings.h"

namespace kerf::view {

namespace {

constexpr double usual_explosion = 0.4;  // Explosion::amount of parts that are nothing but surfaces

}  // namespace

void Opening::open_files(const std::vector<std::string>& paths) {
    if (unsaved_.asks_before([this, paths] { open_files(paths); })) return;
    keep_sizes(view_.settings, view_.session.document());
    RunRequest run = view_.options.run;
    run.input_options.more_files.assign(paths.begin() + 1, paths.end());
    view_.session.open(paths.front(), run);
    to_remember_ = paths;
    const ViewState before = view_.state;
    // The next step of an analysis is seen in the same colours.
    kept_scale_ = {before.coloring.by, is_of_solution(before.coloring.by) ? before.coloring.range : std::nullopt};
    view_.state = {};
    view_.state.theme = before.theme;
    view_.state.panels = before.panels;
    view_.state.look.shading = before.look.shading;
    view_.chosen = {};
    is_view_complete_ = false;
    await_document();
}

void Opening::show(const ViewState& state, const ChosenView& chosen) {
    view_.state = state;
    view_.chosen = chosen;
    is_view_complete_ = false;
    choose_view();
}

void Opening::await_document() {
    opened_.clear();
    is_running_ = false;  // a run that is left has no end here
    view_.session_changed = true;
    view_.wake();
}

// Only what could be opened is offered again.
void Opening::remember_opened() {
    const Document& document = view_.session.document();
    if (to_remember_.empty() || document.is_opening()) return;
    const std::vector<std::string> paths = std::exchange(to_remember_, {});
    if (!document.error.empty()) return;
    for (auto path = paths.rbegin(); path != paths.rend(); ++path) remember(view_.settings, *path, today());
    save_settings(view_.options.config_folder, view_.settings);
}

void Opening::reload() {
    if (unsaved_.asks_before([this] { reload(); })) return;
    view_.session.reload();
    await_document();
}

void Opening::open_again(const RunRequest& options) {
    if (unsaved_.asks_before([this, options] { open_again(options); })) return;
    view_.session.open(std::string(view_.session.document().path), options);
    await_document();
}

void Opening::start_run(const RunRequest& options, bool volume) {
    if (unsaved_.asks_before_change([this, options, volume] { start_run(options, volume); })) return;
    opened_ =
        view_.session.document().path;  // a run by the user is not repeated when repairs have made the surface clean
    view_.session.start_run(options, volume);
}

void Opening::redo_cut(NodeId node, const RunRequest& options, const std::optional<Plane>& plane) {
    if (unsaved_.asks_before_change([this, node, options, plane] { redo_cut(node, options, plane); })) return;
    view_.session.pair().redo_cut(node, options, plane);
}

// Exchanges the runs under the same camera, so that equal parts stay where they are. Numbers of cells mean others
// there.
void Opening::swap_runs() {
    if (!view_.session.pair().can_swap()) return;
    view_.session.pair().swap();
    view_.state.camera = view_.camera;
    if (view_.state.selection.kind != Selection::Kind::place) view_.state.selection = {};
    view_.unresolved.reset();
    view_.session_changed = true;
    view_.wake();
}

void Opening::repair(const InputOptions& options) {
    if (unsaved_.asks_before_change([this, options] { repair(options); })) return;
    opened_ = view_.session.document().path;  // whether it is meshed then is the user's to say
    show_before_repair(false);
    view_.session.repairs().repair(options);
}

void Opening::undo_repair() {
    if (unsaved_.asks_before_change([this] { undo_repair(); })) return;
    show_before_repair(false);
    view_.session.repairs().undo();
    view_.session_changed = true;
}

void Opening::redo_repair() {
    if (unsaved_.asks_before_change([this] { redo_repair(); })) return;
    show_before_repair(false);
    view_.session.repairs().redo();
    view_.session_changed = true;
}

void Opening::show_before_repair(bool before) {
    view_.state.camera = view_.camera;
    view_.state.node = root_node;
    view_.state.step = {before ? Stage::before_repair : Stage::input, -1};
    view_.wake();
}

// Goes between the states before and after a run or repair, by key B.
void Opening::show_other() {
    if (view_.session.other_document())
        swap_runs();
    else if (view_.session.document().unrepaired)
        show_before_repair(view_.state.node != root_node || view_.state.step.stage != Stage::before_repair);
}

// Numbers of facets and defects mean others in a repaired surface.
void Opening::follow_repairs() {
    if (checked_ == view_.session.document().checked) return;
    const bool is_other = checked_ && view_.session.document().checked;
    checked_ = view_.session.document().checked;
    if (is_other && view_.state.selection.kind != Selection::Kind::place) view_.state.selection = {};
}

// A surface that can be cut is cut once, after it was opened.
void Opening::begin_auto_run() {
    const Document& document = view_.session.document();
    if (!view_.options.auto_run || document.kind != Document::Kind::surface || opened_ == document.path) return;
    if (!document.checked || document.has_problems()) return;
    opened_ = document.path;
    view_.session.start_run(document.options, view_.options.volume);
}

// A solution is seen by its stress, a finished run by its cells, and parts without cells pulled apart, unless
// somebody has chosen something else.
void Opening::choose_view() {
    const Document& document = view_.session.document();
    if (is_view_complete_ || document.kind == Document::Kind::none) return;
    is_view_complete_ = true;
    if (view_.session.other_document()) {
        view_.state.panels.parameters = true;  // which compares the two
        if (!view_.chosen.beside) view_.state.look.beside = true;
    }
    if (document.solution && !view_.chosen.color && !view_.chosen.stage) {
        const auto& cases = document.solution->cases;
        view_.state.coloring.by =
            !cases.empty() && cases.front().is_mode() ? ColorBy::displacement : ColorBy::von_mises;
        if (kept_scale_.range) {
            view_.state.coloring.by = kept_scale_.color;
            view_.state.coloring.range = kept_scale_.range;
        }
        view_.state.step.stage = Stage::tetrahedra;
    }
    if (view_.chosen.faces_clip && !view_.chosen.stage && has_cells(document, view_.state.node))
        view_.state.step = {Stage::tetrahedra, -1};
    if (!document.progress.running && !view_.chosen.stage && !view_.chosen.color) show_cells();
    if (!document.has_surfaces_alone() || view_.chosen.stage || is_of_cells(view_.state.coloring.by)) return;
    view_.state.step = {Stage::parts, -1};
    if (!view_.chosen.explode) view_.state.explosion.amount = usual_explosion;
}

// The cells of a finished run, in the colours of its regions where there are several.
void Opening::show_cells() {
    const Document& document = view_.session.document();
    if (document.solution || !has_cells(document, view_.shown().node)) return;
    view_.state.step = {Stage::tetrahedra, -1};
    const bool is_free = !view_.chosen.color && view_.state.coloring.by == ColorBy::part;
    if (is_free && document.region_names.size() > 1) view_.state.coloring.by = ColorBy::region;
}

// The end of a run is told, and its cells are shown to who has waited for them at the surface.
void Opening::follow_run(bool leads_tour) {
    const Document& document = view_.session.document();
    const bool was_running = std::exchange(is_running_, document.progress.running);
    if (is_running_ && !was_running) camera_at_start_ = view_.state.camera;
    if (!was_running || is_running_ || !document.progress.message.empty()) return;
    if (!has_cells(document, root_node)) return;
    view_.notify("meshed: " + outcome_of(document, true));
    if (view_.state.camera == camera_at_start_)
        view_.state.camera.reset();  // the same as before the run: all fits again
    const ViewState& state = view_.state;
    if (!leads_tour && state.node == root_node && state.step.stage <= Stage::input) show_cells();
}

void Opening::follow(bool leads_tour) {
    remember_opened();
    begin_auto_run();
    follow_run(leads_tour);
    choose_view();
    follow_repairs();
}

}  // namespace kerf::view

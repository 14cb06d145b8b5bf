// A state is the surface of the files as one set of options mends it (CheckedSurface). The surface without repairs is
// checked before the first repaired one and begins the history, because deviations refer to it. Every repair starts
// from the files, so that a state depends on its options alone, and going back computes nothing. Checks run on the
// loader's thread and ask their scope now and then whether they are still wanted; if not they end by Error(cancelled).
// Where a run or a trace is shown, a check changes neither surface nor tree; only a repair, undo() or redo() sets the
// run aside (show_surface_again()). Document::soup shares memory with files_ or with the state, so that its address
// tells whether the surface is shown as it was read.
#include "viewer/model/inside/repairs.h"

#include <utility>

#include "base/core/error.h"
#include "base/geometry/box.h"
#include "run/prepare/repaired_file.h"
#include "viewer/model/advice.h"
#include "viewer/model/file_kind.h"
#include "viewer/model/inside/node_surface.h"
#include "viewer/model/inside/opened_run.h"
#include "viewer/model/inside/tree_source.h"

namespace kerf::view {

// The surface as the file has it is checked before the first one that is repaired.
Loader::Work Repairs::checking(const InputOptions& options, std::shared_ptr<const Scope> scope) {
    const InputOptions plain = without_repairs(options);
    const bool knows_plain = !history_.empty() && same_input(plain, history_.unrepaired().options);
    return [this, files = files_, path = document_.options.input, options, plain, scope = std::move(scope),
            unrepaired = knows_plain ? history_.unrepaired().checked : nullptr]() -> Loader::Completion {
        const auto check_cancelled = [&] {
            if (scope->has_ended()) throw Error(ErrorCode::cancelled, "The repair was cancelled.");
        };
        std::vector<CheckedSurface> states;
        std::shared_ptr<const CheckedSoup> first = unrepaired;
        if (!first) first = states.emplace_back(check_surface(*files, plain, path, nullptr, check_cancelled)).checked;
        if (!same_input(plain, options))
            states.push_back(check_surface(*files, options, path, first.get(), check_cancelled));
        return [this, states = std::move(states)] { take_checked(states); };
    };
}

void Repairs::check() {
    background_.post(background_.open, checking(document_.options.input_options, background_.open.scope));
}

void Repairs::begin(std::shared_ptr<const InputFiles> files) {
    files_ = std::move(files);
    opened_with_ = document_.options.input_options;
    check();
}

void Repairs::check_again() {
    if (files_ && document_.checked) check();
}

void Repairs::forget() {
    background_.repair.reset();
    files_.reset();
    history_.clear();
}

void Repairs::next_frame() {
    if (is_repairing())
        document_.progress.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - since_).count();
}

void Repairs::take_checked(std::vector<CheckedSurface> states) {
    for (CheckedSurface& state : states)
        if (same_input(state.options, without_repairs(state.options)))
            history_.begin(std::move(state));
        else
            history_.add(std::move(state));
    if (states.empty())
        while (history_.can_undo()) history_.undo();
    show_checked();
}

// If there is a run, it has told more of surface and tree since, and these stay.
void Repairs::show_checked() {
    const CheckedSurface& state = history_.shown();
    document_.checked = state.checked;
    document_.unrepaired = state.surface ? history_.unrepaired().checked : nullptr;
    document_.surface_saved_as.clear();
    Store& store = pair_.now.store;
    store.erase({Store::Kind::surface, not_repaired});
    store.erase_if([](const Store::Key& key) { return key.kind == Store::Kind::on_surface; });
    std::erase(document_.notes, shown_note_);
    shown_note_ = state.note;
    if (!state.note.empty() && !is_set(document_.options, *advised_option(state.note))) add_note(state.note, document_);
    const TreeRow* uncut = document_.tree.find(root_node);
    if (document_.trace || !document_.folder.empty() || !uncut || !uncut->leaf()) return;
    show_its_surface();
    if (!state.oriented) return;
    const OrientedSurface& oriented = *state.oriented;
    TreeRow& root = document_.tree.at(root_node);  // the tree may be a new one
    root.vertices = oriented.vertices;
    root.facets = oriented.facets;
    root.volume = document_.volume = oriented.volume;
    if (oriented.mass) describe_surface(oriented.vertices, oriented.facets, *oriented.mass, root);
    document_.region_names = oriented.region_names;
}

void Repairs::show_its_surface() {
    const CheckedSurface& state = history_.shown();
    const bool is_as_read = document_.soup.get() == &files_->soup;
    if (!state.surface && is_as_read) return;
    const Store::Key key{Store::Kind::surface, root_node};
    if (state.surface) {
        document_.soup = {state.checked, &state.checked->soup};
        pair_.now.store.insert(key, state.surface, bytes_of(*state.surface));
    } else {
        document_.soup = {files_, &files_->soup};
        fetched_.drop(key);
    }
    document_.box.extend(box_around_finite(document_.soup->vertices));
    set_input(*document_.soup, document_);
    document_.volume = 0;
    document_.region_names.clear();
    document_.tree = {};
    TreeRow& root = document_.tree.at(root_node);
    root.vertices = document_.input_vertices;
    root.facets = document_.input_facets;
}

bool Repairs::can_repair() const {
    return files_ && document_.checked && !history_.empty() && !document_.progress.running &&
           background_.open.jobs == 0;
}

void Repairs::repair(const InputOptions& options) {
    if (!can_repair()) return;
    background_.forget_failures();
    background_.repair.reset();
    since_ = std::chrono::steady_clock::now();
    const auto take = [this, options](const Loader::Completion& completion) {
        show_surface_again();
        document_.options.input_options = options;
        completion();
    };
    const auto work = [check = checking(options, background_.repair.scope), take]() -> Loader::Completion {
        return [take, completion = check()] { take(completion); };
    };
    document_.progress = {};
    document_.progress.running = document_.progress.ours = true;
    document_.progress.stage = "repair";
    background_.post(background_.repair, work, [this](const Error& error) {
        document_.progress = {};
        background_.note_failure(error);
    });
}

void Repairs::cancel() {
    if (!is_repairing()) return;
    background_.repair.reset();
    document_.progress = {};
    background_.note_failure("The repair was cancelled.");
}

void Repairs::undo() {
    if (!can_undo()) return;
    history_.undo();
    show_state();
}

void Repairs::redo() {
    if (!can_redo()) return;
    history_.redo();
    show_state();
}

void Repairs::show_state() {
    show_surface_again();
    document_.options.input_options = history_.shown().options;
    show_checked();
}

// The result of a run that is shown is kept to compare with.
void Repairs::show_surface_again() {
    background_.forget_failures();
    document_.progress = {};
    if (!document_.trace && document_.folder.empty()) return;
    pair_.set_aside(document_);
    fetched_.forget();
    pair_.now.scratch.reset();
    Document surface;
    surface.kind = Document::Kind::surface;
    surface.path = document_.path;
    surface.title = document_.title;
    surface.options = document_.options;
    surface.options.output.clear();
    surface.box = document_.box;
    surface.patch_colours = files_->soup.patch_colours;
    surface.notes = files_->soup.notes;
    set_input(files_->soup, surface);
    surface.soup = {files_, &files_->soup};
    surface.tree.at(root_node).facets = surface.input_facets;
    document_ = std::move(surface);
}

bool Repairs::is_unsaved() const {
    return document_.unrepaired && document_.surface_saved_as.empty() && document_.saved_as.empty() &&
           !same_input(document_.options.input_options, opened_with_);
}

void Repairs::save(const std::string& path) {
    if (!can_repair()) return;
    background_.forget_failures();
    background_.post(background_.open,
                     [this, path = absolute_path(path), options = document_.options]() -> Loader::Completion {
                         repair_file(options.input, options.input_options, path);
                         return [this, path] { document_.surface_saved_as = path; };
                     });
}

}  // namespace kerf::view

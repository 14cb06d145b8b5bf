// Surfaces are checked, and repaired, on the loader's thread, always from what their files said.
#include "viewer/model/session_impl.h"

#include "core/error.h"
#include "geometry/box.h"
#include "prepare/repaired_file.h"
#include "viewer/model/advice.h"
#include "viewer/model/file_kind.h"
#include "viewer/model/node_surface.h"
#include "viewer/model/tree_source.h"

namespace kerf::view {

// The surface as the file has it comes before the first that is repaired.
Loader::Work Session::Impl::checking(const InputOptions& options, std::shared_ptr<const Scope> scope) {
    const InputOptions plain = without_repairs(options);
    const bool knows_plain = !history_.empty() && same_input(plain, history_.unrepaired().options);
    return [this, files = files_, path = document_.options.input, options, plain, scope = std::move(scope),
            unrepaired = knows_plain ? history_.unrepaired().checked : nullptr]() -> Loader::Completion {
        const auto poll = [&] {
            if (scope->has_ended()) throw Error(ErrorCode::cancelled, "The repair was cancelled.");
        };
        std::vector<CheckedSurface> states;
        std::shared_ptr<const CheckedSoup> first = unrepaired;
        if (!first) first = states.emplace_back(check_surface(*files, plain, path, nullptr, poll)).checked;
        if (!same_input(plain, options)) states.push_back(check_surface(*files, options, path, first.get(), poll));
        return [this, states = std::move(states)] { take_checked(states); };
    };
}

void Session::Impl::check_files_in_background() {
    const auto scope = std::shared_ptr<const Scope>(open_.scope);
    post(open_, checking(document_.options.input_options, scope),
         [this](const std::string& message) { note_failure(message); });
}

void Session::Impl::take_checked(std::vector<CheckedSurface> states) {
    for (CheckedSurface& state : states)
        if (same_input(state.options, without_repairs(state.options)))
            history_.begin(std::move(state));
        else
            history_.add(std::move(state));
    if (states.empty())
        while (history_.can_undo()) history_.undo();
    show_checked();
}

// A run has told more since, if there is one.
void Session::Impl::show_checked() {
    const CheckedSurface& state = history_.shown();
    document_.checked = state.checked;
    document_.unrepaired = state.surface ? history_.unrepaired().checked : nullptr;
    document_.surface_saved_as.clear();
    store_.erase({Store::Kind::surface, not_repaired});
    store_.erase_if([](const Store::Key& key) { return key.kind == Store::Kind::on_surface; });
    std::erase(document_.notes, shown_note_);
    shown_note_ = state.note;
    if (!state.note.empty() && !is_set(document_.options, *advised_option(state.note))) add_note(state.note);
    const TreeRow* uncut = document_.tree.find(1);
    if (document_.trace || !document_.folder.empty() || !uncut || !uncut->leaf()) return;
    show_its_surface();
    if (!state.oriented) return;
    const OrientedSurface& oriented = *state.oriented;
    TreeRow& root = document_.tree.at(1);  // the tree may be a new one
    root.vertices = oriented.vertices;
    root.facets = oriented.facets;
    root.volume = document_.volume = oriented.volume;
    if (oriented.mass) describe_surface(oriented.vertices, oriented.facets, *oriented.mass, root);
    document_.region_names = oriented.region_names;
}

void Session::Impl::show_its_surface() {
    const CheckedSurface& state = history_.shown();
    const bool is_as_read = document_.soup.get() == &files_->soup;
    if (!state.surface && is_as_read) return;
    const Store::Key key{Store::Kind::surface, 1};
    const Soup* soup = state.surface ? &state.checked->soup : &files_->soup;
    if (state.surface) {
        document_.soup = {state.checked, soup};
        store_.insert(key, state.surface, bytes_of(*state.surface));
    } else {
        document_.soup = {files_, soup};
        store_.erase(key);
        failed_.erase(key);
    }
    document_.box.extend(box_around_finite(soup->vertices));
    document_.patch_names = soup->patch_names;
    document_.input_vertices = static_cast<std::int64_t>(soup->vertices.size());
    document_.input_facets = static_cast<std::int64_t>(soup->facets.size());
    document_.volume = 0;
    document_.region_names.clear();
    document_.tree = {};
    TreeRow& root = document_.tree.at(1);
    root.vertices = document_.input_vertices;
    root.facets = document_.input_facets;
}

bool Session::Impl::can_repair() const {
    return files_ && document_.checked && !history_.empty() && !document_.progress.running && !opening_ &&
           open_.jobs == 0;
}

void Session::Impl::repair(const InputOptions& options) {
    if (!can_repair()) return;
    failures_.clear();
    mending_.reset();
    mending_since_ = std::chrono::steady_clock::now();
    const auto end = [this] { document_.progress = {}; };
    const auto take = [this, end, options](const Loader::Completion& completion) {
        end();
        show_surface_again();
        document_.options.input_options = options;
        completion();
    };
    const auto work = [check = checking(options, mending_.scope), take]() -> Loader::Completion {
        return [take, completion = check()] { take(completion); };
    };
    document_.progress = {};
    document_.progress.running = document_.progress.ours = true;
    document_.progress.stage = "repair";
    post(mending_, work, [this, end](const std::string& message) {
        end();
        note_failure(message);
    });
}

void Session::Impl::cancel_repair() {
    if (!is_repairing()) return;
    mending_.reset();
    document_.progress = {};
    note_failure("The repair was cancelled.");
}

void Session::Impl::undo_repair() {
    if (!can_undo_repair()) return;
    history_.undo();
    show_surface_again();
    document_.options.input_options = history_.shown().options;
    show_checked();
}

void Session::Impl::redo_repair() {
    if (!can_redo_repair()) return;
    history_.redo();
    show_surface_again();
    document_.options.input_options = history_.shown().options;
    show_checked();
}

// What a run has made of it is kept to compare with.
void Session::Impl::show_surface_again() {
    failures_.clear();
    document_.progress = {};
    if (!document_.trace && document_.folder.empty()) return;
    set_aside(document_);
    forget_data();
    scratch_.reset();
    Document surface;
    surface.kind = Document::Kind::surface;
    surface.path = document_.path;
    surface.title = document_.title;
    surface.options = document_.options;
    surface.options.output.clear();
    surface.box = document_.box;
    surface.patch_colours = files_->soup.patch_colours;
    surface.notes = files_->soup.notes;
    surface.patch_names = files_->soup.patch_names;
    surface.input_vertices = static_cast<std::int64_t>(files_->soup.vertices.size());
    surface.input_facets = static_cast<std::int64_t>(files_->soup.facets.size());
    surface.soup = {files_, &files_->soup};
    surface.tree.at(1).facets = surface.input_facets;
    document_ = std::move(surface);
}

void Session::Impl::save_surface(const std::string& path) {
    if (!can_repair()) return;
    failures_.clear();
    const auto write = [this, path = absolute_path(path), options = document_.options]() -> Loader::Completion {
        repair_file(options.input, options.input_options, path);
        return [this, path] { document_.surface_saved_as = path; };
    };
    post(open_, write, [this](const std::string& message) { note_failure(message); });
}

}  // namespace kerf::view

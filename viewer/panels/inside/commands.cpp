// The table of commands (all_commands), in the order of menus and lists. A command acts by plain functions; templates
// make those that only toggle a flag or call one action. A new command is a row here, and the menus, the window of
// keys, the search box and the keyboard have it. A search ranks a command 0 if its name begins with the text, 1 if its
// name contains it, 2 if its words are elsewhere in name, heading or keys. Left, Right, Up, Down and Escape mean other
// things during a tour or in a list of defects or cells: step_by(), go_by() and leave() decide that.
#include "viewer/panels/inside/commands.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "base/core/error.h"
#include "viewer/model/saving.h"

namespace kerf::view {

namespace {

constexpr const char* looking = "Looking";
constexpr const char* showing = "Showing";
constexpr const char* stepping = "Stepping";
constexpr const char* files = "Files";
constexpr const char* helping = "Help";
constexpr const char* panel_heading = "Panels";

template <bool Panels::*Panel>
void toggle_panel(UiContext& context, Dialogs& /*dialogs*/) {
    context.state.panels.*Panel = !(context.state.panels.*Panel);
}
template <bool Panels::*Panel>
bool shows_panel(const UiContext& context) {
    return context.state.panels.*Panel;
}

template <auto Group, auto Flag>
void toggle_flag(UiContext& context, Dialogs& /*dialogs*/) {
    bool& flag = context.state.*Group.*Flag;
    flag = !flag;
}
template <auto Group, auto Flag>
bool has_flag(const UiContext& context) {
    return context.state.*Group.*Flag;
}

template <void (FileActions::*Action)()>
void act_by_files(UiContext& context, Dialogs& /*dialogs*/) {
    (context.actions.files.*Action)();
}
template <void (WindowActions::*Action)()>
void act_by_window(UiContext& context, Dialogs& /*dialogs*/) {
    (context.actions.window.*Action)();
}
template <void (CameraActions::*Action)()>
void act_by_camera(UiContext& context, Dialogs& /*dialogs*/) {
    (context.actions.camera.*Action)();
}
template <void (PlayActions::*Action)()>
void act_by_play(UiContext& context, Dialogs& /*dialogs*/) {
    (context.actions.play.*Action)();
}
template <void (RunActions::*Action)()>
void act_by_runs(UiContext& context, Dialogs& /*dialogs*/) {
    (context.actions.runs.*Action)();
}
template <void (RepairActions::*Action)()>
void act_by_repairs(UiContext& context, Dialogs& /*dialogs*/) {
    (context.actions.repairs.*Action)();
}

template <Direction From>
void look_at_it(UiContext& context, Dialogs& /*dialogs*/) {
    Camera camera = context.camera;
    look_from(camera, From, context.facts.up);
    context.actions.camera.take_camera(camera);
}

void look_from_behind(UiContext& context, Dialogs& /*dialogs*/) {
    Camera camera = context.camera;
    camera.turn = (Eigen::AngleAxisd(M_PI, Vec3::Unit(context.facts.up)) * camera.turn).normalized();
    context.actions.camera.take_camera(camera);
}

void change_projection(UiContext& context, Dialogs& /*dialogs*/) {
    Camera camera = context.camera;
    camera.perspective = !camera.perspective;
    context.actions.camera.take_camera(camera);
}
bool has_earlier(const UiContext& context) { return context.facts.has_earlier; }
bool has_later(const UiContext& context) { return context.facts.has_later; }
bool is_perspective(const UiContext& context) { return context.camera.perspective; }

void copy_camera(UiContext& context, Dialogs& /*dialogs*/) { context.actions.window.copy(to_json(context.camera)); }

void paste_camera(UiContext& context, Dialogs& /*dialogs*/) {
    try {
        context.actions.camera.take_camera(camera_from_json(context.actions.window.clipboard(), "the clipboard"));
    } catch (const Error& error) {
        context.actions.window.complain(error.what());
    }
}

void change_theme(UiContext& context, Dialogs& /*dialogs*/) {
    const Theme other = context.state.theme == Theme::dark ? Theme::light : Theme::dark;
    context.state.theme = context.settings.theme = other;
}
bool is_dark(const UiContext& context) { return context.state.theme == Theme::dark; }

void toggle_clip(UiContext& context, Dialogs& dialogs) {
    context.state.clip.on = !context.state.clip.on;
    if (context.state.clip.on) show_cut_face(context, dialogs.clip);
}
void show_patches(UiContext& context, Dialogs& /*dialogs*/) { context.state.visibility.hidden_patches.clear(); }
bool hides_patches(const UiContext& context) { return !context.state.visibility.hidden_patches.empty(); }

bool is_clipped(const UiContext& context) { return context.state.clip.on; }
void clip_through(UiContext& context, Dialogs& /*dialogs*/) { context.actions.camera.clip_through_selection(false); }

template <int Count>
void step_by(UiContext& context, Dialogs& dialogs) {
    if (dialogs.tour.node != no_node)
        go_on_tour(context, dialogs, Count);
    else
        context.actions.play.move_step(Count);
}

// Up and Down go on in the list of defects or cells that was used last, else in the tree.
template <int Count>
void go_by(UiContext& context, Dialogs& dialogs) {
    if (dialogs.list.list == ListKeys::List::none)
        context.actions.play.move_node(Count);
    else
        dialogs.list.steps += Count;
}

bool is_playing(const UiContext& context) { return context.facts.playing; }
bool has_other(const UiContext& context) {
    return context.session.other_document() || context.session.document().unrepaired;
}
bool has_two_runs(const UiContext& context) {
    const Document* other = context.session.other_document();
    return other && has_mesh(*other) && has_mesh(context.session.document());
}
bool can_undo(const UiContext& context) { return context.session.repairs().can_undo(); }
bool can_redo(const UiContext& context) { return context.session.repairs().can_redo(); }

void leave(UiContext& context, Dialogs& dialogs) {
    dialogs.list.list = ListKeys::List::none;
    if (context.state.panels.keys)
        context.state.panels.keys = false;
    else if (dialogs.tour.node != no_node)
        end_tour(context, dialogs);
    else
        context.state.selection = {};
}

void choose_file(UiContext& /*context*/, Dialogs& dialogs) { dialogs.browser.requested = true; }

void choose_other_run(UiContext& /*context*/, Dialogs& dialogs) {
    dialogs.browser.requested = dialogs.browser.compares = true;
}

template <SaveDialog::Kind Kind>
void ask_where_to_save(UiContext& /*context*/, Dialogs& dialogs) {
    dialogs.save.request(Kind);
}
bool can_save_run(const UiContext& context) { return context.session.pair().can_save(); }
bool can_be_exported(const UiContext& context) { return has_mesh(context.session.document()); }
bool can_save_surface(const UiContext& context) {
    return context.session.document().unrepaired && context.session.repairs().can_repair();
}
bool has_picture(const UiContext& context) { return has_body(context.session.document()); }

void mesh_it(UiContext& context, Dialogs& dialogs) { start_edited_run(context, dialogs.parameters, true); }
void ask_for_search(UiContext& /*context*/, Dialogs& dialogs) { dialogs.search.requested = true; }

bool can_be_cut(const UiContext& context) {
    return has_body(context.session.document()) && !context.session.document().has_problems();
}

bool can_be_meshed(const UiContext& context) {
    return can_be_cut(context) && !context.session.document().progress.running;
}

bool is_something_open(const UiContext& context) { return !context.session.document().path.empty(); }

template <bool Panels::*Panel>
constexpr Command panel_switch(const char* name, bool ends_section = false) {
    return {.name = name,
            .keys = "",
            .heading = panel_heading,
            .menu = "View",
            .run = toggle_panel<Panel>,
            .is_on = shows_panel<Panel>,
            .ends_section = ends_section};
}

template <auto Group, auto Flag>
constexpr Command flag_switch(const char* name, const char* keys, const char* heading, const char* menu) {
    return {.name = name,
            .keys = keys,
            .heading = heading,
            .menu = menu,
            .run = toggle_flag<Group, Flag>,
            .is_on = has_flag<Group, Flag>};
}

template <Direction From>
constexpr Command view_from(const char* name, const char* keys) {
    return {.name = name, .keys = keys, .heading = looking, .menu = "View", .run = look_at_it<From>};
}

template <SaveDialog::Kind Kind>
constexpr Command save_as(const char* name, const char* keys, bool (*is_enabled)(const UiContext& context)) {
    return {.name = name,
            .keys = keys,
            .heading = files,
            .menu = "File",
            .run = ask_where_to_save<Kind>,
            .is_enabled = is_enabled};
}

const std::vector<Command> all_commands = {
    {.name = "Open...", .keys = "Ctrl+O", .heading = files, .menu = "File", .run = choose_file},
    {.name = "Compare with...",
     .keys = "",
     .heading = files,
     .menu = "File",
     .run = choose_other_run,
     .is_enabled = can_be_exported},
    {.name = "Reload",
     .keys = "Ctrl+R",
     .heading = files,
     .menu = "File",
     .run = act_by_files<&FileActions::reload>,
     .is_enabled = is_something_open,
     .ends_section = true},
    {.name = "Mesh the surface",
     .keys = "",
     .heading = files,
     .menu = "File",
     .run = mesh_it,
     .is_enabled = can_be_meshed},
    save_as<SaveDialog::Kind::run>("Save run as...", "Ctrl+S", can_save_run),
    save_as<SaveDialog::Kind::mesh>("Export mesh...", "Ctrl+E", can_be_exported),
    save_as<SaveDialog::Kind::surface>("Save surface as...", "", can_save_surface),
    save_as<SaveDialog::Kind::page>("Save report page...", "", can_be_exported),
    save_as<SaveDialog::Kind::picture>("Save picture...", "", has_picture),
    {.name = "Screenshot",
     .keys = "F12",
     .heading = files,
     .menu = "File",
     .run = act_by_window<&WindowActions::take_screenshot>,
     .ends_section = true},
    {.name = "Quit", .keys = "Ctrl+Q", .heading = files, .menu = "File", .run = act_by_window<&WindowActions::quit>},

    panel_switch<&Panels::tree>("Tree panel"),
    panel_switch<&Panels::problems>("Problems panel"),
    panel_switch<&Panels::display>("Display panel"),
    panel_switch<&Panels::quality>("Worst cells panel"),
    panel_switch<&Panels::parameters>("Parameters panel"),
    panel_switch<&Panels::timeline>("Timeline panel"),
    {.name = "Times in the tree",
     .keys = "",
     .heading = panel_heading,
     .menu = "View",
     .run = toggle_flag<&ViewState::look, &Look::times>,
     .is_on = has_flag<&ViewState::look, &Look::times>,
     .ends_section = true},
    {.name = "Dark theme",
     .keys = "",
     .heading = panel_heading,
     .menu = "View",
     .run = change_theme,
     .is_on = is_dark,
     .ends_section = true},
    {.name = "Fit everything",
     .keys = "Home",
     .heading = looking,
     .menu = "View",
     .run = act_by_camera<&CameraActions::fit_all>},
    {.name = "Frame the selection",
     .keys = "F",
     .heading = looking,
     .menu = "View",
     .run = act_by_camera<&CameraActions::frame_selection>},
    view_from<Direction::front>("Front view", "1"),
    view_from<Direction::back>("Back view", ""),
    view_from<Direction::right>("Right view", "3"),
    view_from<Direction::left>("Left view", ""),
    view_from<Direction::top>("Top view", "7"),
    view_from<Direction::bottom>("Bottom view", ""),
    view_from<Direction::corner>("Corner view", ""),
    {.name = "Opposite view", .keys = "9", .heading = looking, .menu = "View", .run = look_from_behind},
    {.name = "Perspective",
     .keys = "5",
     .heading = looking,
     .menu = "View",
     .run = change_projection,
     .is_on = is_perspective,
     .ends_section = true},
    {.name = "Earlier view",
     .keys = "U",
     .heading = looking,
     .menu = "View",
     .run = act_by_camera<&CameraActions::show_earlier>,
     .is_enabled = has_earlier},
    {.name = "Later view",
     .keys = "Shift+U",
     .heading = looking,
     .menu = "View",
     .run = act_by_camera<&CameraActions::show_later>,
     .is_enabled = has_later,
     .ends_section = true},
    {.name = "Copy camera", .keys = "", .heading = looking, .menu = "View", .run = copy_camera},
    {.name = "Paste camera", .keys = "", .heading = looking, .menu = "View", .run = paste_camera},

    {.name = "Clip plane", .keys = "C", .heading = showing, .menu = "", .run = toggle_clip, .is_on = is_clipped},
    {.name = "Clip through the selection", .keys = "Shift+C", .heading = showing, .menu = "", .run = clip_through},
    {.name = "Hide the patch under the mouse",
     .keys = "P",
     .heading = showing,
     .menu = "",
     .run = act_by_camera<&CameraActions::hide_patch>},
    {.name = "Show hidden patches",
     .keys = "Shift+P",
     .heading = showing,
     .menu = "",
     .run = show_patches,
     .is_enabled = hides_patches},
    flag_switch<&ViewState::look, &Look::edges>("Edges", "E", showing, ""),
    flag_switch<&ViewState::visibility, &Visibility::neighbours>("Only neighbours of a selected cell", "N", showing,
                                                                 ""),
    {.name = "Select nothing, close what is open", .keys = "Escape", .heading = showing, .menu = "", .run = leave},

    {.name = "Previous step", .keys = "Left", .heading = stepping, .menu = "", .run = step_by<-1>, .repeats = true},
    {.name = "Next step", .keys = "Right", .heading = stepping, .menu = "", .run = step_by<1>, .repeats = true},
    {.name = "Previous node, or entry of a list",
     .keys = "Up",
     .heading = stepping,
     .menu = "",
     .run = go_by<-1>,
     .repeats = true},
    {.name = "Next node, or entry of a list",
     .keys = "Down",
     .heading = stepping,
     .menu = "",
     .run = go_by<1>,
     .repeats = true},
    {.name = "Play the steps",
     .keys = "Space",
     .heading = stepping,
     .menu = "",
     .run = act_by_play<&PlayActions::toggle_play>,
     .is_on = is_playing},
    {.name = "The run or repair before, or after",
     .keys = "B",
     .heading = stepping,
     .menu = "",
     .run = act_by_runs<&RunActions::show_other>,
     .is_enabled = has_other},
    {.name = "Two runs side by side",
     .keys = "Shift+B",
     .heading = stepping,
     .menu = "",
     .run = toggle_flag<&ViewState::look, &Look::beside>,
     .is_on = has_flag<&ViewState::look, &Look::beside>,
     .is_enabled = has_two_runs},
    {.name = "Undo the last repair",
     .keys = "Ctrl+Z",
     .heading = stepping,
     .menu = "",
     .run = act_by_repairs<&RepairActions::undo_repair>,
     .is_enabled = can_undo},
    {.name = "Redo the repair",
     .keys = "Ctrl+Shift+Z, Ctrl+Y",
     .heading = stepping,
     .menu = "",
     .run = act_by_repairs<&RepairActions::redo_repair>,
     .is_enabled = can_redo},

    {.name = "Search commands", .keys = "Ctrl+K", .heading = helping, .menu = "Help", .run = ask_for_search},
    {.name = "How this cut is made",
     .keys = "T",
     .heading = helping,
     .menu = "Help",
     .run = begin_tour,
     .is_enabled = can_be_cut},
    {.name = "Keys and mouse",
     .keys = "H",
     .heading = helping,
     .menu = "Help",
     .run = toggle_panel<&Panels::keys>,
     .is_on = shows_panel<&Panels::keys>},
};

std::string in_small_letters(std::string_view text) {
    std::string small(text);
    std::transform(small.begin(), small.end(), small.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return small;
}

bool has_key(const Command& command, const std::string& key) {
    std::istringstream keys(command.keys);
    for (std::string one; std::getline(keys >> std::ws, one, ',');)
        if (one == key) return true;
    return false;
}

// The rank of a command in a search: 0, 1, 2, the best first, or -1 if it does not have all typed words.
int rank_of(const Command& command, const std::string& typed) {
    const std::string name = in_small_letters(command.name);
    const std::string all = name + " " + in_small_letters(command.heading) + " " + in_small_letters(command.keys);
    std::istringstream words(typed);
    for (std::string word; words >> word;)
        if (all.find(word) == std::string::npos) return -1;
    return name.starts_with(typed) ? 0 : name.find(typed) != std::string::npos ? 1 : 2;
}

}  // namespace

const std::vector<Command>& commands() { return all_commands; }

bool is_enabled(const Command& command, const UiContext& context) {
    return !command.is_enabled || command.is_enabled(context);
}

const Command* command_of_key(const std::string& key) {
    const auto named = [](const std::string& text) {
        const auto found = std::find_if(all_commands.begin(), all_commands.end(),
                                        [&](const Command& command) { return has_key(command, text); });
        return found == all_commands.end() ? nullptr : &*found;
    };
    const Command* command = named(key);
    const std::size_t shift = key.find("Shift+");
    return command || shift == std::string::npos ? command : named(std::string(key).erase(shift, 6));
}

std::vector<const Command*> find_commands(std::string_view typed) {
    const std::string text = in_small_letters(typed);
    std::vector<const Command*> found;
    for (const int rank : {0, 1, 2})
        for (const Command& command : all_commands)
            if (rank_of(command, text) == rank) found.push_back(&command);
    return found;
}

}  // namespace kerf::view

// The parts of the user interface: a function for each, and a struct with the state that it keeps between frames. Only
// this folder includes this header.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "viewer/model/tour.h"
#include "viewer/panels/inside/layout.h"
#include "viewer/panels/inside/style.h"
#include "viewer/panels/inside/tree_columns.h"
#include "viewer/panels/panels.h"
#include "viewer/panels/text.h"

namespace kerf::view {

/// A dialog that chooses a file or folder. It reads a folder when it is shown and when it changes, not in every frame.
struct FileBrowser {
    struct Entry {
        enum class Kind { folder, run, surface, trace, events, other };
        std::string name;
        Kind kind = Kind::other;
        std::uintmax_t bytes = 0;
    };
    bool requested = false;  ///< it opens in the next frame
    bool compares = false;   ///< the run that is chosen is opened beside the open one
    bool open = false;
    int frames_to_focus = 0;  ///< frames until the path has the keyboard
    bool all_files = false;
    std::string folder, typed, filter, error;
    bool is_run = false;  ///< whether the folder is that of a run
    std::vector<Entry> entries;
    int chosen = -1;  ///< index in `entries`

    void go_to(const std::filesystem::path& new_folder);
};

/// A dialog that finds commands by their names.
struct SearchBox {
    bool requested = false;  ///< it opens in the next frame
    std::string typed;
    int chosen = 0;      ///< index in the commands found
    bool moved = false;  ///< keys have moved the choice in this frame
};

/// A dialog that saves what is open.
struct SaveDialog {
    enum class Kind { run, other_run, mesh, picture, page, surface };
    Kind kind = Kind::run;
    bool is_requested = false;  ///< it opens in the next frame
    std::string path;           ///< as typed
    int format = 0;             ///< index in formats()
    int order = 0;              ///< MeshFile::order

    void request(Kind what) {
        kind = what;
        is_requested = true;
    }
};

/// A guided tour of the stages of one cut.
struct Tour {
    bool awaited = false;                  ///< it begins as soon as there is a cut to show
    bool has_run = false;                  ///< a run was started to have a cut to show
    NodeId node = no_node;                 ///< the node whose cut is shown; no_node: there is no tour
    std::optional<TourStop> go_to = {};    ///< the stop that the next frame shows
    std::optional<ViewState> before = {};  ///< the view before the tour
};

/// A collapsing section. When it opens, its panel scrolls to it for some frames, because it grows meanwhile.
struct Section {
    bool open = false;
    int frames_to_scroll = 0;
};

/// The list that was used last, in which the keys Up and Down go on.
struct ListKeys {
    enum class List { none, defects, worst_cells };
    List list = List::none;
    int steps = 0;  ///< steps down, negative: up, that keys have asked for

    /// Returns the steps that were asked for, and forgets them, if `of` is the list used last; else 0.
    int take(List of) { return list == of ? std::exchange(steps, 0) : 0; }
};

/// Position and normal of the clip plane while they are typed, and the document in which somebody has flipped it.
struct ClipMemory {
    double at = 0;  ///< distance from the origin along the normal, in units of the file
    std::array<double, 3> normal = {};
    std::string flipped_in;  ///< path of that document; empty: none
};

/// The options of the next run, while they are edited.
struct ParametersMemory {
    Section section;
    RunRequest options;          ///< the options as edited
    RunRequest given;            ///< the options of the document that they were taken from
    std::string path, given_of;  ///< path of that document, and key_of() it
    std::string wrong;           ///< the error in these options; empty: none
    /// A text in the field of a number that is no such number, so that the option keeps its value.
    struct Refused {
        std::string text, error;
    };
    std::map<std::string, Refused> refused;  ///< by the names of options
};

/// The dialogs that commands open, the list in which they go on, and the panels whose content they use.
struct Dialogs {
    FileBrowser browser;
    SearchBox search;
    SaveDialog save;
    Tour tour;
    ListKeys list;
    ParametersMemory parameters;
    ClipMemory clip;
};

void draw_menu(UiContext& context, Dialogs& dialogs);
void draw_browser(UiContext& context, FileBrowser& browser);
/// Draws the search box of commands while it is open.
void draw_search(UiContext& context, Dialogs& dialogs);
/// Draws the dialog that saves while it is open.
void draw_save_dialog(UiContext& context, SaveDialog& dialog);
/// Draws the question of SceneFacts::asks_to_save.
void draw_unsaved(UiContext& context, SaveDialog& dialog);

struct TreeMemory {
    NodeId scrolled_to = no_node;  ///< the node that the list was scrolled to
    TreeOrder order;
    std::set<int> columns;    ///< columns about cuts that were chosen
    std::set<NodeId> folded;  ///< nodes whose children are not listed
};
void draw_tree(UiContext& context, TreeMemory& memory);

void draw_selection(UiContext& context);

struct RepairMemory {
    std::string plan, plan_of;     ///< repair plan as typed; the document's plan for which it was typed
    int action = -1;               ///< number of the chosen action in the report of repairs; -1: none
    int place = -1;                ///< number of the chosen place of that action; -1: none
    std::string save_to, save_of;  ///< file to save the surface to, as typed; path of the document it was typed for
};
/// Draws the repairs that the open surface can have, and those that it has had.
void draw_repairs(UiContext& context, RepairMemory& memory, ParametersMemory& parameters);
/// Draws a button for the steps that mend a kind of defects; nothing where there are none.
void draw_repairs_of(UiContext& context, DefectKind kind);

/// An option that a text advises: the value of its field, and the options of a run with it. They are made anew only
/// when the value changes, as options are held against files.
struct AdvisedRun {
    std::string value, made_for;        ///< value as typed; value that `options` were made for
    std::optional<RunRequest> options;  ///< none: there is no value, or no valid one
};
struct ProblemsMemory {
    std::map<std::string, AdvisedRun> advised;  ///< advised options, by name and by the value if the text names one
    std::string advised_for;                    ///< key_of() the document that they are for
    std::set<std::string> drawn;                ///< options with a button in this frame: two texts may advise the same
    const CheckedSoup* of = nullptr;            ///< the surface in whose lists the following numbers are
    int group = -1;                             ///< number of the kind and severity of the only defects listed; -1: all
    int chosen = -1;                            ///< index of the chosen defect; -1: none
    int frames_to_scroll = 0;                   ///< frames in which the chosen defect is brought into sight
    RepairMemory repairs;
};
void draw_problems(UiContext& context, ProblemsMemory& memory, Dialogs& dialogs);

void draw_display(UiContext& context);
/// Draws a list of regions with switches that show, isolate and make glass, and one that explodes them as wholes;
/// nothing for a body of one region.
void draw_regions(UiContext& context);

void draw_clip(UiContext& context, ClipMemory& memory);
/// Shows the side of the clip plane whose cut face looks to the camera, unless somebody has flipped it.
void show_cut_face(UiContext& context, const ClipMemory& memory);

struct ColorBarMemory {
    std::optional<ValueRange> colored;  ///< range of the values shown when there was no fixed range
    std::string colored_of;             ///< colouring and document of these values
    double drag_from = 0;               ///< value where a drag began, or the end that it leaves in place
};
void draw_color_bar(UiContext& context, ColorBarMemory& memory);

struct HistogramMemory {
    bool log_counts = false;
    std::size_t brush_from = 0;  ///< index of the bin where a drag began
};
void draw_histogram(UiContext& context, HistogramMemory& memory);

struct WorstCellsMemory {
    Section section;
    int chosen = -1;
};
void draw_worst_cells(UiContext& context, WorstCellsMemory& memory, ListKeys& keys);

struct WorstInterfacesMemory {
    bool by_angle = false;     ///< sorted by angles of interface triangles, not by angles with the surface
    NodeId chosen = no_node;   ///< the node of the chosen interface
    NodeId awaited = no_node;  ///< the node to be flown to as soon as its surface is there; 0: none
};
void draw_worst_interfaces(UiContext& context, WorstInterfacesMemory& memory);

struct ColorMemory {
    ValueRange range, filter;  ///< limits of colours and of the filter while they are typed
    ColorBarMemory bar;
    HistogramMemory histogram;
    WorstCellsMemory worst_cells;
    WorstInterfacesMemory worst_interfaces;
};
void draw_color(UiContext& context, ColorMemory& memory, ListKeys& keys);
void draw_solution(UiContext& context);

/// Draws the comparison of two runs, and a button that asks where the shown one is to be saved.
void draw_comparison(UiContext& context, SaveDialog& dialog);

void draw_parameters(UiContext& context, Dialogs& dialogs);
/// Starts a run with the options of the Parameters panel, or says what is wrong with these.
void start_edited_run(UiContext& context, ParametersMemory& memory, bool volume);

struct TimelineMemory {
    int chosen = -1;        ///< index of the place of a refused try that was flown to last; -1: none
    NodeId node = no_node;  ///< node of that try
    Step step;              ///< step of that try
};
void draw_timeline(UiContext& context, TimelineMemory& memory, Dialogs& dialogs);

/// Makes the cuts of the document again, in another process, so that their stages are recorded. The open folder stays
/// as it is.
void record_stages(UiContext& context);
/// Begins a guided tour of the cut of the node shown, else of the first cut, as soon as there is one.
void begin_tour(UiContext& context, Dialogs& dialogs);
void end_tour(UiContext& context, Dialogs& dialogs);
/// Goes `count` stages on, or back if negative; does nothing beyond the ends.
void go_on_tour(UiContext& context, Dialogs& dialogs, int count);
/// Shows the stage of the tour that was asked for. Call it before anything is drawn.
void follow_tour(UiContext& context, Dialogs& dialogs, const Rectangle& scene);
/// Draws the tour in the timeline, while there is one.
void draw_tour(UiContext& context, Dialogs& dialogs);

void draw_status(UiContext& context);
void draw_keys(UiContext& context);
/// Draws the start page, while nothing is open.
void draw_welcome(UiContext& context, Dialogs& dialogs, const Rectangle& scene);
void draw_legend(UiContext& context, const Rectangle& scene);
/// Draws a caption at the upper left of the scene: its content in words for a reader who does not know Kerf.
void draw_caption(UiContext& context, const Rectangle& scene);
/// Draws the caption of the other one of two runs, and a line between the two.
void draw_caption_beside(UiContext& context, const RunBeside& other);
void draw_gizmo(UiContext& context, const Rectangle& scene);
/// Draws a bar of a round length at the lower left of a scene that has room for it.
void draw_scale_bar(UiContext& context, const Rectangle& scene);
/// Draws handles between panels and scene: a drag resizes the panel, a double click gives it back the size that the
/// window suggests.
void draw_splitters(UiContext& context, const Layout& layout);

struct CutHandleMemory {
    double dragged = 0;     ///< distance along its normal by which the plane of a cut was dragged, units of the file
    NodeId node = no_node;  ///< node of that cut
};
/// Draws the clip plane's outline with two handles, one in its middle that moves it and one off the plane that turns
/// it; and a handle on the plane of the cut shown, which is made again where the handle is let go.
void draw_plane_handles(UiContext& context, CutHandleMemory& memory, const Rectangle& scene);

/// Returns path and options of the document as one text. Edits and advice for a document with another key are void.
std::string key_of(const Document& document);
/// Shows another node, at the step nearest to the one shown.
void go_to_node(UiContext& context, NodeId node);
/// Shows a hidden node again, with its region and all nodes above it.
void reveal(UiContext& context, NodeId node);
/// Returns the colour of a part in the scene; null unless the scene is coloured by parts.
const Color* part_color(const SceneFacts& facts, const ViewState& state, NodeId part);
/// Returns the colour that the legend explains by this text; null if there is none.
const Color* color_in_legend(const SceneFacts& facts, const std::string& text);
/// Returns the index of a measure in Document::histograms; -1 if the colouring has none.
int histogram_number(ColorBy color);
/// Returns the range of the values of the colouring: of all cells of the run if known, else of the scene, else [0, 1].
ValueRange values_of_run(const UiContext& context);
/// Scrolls the list that is being drawn so that the pixels from `top` to `top` + `height` are seen.
void scroll_to_row(float top, float height);
/// Draws the head of a section that a switch opens and closes, too. The section comes into sight when it opens.
void draw_head(Widgets& widgets, const char* label, bool& open, Section& section);
/// Draws a field of this width, without its label, for a number that takes effect when the field is left, and returns
/// whether it was left with a new number. `typed` is the number in the field, and `value` as long as nobody types.
bool input_on_leaving(Widgets& widgets, const char* label, float width, double value, double& typed);
/// Returns the length of the body's diagonal, of the soup's if there is no body, or 1.
double diagonal_of(const Document& document);
/// Shows a message as long as the mouse is over the last item; `text` may be long, and nothing is shown if it is empty.
void explain(const std::string& text);
/// Draws the soft ground of a text at a corner of the scene.
void draw_backdrop(ImDrawList& list, Theme theme, const ImVec2& from, const ImVec2& to);

}  // namespace kerf::view

// The parts of the user interface: one function each, and what it keeps between frames. Only this folder includes it.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "viewer/panels/layout.h"
#include "viewer/panels/panels.h"
#include "viewer/panels/style.h"
#include "viewer/panels/text.h"
#include "viewer/panels/tree_columns.h"

namespace kerf::view {

/// Chooses a file or folder. Reads a folder when it is shown and when it changes, not in every frame.
struct FileBrowser {
    struct Entry {
        enum class Kind { folder, run, surface, trace, events, other };
        std::string name;
        Kind kind = Kind::other;
        std::uintmax_t bytes = 0;
    };
    bool requested = false;  ///< is to open in the next frame
    bool open = false;
    int frames_to_focus = 0;  ///< until the path has the keyboard
    bool all_files = false;
    std::string folder, typed, filter, error;
    std::vector<Entry> entries;
    int chosen = -1;  ///< index in `entries`

    void go_to(const std::filesystem::path& new_folder);
};

/// Of commands by their names.
struct SearchBox {
    bool requested = false;  ///< is to open in the next frame
    std::string typed;
    int chosen = 0;      ///< of those that are found
    bool moved = false;  ///< the choice has, by keys, in this frame
};

/// Of the stages of one cut.
struct Tour {
    bool awaited = false;             ///< it begins as soon as there is a cut to show
    bool has_run = false;             ///< to have one
    NodeId node = 0;                  ///< whose cut is shown; 0: there is no tour
    std::optional<Stage> go_to = {};  ///< what the next frame shows
    std::optional<ViewState> before = {};
};

/// A collapsing section, and for how many frames more the panel scrolls to it: it grows when it opens.
struct Section {
    bool open = false;
    int frames_to_scroll = 0;
};

/// Up and down go on in the list that was used last.
struct ListKeys {
    enum class List { none, defects, worst_cells };
    List list = List::none;
    int steps = 0;  ///< that keys have asked for

    /// Those of this list, once.
    int take(List of) { return list == of ? std::exchange(steps, 0) : 0; }
};

/// What commands open, and where they go on.
struct Dialogs {
    FileBrowser browser;
    SearchBox search;
    Tour tour;
    ListKeys list;
};

void draw_menu(UiContext& context, Dialogs& dialogs);
void draw_browser(UiContext& context, FileBrowser& browser);
/// Of commands, while it is open.
void draw_search(UiContext& context, Dialogs& dialogs);

struct TreeMemory {
    NodeId scrolled_to = 0;  ///< node that it has been scrolled to
    TreeOrder order;
    std::set<int> columns;    ///< about cuts, that were chosen
    std::set<NodeId> folded;  ///< nodes whose children are not listed
};
void draw_tree(UiContext& context, TreeMemory& memory);

void draw_selection(UiContext& context);

struct RepairMemory {
    std::string plan, plan_of;     ///< of repairs, as typed; that of the document
    int action = -1;               ///< of the report of repairs, that was chosen
    int place = -1;                ///< of that action
    std::string save_to, save_of;  ///< where the surface is to be saved, as typed; path of the document
};
/// How the surface that is open can be repaired, and what repairs have done.
void draw_repairs(UiContext& context, RepairMemory& memory);
/// A button for the steps that mend a kind of defects; nothing where there are none.
void draw_repairs_of(UiContext& context, DefectKind kind);

/// An option that a text advises: its value, and what a run would have with it. Made anew only when the value changes,
/// since options are held against files.
struct AdvisedRun {
    std::string value, made_for;
    std::optional<RunOptions> options;
};
struct ProblemsMemory {
    std::map<std::string, AdvisedRun> advised;  ///< by option, and value if the text names one
    std::string advised_for;                    ///< key_of() the document that they are for
    const CheckedSoup* of = nullptr;            ///< whose lists the following is in
    int group = -1;                             ///< kind and severity of the only defects that are listed; -1: all
    int chosen = -1;                            ///< defect
    RepairMemory repairs;
};
void draw_problems(UiContext& context, ProblemsMemory& memory, ListKeys& keys);

void draw_display(UiContext& context);
/// Of bodies of several regions: what is shown of each, and whether they move as wholes.
void draw_regions(UiContext& context);

/// While they are typed.
struct ClipMemory {
    double at = 0;  ///< in units of the file
    std::array<double, 3> normal = {};
};
void draw_clip(UiContext& context, ClipMemory& memory);

struct ColorBarMemory {
    std::optional<ValueRange> colored;  ///< values of what is shown, as it was without a fixed range
    std::string colored_of;             ///< colouring and document that they were of
    double drag_from = 0;               ///< value where a drag began, or that it leaves in place
};
void draw_color_bar(UiContext& context, ColorBarMemory& memory);

struct HistogramMemory {
    bool log_counts = false;
    double brush_from = 0;  ///< bin where a drag began
};
void draw_histogram(UiContext& context, HistogramMemory& memory);

struct WorstCellsMemory {
    Section section;
    int chosen = -1;
};
void draw_worst_cells(UiContext& context, WorstCellsMemory& memory, ListKeys& keys);

struct WorstInterfacesMemory {
    bool by_angle = false;  ///< of their triangles, not those with the surface
    NodeId chosen = 0;      ///< by its node
    NodeId awaited = 0;     ///< it is flown to as soon as its surface is there
};
void draw_worst_interfaces(UiContext& context, WorstInterfacesMemory& memory);

struct ColorMemory {
    ValueRange range, filter;  ///< while they are typed
    ColorBarMemory bar;
    HistogramMemory histogram;
    WorstCellsMemory worst_cells;
    WorstInterfacesMemory worst_interfaces;
};
void draw_color(UiContext& context, ColorMemory& memory, ListKeys& keys);
void draw_solution(UiContext& context);

struct ComparisonMemory {
    std::string save_to, save_of;  ///< where a run is to be saved, as typed; path of the document
};
void draw_comparison(UiContext& context, ComparisonMemory& memory);

struct ParametersMemory {
    Section section;
    RunOptions options;      ///< as edited
    std::string options_of;  ///< key_of() the document that they were taken from
    std::string wrong;       ///< with them; empty: nothing is
    ComparisonMemory comparison;
};
void draw_parameters(UiContext& context, ParametersMemory& memory);

struct TimelineMemory {
    int chosen = -1;  ///< place of a refused try, that was flown to last
    NodeId node = 0;  ///< of that try
    Step step;
};
void draw_timeline(UiContext& context, TimelineMemory& memory, Dialogs& dialogs);

/// Makes the cuts of the document again, in another process, so that their stages are there. What is open stays.
void record_stages(UiContext& context);
/// A guided tour of the cut of the node that is shown, else of the first one, as soon as there is one.
void begin_tour(UiContext& context, Dialogs& dialogs);
void end_tour(UiContext& context, Dialogs& dialogs);
/// So many stages.
void go_on_tour(UiContext& context, Dialogs& dialogs, int count);
/// Before anything is drawn: shows the stage that was asked for.
void follow_tour(UiContext& context, Dialogs& dialogs, const Rectangle& scene);
/// In the timeline, while there is a tour.
void draw_tour(UiContext& context, Dialogs& dialogs);

void draw_status(UiContext& context);
void draw_keys(UiContext& context);
/// The start page, while nothing is open.
void draw_welcome(UiContext& context, Dialogs& dialogs, const Rectangle& scene);
void draw_legend(UiContext& context, const Rectangle& scene);
/// What the picture shows, at its upper left, in words for who does not know Kerf.
void draw_caption(UiContext& context, const Rectangle& scene);
void draw_gizmo(UiContext& context, const Rectangle& scene);
/// Between panels and scene: to be dragged, or clicked twice to have the window's suggestion again.
void draw_splitters(UiContext& context, const Layout& layout);

struct CutHandleMemory {
    double dragged = 0;  ///< how far the plane of a cut is from where it is, along its normal
    NodeId node = 0;     ///< of that cut
};
/// The clip plane's outline, an arrow that moves it, and a ball at its end that turns it; and what moves the plane of
/// the cut that is shown, which is then made there.
void draw_plane_handles(UiContext& context, CutHandleMemory& memory, const Rectangle& scene);

/// Path and options: what is edited or advised for a document is for another one no more.
std::string key_of(const Document& document);
/// Shows another node, at the step nearest to the one that is shown.
void go_to_node(UiContext& context, NodeId node);
/// Shows a node again, its region, and what it lies below.
void reveal(UiContext& context, NodeId node);
/// The colour of a part in the scene, where parts have one.
const Color* part_color(const SceneFacts& facts, const ViewState& state, NodeId part);
/// The colour that the legend explains by this text; null if there is none.
const Color* color_in_legend(const SceneFacts& facts, const std::string& text);
/// Where Document::histograms has a measure; -1: it is none.
int histogram_number(ColorBy color);
/// Of the colouring: of all cells as far as is known, else of what is shown.
ValueRange values_of_run(const UiContext& context);
/// Scrolls the list that is being drawn so that what is there between `top` and `top` + `height` is seen.
void scroll_to_row(float top, float height);
/// The head of a section that a switch opens and closes, too. When it opens it comes into sight.
void draw_head(Widgets& widgets, const char* label, bool& open, Section& section);
/// A field of this width without its label, for a number that takes effect when it is left: then true. `typed` is what
/// stands there, which is `value` as long as nobody types.
bool input_on_leaving(Widgets& widgets, const char* label, float width, double value, double& typed);
/// The length of the body's diagonal, of the soup's if there is no body, or 1.
double diagonal_of(const Document& document);
/// A message as long as the mouse is over the last item; `text` may be long.
void explain(const std::string& text);
/// Text on a soft ground at a corner of the scene, over everything drawn there.
void draw_backdrop(ImDrawList& list, Theme theme, const ImVec2& from, const ImVec2& to);

}  // namespace kerf::view

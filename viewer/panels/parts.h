// The parts of the user interface: one function each, and what it keeps between frames. Only this folder includes it.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
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

/// A collapsing section, and for how many frames more the panel scrolls to it: it grows when it opens.
struct Section {
    bool open = false;
    int frames_to_scroll = 0;
};

/// What ImGui does not keep for us.
struct Memory {
    FileBrowser browser;
    NodeId scrolled_to = 0;  ///< node that the tree has been scrolled to
    TreeOrder tree_order;
    std::set<int> tree_columns;    ///< about cuts, that were chosen
    std::set<NodeId> folded;       ///< nodes of the tree whose children are not listed
    bool worst_by_angle = false;   ///< interfaces by the angles of their triangles, not those with the surface
    NodeId chosen_interface = 0;   ///< of the worst, by its node
    NodeId awaited_interface = 0;  ///< it is flown to as soon as its surface is there
    std::map<std::string, std::string> advised;  ///< values of options that texts advise, as edited
    std::string advised_for;                     ///< path of the document that they are for
    double dragged_plane = 0;                    ///< how far the plane of a cut is from where it is, along its normal
    NodeId dragged_cut = 0;                      ///< the node of that cut
    int chosen_place = -1;                       ///< of a refused try, that was flown to last
    NodeId place_node = 0;                       ///< of that try
    Step place_step;
    int defect_group = -1;  ///< kind and severity of the only defects that are listed; -1: all
    enum class List { none, defects, worst_cells };
    List list = List::none;  ///< that was used last: keys go on in it
    int list_steps = 0;      ///< that keys have asked for
    int chosen_defect = -1;
    int chosen_worst = -1;
    std::optional<ValueRange> colored;  ///< values of what is shown, as it was without a fixed range
    std::string colored_of;             ///< colouring and document that they were of
    double drag_from = 0;               ///< value where a drag over the colour bar began, or that it leaves in place
    double clip_at = 0;                 ///< of the clip plane, in units of the file, while it is typed
    ValueRange range, filter;           ///< while they are typed
    bool log_counts = false;            ///< of the histogram
    double brush_from = 0;              ///< bin where a drag over the histogram began
    std::array<double, 3> normal = {};  ///< of the clip plane while it is typed
    RunOptions options;                 ///< as edited
    std::string options_of;             ///< path and options of the document that they were taken from
    std::string save_to, save_of;       ///< where a run is to be saved, as typed; path of the document
    std::string plan, plan_of;          ///< of repairs, as typed; that of the document
    const CheckedSoup* repairs_of = nullptr;  ///< whose lists the following is in
    int chosen_action = -1;                   ///< of the report of repairs
    int chosen_repair = -1;                   ///< place of that action
    std::string surface_to, surface_of;       ///< where a surface is to be saved, as typed; path of the document
    Section parameters, worst_cells;
};

void draw_menu(UiContext& context, Memory& memory);
void draw_tree(UiContext& context, Memory& memory);
void draw_selection(UiContext& context);
void draw_problems(UiContext& context, Memory& memory);
/// How the surface that is open can be repaired, and what repairs have done.
void draw_repairs(UiContext& context, Memory& memory);
/// A button for the steps that mend a kind of defects; nothing where there are none.
void draw_repairs_of(UiContext& context, DefectKind kind);
void draw_display(UiContext& context);
/// Of bodies of several regions: what is shown of each, and whether they move as wholes.
void draw_regions(UiContext& context);
void draw_clip(UiContext& context, Memory& memory);
void draw_color(UiContext& context, Memory& memory);
void draw_solution(UiContext& context);
void draw_color_bar(UiContext& context, Memory& memory);
void draw_histogram(UiContext& context, Memory& memory);
void draw_worst_cells(UiContext& context, Memory& memory);
void draw_worst_interfaces(UiContext& context, Memory& memory);
void draw_parameters(UiContext& context, Memory& memory);
void draw_comparison(UiContext& context, Memory& memory);
void draw_timeline(UiContext& context, Memory& memory);
void draw_status(UiContext& context);
void draw_browser(UiContext& context, Memory& memory);
void draw_keys(UiContext& context);
void draw_welcome(UiContext& context, const Rectangle& scene);
void draw_legend(UiContext& context, const Rectangle& scene);
/// What the picture shows, at its upper left, in words for who does not know Kerf.
void draw_caption(UiContext& context, const Rectangle& scene);
void draw_gizmo(UiContext& context, const Rectangle& scene);
/// Between panels and scene: to be dragged, or clicked twice to have the window's suggestion again.
void draw_splitters(UiContext& context, const Layout& layout);
/// The clip plane's outline, an arrow that moves it, and a ball at its end that turns it; and what moves the plane of
/// the cut that is shown, which is then made there.
void draw_plane_handles(UiContext& context, Memory& memory, const Rectangle& scene);

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

// The user interface around the scene. Panels read the document, change the view state, and ask the app for the rest.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewer/model/session.h"
#include "viewer/model/timeline.h"
#include "viewer/panels/widgets.h"
#include "viewer/scene/layer.h"

namespace kerf::view {

/// What panels cannot do by changing the view state, by what does it.
class FileActions {
 public:
    virtual ~FileActions() = default;
    virtual void open_files(
        const std::vector<std::string>& paths) = 0;  ///< together, at least one; see Session::open()
    virtual void reload() = 0;
    virtual void open_again(const RunOptions& options) = 0;  ///< what is open, read by them
};

class CameraActions {
 public:
    virtual ~CameraActions() = default;
    virtual void fit_all() = 0;
    virtual void frame_selection() = 0;
    /// Turns the camera's target to a point and comes as close as `radius` (units of the file) asks for; selects it.
    /// `back`: where the eye goes from there, of length 1; zero: as before.
    virtual void fly_to(const Vec3& point, double radius, const Vec3& back) = 0;
    /// Once it is known where a selected cell at the surface can be seen from, the camera turns there.
    virtual void turn_to_selection() = 0;
    /// The clip plane with its normal, or facing the eye, goes through the middle of what is selected.
    virtual void clip_through_selection(bool faces_eye) = 0;
    /// Looks through it from now on, in this frame, too.
    virtual void take_camera(const Camera& camera) = 0;
    /// To the view before, and back to the one after (ViewHistory).
    virtual void show_earlier() = 0;
    virtual void show_later() = 0;
};

class PlayActions {
 public:
    virtual ~PlayActions() = default;
    virtual void move_step(int count) = 0;  ///< so many steps of the node on, or back
    virtual void move_node(int count) = 0;  ///< to the next node of the tree, 1, or the one before, -1
    virtual void toggle_play() = 0;
    virtual void toggle_motion() = 0;  ///< of the deformation
};

class RunActions {
 public:
    virtual ~RunActions() = default;
    virtual void start_run(const RunOptions& options, bool volume) = 0;
    /// At the plane, or where it was.
    virtual void redo_cut(NodeId node, const RunOptions& options, const std::optional<Plane>& plane) = 0;
    virtual void swap_runs() = 0;
    /// From what was before a run or a repair to what is after, and back.
    virtual void show_other() = 0;
};

class RepairActions {
 public:
    virtual ~RepairActions() = default;
    /// Repairs::repair() and its like; what was selected is no more.
    virtual void repair(const InputOptions& options) = 0;
    virtual void undo_repair() = 0;
    virtual void redo_repair() = 0;
    virtual void show_before_repair(bool before) = 0;  ///< or the surface after it, under the same camera
};

class WindowActions {
 public:
    virtual ~WindowActions() = default;
    virtual void quit() = 0;
    virtual void take_screenshot() = 0;
    virtual void copy(const std::string& text) = 0;  ///< to the clipboard
    virtual std::string clipboard() = 0;
    /// Shows what could not be done, until the next notice or click.
    virtual void complain(const std::string& text) = 0;
};

struct Actions {
    FileActions& files;
    CameraActions& camera;
    PlayActions& play;
    RunActions& runs;
    RepairActions& repairs;
    WindowActions& window;
};

/// A number on a face: its middle, in ImGui's units of the window.
struct FaceNumber {
    std::int32_t number = 0;
    float x = 0, y = 0;
};

/// A text at a place of the scene, in ImGui's units of the window.
struct ValueLabel {
    std::string text;
    float x = 0, y = 0;
    bool is_beside = false;  ///< the text stands beside the place, not on it
};

/// What the scene knows that panels show.
struct SceneFacts {
    std::string legend_title;                     ///< empty: the legend explains what is there, not a colouring
    std::optional<ValueRange> values;             ///< of what is shown, by ViewState::color
    std::optional<ValueRange> extremes;           ///< Legend::extremes
    std::vector<PlacedValue> marked;              ///< Legend::marked
    double percentile = 100;                      ///< Legend::percentile
    std::vector<LegendEntry> categories;          ///< what else a legend explains: "part 8"
    std::vector<Color> scale;                     ///< colours from low to high, of a legend with numbers
    bool goes_below = false, goes_above = false;  ///< Legend::goes_below, goes_above
    std::string selection;                        ///< what is selected, as lines of text; empty: nothing
    std::int64_t triangles = 0, lines = 0;        ///< drawn
    std::string notice;                           ///< e.g. "saved as kerf-001.png"; shown for some seconds
    bool notice_is_error = false;                 ///< then until the next click
    std::vector<FaceNumber> numbers;              ///< of patches, to be drawn on them
    std::vector<ValueLabel> labels;               ///< values of isolines, the least and the largest value
    std::optional<ValueLabel> probe;              ///< the value under the mouse
    bool has_earlier = false, has_later = false;  ///< views
    bool playing = false;
    bool moving = false;   ///< the deformation does
    bool pending = false;  ///< something that is to be shown is still being read
};

/// Sizes that the user has given to panels, in heights of the font; 0: as the window suggests.
struct PanelSizes {
    float left = 0, right = 0, timeline = 0;

    bool operator==(const PanelSizes&) const = default;
};

/// Of the picture in the window: pixels, and the scale of the screen (FrameSize::scale) that it was on.
struct WindowSize {
    int width = 1280, height = 800;
    double scale = 1;
};

/// What was open once.
struct RecentFile {
    std::string path;
    std::string day;    ///< when, "26 Nov 2026"; empty: not known
    std::string sizes;  ///< as sizes_of() said; empty: not known
};

/// A surface to try that comes with the program.
struct Example {
    std::string name;  ///< "Bearing cap 14k"
    std::string path;
    std::int64_t facets = 0;
    ImTextureID picture = nullptr;  ///< null: there is none
};

/// "6.21 k facets, 14.6 k tetrahedra", as far as they are known.
std::string sizes_of(const Document& document);

/// Settings that outlive the document, kept in the user's config folder.
struct Settings {
    Theme theme = Theme::light;
    std::vector<RecentFile> recent;  ///< the last one first
    std::string browser_folder;      ///< of the file browser
    PanelSizes panels;
    WindowSize window;  ///< when it was last drawn
};

struct UiContext {
    ViewState& state;
    Session& session;
    Settings& settings;
    const SceneFacts& facts;
    const std::vector<Step>& steps;  ///< of the node
    const Actions& actions;
    Widgets& widgets;
    const Camera& camera;                  ///< that is in use, also where the state has none
    const std::vector<Example>& examples;  ///< for the start page
};

/// A rectangle of the window in ImGui's units, y down.
struct Rectangle {
    float x = 0, y = 0, width = 0, height = 0;

    bool contains(float px, float py) const { return px >= x && py >= y && px < x + width && py < y + height; }
};

/// The ground of a text in the scene.
Rectangle rectangle_of(const ValueLabel& label);

/// Where the scene goes: what the panels leave. Without panels the whole window.
Rectangle scene_rectangle(const ViewState& state, const Document& document, const PanelSizes& sizes, float width,
                          float height, bool panels);

/// What the legend leaves of the scene, on its left or above it, so that the body stands beside it. The same for all
/// steps and colourings.
Rectangle body_area(const ViewState& state, const Rectangle& scene);

/// What Dear ImGui keeps for us between frames: open dialogs, edited options.
class Ui {
 public:
    Ui();
    ~Ui();

    /// Style, colours and fonts for a theme and a HiDPI factor.
    void apply(Theme theme, float scale);
    /// All panels, dialogs and overlays. Between ImGui::NewFrame() and ImGui::Render().
    void draw(UiContext& context, float width, float height);
    /// Legend, gizmo and caption in the scene's rectangle: part of every picture, also without panels.
    void draw_overlays(UiContext& context, const Rectangle& scene);
    /// Does what a key means, "Ctrl+Shift+Z", unless a dialog or a text field has the keyboard. `repeat`: it is held.
    void press(UiContext& context, const std::string& key, bool repeat);

 private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Loads DejaVu Sans at the size, or what fontconfig has in its place, or else ImGui's own font.
void load_fonts(ImFontAtlas& atlas, float pixels);

}  // namespace kerf::view

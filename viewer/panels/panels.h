// The user interface around the scene. Panels read the document, change the view state, and ask the app for the rest.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewer/model/session.h"
#include "viewer/model/timeline.h"
#include "viewer/panels/inside/widgets.h"
#include "viewer/scene/legend.h"

namespace kerf::view {

/// The action of opening files. This class and the five below are interfaces to the parts of the app that do more than
/// change the view state, which panels do themselves.
class FileActions {
 public:
    virtual ~FileActions() = default;
    virtual void open_files(
        const std::vector<std::string>& paths) = 0;  ///< opens at least one, together; see Session::open()
    virtual void reload() = 0;
    virtual void open_again(const RunRequest& options) = 0;  ///< reads the open files again, with these options
};

class CameraActions {
 public:
    virtual ~CameraActions() = default;
    virtual void fit_all() = 0;
    virtual void frame_selection() = 0;
    /// Moves the camera's target to a point, makes the scene 6 times `radius` (units of the file) high, and selects the
    /// point unless a cell is selected. `back`: the direction from there to the eye, of length 1; zero: the present
    /// one.
    virtual void fly_to(const Vec3& point, double radius, const Vec3& back) = 0;
    /// Turns the camera to a direction from which the selected cell is seen at the surface, as soon as that direction
    /// is known.
    virtual void turn_to_selection() = 0;
    /// Moves the clip plane through the middle of the selection, with its present normal or, if `faces_eye`, facing the
    /// eye.
    virtual void clip_through_selection(bool faces_eye) = 0;
    /// Hides the patch under the mouse; says so if there is none.
    virtual void hide_patch() = 0;
    /// Looks through this camera from now on, in this frame, too.
    virtual void take_camera(const Camera& camera) = 0;
    /// Goes to the view before, and on to the one after (ViewHistory).
    virtual void show_earlier() = 0;
    virtual void show_later() = 0;
};

class PlayActions {
 public:
    virtual ~PlayActions() = default;
    virtual void move_step(int count) = 0;  ///< goes `count` steps of the node on, or back if negative
    virtual void move_node(int count) = 0;  ///< goes to the next node of the tree, 1, or the one before, -1
    virtual void toggle_play() = 0;
    virtual void toggle_motion() = 0;  ///< starts or stops the motion of the deformation
};

class RunActions {
 public:
    virtual ~RunActions() = default;
    virtual void start_run(const RunRequest& options, bool volume) = 0;
    /// Makes the cut of a node again with these options, at the plane if there is one, else where it was.
    virtual void redo_cut(NodeId node, const RunRequest& options, const std::optional<Plane>& plane) = 0;
    virtual void swap_runs() = 0;
    /// Goes from the state before a run or a repair to the state after it, and back.
    virtual void show_other() = 0;
};

class RepairActions {
 public:
    virtual ~RepairActions() = default;
    /// Repairs the surface (Repairs::repair()).
    virtual void repair(const InputOptions& options) = 0;
    virtual void undo_repair() = 0;
    virtual void redo_repair() = 0;
    virtual void show_before_repair(bool before) = 0;  ///< shows the surface before repairs, or after them
};

/// Work that nobody has saved: the shown run, the other one, or a repaired surface.
enum class UnsavedWork { run, other_run, surface };
/// The fate of unsaved work; only the first of it is saved at once.
enum class UnsavedFate { save, lose, stay };

class WindowActions {
 public:
    virtual ~WindowActions() = default;
    virtual void quit() = 0;
    virtual void take_screenshot() = 0;
    virtual void save_picture(const std::string& path) = 0;  ///< without panels, and its view as JSON beside it
    /// Answers the question of SceneFacts::asks_to_save; `stay` forgets what it stood before.
    virtual void answer(UnsavedFate answer) = 0;
    virtual void copy(const std::string& text) = 0;  ///< copies it to the clipboard
    virtual std::string clipboard() = 0;
    /// Shows an error until the next notice or click.
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

/// A rectangle of the window in ImGui's units, y down.
struct Rectangle {
    float x = 0, y = 0, width = 0, height = 0;

    bool contains(float px, float py) const { return px >= x && py >= y && px < x + width && py < y + height; }
};

/// A number on a face, and the place of its middle in ImGui's units of the window.
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

/// The other of two runs, Session::other_document(), which is drawn beside the shown one.
struct RunBeside {
    Rectangle area;     ///< its part of the scene
    std::string error;  ///< reason why it, or something of it, is not drawn; empty: all is
};

/// The facts about the scene that panels show.
struct SceneFacts {
    Legend legend;
    std::string selection;                        ///< the selection as lines of text; empty: nothing is selected
    std::int64_t triangles = 0, lines = 0;        ///< numbers of triangles and lines drawn
    std::string notice;                           ///< e.g. "saved as kerf-001.png"; shown for some seconds
    bool notice_is_error = false;                 ///< the notice is an error, which stays until the next click
    std::vector<FaceNumber> numbers;              ///< numbers of patches, to be drawn on them
    std::vector<ValueLabel> labels;               ///< values of isolines, the least and the largest value
    std::optional<ValueLabel> probe;              ///< the value under the mouse
    std::optional<RunBeside> beside;              ///< another run beside the shown one
    std::string patch;                            ///< the patch that was clicked with the right button last
    int patch_clicks = 0;                         ///< number of such clicks
    int up = 2;                                   ///< axis that points up
    bool has_earlier = false, has_later = false;  ///< there are views to go back to, or on to
    bool playing = false;
    bool moving = false;                ///< the deformation is in motion
    bool pending = false;               ///< data to be shown is still being read
    bool asks_to_save = false;          ///< something waits for the answer what is to become of unsaved work
    std::vector<UnsavedWork> at_stake;  ///< that work, at least one while asks_to_save
};

/// Sizes that the user has given to panels, in heights of the font; 0: as the window suggests.
struct PanelSizes {
    float left = 0, right = 0, timeline = 0;

    bool operator==(const PanelSizes&) const = default;
};

/// The size of the picture in the window in pixels, and the scale of its screen (FrameSize::scale).
struct WindowSize {
    int width = 1280, height = 800;
    double scale = 1;
};

/// A file or folder that was open once.
struct RecentFile {
    std::string path;
    std::string day;    ///< the day when it was last opened, "26 Nov 2026"; empty: not known
    std::string sizes;  ///< its content as sizes_of() told it; empty: not known
};

/// A surface to try that comes with the program.
struct Example {
    std::string name;  ///< "Bearing cap 14k"
    std::string path;
    std::int64_t facets = 0;
    ImTextureID picture = nullptr;  ///< null: there is none
};

/// Returns "6.21 k facets, 14.6 k tetrahedra", as far as they are known.
std::string sizes_of(const Document& document);
/// Returns what a finished run has made: "14.6 k tetrahedra, least dihedral angle 9.7 deg, verified, 2.1 s", as far as
/// that is known.
std::string outcome_of(const Document& document, bool with_seconds);

/// Settings that outlive the document, kept in the user's config folder.
struct Settings {
    Theme theme = Theme::light;
    std::vector<RecentFile> recent;  ///< the files opened before, the last one first
    std::string browser_folder;      ///< the folder of the file browser
    PanelSizes panels;
    WindowSize window;  ///< size of the window when it was last drawn
};

struct UiContext {
    ViewState& state;
    Session& session;
    Settings& settings;
    const SceneFacts& facts;
    const std::vector<Step>& steps;  ///< steps of the node shown, at least its surface
    const Actions& actions;
    Widgets& widgets;
    const Camera& camera;                  ///< the camera in use, also where the state has none
    const std::vector<Example>& examples;  ///< surfaces for the start page
};

/// Returns the rectangle behind a label in the scene.
Rectangle rectangle_of(const ValueLabel& label);

/// Returns the rectangle of the scene: the part of the window that the panels leave, or without panels the whole
/// window.
Rectangle scene_rectangle(const ViewState& state, const Document& document, const PanelSizes& sizes, float width,
                          float height, bool panels);

/// Returns the part of the scene that legend and caption leave, so that the body stands beside them. It is the same for
/// all steps and colourings.
Rectangle body_area(const ViewState& state, const Rectangle& scene);

/// The user interface, with its state between frames: open dialogs, edited options.
class Ui {
 public:
    Ui();
    ~Ui();

    /// Sets style, colours and fonts for a theme and a HiDPI factor.
    void apply(Theme theme, float scale);
    /// Draws all panels, dialogs and overlays. `scene`: the rectangle of the shown document. Call it between
    /// ImGui::NewFrame() and ImGui::Render().
    void draw(UiContext& context, const Rectangle& scene, float width, float height);
    /// Draws legend, gizmo, caption and labels into the rectangle of the shown document, or the start page where
    /// nothing is open. They are part of every picture, also without panels.
    void draw_overlays(UiContext& context, const Rectangle& scene);
    /// Runs the command of a key, "Ctrl+Shift+Z", unless a dialog has the keyboard, or a text field that the
    /// key belongs to. `repeat`: the key
    /// is held.
    void press(UiContext& context, const std::string& key, bool repeat);
    /// Returns whether a guided tour has the view.
    bool leads_tour() const;

 private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Loads DejaVu Sans at this size and a larger one for titles, or fontconfig's substitute, or else ImGui's own font.
void load_fonts(ImFontAtlas& atlas, float pixels);

}  // namespace kerf::view

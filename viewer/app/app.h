// The viewer without its window: state, session, scene and panels, a frame at a time. The window, the screenshots and
// the tests run the same one.
#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "viewer/app/imgui_owner.h"
#include "viewer/model/session.h"
#include "viewer/panels/panels.h"
#include "viewer/render/frame_size.h"
#include "viewer/render/key_event.h"
#include "viewer/render/renderer.h"
#include "viewer/scene/scene_builder.h"
#include "viewer/scene/selection.h"

namespace kerf::view {

struct Gl;

struct AppOptions {
    std::string shader_folder;
    std::string kerf_program;
    std::string config_folder;  ///< of the settings; empty: none are read or kept
    std::string screenshot_folder = ".";
    /// Surfaces that are opened are cut, and meshed if `volume`, with these options; `auto_run` false: only shown.
    bool auto_run = true, volume = true;
    RunOptions run;
};

/// What somebody has asked for of the view; the rest suits what is opened.
struct ChosenView {
    bool color = false, stage = false, explode = false;
    bool faces_clip = false;  ///< without a camera the clip plane is looked at, and what it leaves fits
    std::optional<Eigen::Quaterniond> turn = {};  ///< of a camera without a place: it is where all fits
};

class App : private FileActions,
            private CameraActions,
            private PlayActions,
            private RunActions,
            private RepairActions,
            private WindowActions {
 public:
    /// The context of `gl` is current, and an ImGuiOwner lives.
    App(const Gl& gl, AppOptions options);
    ~App() override;

    void open_files(const std::vector<std::string>& paths) override;
    ViewState& state() { return state_; }
    void show(const ViewState& state, const ChosenView& chosen);
    Session& session() { return session_; }
    const Settings& settings() const { return settings_; }

    /// Takes ImGui's input and lays out the next picture: with the panels, or only the scene with its legend. Requires
    /// io.DeltaTime to be set, and io.MousePos to be anew before every frame, in the window's units.
    void frame(const FrameSize& size, bool panels);
    /// Paints what the last frame has laid out: most of a frame's time where the CPU draws, so only if it is looked at.
    void paint();
    Image picture();  ///< painted
    void present();   ///< paints it for the window

    /// Of the window, or a test; the next frame with panels takes them in the order in which they came.
    void press(const KeyEvent& event) { key_events_.push_back(event); }

    /// The next frame would look like the last: nothing arrives, plays, or is being moved.
    bool settled() const;
    /// Waits until something arrives from files or runs, at most `seconds`; false if nothing did.
    bool wait(double seconds);
    /// Looks at what has arrived from files and runs. False: the picture on the screen is still right.
    bool wants_frame();
    /// Something has happened outside: the next frames are wanted.
    void wake() { frames_wanted_ = 3; }

    const Widgets& widgets() const { return widgets_; }
    const BuiltScene& scene() const { return built_; }
    const std::vector<DrawnLayer>& drawn() const { return renderer_.drawn(); }  ///< by the last paint()
    const SceneFacts& facts() const { return facts_; }
    const std::vector<Step>& steps() const { return steps_; }
    Rectangle scene_area() const { return area_; }
    const Camera& camera() const { return camera_; }
    std::int64_t geometry_made() const { return builder_.geometry_made(); }
    std::string window_title() const;
    std::string graphics_driver() const { return renderer_.driver(); }  ///< name and version
    bool wants_to_quit() const { return quit_; }

 private:
    void reload() override;
    void open_again(const RunOptions& options) override;
    void fit_all() override { state_.camera.reset(); }
    void frame_selection() override;
    void fly_to(const Vec3& point, double radius, const Vec3& back) override;
    void turn_to_selection() override { turning_to_ = state_.selection; }
    void clip_through_selection(bool faces_eye) override;
    void look(Direction direction) override;
    void toggle_play() override;
    void toggle_motion() override;
    void quit() override;
    void take_screenshot() override { capture_ = true; }
    void copy(const std::string& text) override;
    std::string clipboard() override;
    void start_run(const RunOptions& options, bool volume) override;
    void redo_cut(NodeId node, const RunOptions& options, const std::optional<Plane>& plane) override;
    void swap_runs() override;
    void repair(const InputOptions& options) override;
    void undo_repair() override;
    void redo_repair() override;
    void show_before_repair(bool before) override;
    void complain(const std::string& text) override;

    // Of a picture with numbers: the matrix, the viewport, and which scene it is of.
    struct NumberedView {
        Eigen::Matrix4f matrix;
        std::array<int, 4> viewport;
        std::int64_t scene;

        bool operator==(const NumberedView&) const = default;
    };

    void lay_out(bool panels);
    void follow_session();
    void await_document();
    void begin_auto_run();
    void follow_repairs();
    void show_other();
    void choose_view();
    void update_camera();
    void project_scene();
    void place_labels();
    void place_numbers();
    void place_line_values();
    void place_extremes();
    NumberedView numbered_view() const;
    void probe(bool panels);
    void fit_body(Camera& camera, const Eigen::AlignedBox3d& box) const;
    void take_keys();
    void take_key(const KeyEvent& event);
    void take_character_key(const KeyEvent& event);
    bool take_digit(int key);
    void take_mouse();
    void take_click(float x, float y, bool center);
    void resolve_click();
    void resolve_turn();
    void zoom(float x, float y, float notches);
    Vec3 seen_point(const PickHit& hit) const;
    void move_step(int direction);
    void move_node(int direction);
    void play();
    void move();
    void build_scene();
    ViewState shown_state() const;  ///< as the tree that is known allows
    void save_picture(float scale);
    ViewOrigin origin_of_picture(float scale) const;
    void notify(const std::string& text);

    AppOptions options_;
    Settings settings_;
    ViewState state_;
    Session session_;
    SceneBuilder builder_;
    Renderer renderer_;
    Ui ui_;
    Widgets widgets_;

    BuiltScene built_;
    std::string built_for_;  // the state as JSON, without camera and panels
    bool session_changed_ = true;
    std::optional<Hit> unresolved_;        // a click whose cells are being read
    std::optional<Selection> turning_to_;  // a cell that is being read
    SceneFacts facts_;
    std::vector<Step> steps_;
    Camera camera_;
    Projection projection_;
    std::optional<NumberedView> numbered_;  // what the labels of facts_ are of
    // What facts_.probe is of: a view, and a place of the mouse in it.
    struct Probed {
        NumberedView view;
        float x, y;

        bool operator==(const Probed&) const = default;
    };
    std::optional<Probed> probed_;
    double motion_ = 0;  // phase of the motion that plays, not yet that of a picture
    std::int64_t scenes_built_ = 0;
    Rectangle area_;  // of the scene
    Rectangle body_;  // what the legend leaves of it

    FrameSize size_;
    std::vector<KeyEvent> key_events_;  // that no frame has taken yet

    std::string styled_for_;                      // theme and scale
    std::string opened_;                          // what auto_run has been decided for
    std::shared_ptr<const CheckedSoup> checked_;  // of the document as it was last looked at
    ChosenView chosen_;
    struct KeptScale {
        ColorBy color = ColorBy::part;
        std::optional<ValueRange> range = {};  // that somebody has given to values of a solution
    };
    KeptScale kept_scale_;           // of what was open before
    bool is_view_complete_ = false;  // what nobody has chosen is
    bool quit_ = false, capture_ = false, dragging_ = false, pressed_in_scene_ = false;
    double notice_until_ = 0, played_until_ = 0;
    std::chrono::steady_clock::time_point last_frame_;
    int frames_wanted_ = 3;
};

}  // namespace kerf::view

// The viewer without its window: state, session, scene and panels, a frame at a time. The window, the screenshots and
// the tests drive the same App. Its parts share a View; Opening, Navigation, Playing and Desk are also the Actions that
// panels ask for.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viewer/app/beside.h"
#include "viewer/app/desk.h"
#include "viewer/app/gallery.h"
#include "viewer/app/labels.h"
#include "viewer/app/navigation.h"
#include "viewer/app/opening.h"
#include "viewer/app/painting.h"
#include "viewer/app/playing.h"
#include "viewer/app/scene_input.h"

namespace kerf::view {

/// Owns Dear ImGui's global context. Keys are numbered as in app/keys.h; ImGui saves no file.
class ImGuiOwner {
 public:
    ImGuiOwner();
    ~ImGuiOwner();
    ImGuiOwner(const ImGuiOwner&) = delete;
    ImGuiOwner& operator=(const ImGuiOwner&) = delete;
};

class App {
 public:
    /// Requires that the context of `gl` is current and that an ImGuiOwner lives.
    App(const Gl& gl, AppOptions options);
    ~App();

    void open_files(const std::vector<std::string>& paths) { opening_.open_files(paths); }
    ViewState& state() { return view_.state; }
    void show(const ViewState& state, const ChosenView& chosen) { opening_.show(state, chosen); }
    Session& session() { return view_.session; }
    const Settings& settings() const { return view_.settings; }

    /// Takes ImGui's input and lays out the next picture: with the panels, or only the scene with its legend. Requires
    /// io.DeltaTime to be set, and the mouse to be put anew before every frame, in the window's units.
    void frame(const FrameSize& size, bool panels);
    /// Paints the layout of the last frame. That is most of a frame's time where the CPU draws, so call it only if the
    /// picture is looked at.
    void paint() { painting_.paint(); }
    Image picture() { return painting_.picture(); }  ///< paints and returns the picture
    Renderer& renderer() { return view_.renderer; }

    /// Takes a key event of the window, or of a test. The next frame with panels acts on events in the order in which
    /// they came.
    void press(const KeyEvent& event) { input_.press(event); }

    /// Returns whether the next frame would look like the last: nothing arrives, plays, or is being moved.
    bool settled() const;
    /// Waits until data arrive from files or runs, at most `seconds`, and returns whether any did.
    bool wait(double seconds);
    /// Takes data that have arrived from files and runs, and returns whether a new frame is wanted; false: the picture
    /// on the screen is still right.
    bool wants_frame();
    /// Asks for the next frames, because something has happened outside.
    void wake() { view_.wake(); }

    const Widgets& widgets() const { return widgets_; }
    const BuiltScene& scene() const { return view_.built; }
    const SceneFacts& facts() const { return view_.facts; }
    const std::vector<Step>& steps() const { return view_.steps; }
    Rectangle scene_area() const { return view_.area; }
    const Camera& camera() const { return view_.camera; }
    std::int64_t geometry_made() const { return builder_.geometry_made(); }
    Desk& desk() { return desk_; }

 private:
    void lay_out(bool panels);
    void follow_session();
    void build_scene();

    View view_;
    Unsaved unsaved_{view_};
    Opening opening_{view_, unsaved_};
    Navigation navigation_{view_};
    Playing playing_{view_};
    Beside beside_{view_};
    Labels labels_{view_};
    Painting painting_{view_};
    Desk desk_{view_, unsaved_};
    Ui ui_;
    SceneInput input_{view_, ui_, navigation_};
    Gallery gallery_{view_};
    Actions actions_{opening_, navigation_, playing_, opening_, opening_, desk_};
    Widgets widgets_;
    SceneBuilder builder_;
    ViewState built_for_;  // the state that the scene was built for, as far as the scene depends on it
    std::optional<std::pair<Theme, float>> styled_for_ = {};  // theme and scale
    std::chrono::steady_clock::time_point last_frame_;
};

}  // namespace kerf::view

// The open document, the way in which it is looked at, and its picture: all that the parts of the app share.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "viewer/model/session.h"
#include "viewer/model/upright.h"
#include "viewer/model/view_history.h"
#include "viewer/panels/panels.h"
#include "viewer/render/frame_size.h"
#include "viewer/render/renderer.h"
#include "viewer/scene/scene_builder.h"
#include "viewer/scene/selection.h"

namespace kerf::view {

struct Gl;

struct AppOptions {
    std::string shader_folder;
    std::string kerf_program;
    std::string config_folder;   ///< folder of the settings; empty: none are read or kept
    std::string example_folder;  ///< folder of surfaces for the start page; empty: none
    std::string screenshot_folder = ".";
    /// `auto_run`: a surface that is opened is cut, and meshed if `volume`, with the options `run`; else it is only
    /// shown.
    bool auto_run = true, volume = true;
    bool asks_to_save = false;  ///< before work is lost that nobody has saved
    RunRequest run;
    /// A scene that takes longer to paint has a stand-in while the camera is moved.
    double frame_seconds = 1. / 30;
};

/// The parts of the view that somebody has asked for; all others suit the document.
struct ChosenView {
    bool color = false, stage = false, explode = false;
    bool faces_clip = false;     ///< without a camera the clip plane is looked at, and the part that it leaves fits
    bool clip_fraction = false;  ///< the clip plane was asked for by a fraction, so that it may keep off faces
    std::optional<Direction> from = {};  ///< side that a camera looks from, whose place is where all fits
    std::optional<int> up = {};          ///< axis that points up
    bool beside = false;                 ///< whether two runs stand side by side
};

/// Returns the state without the members that a scene does not depend on.
ViewState of_scene(ViewState state);

/// Another run that is drawn beside the shown one, under the same camera.
struct SceneBeside {
    BuiltScene built;
    std::int64_t scenes_built = 0;  ///< grows with each scene that is built of any such run
    Projection projection;
    Rectangle area;
};

struct View {
    /// Requires that the context of `gl` is current.
    View(const Gl& gl, AppOptions given);

    AppOptions options;
    Settings settings;
    Session session;
    bool session_changed = true;  ///< the session has new data since the scene was built
    ViewState state;
    ViewHistory history;
    ChosenView chosen;
    std::vector<Step> steps;        ///< steps of the node shown
    std::optional<Hit> unresolved;  ///< a click whose cells are being read

    Renderer renderer;
    BuiltScene built;
    std::int64_t scenes_built = 0;
    std::optional<SceneBeside> beside;
    SceneFacts facts;
    double notice_until = 0;  ///< time until which the notice of the facts is shown
    Camera camera;            ///< the camera in use, also where the state has none
    Projection projection;
    FrameSize size;
    Rectangle area;         ///< rectangle of the shown document's scene
    Rectangle body;         ///< the part of it that the legend leaves
    int frames_wanted = 0;  ///< frames to be drawn even if nothing else changes

    /// Asks for the next frames, because something has happened outside.
    void wake() { frames_wanted = 3; }
    void notify(const std::string& text);
    ViewState shown() const;  ///< returns the state with a node that the tree, as far as it is known, has
    /// Returns the axis that points up: the one that was asked for, or guessed.
    int up() const { return chosen.up.value_or(guessed_up(session.document())); }
    double diagonal() const { return session.document().box.diagonal().norm(); }
    /// Returns the height of the scene in pixels, at least 1, so that it can be divided by.
    float height() const { return std::max(area.height, 1.f); }
    /// Returns the projection of a scene, seen by the camera, into a rectangle.
    Projection projection_into(const Rectangle& rectangle, const BuiltScene& scene) const;
    std::optional<PickHit> pick(float x, float y);  ///< returns the primitive at a pixel; none: the background
};

}  // namespace kerf::view

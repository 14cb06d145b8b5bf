// What is open, how it is looked at, and the picture of it: what the parts of the app share.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "viewer/model/session.h"
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
    std::string config_folder;   ///< of the settings; empty: none are read or kept
    std::string example_folder;  ///< surfaces for the start page; empty: none
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

struct View {
    /// The context of `gl` is current.
    View(const Gl& gl, AppOptions given);

    AppOptions options;
    Settings settings;
    Session session;
    bool session_changed = true;  ///< since the scene was built
    ViewState state;
    ViewHistory history;
    ChosenView chosen;
    std::vector<Step> steps;        ///< of the node
    std::optional<Hit> unresolved;  ///< a click whose cells are being read

    Renderer renderer;
    BuiltScene built;
    std::int64_t scenes_built = 0;
    SceneFacts facts;
    double notice_until = 0;  ///< that of the facts
    Camera camera;            ///< that is in use, also where the state has none
    Projection projection;
    FrameSize size;
    Rectangle area;  ///< of the scene
    Rectangle body;  ///< what the legend leaves of it
    int frames_wanted = 0;

    /// Something has happened outside: the next frames are wanted.
    void wake() { frames_wanted = 3; }
    void notify(const std::string& text);
    ViewState shown() const;  ///< the state as the tree that is known allows
    double diagonal() const { return session.document().box.diagonal().norm(); }
    /// Of the scene, as large as something to divide by has to be.
    float height() const { return std::max(area.height, 1.f); }
    std::optional<PickHit> pick(float x, float y);  ///< at a pixel
};

}  // namespace kerf::view

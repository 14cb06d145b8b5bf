// The options of `kerf view` and `kerf screenshot` for the content and the look of the scene.
#pragma once

#include <string>
#include <vector>

#include "viewer/app/command_line.h"

namespace CLI {
class App;
}

namespace kerf::view {

/// The options for the node, the step and the camera, and the file with a whole view.
struct SideOptions {
    std::string state_file, camera_file, view, up, stage;
    std::int32_t node = 0, isolated = 0;
    std::vector<std::int32_t> hidden;
    std::vector<std::string> hidden_patches;
};

/// The options for the layers that are drawn.
struct LookOptions {
    bool features = false, axes = false, smooth = false, no_edges = false, no_context = false, no_legend = false,
         no_numbers = false, no_scale_bar = false;
    std::string theme;
};

/// The options for colours, and for what is drawn of a solution.
struct ColorOptions {
    std::string by, deform, motion;
    std::vector<double> range, filter;
    double percentile = -1;
    bool isolines = false, extremes = false, vectors = false;
};

/// The options for the clip plane, and for parts and cells that are pulled apart.
struct ClipOptions {
    std::string style;
    double explode = -1, shrink = -1;
};

/// The options for regions.
struct RegionOptions {
    std::vector<std::string> hidden, glass;
    std::string isolated;
    bool walls = false, explode = false;

    bool any() const { return walls || explode || !isolated.empty() || !hidden.empty() || !glass.empty(); }
};

/// The options for the run of a surface.
struct SurfaceRunOptions {
    std::string surface, repair, scale, config;
};

/// The values of these options as they are given, by the groups of their help.
struct SceneOptions {
    std::vector<std::string> inputs;
    std::string resolution;
    SideOptions side;
    LookOptions look;
    ColorOptions colors;
    ClipOptions clip;
    RegionOptions regions;
    SurfaceRunOptions run;
};

/// Adds the options to a parser. Values go into `options` and `command`, which have to live as long as the parser.
void add_scene_options(CLI::App& app, ViewCommand& command, SceneOptions& options);

/// Applies the options to the command after parsing, and reads the files that they name. Throws Error(usage) for
/// invalid values.
void apply(const SceneOptions& options, ViewCommand& command);

}  // namespace kerf::view

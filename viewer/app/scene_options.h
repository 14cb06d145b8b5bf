// The options of `kerf view` and `kerf screenshot` for the content and the look of the scene.
#pragma once

#include <string>
#include <vector>

#include "viewer/app/command_line.h"

namespace CLI {
class App;
}

namespace kerf::view {

/// The values of these options as they are given, in the order in which they are applied.
struct SceneOptions {
    std::string state_file, camera_file, view, up, stage, color, clip_style, resolution, theme, surface, repair,
        input_scale, config, deform, motion;
    std::vector<std::string> inputs;
    std::vector<NodeId> hidden;
    NodeId node = 0, isolated = 0;
    double explode = -1, shrink = -1, percentile = -1;
    bool features = false, smooth = false, no_edges = false, no_context = false, no_legend = false;
    bool no_numbers = false;
    bool isolines = false, extremes = false, vectors = false;
    bool walls = false, explode_regions = false;
    std::string isolated_region;
    std::vector<std::string> hidden_regions, glass_regions;
    std::vector<double> filter, range;
};

/// Adds the options to a parser. Values go into `options` and `command`, which have to live as long as the parser.
void add_scene_options(CLI::App& app, ViewCommand& command, SceneOptions& options);

/// Applies the options to the command after parsing, and reads the files that they name. Throws Error(usage) for
/// invalid values.
void apply(const SceneOptions& options, ViewCommand& command);

}  // namespace kerf::view

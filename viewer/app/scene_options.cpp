// The options of the scene: groups of add_...() functions for the parser, and apply(), which turns the texts into a
// ViewState. Order in apply() is precedence: a file of --state is the base, --camera and --view replace its camera, and
// every single option wins over the file, so that an option may only write if it was given. Options that only cells can
// show (a measure, a filter, a deformation) choose the stage of tetrahedra unless --stage is given, lest they be asked
// for in vain. ChosenView records which members somebody has chosen; the app fills the others by the document. A new
// option of the scene is a member of a group of SceneOptions, a line in an add_...() and one in apply().
#include "viewer/app/scene_options.h"

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/core/error.h"
#include "files/io/file_bytes.h"
#include "help/command_help.h"
#include "help/number_option.h"
#include "help/usage_error.h"
#include "viewer/model/camera.h"

namespace kerf::view {

namespace {

constexpr NumberRange node_range = {"the number of a node, 1 or more", 1};

void parse_resolution(const std::string& text, ViewCommand& command) {
    const std::size_t x = text.find('x');
    const auto width = number_in<int>(text.substr(0, x));
    const auto height = number_in<int>(x == text.npos ? "" : text.substr(x + 1));
    const auto is_good = [](std::optional<int> pixels) { return pixels && *pixels >= 16 && *pixels <= 16384; };
    if (!is_good(width) || !is_good(height))
        throw Error(ErrorCode::usage,
                    fmt::format("--resolution is '{}', but it must be WIDTHxHEIGHT in pixels, 16 to 16384.", text));
    command.picture.width = *width;
    command.picture.height = *height;
}

// The names of --view, in the order of Direction.
constexpr std::array<const char*, 7> view_names = {"front", "back", "right", "left", "top", "bottom", "iso"};

std::string names_of_views() { return fmt::format("{}", fmt::join(view_names, ",")); }

std::string names_of_colors() {
    std::string names;
    for (std::size_t i = 0; i < color_by_count; ++i)
        names += fmt::format("{}{}", i == 0 ? "" : ",", name(static_cast<ColorBy>(i)));
    return names;
}

void add_names(CLI::App& app, const char* option, std::vector<std::string>& names, const char* help) {
    app.add_option(option, names, help)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->expected(1)
        ->type_name("NAME");
}

void add_side_options(CLI::App& app, SideOptions& options) {
    app.option_defaults()->group("Scene");
    app.add_option("--state", options.state_file, "Read the whole view from a JSON file; other options win.")
        ->type_name("FILE");
    add_number(app, "--node", options.node, node_range,
               "Node of the tree: the root is 1, the children of i are 2i and 2i+1.")
        ->type_name("N");
    app.add_option(
           "--stage", options.stage,
           fmt::format("{}, or try:0 for the first refused try. Default: tetrahedra, of a folder of kerf decompose "
                       "parts, pulled apart, else input.",
                       names_of_stages()))
        ->type_name("STAGE")
        ->check(suggest(names_of_stages()));
    add_numbers(app, "--hide", options.hidden, 1, node_range, "Nodes that are not shown, with commas between.")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->delimiter(',')
        ->type_name("LIST");
    add_number(app, "--isolate", options.isolated, node_range, "Only what lies below this node.")->type_name("N");
    add_names(app, "--hide-patch", options.hidden_patches,
              "Patch that is not drawn, to look inside; * in NAME stands for any characters. Repeatable.");
    app.add_option("--camera", options.camera_file, "JSON file with the camera, as the viewer copies it.")
        ->type_name("FILE");
    app.add_option("--view", options.view, "Side from which all is looked at; iso, the default: from a corner.")
        ->type_name("")
        ->check(one_of(names_of_views()))
        ->excludes("--camera");
    app.add_option("--up", options.up, "Axis that points up in the picture. Default z.")
        ->type_name("")
        ->check(one_of("x,y,z"))
        ->excludes("--camera");
}

void add_look_options(CLI::App& app, LookOptions& options) {
    app.option_defaults()->group("Scene");
    app.add_flag("--features", options.features, "With sharp edges and the borders of patches as lines.");
    app.add_flag("--axes", options.axes,
                 "With principal axes and centre of gravity, which are only drawn with the plane of a cut else.");
    app.add_flag("--smooth", options.smooth, "Smooth shading instead of flat facets.");
    app.add_flag("--no-edges", options.no_edges, "Without the edges of triangles.");
    app.add_flag("--no-context", options.no_context, "Without the rest of the body.");
    app.add_flag("--no-legend", options.no_legend, "Without the legend.");
    app.add_flag("--no-scale-bar", options.no_scale_bar, "Without the bar of a round length.");
    app.add_flag("--no-numbers", options.no_numbers,
                 "Without the numbers of patches on their faces, and of values on isolines.");
    app.add_option("--theme", options.theme, "Colours of the background and of all around.")
        ->type_name("")
        ->check(one_of("light,dark"));
}

void add_color_options(CLI::App& app, ViewCommand& command, ColorOptions& options) {
    app.option_defaults()->group("Colours");
    app.add_option("--color", options.by,
                   "part, rank, level, region, patch, deviation, size, kind, origin (core, shell or other mesher), "
                   "min-dihedral, "
                   "radius-edge, aspect, shape, volume or edge-length; of a solution error, displacement, von-mises, "
                   "stress-xx, stress-yy, stress-zz, stress-xy, stress-yz or stress-xz.")
        ->type_name("NAME")
        ->check(suggest(names_of_colors()));
    add_numbers(app, "--range", options.range, 2, {},
                "Values of the ends of the colours. Default: those shown; of stresses see --percentile.")
        ->type_name("LOW HIGH");
    add_number(app, "--percentile", options.percentile, {"60 to 100", least_percentile, 100},
               "Colours of stresses span so many per cent of the values shown. Default 99; 100: all.")
        ->type_name("P");
    app.add_flag("--isolines", options.isolines, "With lines where displacements or stresses are alike, and numbers.");
    app.add_flag("--mark-extremes", options.extremes, "With marks at the least and the largest value shown.");
    app.add_flag("--vectors", options.vectors, "With arrows along the displacements of a solution.");
    app.add_option("--deform", options.deform, "Draw the displacements of a solution so many times as long, or auto.")
        ->type_name("FACTOR|auto");
    app.add_option("--motion", options.motion,
                   "How the deformation moves: still (default), swing (to both sides) or rise (from nothing to all).")
        ->type_name("")
        ->check(one_of("still,swing,rise"));
    app.add_option("--load-case", command.load_case,
                   "Name of the load case of a solution, or of a mode: 'Mode 1'. Default: the first one.")
        ->type_name("NAME");
    add_numbers(app, "--filter", options.filter, 2, {}, "Only cells whose value of --color lies in this range.")
        ->type_name("LOW HIGH");
}

void add_clip_options(CLI::App& app, ViewCommand& command, ClipOptions& options) {
    app.option_defaults()->group("Clipping and moving");
    app.add_option(
           "--clip", command.clip,
           "Clip plane, at a share of the body's extent from 0 to 1: x=0.3, -y=0.5 (other side), 1,1,0=0.4 (normal); "
           "node=5 (at its cut). Without a camera it is looked at.")
        ->type_name("PLANE");
    app.add_option("--clip-style", options.style, "cells (whole ones, default), smooth, or layer (at the plane).")
        ->type_name("")
        ->check(suggest("cells,smooth,layer"));
    add_number(app, "--explode", options.explode, {"0 to 1e6; 1 is much", 0, 1e6},
               "Pull the parts apart along the tree; 0 to 1.")
        ->type_name("X");
    add_number(app, "--shrink", options.shrink, {"0 to 1", 0, 1}, "Shrink cells about their centres; 0 to 1.")
        ->type_name("X");
}

void add_region_options(CLI::App& app, RegionOptions& options) {
    app.option_defaults()->group("Regions");
    add_names(app, "--hide-region", options.hidden, "Region that is not shown. Repeatable.");
    app.add_option("--isolate-region", options.isolated, "Only this region.")->type_name("NAME");
    add_names(app, "--glass-region", options.glass,
              "Region that is translucent, so that what it holds is seen. Repeatable.");
    app.add_flag("--walls", options.walls, "Only facets between two regions.");
    app.add_flag("--explode-regions", options.explode, "--explode moves regions as wholes.");
}

void add_run_options(CLI::App& app, ViewCommand& command, SurfaceRunOptions& options) {
    app.option_defaults()->group("Run");
    add_number(app, "-n,--parts", command.run.parts, {"a whole number, 1 or more, at most 2147483647", 1},
               "Number of parts, if INPUT is a surface.")
        ->type_name("K");
    app.add_option("--surface", options.surface, "Of that run, as of kerf mesh.")
        ->type_name("")
        ->check(suggest("keep,split,remesh,auto"));
    app.add_option("--repair", options.repair,
                   "Repair a surface first, as kerf repair does: exact, near, full, or steps by name.")
        ->type_name("LEVEL");
    app.add_option("--scale", options.scale, "Multiply all coordinates of a surface by this. Default 1.")
        ->type_name("F");
    app.add_option("--config", options.config, "Other options of that run: a file of kerf mesh --print-config.")
        ->type_name("FILE");
}

bool is_seen_on_surfaces(const std::string& color) {
    return color == "patch" || (!color.empty() && is_of_surface(color_by_from_name(color)));
}

// Takes the origin of a state. The command line wins over it; options of a run are of use for its own input only.
void take_origin(ViewCommand& command) {
    const ViewOrigin& origin = command.origin;
    if (command.input.empty()) {
        command.input = origin.input;
        const std::int32_t parts = command.run.parts;
        const bool is_given = parts != RunRequest().parts;
        set_options(command.run, origin.run, "The state");
        if (is_given) command.run.parts = parts;
    }
    if (origin.width == 0) return;
    command.picture.width = origin.width;
    command.picture.height = origin.height;
    command.picture.scale = static_cast<float>(origin.scale);
}

// Takes the side that is looked from; the place of the camera follows from the scene.
void apply_view(const SideOptions& options, ViewCommand& command) {
    if (options.view.empty() && options.up.empty()) return;
    const auto* name = std::find(view_names.begin(), view_names.end(), options.view.empty() ? "iso" : options.view);
    command.chosen.from = static_cast<Direction>(name - view_names.begin());
    if (!options.up.empty()) command.chosen.up = options.up[0] - 'x';
    command.state.camera.reset();
}

void apply_look(const LookOptions& options, Look& look) {
    if (options.features) look.features = true;
    if (options.axes) look.axes = true;
    if (options.smooth) look.shading = Shading::smooth;
    if (options.no_edges) look.edges = false;
    if (options.no_context) look.context = false;
    if (options.no_legend) look.legend = false;
    if (options.no_scale_bar) look.scale_bar = false;
    if (options.no_numbers) look.numbers = false;
}

void apply_regions(const RegionOptions& options, ViewState& state) {
    for (const std::string& region : options.hidden) set_member(state.visibility.hidden_regions, region, true);
    for (const std::string& region : options.glass) set_member(state.visibility.glass_regions, region, true);
    if (!options.isolated.empty()) state.visibility.isolated_region = options.isolated;
    if (options.walls) state.visibility.walls = true;
    if (options.explode) state.explosion.regions = true;
}

void apply_colors(const ColorOptions& options, ViewCommand& command) {
    ViewState& state = command.state;
    if (!options.filter.empty()) {
        state.coloring.filter = ValueRange{options.filter[0], options.filter[1]};
        if (!(state.coloring.filter->low <= state.coloring.filter->high) || !is_measure(state.coloring.by))
            throw Error(ErrorCode::usage,
                        "--filter needs LOW <= HIGH and a --color with values, such as min-dihedral.");
    }
    if (!options.range.empty()) {
        state.coloring.range = ValueRange{options.range[0], options.range[1]};
        if (!(options.range[0] < options.range[1])) throw Error(ErrorCode::usage, "--range needs LOW < HIGH.");
    }
    if (options.percentile >= 0) state.coloring.percentile = options.percentile;
    if (options.isolines) state.coloring.isolines = true;
    if (options.extremes) state.coloring.extremes = true;
    if (options.vectors) state.deformation.vectors = true;
    if (!options.motion.empty()) state.deformation.motion = motion_from_name(options.motion);
    command.good_deformation = options.deform == "auto";
    if (options.deform.empty() || command.good_deformation) return;
    const std::optional<double> factor = number_in<double>(options.deform);
    if (!factor)
        throw Error(ErrorCode::usage,
                    fmt::format("--deform is '{}', but it must be a number or auto.", options.deform));
    state.deformation.factor = *factor;
}

}  // namespace

void add_scene_options(CLI::App& app, ViewCommand& command, SceneOptions& options) {
    add_side_options(app, options.side);
    add_look_options(app, options.look);
    add_color_options(app, command, options.colors);
    add_clip_options(app, command, options.clip);
    add_region_options(app, options.regions);
    add_run_options(app, command, options.run);
}

void apply(const SceneOptions& options, ViewCommand& command) {
    ViewState& state = command.state;
    if (!options.side.state_file.empty()) {
        state = state_from_json(read_file(options.side.state_file), options.side.state_file, &command.origin);
        take_origin(command);
    }
    if (!options.side.camera_file.empty())
        state.camera = camera_from_json(read_file(options.side.camera_file), options.side.camera_file);
    apply_view(options.side, command);
    if (options.side.node > 0) state.node = NodeId(options.side.node);
    // Values that only cells have are not to be asked for in vain.
    const bool is_of_cells = !options.colors.by.empty() || options.clip.explode > 0 || options.clip.shrink > 0 ||
                             !options.colors.filter.empty() || !options.colors.deform.empty() || options.colors.vectors;
    if (!options.side.stage.empty())
        state.step = step_from_name(options.side.stage);
    else if (options.side.state_file.empty() &&
             (options.regions.any() || (is_of_cells && !is_seen_on_surfaces(options.colors.by))))
        state.step.stage = Stage::tetrahedra;
    if (!options.colors.by.empty()) state.coloring.by = color_by_from_name(options.colors.by);
    const bool is_whole = !options.side.state_file.empty();
    command.chosen.color = is_whole || !options.colors.by.empty();
    command.chosen.stage = is_whole || !options.side.stage.empty();
    command.chosen.beside = is_whole;
    command.chosen.explode = is_whole || options.clip.explode >= 0;
    command.chosen.faces_clip = !command.clip.empty();
    command.chosen.clip_fraction = !command.clip.empty() && !command.clip.starts_with("node=");
    if (!options.clip.style.empty()) state.clip.style = clip_style_from_name(options.clip.style);
    apply_colors(options.colors, command);
    if (options.clip.explode >= 0) state.explosion.amount = options.clip.explode;
    if (options.clip.shrink >= 0) state.explosion.shrink = options.clip.shrink;
    for (const std::int32_t node : options.side.hidden) state.visibility.set_hidden(NodeId(node), true);
    if (options.side.isolated > 0) state.visibility.isolated = NodeId(options.side.isolated);
    for (const std::string& patch : options.side.hidden_patches)
        set_member(state.visibility.hidden_patches, patch, true);
    apply_regions(options.regions, state);
    apply_look(options.look, state.look);
    if (!options.side.state_file.empty()) command.theme = state.theme;
    if (!options.look.theme.empty()) command.theme = options.look.theme == "dark" ? Theme::dark : Theme::light;
    state.theme = command.theme.value_or(state.theme);
    if (!options.resolution.empty()) {
        parse_resolution(options.resolution, command);
        command.picture.scale = 1;
    }
    if (!command.clip.empty() && !command.clip.starts_with("node="))
        state.clip = clip_from_text(command.clip, state.clip, {});
}

}  // namespace kerf::view

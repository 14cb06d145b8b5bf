#include "viewer/app/command_line.h"

#include <algorithm>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "core/error.h"
#include "core/version.h"
#include "help/command_help.h"
#include "help/number_option.h"
#include "help/program_help.h"
#include "help/usage_error.h"
#include "io/file_bytes.h"
#include "request/config_file.h"

namespace kerf::view {

namespace {

constexpr const char* description =
    "The viewer of Kerf: every cut of a decomposition step by step, every cell of its mesh.";
constexpr const char* footer =
    "INPUT is a closed surface (it is cut and meshed then), a run folder, one that is under way, a folder of kerf "
    "solve, a file of --trace or of --events.";

constexpr NumberRange node_range = {"the number of a node, 1 or more", 1};

template <class Number>
bool read_number(std::string_view text, Number& number) {
    const std::optional<Number> found = number_in<Number>(text);
    number = found.value_or(number);
    return found.has_value();
}

[[noreturn]] void refuse_clip(const std::string& text) {
    throw Error(ErrorCode::usage,
                fmt::format("'{}' is no clip plane. Give an axis, a normal or a node, and where along "
                            "the body's extent from 0 to 1: x=0.3, -y=0.5, 1,1,0=0.5, node=5.",
                            text));
}

// "x", "-z", "1,1,0".
bool parse_normal(std::string_view text, Vec3& normal, bool& flipped) {
    flipped = text.size() == 2 && text[0] == '-';
    if (flipped) text.remove_prefix(1);
    if (text.size() == 1 && text[0] >= 'x' && text[0] <= 'z') {
        normal = Vec3::Unit(text[0] - 'x');
        return true;
    }
    for (int i = 0; i < 3; ++i) {
        const std::size_t comma = i < 2 ? text.find(',') : text.size();
        if (comma == text.npos || !read_number(text.substr(0, comma), normal[i])) return false;
        text.remove_prefix(std::min(text.size(), comma + 1));
    }
    return normal.norm() > 0;
}

void parse_size(const std::string& text, ViewCommand& command) {
    const std::size_t x = text.find('x');
    if (x == text.npos || !read_number(std::string_view(text).substr(0, x), command.width) ||
        !read_number(std::string_view(text).substr(x + 1), command.height) || command.width < 16 ||
        command.height < 16 || command.width > 16384 || command.height > 16384)
        throw Error(ErrorCode::usage,
                    fmt::format("--size is '{}', but it must be WIDTHxHEIGHT in pixels, 16 to 16384.", text));
}

// The texts of options that change the state, in the order in which they are applied.
struct StateTexts {
    std::string state_file, camera_file, stage, color, clip_style, size, theme, surface, input_scale, config, deform;
    std::vector<NodeId> hidden;
    NodeId node = 0, isolated = 0;
    double explode = -1, shrink = -1, percentile = -1;
    bool features = false, smooth = false, no_edges = false, no_context = false, no_legend = false;
    bool no_numbers = false;
    bool isolines = false;
    std::vector<double> filter, range;
};

std::string names_of_colors() {
    std::string names;
    for (std::size_t i = 0; i < color_by_count; ++i)
        names += fmt::format("{}{}", i == 0 ? "" : ",", name(static_cast<ColorBy>(i)));
    return names;
}

void add_scene_options(CLI::App& app, ViewCommand& command, StateTexts& texts) {
    app.option_defaults()->group("Scene");
    app.add_option("--state", texts.state_file, "Read the whole view from a JSON file; other options win.")
        ->type_name("FILE");
    add_number(app, "--node", texts.node, node_range,
               "Node of the tree: the root is 1, the children of i are 2i and 2i+1.")
        ->type_name("N");
    app.add_option("--stage", texts.stage,
                   fmt::format("{}, or try:0 for the first refused try. Default: input, or tetrahedra where they are "
                               "coloured, moved or cut open; of a folder of kerf decompose parts, pulled apart.",
                               names_of_stages()))
        ->type_name("STAGE")
        ->check(suggest(names_of_stages()));
    add_numbers(app, "--hide", texts.hidden, 1, node_range, "Nodes that are not shown, with commas between.")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->delimiter(',')
        ->type_name("LIST");
    add_number(app, "--isolate", texts.isolated, node_range, "Only what lies below this node.")->type_name("N");
    app.add_option("--camera", texts.camera_file, "JSON file with the camera, as the viewer copies it.")
        ->type_name("FILE");
    app.add_flag("--features", texts.features, "With sharp edges and the borders of patches as lines.");
    app.add_flag("--smooth", texts.smooth, "Smooth shading instead of flat facets.");
    app.add_flag("--no-edges", texts.no_edges, "Without the edges of triangles.");
    app.add_flag("--no-context", texts.no_context, "Without the rest of the body.");
    app.add_flag("--no-legend", texts.no_legend, "Without the legend.");
    app.add_flag("--no-numbers", texts.no_numbers, "Without the numbers of patches on the faces coloured by them.");
    app.add_option("--theme", texts.theme, "Colours of the background and of all around.")
        ->type_name("")
        ->check(one_of("light,dark"));
    app.option_defaults()->group("Colours");
    app.add_option(
           "--color", texts.color,
           "part, rank, level, patch, deviation, size, kind, origin (core, shell or other mesher), min-dihedral, "
           "radius-edge, aspect, shape, volume or edge-length; of a solution error, displacement, von-mises, "
           "stress-xx, stress-yy, stress-zz, stress-xy, stress-yz or stress-xz.")
        ->type_name("NAME")
        ->check(suggest(names_of_colors()));
    add_numbers(app, "--range", texts.range, 2, {},
                "Values of the ends of the colours. Default: those shown; of stresses see --percentile.")
        ->type_name("LOW HIGH");
    add_number(app, "--percentile", texts.percentile, {"60 to 100", least_percentile, 100},
               "Colours of stresses span so many per cent of the values shown. Default 99; 100: all.")
        ->type_name("P");
    app.add_flag("--isolines", texts.isolines, "With lines where displacements or stresses are alike.");
    app.add_option("--deform", texts.deform, "Draw the displacements of a solution so many times as long, or auto.")
        ->type_name("FACTOR|auto");
    app.add_option("--case", command.load_case, "Name of the case of a solution. Default: the first one.")
        ->type_name("NAME");
    add_numbers(app, "--filter", texts.filter, 2, {}, "Only cells whose value of --color lies in this range.")
        ->type_name("LOW HIGH");
    app.option_defaults()->group("Clipping and moving");
    app.add_option("--clip", command.clip,
                   "Clip plane: x=0.3, -y=0.5 (other side), 1,1,0=0.4 (normal), node=5 (at its cut). Without a camera "
                   "it is looked at.")
        ->type_name("PLANE");
    app.add_option("--clip-style", texts.clip_style, "cells (whole ones, default), smooth, or layer (at the plane).")
        ->type_name("")
        ->check(suggest("cells,smooth,layer"));
    add_number(app, "--explode", texts.explode, {"0 to 1e6; 1 is much", 0, 1e6},
               "Pull the parts apart along the tree; 0 to 1.")
        ->type_name("X");
    add_number(app, "--shrink", texts.shrink, {"0 to 1", 0, 1}, "Shrink cells about their centres; 0 to 1.")
        ->type_name("X");
    app.option_defaults()->group("Run");
    add_number(app, "-n,--parts", command.run.decompose.parts, {"a whole number, 1 or more, at most 2147483647", 1},
               "Number of parts, if INPUT is a surface.")
        ->type_name("K");
    app.add_option("--surface", texts.surface, "Of that run, as of kerf mesh.")
        ->type_name("")
        ->check(suggest("keep,split,remesh,auto,by-file"));
    app.add_option("--scale", texts.input_scale, "Multiply all coordinates of a surface by this. Default 1.")
        ->type_name("F");
    app.add_option("--config", texts.config, "Other options of that run: a file of kerf mesh --print-config.")
        ->type_name("FILE");
}

bool is_seen_on_surfaces(const std::string& color) {
    return color == "patch" || (!color.empty() && is_of_surface(color_by_from_name(color)));
}

// What the command line says itself wins; options of a run are of use for its own input only.
void take_origin(ViewCommand& command) {
    const ViewOrigin& origin = command.origin;
    if (command.input.empty()) {
        command.input = origin.input;
        const std::int32_t parts = command.run.decompose.parts;
        const bool is_given = parts != RunOptions().decompose.parts;
        set_options(command.run, origin.run, "The state");
        if (is_given) command.run.decompose.parts = parts;
    }
    if (origin.width == 0) return;
    command.width = origin.width;
    command.height = origin.height;
    command.scale = static_cast<float>(origin.scale);
}

void apply(const StateTexts& texts, ViewCommand& command) {
    ViewState& state = command.state;
    if (!texts.state_file.empty()) {
        state = state_from_json(read_file(texts.state_file), texts.state_file, &command.origin);
        take_origin(command);
    }
    if (!texts.camera_file.empty()) state.camera = camera_from_json(read_file(texts.camera_file), texts.camera_file);
    if (texts.node > 0) state.node = texts.node;
    // What only cells have is not to be asked for in vain.
    const bool is_of_cells =
        !texts.color.empty() || texts.explode > 0 || texts.shrink > 0 || !texts.filter.empty() || !texts.deform.empty();
    if (!texts.stage.empty())
        state.step = step_from_name(texts.stage);
    else if (is_of_cells && texts.state_file.empty() && !is_seen_on_surfaces(texts.color))
        state.step.stage = Stage::tetrahedra;
    if (!texts.color.empty()) state.color = color_by_from_name(texts.color);
    const bool is_whole = !texts.state_file.empty();
    command.chosen = {.color = is_whole || !texts.color.empty(),
                      .stage = is_whole || !texts.stage.empty(),
                      .explode = is_whole || texts.explode >= 0,
                      .faces_clip = !command.clip.empty()};
    if (!texts.clip_style.empty()) state.clip.style = clip_style_from_name(texts.clip_style);
    if (!texts.filter.empty()) {
        state.filter = ValueRange{texts.filter[0], texts.filter[1]};
        if (!(state.filter->low <= state.filter->high) || !is_measure(state.color))
            throw Error(ErrorCode::usage,
                        "--filter needs LOW <= HIGH and a --color with values, such as min-dihedral.");
    }
    if (!texts.range.empty()) {
        state.color_range = ValueRange{texts.range[0], texts.range[1]};
        if (!(texts.range[0] < texts.range[1])) throw Error(ErrorCode::usage, "--range needs LOW < HIGH.");
    }
    if (texts.percentile >= 0) state.percentile = texts.percentile;
    if (texts.isolines) state.isolines = true;
    command.good_deformation = texts.deform == "auto";
    if (!texts.deform.empty() && !command.good_deformation && !read_number(texts.deform, state.deform))
        throw Error(ErrorCode::usage, fmt::format("--deform is '{}', but it must be a number or auto.", texts.deform));
    if (texts.explode >= 0) state.explode = texts.explode;
    if (texts.shrink >= 0) state.shrink = texts.shrink;
    for (const NodeId node : texts.hidden) state.set_hidden(node, true);
    if (texts.isolated > 0) state.isolated = texts.isolated;
    if (texts.features) state.features = true;
    if (texts.smooth) state.shading = Shading::smooth;
    if (texts.no_edges) state.edges = false;
    if (texts.no_context) state.context = false;
    if (texts.no_legend) state.legend = false;
    if (texts.no_numbers) state.numbers = false;
    if (!texts.state_file.empty()) command.theme = state.theme;
    if (!texts.theme.empty()) command.theme = texts.theme == "dark" ? Theme::dark : Theme::light;
    state.theme = command.theme.value_or(state.theme);
    if (!texts.size.empty()) {
        parse_size(texts.size, command);
        command.scale = 1;
    }
    if (!command.clip.empty() && !command.clip.starts_with("node="))
        state.clip = clip_from_text(command.clip, state.clip, {});
}

void read_run_config(const std::string& path, RunOptions& run) {
    if (path.empty()) return;
    std::vector<ConfigEntry> given = read_config(path);
    // What the run would write beside its folder is not for a picture.
    static const std::set<std::string> not_taken = {"output", "quiet", "verbose", "report", "trace", "events", "stl"};
    std::erase_if(given, [](const OptionText& o) { return not_taken.contains(o.name); });
    const std::int32_t parts = run.decompose.parts;
    const std::vector<OptionField> fields = option_fields(run);
    for (const ConfigEntry& entry : given) set_option(fields, entry);
    if (parts > 0) run.decompose.parts = parts;
}

}  // namespace

bool depends_on_document(const ViewCommand& command) {
    const bool has_camera = command.state.camera && !command.origin.body.isEmpty();
    return has_camera || command.clip.starts_with("node=") || !command.load_case.empty() || command.good_deformation;
}

void apply_document(const ViewCommand& command, const Document& document, double aspect, ViewState& state) {
    if (command.clip.starts_with("node=")) state.clip = clip_from_text(command.clip, command.state.clip, document);
    if (command.load_case.empty() && !command.good_deformation)
        return fit_to_body(state, command.origin, document.box, aspect);
    if (!document.solution)
        throw Error(ErrorCode::usage,
                    "--case and --deform need a solution: open the folder that kerf solve has "
                    "written.");
    const auto& cases = document.solution->cases;
    if (!command.load_case.empty()) {
        const auto found = std::find_if(cases.begin(), cases.end(),
                                        [&](const Solution::Case& one) { return one.name == command.load_case; });
        std::vector<std::string> names;
        for (const Solution::Case& one : cases) names.push_back(one.name);
        if (found == cases.end())
            throw Error(ErrorCode::usage, fmt::format("The solution has no case '{}'. It has '{}'.", command.load_case,
                                                      fmt::join(names, "', '")));
        state.load_case = static_cast<int>(found - cases.begin());
    }
    if (command.good_deformation)
        state.deform = good_deformation(cases.at(static_cast<std::size_t>(state.load_case)).largest_displacement,
                                        document.box.diagonal().norm());
    fit_to_body(state, command.origin, document.box, aspect);  // once, when nothing is refused any more
}

Clip clip_from_text(const std::string& text, const Clip& before, const Document& document) {
    Clip clip = before;
    clip.on = true;
    const std::size_t equals = text.find('=');
    if (equals == text.npos) refuse_clip(text);
    const std::string_view place = std::string_view(text).substr(0, equals);
    const std::string_view value = std::string_view(text).substr(equals + 1);
    if (place == "node") {
        NodeId node = 0;
        if (!read_number(value, node) || node < 1) refuse_clip(text);
        const TreeRow* row = document.tree.find(node);
        if (!row || !row->plane())
            throw Error(ErrorCode::usage,
                        fmt::format("Node {} was not cut, so that there is no plane to clip at.", node));
        snap_to(clip, *row->plane(), document.box);
        return clip;
    }
    if (!parse_normal(place, clip.normal, clip.flipped) || !read_number(value, clip.position)) refuse_clip(text);
    clip.normal.normalize();
    return clip;
}

ViewCommand parse_view_command(int argc, const char* const* argv) {
    ViewCommand command;
    StateTexts texts;
    CLI::App app(description, "kerf");
    app.footer(footer);
    use_help_text(app);
    app.require_subcommand(1);
    CLI::App* view = app.add_subcommand("view", "Open the viewer.");
    view->add_option("input", command.input, "What to open.")->type_name("INPUT");
    CLI::App* screenshot = app.add_subcommand("screenshot", "Draw a picture without a display.");
    screenshot->add_option("input", command.input, "What to open. Default: what --state was made of.")
        ->type_name("INPUT");
    screenshot->option_defaults()->group("Picture");
    screenshot->add_option("-o,--output", command.output, "PNG file.")->type_name("FILE")->required();
    screenshot->add_option("--size", texts.size, "Pixels of the picture. Default 1280x800.")->type_name("WxH");
    add_number(*screenshot, "--antialias", command.antialias, {"a whole number, 1 to 4", 1, 4},
               "Draw 2 to 4 times as large and average. Default 1.")
        ->type_name("N");
    screenshot
        ->add_option_function<std::string>(
            "--context", [&](const std::string& library) { command.context = offscreen_library_from_name(library); },
            fmt::format("Library that makes the OpenGL context: osmesa or egl. The picture is the same. Default {}.",
                        name(offscreen_libraries().front())))
        ->type_name("NAME");
    screenshot->add_flag("--ui", command.panels, "With all panels, as in the window.");
    add_number(*screenshot, "--timeout", command.timeout_seconds, {"0.001 to 1e9 seconds", 1e-3, 1e9},
               "Seconds after which to give up. Default 600.")
        ->type_name("S");
    for (CLI::App* each : {view, screenshot}) add_scene_options(*each, command, texts);
    bool no_run = false;
    view->add_flag("--no-run", no_run, "Only show a surface: it is cut and meshed else.")->group("Run");
    for (CLI::App* each : {view, screenshot}) put_help_last(*each, "Run");
    const auto answer = [&](const Answer& given) {
        command.exit_code = given.exit_code;
        command.print = given.text;
        return command;
    };
    if (const auto document_text = answer_before_parsing(app, argc, argv, version)) return answer(*document_text);
    try {
        app.parse(argc, argv);
        command.screenshot = screenshot->parsed();
        command.auto_run = !no_run;
        apply(texts, command);
        if (command.screenshot && command.input.empty())
            throw Error(ErrorCode::usage, "Say what to draw: an INPUT, or a --state that knows what it was made of.");
        read_run_config(texts.config, command.run);
        if (!texts.surface.empty()) set_options(command.run, {{"surface", texts.surface}}, "The command line");
        if (!texts.input_scale.empty()) set_options(command.run, {{"scale", texts.input_scale}}, "The command line");
        command.run.input_options.check();
    } catch (const CLI::ParseError& e) {
        return answer(answer_to(app, e, argc, argv));
    } catch (const Error& error) {
        command.exit_code = static_cast<int>(error.code());
        command.print = fmt::format("kerf: {}\n", error.what());
    }
    return command;
}

}  // namespace kerf::view

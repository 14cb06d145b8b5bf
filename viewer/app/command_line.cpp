// The command line of kerf-view: two commands of one parser, view and screenshot, which share the options of the scene
// (scene_options.h). Options are applied in two steps: those that stand by themselves after parsing (apply_options()),
// those that need the document, such as a plane at the cut of a node, when it is there (apply_document());
// depends_on_document() tells whether there are any. apply_document() fits the camera last, once nothing is refused any
// more. Every error becomes a text and an exit code in the command, so that parsing never throws.
#include "viewer/app/command_line.h"

#include <algorithm>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/core/error.h"
#include "base/core/version.h"
#include "help/number_option.h"
#include "help/program_help.h"
#include "run/request/config_file.h"
#include "viewer/app/scene_options.h"

namespace kerf::view {

namespace {

constexpr const char* description =
    "The viewer of Kerf: every cut of a decomposition step by step, every cell of its mesh.";
constexpr const char* footer =
    "INPUT is a closed surface (it is cut and meshed then), a run folder, one that is under way, a folder of kerf "
    "solve, a file of --trace or of --events.";

const std::vector<std::string> common_options = {"view",  "up",      "node",   "stage",     "color", "clip",
                                                 "theme", "explode", "deform", "load-case", "parts"};

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

// Reads a normal from "x", "-z" or "1,1,0".
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

void read_run_config(const std::string& path, RunRequest& run) {
    if (path.empty()) return;
    std::vector<ConfigEntry> given = read_config(path);
    // Files that the run would write beside its folder are not for a picture.
    static const std::set<std::string> not_taken = {"output", "quiet", "verbose", "report", "trace", "events", "stl"};
    std::erase_if(given, [](const OptionText& o) { return not_taken.contains(o.name); });
    const std::int32_t parts = run.parts;
    const std::vector<OptionField> fields = option_fields(run);
    for (const ConfigEntry& entry : given) set_option(fields, entry);
    if (parts > 0) run.parts = parts;
}

void add_inputs(CLI::App& app, SceneOptions& options, const std::string& what) {
    app.add_option("input", options.inputs,
                   what + " Several surfaces are opened together; two runs stand side by side.")
        ->type_name("INPUT");
}

void add_screenshot_options(CLI::App& app, ViewCommand& command, SceneOptions& options) {
    add_inputs(app, options, "What to open. Default: what --state was made of.");
    app.option_defaults()->group("Picture");
    app.add_option("-o,--output", command.picture.output, "PNG file.")->type_name("FILE")->required();
    app.add_option("--resolution", options.resolution, "Pixels of the picture. Default 1280x800.")->type_name("WxH");
    add_number(app, "--antialias", command.picture.antialias, {"a whole number, 1 to 4", 1, 4},
               "Draw 2 to 4 times as large and average. Default 1.")
        ->type_name("N");
    app.add_option_function<std::string>(
           "--context",
           [&command](const std::string& library) { command.picture.context = offscreen_library_from_name(library); },
           fmt::format("Library that makes the OpenGL context: osmesa or egl. The picture is the same. Default {}.",
                       name(offscreen_libraries().front())))
        ->type_name("NAME");
    add_number(app, "--frames", command.picture.frames, {"a whole number, 2 to 1000", 2, 1000},
               "So many pictures of a period of --motion (default swing): FILE_001.png, and so on.")
        ->type_name("N");
    app.add_flag("--ui", command.picture.panels, "With all panels, as in the window.");
    add_number(app, "--timeout", command.picture.timeout_seconds, {"0.001 to 1e9 seconds", 1e-3, 1e9},
               "Seconds after which to give up. Default 600.")
        ->type_name("S");
    add_scene_options(app, command, options);
    std::vector<std::string> common = {"output", "resolution", "antialias"};
    common.insert(common.end(), common_options.begin(), common_options.end());
    put_help_last(app, "Run", common);
}

void add_view_options(CLI::App& app, ViewCommand& command, SceneOptions& options) {
    add_inputs(app, options, "What to open.");
    add_scene_options(app, command, options);
    app.add_flag_callback(
           "--no-run", [&command] { command.auto_run = false; }, "Only show a surface: it is cut and meshed else.")
        ->group("Run");
    put_help_last(app, "Run", common_options);
}

// Sets the scene, and a run for it, by the options. Throws Error.
void apply_options(const SceneOptions& options, ViewCommand& command) {
    if (!options.inputs.empty()) command.input = options.inputs.front();
    apply(options, command);
    if (command.screenshot && command.input.empty())
        throw Error(ErrorCode::usage, "Say what to draw: an INPUT, or a --state that knows what it was made of.");
    read_run_config(options.run.config, command.run);
    take_inputs(options.inputs, command.input, command.run.input_options);
    if (!options.run.surface.empty()) set_options(command.run, {{"surface", options.run.surface}}, "The command line");
    if (!options.run.repair.empty()) set_options(command.run, {{"repair", options.run.repair}}, "The command line");
    if (!options.run.scale.empty()) set_options(command.run, {{"scale", options.run.scale}}, "The command line");
    command.run.input_options.check();
}

}  // namespace

std::vector<std::string> PictureOptions::files() const {
    if (frames == 0) return {output};
    std::vector<std::string> files;
    const std::string stem = output.substr(0, output.rfind('.'));
    for (int i = 1; i <= frames; ++i) files.push_back(fmt::format("{}_{:03}.png", stem, i));
    return files;
}

bool depends_on_document(const ViewCommand& command) {
    const bool has_camera = command.state.camera && !command.origin.body.isEmpty();
    return has_camera || command.clip.starts_with("node=") || !command.load_case.empty() || command.good_deformation ||
           command.picture.frames > 0;
}

void apply_document(const ViewCommand& command, const Document& document, double aspect, ViewState& state) {
    if (command.clip.starts_with("node=")) state.clip = clip_from_text(command.clip, command.state.clip, document);
    if (command.load_case.empty() && !command.good_deformation && command.picture.frames == 0)
        return fit_to_body(state, command.origin, document.box, aspect);
    if (!document.solution)
        throw Error(ErrorCode::usage,
                    "--load-case, --deform and --frames need a solution: open the folder that kerf solve has "
                    "written.");
    const auto& cases = document.solution->cases;
    if (!command.load_case.empty()) {
        const auto found = std::find_if(cases.begin(), cases.end(),
                                        [&](const Solution::Case& one) { return one.name == command.load_case; });
        std::vector<std::string> names;
        for (const Solution::Case& one : cases) names.push_back(one.name);
        if (found == cases.end())
            throw Error(ErrorCode::usage, fmt::format("The solution has no load case '{}'. It has '{}'.",
                                                      command.load_case, fmt::join(names, "', '")));
        state.deformation.load_case = static_cast<int>(found - cases.begin());
    }
    const auto& chosen = cases.at(state.deformation.load_case);
    if (chosen.is_mode() && !command.chosen.color) state.coloring.by = ColorBy::displacement;
    if (command.picture.frames > 0 && state.deformation.motion == Motion::still)
        state.deformation.motion = Motion::swing;
    if (command.good_deformation || (command.picture.frames > 0 && state.deformation.factor == 0))
        state.deformation.factor = good_deformation(chosen.largest_displacement, document.box.diagonal().norm());
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
        std::int32_t node = 0;
        if (!read_number(value, node) || node < 1) refuse_clip(text);
        const TreeRow* row = document.tree.find(NodeId(node));
        if (!row || !row->plane())
            throw Error(ErrorCode::usage,
                        fmt::format("Node {} was not cut, so that there is no plane to clip at.", node));
        snap_to(clip, *row->plane(), document.box);
        return clip;
    }
    if (!parse_normal(place, clip.normal, clip.flipped) || !read_number(value, clip.position) ||
        !(clip.position >= 0 && clip.position <= 1))
        refuse_clip(text);
    clip.normal.normalize();
    return clip;
}

ViewCommand parse_view_command(int argc, const char* const* argv) {
    ViewCommand command;
    SceneOptions options;
    CLI::App app(description, "kerf");
    app.footer(footer);
    use_help_text(app);
    app.require_subcommand(1);
    add_view_options(*app.add_subcommand("view", "Open the viewer."), command, options);
    CLI::App* screenshot = app.add_subcommand("screenshot", "Draw a picture without a display.");
    add_screenshot_options(*screenshot, command, options);
    const auto answer = [&](const Answer& given) {
        command.exit_code = given.exit_code;
        command.print = given.text;
        return command;
    };
    if (const auto at_once = answer_before_parsing(app, argc, argv, version)) return answer(*at_once);
    try {
        app.parse(argc, argv);
        command.screenshot = screenshot->parsed();
        apply_options(options, command);
    } catch (const CLI::ParseError& e) {
        return answer(answer_to(app, e, argc, argv));
    } catch (const Error& error) {
        return answer({static_cast<int>(error.code()), fmt::format("kerf: {}\n", error.what())});
    }
    return command;
}

}  // namespace kerf::view

#include "cli/command_line.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "cli/option_flags.h"
#include "cli/other_programs.h"
#include "core/error.h"
#include "core/version.h"
#include "export/format.h"
#include "help/nearest.h"
#include "help/number_option.h"
#include "help/program_help.h"
#include "help/usage_error.h"
#include "quality/quality_gate.h"
#include "request/config_file.h"
#include "request/saved_run.h"

namespace kerf {

namespace {

constexpr const char* description =
    "Kerf: parallel tetrahedral meshes by decomposition of the closed surface.\n"
    "mpirun -n P kerf mesh ... runs the same command on P ranks.\n"
    "kerf COMMAND --help lists the options of a command.";

constexpr const char* exit_codes =
    "Exit codes: 0 done and verified, 1 internal error, 2 usage, 3 input rejected, 4 a part could not be meshed, 5 out "
    "of memory, 6 a limit of quality was missed, 7 reading or writing failed, 8 verification failed, 9 the solver did "
    "not reach its tolerance, 130 cancelled.";

// What the program itself asks for.
std::vector<OptionField> program_fields(CommandLine& line) {
    return {
        {"output", "o", option_group::output, "DIR|FILE",
         "Folder of the result; an older run there is replaced. Of kerf mesh a file, too, whose ending is that of a "
         "format of kerf merge: one mesh. Default: named like the input, in this folder.",
         &line.options.output},
        {"quiet", "q", option_group::output, "", "Print nothing but errors.", &line.quiet},
        {"verbose", "v", option_group::output, "",
         "Print all that is known of the result, and the tree of cuts with every node of it.", &line.verbose}};
}
// What a config file may say: the table, and that.
std::vector<OptionField> config_fields(CommandLine& line) {
    std::vector<OptionField> fields = option_fields(line.options);
    for (OptionField& field : program_fields(line)) fields.push_back(std::move(field));
    return fields;
}

// Options that say what the surface is, how fine, and how far it may be off.
bool shapes_surface(const std::string& name) {
    InputOptions of_input;
    SizeOptions of_sizes;
    const auto is_named = [&](const OptionField& field) { return field.name == name; };
    const std::vector<OptionField> input = input_option_fields(of_input), sizes = size_option_fields(of_sizes);
    return name == "deviation" || std::any_of(input.begin(), input.end(), is_named) ||
           std::any_of(sizes.begin(), sizes.end(), is_named);
}

CLI::App* add_run_command(CLI::App& app, const char* name, const char* text, CommandLine& line) {
    CLI::App* command = app.add_subcommand(name, text);
    command
        ->add_option(
            "input", line.options.input,
            "Closed surface: STL, OBJ, PLY, OFF, .msh, .vtu, .mesh, .smesh or .poly, CAD file: STEP, IGES, BREP, "
            "or 3MF; also as .gz or .zst.")
        ->type_name("INPUT");
    add_run_options(*command, line.options);
    for (const OptionField& field : program_fields(line)) add_option_field(*command, field);
    command->option_defaults()->group(option_group::running);
    command->add_flag("--print-config", line.print_config, "Print the options as a config file and end.");
    command->add_option("--config", line.config_file, "Read options from a TOML file; the command line wins.")
        ->type_name("FILE");
    return command;
}

CLI::App* add_quality_command(CLI::App& app, QualityRequest& request) {
    CLI::App* command = app.add_subcommand("quality", "Measure the cells of a mesh, alone or beside another one.");
    command
        ->add_option("mesh", request.mesh,
                     "Folder of a run, or .msh (Gmsh), .mesh (MEDIT), .vtu, .node or .ele (TetGen) of any program.")
        ->required()
        ->type_name("DIR|FILE");
    command->add_flag("--json", request.json, "Print everything as JSON.");
    command->add_flag("-v,--verbose", request.verbose, "Print all tables, and a histogram of each measure.");
    command
        ->add_option("--picture", request.picture,
                     "Write the distributions and accumulated distributions of all measures as SVG.")
        ->type_name("FILE");
    command->add_option("--compare", request.compare, "Another mesh, to be put beside this one.")->type_name("OTHER");
    command
        ->add_option("--fail-below", request.fail_below,
                     fmt::format("Limits, with commas between, as min-dihedral=5: exit with 6 if a cell or boundary "
                                 "triangle has less. For {}.",
                                 limit_names(BadEnd::small)))
        ->type_name("LIST");
    command
        ->add_option("--fail-above", request.fail_above,
                     fmt::format("The same for what has more, as radius-edge=10. For {}.", limit_names(BadEnd::large)))
        ->type_name("LIST");
    return command;
}

CLI::App* add_export_command(CLI::App& app, CommandLine& line) {
    ExportRequest& request = line.export_request;
    request.threads = 0;
    CLI::App* command = app.add_subcommand("export", "Write a finished run in the formats of solvers, part by part.");
    std::string list = "Formats:\n";
    for (const Format* format : formats()) list += fmt::format("  {:<10} {}\n", format->name, format->help);
    command->footer(
        list +
        "\nA single format goes into OUT itself, several go into sub-folders. mpirun -n P kerf export shares "
        "the parts among P ranks.");
    command->add_option("folder", request.folder, "Folder of the run, or of a solution, with its values.")
        ->required()
        ->type_name("DIR");
    command->add_option("-f,--format", request.formats, "Formats, with commas between.")
        ->required()
        ->type_name("LIST")
        ->check(suggest_formats());
    command
        ->add_option("-o,--output", request.output,
                     "Folder for them. Default: DIR/export/NAME, so that they become part of the run.")
        ->type_name("OUT");
    command
        ->add_option("--fields", request.fields,
                     "Qualities of cells in vtu files, as kerf mesh --help says. Default min-dihedral.")
        ->type_name("LIST")
        ->check(suggest_cell_fields());
    command->add_flag("--msh-ascii", request.msh_ascii, "Write msh as text instead of binary.");
    command
        ->add_option("--patch-type", request.patch_types,
                     "OpenFOAM's type of a patch: patch (default), wall, symmetry, symmetryPlane. Repeatable.")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("NAME=TYPE");
    add_number(*command, "--into", request.into, {"a whole number, 1 or more", 1},
               "Join the parts along the tree into so many pieces.")
        ->type_name("N");
    add_number(*command, "--workers", request.threads, {"a whole number, 1 to 4096", 1, 4096},
               "Parts that each rank writes at once. Default: its processors.")
        ->type_name("W");
    command->add_flag("-q,--quiet", line.quiet, "Print nothing but errors.");
    return command;
}

CLI::App* add_remesh_command(CLI::App& app, CommandLine& line) {
    CLI::App* command = app.add_subcommand("remesh", "Make a surface worth meshing, within a bound of the input.");
    command->add_option("input", line.options.input, "Closed surface, as for kerf mesh.")
        ->required()
        ->type_name("INPUT");
    command->option_defaults()->group(option_group::output);
    command->add_option("-o,--output", line.remeshed_file, "Surface, .obj (with patches) or .stl.")
        ->required()
        ->type_name("FILE");
    for (const OptionField& field : option_fields(line.options))
        if (shapes_surface(field.name)) add_option_field(*command, field);
    heed_unit(*command, line.options.input_options);
    command->add_flag("-q,--quiet", line.quiet, "Print nothing but errors.");
    put_help_last(*command, option_group::output);
    return command;
}

// Sets what the command line has not given. Throws Error.
void apply_config(const CLI::App& command, CommandLine& line) {
    const std::vector<OptionField> fields = config_fields(line);
    std::vector<std::string> names;
    for (const OptionField& field : fields) names.push_back(field.name);
    for (const ConfigEntry& given : read_config(line.config_file)) {
        if (std::find(names.begin(), names.end(), given.name) == names.end())
            throw Error(ErrorCode::usage,
                        fmt::format("{}: '{}' is not an option.{} kerf mesh --print-config lists them.", given.place,
                                    given.name, did_you_mean(given.name, names)));
        if (command.get_option("--" + given.name)->count() == 0) set_option(fields, given);
    }
}

void require_input(const CommandLine& line) {
    if (line.resume.empty() && !line.print_config && line.options.input.empty()) throw CLI::RequiredError("input");
}

// part-mesh for parts/part.stl.gz. Cuts have another name, so that they do not replace a mesh.
std::string usual_output(const std::string& input, bool meshes) {
    std::filesystem::path name = std::filesystem::path(input).filename();
    if (name.extension() == ".gz" || name.extension() == ".zst") name = name.stem();
    return name.stem().string() + (meshes ? "-mesh" : "-cut");
}

// What a run folder has beside the mesh would be lost with it.
void refuse_what_no_file_holds(const RunOptions& options, const Format& format, bool meshes) {
    const auto refuse = [&](const std::string& why) {
        throw Error(ErrorCode::usage,
                    fmt::format("--output is {}, a file of one mesh, but {}. Name a folder instead: -o {}.",
                                options.output, why, std::filesystem::path(options.output).stem().string()));
    };
    if (!meshes) refuse("kerf decompose writes the surface of every part");
    if (options.stl) refuse("--stl writes the surface of every part");
    if (options.reference) refuse("--reference writes a comparison, too");
    if (!options.fields.empty()) refuse("--fields are those of the files of parts");
    if (!options.patch_types.empty()) refuse("--patch-type is for a case of OpenFOAM");
    if (!options.formats.empty() && options.formats != format.name)
        refuse(fmt::format("--format {} asks for other files", options.formats));
}

// A mesh in one file is that of a run in a folder beside it.
void settle_output(CommandLine& line, bool meshes) {
    RunOptions& options = line.options;
    if (options.dry_run) return;
    line.has_usual_output = options.output.empty();
    if (line.has_usual_output) options.output = usual_output(options.input, meshes);
    const Format* format = find_merged_format(options.output);
    if (!format) return;
    refuse_what_no_file_holds(options, *format, meshes);
    options.formats.clear();
    line.merged_file = options.output;
    options.output = run_folder_beside(line.merged_file);
}

// The interrupted run's options, and those of this command line that change nothing of the result. Throws Error.
RunOptions resumed_options(const CLI::App& command, CommandLine& line) {
    std::error_code ignored;
    if (find_merged_format(line.resume) && !std::filesystem::is_directory(line.resume, ignored))
        line.resume = run_folder_beside(line.resume);
    RunOptions options = load_interrupted_run(line.resume);
    const std::vector<OptionField> saved = option_fields(options), given = option_fields(line.options);
    for (std::size_t i = 0; i < given.size(); ++i) {
        if (command.get_option("--" + given[i].name)->count() == 0) continue;
        if (given[i].shapes_parts)
            throw Error(ErrorCode::usage,
                        fmt::format("--{} would change the parts that are finished. Leave it out with --resume, or "
                                    "start anew: kerf mesh {} -o {}.",
                                    given[i].name, options.input, options.output));
        saved[i].set_text(given[i].text());
    }
    options.dry_run = line.options.dry_run;
    line.merged_file = merged_file_of(options.output);
    if (const Format* format = find_merged_format(line.merged_file)) {
        RunOptions asked = line.options;
        asked.output = line.merged_file;
        refuse_what_no_file_holds(asked, *format, true);
    }
    return options;
}

void finish(CommandLine& line, const Answer& answer) {
    line.finished = true;
    line.exit_code = answer.exit_code;
    line.output = answer.text;
}

}  // namespace

CommandLine parse_command_line(int argc, const char* const* argv) {
    CommandLine line;
    CLI::App app(description, "kerf");
    app.footer(exit_codes);
    use_help_text(app);
    app.set_version_flag("--version", std::string("kerf ") + version, "Print the version and end.");
    app.require_subcommand(1);
    CLI::App* mesh = add_run_command(app, "mesh", "Decompose, mesh every part, verify, write, report.", line);
    CLI::App* decompose =
        add_run_command(app, "decompose", "The same, up to the closed surfaces of the parts; print the tree.", line);
    CLI::Option* resume =
        mesh->add_option("--resume", line.resume,
                         "Finish the run into this folder, or DIR.kerf-partial, that was interrupted, "
                         "with its options.")
            ->type_name("DIR");
    for (const char* name : {"input", "--output", "--config"}) resume->excludes(mesh->get_option(name));
    mesh->add_flag("--dry-run", line.options.dry_run, "Cut, print what every part will take, and end; write nothing.");
    for (CLI::App* command : {mesh, decompose}) put_help_last(*command, option_group::running);
    CLI::App* check = app.add_subcommand("check", "Diagnose a surface without meshing it.");
    check->add_option("input", line.check.path, "Surface file.")->required()->type_name("INPUT");
    add_input_options(*check, line.check.options);
    check->option_defaults()->group(option_group::output);
    check->add_flag("--json", line.check.json, "Print every defect as JSON.");
    check->add_flag(
        "--list-patches", line.check.list_patches,
        "Print name, area, centroid and normal of each patch, and how formats spell its name; no diagnosis.");
    check->add_option("--offenders", line.check.offenders_file, "Write the offending facets, edges and places as VTU.")
        ->type_name("FILE");
    for (const char* name : {"--json", "--offenders"})
        check->get_option("--list-patches")->excludes(check->get_option(name));
    add_option_field(
        *check, {"needle-angle", "", option_group::output, "DEG", "Degrees below which a facet is a needle. Default 1.",
                 &line.check.needle_angle_deg, true, needle_angle_range});
    put_help_last(*check, option_group::output);
    CLI::App* verify = app.add_subcommand("verify", "Check every law of a finished run again, from its files.");
    verify->add_option("folder", line.options.output, "Folder of the run.")->required()->type_name("DIR");
    verify->add_option("--input", line.verify.input, "Where the surface is now. Default: where the run has read it.")
        ->type_name("FILE");
    verify
        ->add_flag("--without-input", line.verify.without_input,
                   "The laws of the mesh are enough: the surface is not there any more.")
        ->excludes("--input");
    CLI::App* to_export = add_export_command(app, line);
    CLI::App* to_merge = app.add_subcommand("merge", "Write a finished run as one mesh.");
    to_merge->add_option("folder", line.merge.folder, "Folder of the run, or of a solution, with its values.")
        ->required()
        ->type_name("DIR");
    to_merge->add_option("-o,--output", line.merge.output, "File, whose ending chooses the format.")
        ->required()
        ->type_name("FILE");
    to_merge->add_option("--msh-version", line.merge.options.msh_version, "Of Gmsh's files: 4.1 or 2.2.")
        ->type_name("V")
        ->check(one_of("4.1,2.2"));
    to_merge->add_flag("--msh-ascii", line.merge.msh_ascii, "Write them as text instead of binary.");
    CLI::App* quality = add_quality_command(app, line.quality);
    CLI::App* to_remesh = add_remesh_command(app, line);
    // Only for the list of commands: main() has passed these on.
    for (const OtherProgram& other : other_programs) app.add_subcommand(other.command, other.help)->disabled();
    if (const auto answer = document(app, argc, argv, version, [](const std::string& shell) {
            return output_of_other_programs({"--completion", shell});
        })) {
        finish(line, *answer);
        return line;
    }

    // The table binds every option to one place, so the values of `mesh` and `decompose` share it.
    try {
        app.parse(argc, argv);
        for (CLI::App* command : {mesh, decompose})
            if (command->parsed()) {
                if (!line.config_file.empty()) apply_config(*command, line);
                require_input(line);
            }
    } catch (const CLI::ParseError& e) {
        finish(line, answer_to(app, e, argc, argv));
        return line;
    }
    if (mesh->parsed() || decompose->parsed()) {
        line.command = mesh->parsed() ? Command::mesh : Command::decompose;
        if (!line.resume.empty() && is_complete_run(line.resume)) {
            finish(line, {0, fmt::format("kerf: {} is complete: nothing waits to be done.\n", line.resume)});
            return line;
        }
        if (!line.resume.empty()) line.options = resumed_options(*mesh, line);
        line.options.volume = mesh->parsed();
        const CLI::Option* parts = (mesh->parsed() ? mesh : decompose)->get_option("--parts");
        if (parts->count() > 0 && line.options.decompose.parts < 1)
            finish(line, {static_cast<int>(ErrorCode::usage),
                          fmt::format("kerf: --parts is {}, but a mesh has 1 or more parts.\n",
                                      line.options.decompose.parts)});
        if (line.print_config)
            line.config = to_config(config_fields(line));
        else if (line.resume.empty())
            settle_output(line, mesh->parsed());
    } else if (check->parsed()) {
        line.command = Command::check;
    } else if (verify->parsed()) {
        line.command = Command::verify;
    } else if (to_export->parsed()) {
        line.command = Command::export_formats;
    } else if (to_merge->parsed()) {
        line.command = Command::merge;
    } else if (quality->parsed()) {
        line.command = Command::quality;
    } else if (to_remesh->parsed()) {
        line.command = Command::remesh;
    }
    return line;
}

}  // namespace kerf

#include "cli/option_flags.h"

#include <string_view>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "files/export/format.h"
#include "files/part/vtu_writer.h"
#include "help/command_help.h"

namespace kerf {

CLI::Option* add_option_field(CLI::App& app, const OptionField& field) {
    const std::string names =
        field.short_name.empty() ? "--" + field.name : "-" + field.short_name + ",--" + field.name;
    if (bool* const* flag = std::get_if<bool*>(&field.value))
        return app.add_flag(**flag ? names + ",!--no-" + field.name : names, **flag, field.help)->group(field.group);
    if (const auto* list = std::get_if<OptionField::List>(&field.value))
        return app
            .add_option_function<std::vector<std::string>>(
                names,
                [items = *list](const std::vector<std::string>& texts) {
                    items->clear();
                    for (const std::string& text : texts)
                        for (std::string& item : split_items(text)) items->push_back(std::move(item));
                },
                field.help)
            ->expected(1)
            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
            ->type_name(field.value_name)
            ->group(field.group);
    CLI::Option* option = app.add_option_function<std::string>(
        names, [field](const std::string& text) { field.set_text(text); }, field.help);
    if (const auto* choice = std::get_if<OptionField::Choice>(&field.value))
        option->check(suggest(fmt::format("{}", fmt::join(choice->names, ","))));
    return option->type_name(field.value_name)->group(field.group);
}

void add_input_options(CLI::App& app, InputOptions& options) {
    for (const OptionField& field : input_option_fields(options)) add_option_field(app, field);
    // A command with few other options has too many of these for one heading.
    for (const char* mends :
         {"--weld", "--fill-holes", "--repair", "--gap", "--offset", "--cap", "--thicken", "--keep-largest"})
        app.get_option(mends)->group("Repairs");
    heed_unit(app, options);
}

void heed_unit(CLI::App& app, InputOptions& options) {
    app.get_option("--unit")->each([&options](const std::string&) { options.cad.unit_is_asked = true; });
}

void add_surface_output(CLI::App& app, std::string& output) {
    app.add_option("-o,--output", output, "Surface: .obj, .vtp, .vtk (with patches), .ply, .off, .stl.")
        ->required()
        ->type_name("FILE");
}

void add_run_options(CLI::App& app, RunRequest& options) {
    const std::vector<OptionField> fields = option_fields(options);
    for (const std::string_view group : option_group::all)
        for (const OptionField& field : fields)
            if (field.group == group) add_option_field(app, field);
    heed_unit(app, options.input_options);
    app.get_option("--format")->check(suggest_formats());
    app.get_option("--fields")->check(suggest_cell_fields());
    // Another name, which the help does not list. It takes effect at once, so that code that asks for the option finds
    // it given.
    app.add_option_function<std::string>("--tetgen", [switches = app.get_option("--tetgen-switches")](
                                                         const std::string& text) { switches->add_result(text); })
        ->trigger_on_parse()
        ->group("");
}

CLI::Validator suggest_formats() {
    std::string names;
    for (const Format* format : formats()) names += fmt::format("{}{}", names.empty() ? "" : ",", format->name);
    return suggest(names);
}

CLI::Validator suggest_cell_fields() {
    std::string names;
    for (const CellField& field : cell_fields) names += fmt::format("{},", field.name);
    return suggest(names + "all,none");
}

}  // namespace kerf

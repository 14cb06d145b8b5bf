#include "cli/option_flags.h"

namespace kerf {

namespace {

const char* type_name(const OptionField& field) {
    if (std::holds_alternative<double*>(field.value)) return "FLOAT";
    const bool is_text = std::holds_alternative<std::string*>(field.value);
    return is_text ? "TEXT" : std::holds_alternative<OptionField::Choice>(field.value) ? "" : "INT";
}

}  // namespace

CLI::Option* add_option_field(CLI::App& app, const OptionField& field) {
    const std::string names =
        field.short_name.empty() ? "--" + field.name : "-" + field.short_name + ",--" + field.name;
    if (bool* const* flag = std::get_if<bool*>(&field.value))
        return app.add_flag(**flag ? names + ",!--no-" + field.name : names, **flag, field.help);
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
            ->type_name("TEXT");
    CLI::Option* option = app.add_option_function<std::string>(
        names, [field](const std::string& text) { field.set_text(text); }, field.help);
    if (const auto* choice = std::get_if<OptionField::Choice>(&field.value))
        option->check(CLI::IsMember(choice->names));
    return option->default_str(field.text())->type_name(type_name(field));
}

void add_run_options(CLI::App& app, RunOptions& options) {
    for (const OptionField& field : option_fields(options)) add_option_field(app, field);
    // At once, so that all that asks whether --surface was given finds it given.
    app.add_flag_callback(
           "--remesh", [surface = app.get_option("--surface")] { surface->add_result("remesh"); },
           "Short for --surface remesh.")
        ->trigger_on_parse();
}

}  // namespace kerf

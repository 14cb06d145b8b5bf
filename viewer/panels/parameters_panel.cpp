// The options of the next run, and the comparison of the last two. There is a field for each row of the kernel's table
// of options (option_fields()), under the headings of the help, so that a new option needs no code here: Editor has one
// way to edit each type of value, and numbers are texts that the table itself reads. The panel edits a copy, which is
// taken anew when key_of() the document changes, because options arrive after the document was opened and change with a
// run. The copy is held against ranges and files only when a value changes, as that reads files. A bar marks a value
// that differs from the document's, and the heading above it.
#include <algorithm>

#include <fmt/format.h>

#include "base/core/error.h"
#include "run/request/run_choices.h"
#include "viewer/panels/inside/parts.h"

namespace kerf::view {

namespace {

// Whether an option names a file that a run writes besides its result, which is no business of the viewer.
bool is_file(const OptionField& field) { return names_output(field.name); }

// Draws the field of a value of each type but numbers, and returns whether the value has changed.
struct Editor {
    Widgets& widgets;
    const char* label;

    template <class Number>
    bool operator()(const Number& /*place*/) const {
        return false;
    }
    bool operator()(std::string* value) const { return widgets.input_text(label, value); }
    bool operator()(OptionField::List items) const {
        std::string text = join_items(*items);
        const bool changed = widgets.input_text(label, &text);
        if (changed) *items = split_items(text);
        return changed;
    }
    bool operator()(bool* value) const { return widgets.checkbox(label, value); }
    bool operator()(const OptionField::Choice& choice) const {
        int index = choice.get();
        const bool changed = widgets.combo(label, &index, choice.names);
        if (changed) choice.set(index);
        return changed;
    }
};

// The text of the field of this name in the other table, to see whether it was changed.
std::string text_in(const std::vector<OptionField>& fields, const std::string& name) {
    for (const OptionField& field : fields)
        if (field.name == name) return field.text();
    return "";
}

// Draws a bar from `at` down: the item to the right of it was changed.
void mark(const ImVec2& at, const Palette& colors) {
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + 0.2f * em(), at.y + ImGui::GetFrameHeight()},
                                              packed(colors.accent));
}

// Sets the option, or notes why the text is none.
void take_text(const OptionField& field, const std::string& text, ParametersMemory& memory) {
    try {
        memory.refused.erase(field.name);
        field.set_text(text);
    } catch (const Error& error) {
        memory.refused[field.name] = {text, error.what()};
    }
}

// Draws the field of a number, which is written as on the command line, "2%" or "50k". A text that is none stays in the
// field with the error below it.
bool draw_number(Widgets& widgets, const OptionField& field, ParametersMemory& memory, const Palette& colors) {
    const auto known = memory.refused.find(field.name);
    std::string text = known == memory.refused.end() ? field.text() : known->second.text;
    const bool edited = widgets.input_text(field.name.c_str(), &text);
    if (edited) take_text(field, text, memory);
    if (const auto refused = memory.refused.find(field.name); refused != memory.refused.end())
        show_wrapped(refused->second.error, colors.bad);
    return edited;
}

bool draw_field(Widgets& widgets, const OptionField& field, bool changed, ParametersMemory& memory,
                const Palette& colors) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::BeginGroup();
    const bool edited = field.is_number() ? draw_number(widgets, field, memory, colors)
                                          : std::visit(Editor{widgets, field.name.c_str()}, field.value);
    ImGui::EndGroup();
    if (!memory.refused.contains(field.name)) explain(field.help);  // it would hide the error
    if (const auto item = widgets.find(field.name); changed && item) mark({item->left - 0.35f * em(), at.y}, colors);
    return edited;
}

// Whether the options of a heading are open at first: most runs change some of these.
bool is_common(const std::string& heading) { return heading == option_group::cuts || heading == option_group::sizes; }

// Holds the edited options against their ranges and the files that they name. It is done when they change, not in every
// frame.
void check_options(ParametersMemory& memory) {
    try {
        memory.wrong = memory.refused.empty() ? "" : memory.refused.begin()->second.error;
        if (memory.wrong.empty()) choices_of(memory.options);
    } catch (const Error& error) {
        memory.wrong = error.what();
    }
}

// Draws all fields under the headings of the help.
void draw_fields(UiContext& context, ParametersMemory& memory) {
    RunRequest given = context.session.document().options;
    const std::vector<OptionField> before = option_fields(given), now = option_fields(memory.options);
    const Palette& colors = palette(context.state.theme);
    bool edited = false;
    const auto is_changed = [&](const OptionField& field) { return field.text() != text_in(before, field.name); };
    for (const char* heading : option_group::all) {
        std::vector<OptionField> fields;
        for (const OptionField& field : now)
            if (field.group == heading && !is_file(field)) fields.push_back(field);
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const bool open = context.widgets.header(heading, is_common(heading));
        if (std::any_of(fields.begin(), fields.end(), is_changed)) mark(at, colors);
        if (!open) continue;
        for (const OptionField& field : fields)
            edited |= draw_field(context.widgets, field, is_changed(field), memory, colors);
    }
    if (edited) check_options(memory);
}

void put_options(ParametersMemory& memory, const RunRequest& options) {
    memory.options = options;
    memory.refused.clear();
    check_options(memory);
}

void draw_buttons(UiContext& context, ParametersMemory& memory) {
    const bool valid = memory.wrong.empty();
    Widgets& w = context.widgets;
    const Document& document = context.session.document();
    const bool can_run = valid && !document.progress.running && !document.path.empty();
    const NodeId node = context.state.node;
    const bool has_cut = document.trace && document.trace->find(node) && !document.progress.running;
    ImGui::BeginDisabled(!can_run);
    if (w.button("Run all", "Cuts the surface and fills the parts with tetrahedra, in another process"))
        start_edited_run(context, memory, true);
    ImGui::SameLine();
    if (w.button("Only cut", "Stops at the closed surfaces of the parts")) start_edited_run(context, memory, false);
    ImGui::SameLine();
    ImGui::EndDisabled();
    if (w.button("Reset", "The options as they were")) put_options(memory, document.options);
    ImGui::BeginDisabled(!valid || !has_cut);
    const std::string label = fmt::format("Re-run cut of node {}", node.value());
    if (w.button(label.c_str(), has_cut ? "Makes this cut again with these options; what lies below it is left out"
                                : document.progress.running ? "A run is under way"
                                                            : "Needs a trace with a cut of this node"))
        context.actions.runs.redo_cut(node, memory.options, std::nullopt);
    ImGui::EndDisabled();
}

// Sets the options that were edited in others, too.
void carry_edits(const RunRequest& given, const RunRequest& edited, RunRequest& options) {
    RunRequest before = given, after = edited;
    const std::vector<OptionField> old_fields = option_fields(before), new_fields = option_fields(after);
    for (const OptionField& field : option_fields(options)) {
        const std::string text = text_in(new_fields, field.name);
        if (text == text_in(old_fields, field.name)) continue;
        try {
            field.set_text(text);
        } catch (const Error&) {
            continue;  // it is out of range
        }
    }
}

// Takes the document's options, which arrive after it was opened and change with a run or a repair. What was typed for
// the same document stays.
void take_options(const Document& document, ParametersMemory& memory) {
    std::string key = key_of(document);
    if (memory.given_of == key) return;
    RunRequest options = document.options;
    if (memory.path == document.path) carry_edits(memory.given, memory.options, options);
    memory.given_of = std::move(key);
    memory.path = document.path;
    memory.given = document.options;
    put_options(memory, options);
}

// Draws the error in the options, or a hint: one line in any case, so that nothing moves while one types.
void draw_remark(const std::string& wrong, const Palette& colors) {
    const std::string text = wrong.empty() ? "A bar marks what was changed." : wrong;
    show(shortened(text, ImGui::GetContentRegionAvail().x), wrong.empty() ? colors.dim : colors.bad);
    explain(wrong);
}

}  // namespace

void draw_parameters(UiContext& context, Dialogs& dialogs) {
    ParametersMemory& memory = dialogs.parameters;
    draw_head(context.widgets, "Parameters", context.state.panels.parameters, memory.section);
    if (!context.state.panels.parameters) return;
    take_options(context.session.document(), memory);
    draw_buttons(context, memory);
    draw_remark(memory.wrong, palette(context.state.theme));
    draw_comparison(context, dialogs.save);
    draw_fields(context, memory);
}

void start_edited_run(UiContext& context, ParametersMemory& memory, bool volume) {
    take_options(context.session.document(), memory);
    if (memory.wrong.empty())
        context.actions.runs.start_run(memory.options, volume);
    else
        context.actions.window.complain(memory.wrong);
}

}  // namespace kerf::view

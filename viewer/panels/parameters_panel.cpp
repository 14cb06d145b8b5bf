// The options of the next run, from the kernel's table, and what a repetition has changed.
#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "core/error.h"
#include "viewer/panels/parts.h"

namespace kerf::view {

namespace {

// Files that a run writes besides the result are no business of the viewer.
bool is_file(const OptionField& field) {
    return field.name == "report" || field.name == "events" || field.name == "trace";
}

struct Editor {
    Widgets& widgets;
    const char* label;

    void operator()(std::int32_t* value) const {
        std::int64_t wide = *value;
        constexpr std::int64_t limit = std::numeric_limits<std::int32_t>::max();
        if (widgets.input_number(label, &wide)) *value = static_cast<std::int32_t>(std::clamp(wide, -limit, limit));
    }
    void operator()(const OptionField::Memory& memory) const { widgets.input_number(label, memory.megabytes); }
    void operator()(const OptionField::Count& count) const { widgets.input_number(label, count.number); }
    void operator()(double* value) const { widgets.input_number(label, value); }
    void operator()(Length* value) const {
        if (value->is_percent()) {
            std::string text = value->text();
            if (widgets.input_text(label, &text)) *value = length_in(text).value_or(*value);
            return;
        }
        double number = value->number();
        if (widgets.input_number(label, &number)) *value = number;
    }
    void operator()(std::string* value) const { widgets.input_text(label, value); }
    void operator()(OptionField::List items) const {
        std::string text = join_items(*items);
        if (widgets.input_text(label, &text)) *items = split_items(text);
    }
    void operator()(bool* value) const { widgets.checkbox(label, value); }
    void operator()(const OptionField::Choice& choice) const {
        int index = choice.get();
        if (widgets.combo(label, &index, choice.names)) choice.set(index);
    }
};

// Of the same name in the other table, to see what was changed.
std::string text_in(const std::vector<OptionField>& fields, const std::string& name) {
    for (const OptionField& field : fields)
        if (field.name == name) return field.text();
    return "";
}

// A bar from `at` down: the item to the right of it was changed.
void mark(const ImVec2& at, const Palette& colors) {
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + 0.2f * em(), at.y + ImGui::GetFrameHeight()},
                                              packed(colors.accent));
}

void draw_field(Widgets& widgets, const OptionField& field, bool changed, const Palette& colors) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float room = ImGui::GetContentRegionAvail().x;
    ImGui::BeginGroup();
    std::visit(Editor{widgets, field.name.c_str()}, field.value);
    ImGui::EndGroup();
    explain(field.help);
    if (changed) mark({at.x + value_place * room - 0.35f * em(), at.y}, colors);
}

// Most runs change some of these.
bool is_common(const std::string& heading) { return heading == option_group::cuts || heading == option_group::sizes; }

// Under the headings of the help.
void draw_fields(UiContext& context, Memory& memory) {
    RunOptions given = context.session.document().options;
    const std::vector<OptionField> before = option_fields(given), now = option_fields(memory.options);
    const Palette& colors = palette(context.state.theme);
    const auto is_changed = [&](const OptionField& field) { return field.text() != text_in(before, field.name); };
    for (const char* heading : option_group::all) {
        std::vector<OptionField> fields;
        for (const OptionField& field : now)
            if (field.group == heading && !is_file(field)) fields.push_back(field);
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const bool open = context.widgets.header(heading, is_common(heading));
        if (std::any_of(fields.begin(), fields.end(), is_changed)) mark(at, colors);
        if (!open) continue;
        for (const OptionField& field : fields) draw_field(context.widgets, field, is_changed(field), colors);
    }
}

// The message of the first option that is out of its range.
std::string complaint(const RunOptions& options) {
    try {
        resolved(options);
        return "";
    } catch (const Error& error) {
        return error.what();
    }
}

void draw_buttons(UiContext& context, Memory& memory, bool valid) {
    Widgets& w = context.widgets;
    const Document& document = context.session.document();
    const bool can_run = valid && !document.progress.running && !document.path.empty();
    const NodeId node = context.state.node;
    const bool has_cut = document.trace && document.trace->find(node) && !document.progress.running;
    ImGui::BeginDisabled(!can_run);
    if (w.button("Run all", "Cuts the surface and fills the parts with tetrahedra, in another process"))
        context.actions.runs.start_run(memory.options, true);
    ImGui::SameLine();
    if (w.button("Only cut", "Stops at the closed surfaces of the parts"))
        context.actions.runs.start_run(memory.options, false);
    ImGui::SameLine();
    ImGui::EndDisabled();
    if (w.button("Reset", "The options as they were")) memory.options = document.options;
    ImGui::BeginDisabled(!valid || !has_cut);
    const std::string label = fmt::format("Re-run cut of node {}", node);
    if (w.button(label.c_str(), has_cut ? "Makes this cut again with these options; what lies below it is left out"
                                : document.progress.running ? "A run is under way"
                                                            : "Needs a trace with a cut of this node"))
        context.actions.runs.redo_cut(node, memory.options, std::nullopt);
    ImGui::EndDisabled();
}

// The document's options arrive after it was opened, and change with a run.
void take_options(const Document& document, Memory& memory) {
    std::string given = document.path;
    for (const OptionText& option : option_texts(document.options, false)) given += "\n" + option.text;
    if (memory.options_of == given) return;
    memory.options_of = given;
    memory.options = document.options;
}

// One line in any case, so that nothing moves while one types.
void draw_remark(const std::string& wrong, const Palette& colors) {
    const std::string text = wrong.empty() ? "A bar marks what was changed." : wrong;
    show(shortened(text, ImGui::GetContentRegionAvail().x), wrong.empty() ? colors.dim : colors.bad);
    explain(wrong);
}

}  // namespace

void draw_parameters(UiContext& context, Memory& memory) {
    draw_head(context.widgets, "Parameters", context.state.panels.parameters, memory.parameters);
    if (!context.state.panels.parameters) return;
    take_options(context.session.document(), memory);
    const std::string wrong = complaint(memory.options);
    draw_buttons(context, memory, wrong.empty());
    draw_remark(wrong, palette(context.state.theme));
    draw_comparison(context, memory);
    draw_fields(context, memory);
}

}  // namespace kerf::view

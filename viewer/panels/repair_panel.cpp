// Repairs of the open surface: buttons for the levels of the ladder and for single steps, a field for any plan, the
// report of the repairs that were done, with their places, and the way on (save, mesh). A plan is the text of --repair,
// so that a command does the same as a button. A button adds its steps to the plan of the document, and the whole plan
// is done again, always from the file; so a second press of a button would do nothing, and it is disabled. Places of
// the report are facets of the file: facets_of_file() leads to them, also while the repaired surface is shown.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "surface/repair/repair_advice.h"
#include "surface/repair/repair_step.h"
#include "viewer/model/advice.h"
#include "viewer/model/line_of_sight.h"
#include "viewer/model/repaired_places.h"
#include "viewer/panels/inside/parts.h"

namespace kerf::view {

namespace {

const char* explanation_of(RepairLevel level) {
    switch (level) {
        case RepairLevel::exact:
            return "No point moves, and no area is added";
        case RepairLevel::near:
            return "Points move within the bound, holes are filled";
        case RepairLevel::full:
            return "Facets that cross are resolved, too";
        case RepairLevel::none:
            break;
    }
    return "";
}

// The error in a plan; empty: there is none.
std::string error_of_plan(const std::string& plan) {
    try {
        parse_repair_plan("repair", plan);
        return "";
    } catch (const Error& error) {
        return error.what();
    }
}

void repair_by(UiContext& context, const std::string& plan) {
    InputOptions options = context.session.document().options.input_options;
    options.repairs.plan = plan;
    context.actions.repairs.repair(options);
}

// Draws a button that adds steps to those that were done. All of them start from the file.
void draw_step_button(UiContext& context, const std::string& label, const std::string& words, const std::string& what) {
    const std::string& plan = context.session.document().options.input_options.repairs.plan;
    const std::string more = with_repairs(plan, words);
    const bool is_done = more == plan;
    ImGui::BeginDisabled(is_done || !context.session.repairs().can_repair());
    const std::string tip = is_done ? "This was done already" : fmt::format("{} (--repair {})", what, more);
    if (context.widgets.small_button(label.c_str(), tip.c_str())) repair_by(context, more);
    ImGui::EndDisabled();
}

void draw_wrap_button(UiContext& context) {
    InputOptions options = context.session.document().options.input_options;
    ImGui::SameLine();
    ImGui::BeginDisabled(options.wraps() || !context.session.repairs().can_repair());
    const char* tip = "A new closed surface around all of it (--surface wrap); --gap and --offset are under Parameters";
    if (context.widgets.small_button("wrap", tip)) {
        options.wrap = true;
        context.actions.repairs.repair(options);
    }
    ImGui::EndDisabled();
}

void draw_levels(UiContext& context) {
    const Palette& colors = palette(context.state.theme);
    show("Repair:", colors.dim);
    for (const RepairLevel level : {RepairLevel::exact, RepairLevel::near, RepairLevel::full}) {
        ImGui::SameLine();
        draw_step_button(context, name(level), name(level), explanation_of(level));
    }
    draw_wrap_button(context);
}

void draw_plan(UiContext& context, RepairMemory& memory) {
    const std::string& plan = context.session.document().options.input_options.repairs.plan;
    if (memory.plan_of != plan || ImGui::IsWindowAppearing()) memory.plan = memory.plan_of = plan;
    context.widgets.input_text("Steps", &memory.plan);
    explain(repair_words());
    const std::string error = error_of_plan(memory.plan);
    ImGui::BeginDisabled(!error.empty() || memory.plan == plan || !context.session.repairs().can_repair());
    const char* tip = !error.empty() ? error.c_str() : "Repairs the surface of the file by these steps";
    if (context.widgets.small_button("Repair by these", tip)) repair_by(context, memory.plan);
    ImGui::EndDisabled();
    const auto control = [&](const char* label, const char* about, bool enabled) {
        ImGui::SameLine();
        ImGui::BeginDisabled(!enabled);
        const bool pressed = context.widgets.small_button(label, about);
        ImGui::EndDisabled();
        return pressed && enabled;
    };
    if (control("Undo", "The surface before the last repair (Ctrl+Z)", context.session.repairs().can_undo()))
        context.actions.repairs.undo_repair();
    if (control("Redo", "The surface after the repair that was undone (Ctrl+Shift+Z)",
                context.session.repairs().can_redo()))
        context.actions.repairs.redo_repair();
}

void draw_before_and_after(UiContext& context) {
    const bool shows_before = context.state.node == root_node && context.state.step.stage == Stage::before_repair;
    if (context.widgets.radio("Before repairs", shows_before)) context.actions.repairs.show_before_repair(true);
    explain("The surface as the file has it, and what was wrong with it, under the same camera (key B)");
    ImGui::SameLine();
    if (context.widgets.radio("After", !shows_before)) context.actions.repairs.show_before_repair(false);
    explain("The surface as repairs have left it (key B)");
    bool colored = context.state.coloring.by == ColorBy::deviation;
    if (context.widgets.checkbox("Colour by distance", &colored,
                                 "How far each facet is from the surface before repairs, or, of that, from the surface "
                                 "after them"))
        context.state.coloring.by = colored ? ColorBy::deviation : ViewState().coloring.by;
}

// The list of actions that repairs did, a line each; the places of the one that was clicked follow.
class ActionList {
 public:
    ActionList(UiContext& context, RepairMemory& memory, const RepairReport& report)
        : context_(context), memory_(memory), report_(report), colors_(palette(context.state.theme)) {}

    void draw() {
        int number = 0;
        for (const StepReport& step : report_.steps)
            for (const RepairAction& action : step.actions)
                if (action.count > 0) draw_action(step, action, number++);
        if (number == 0) show_wrapped("These steps have found nothing to do.", colors_.dim);
        if (report_.largest_move() > 0)
            show_wrapped(fmt::format("No vertex has moved farther than {:.4g}; the bound is {:.4g}.",
                                     report_.largest_move(), report_.bound),
                         colors_.dim);
    }

 private:
    // The line of the report about an action: "stitch: 12 borders joined, ...".
    std::string words_of(const StepReport& step, const RepairAction& action) const {
        const std::string step_name = name(step.kind);
        const std::string text = to_text({report_.diagonal, report_.bound, {StepReport{step.kind, {action}}}}, "");
        return text.starts_with(step_name) ? step_name + ":" + text.substr(step_name.size()) : text;
    }

    void draw_action(const StepReport& step, const RepairAction& action, int number) {
        const bool is_refused = *action.refused_because != '\0', is_chosen = memory_.action == number;
        const std::string text = broken(words_of(step, action), ImGui::GetContentRegionAvail().x);
        const ImVec2 start = ImGui::GetCursorPos();
        const float height = ImGui::CalcTextSize(text.c_str()).y;
        ImGui::PushID(number);
        if (ImGui::Selectable("##action", is_chosen, 0, {0, height})) {
            const int last = count_of(action.places) - 1;
            fly_to(action, number, is_chosen && memory_.place < last ? memory_.place + 1 : 0);
        }
        context_.widgets.record(fmt::format("action {}", number + 1));
        explain(action.places.empty() ? "" : "A click flies to the first place, and then from place to place.");
        const ImVec2 end = ImGui::GetCursorPos();
        ImGui::SetCursorPos(start);
        show(text, is_refused ? colors_.warning : colors_.text);
        ImGui::SetCursorPos(end);
        if (memory_.action == number && action.places.size() > 1) draw_places(action, number);
        ImGui::PopID();
    }

    void draw_places(const RepairAction& action, int number) {
        constexpr int most_rows = 6;
        const int count = count_of(action.places);
        const float row = ImGui::GetTextLineHeightWithSpacing();
        ImGui::BeginChild("##places", {0, (std::min(count, most_rows) + 0.5f) * row}, true);
        ImGuiListClipper clipper;
        clipper.Begin(count, row);
        while (clipper.Step())
            for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
                const RepairPlace& place = action.places[i];
                std::string text = fmt::format("{}: ({:.5g}, {:.5g}, {:.5g})", i + 1, place.where.x(), place.where.y(),
                                               place.where.z());
                if (*action.measure != '\0') text += fmt::format(", {:.4g} {}", place.measure, action.measure);
                if (ImGui::Selectable(text.c_str(), memory_.place == i)) fly_to(action, number, i);
                context_.widgets.record(fmt::format("repaired place {}", i + 1));
            }
        ImGui::EndChild();
    }

    void fly_to(const RepairAction& action, int number, int place_number) {
        memory_.action = number;
        memory_.place = place_number;
        if (action.places.empty()) return;
        const RepairPlace& place = action.places[place_number];
        if (!place.where.allFinite()) return;
        const Document& document = context_.session.document();
        const Soup& soup = document.unrepaired ? document.unrepaired->soup : document.checked->soup;
        const std::vector<std::int32_t> facets = facets_of_file(soup, place.facets);
        const double radius = radius_around(soup, facets, place.where, report_.diagonal);
        const std::optional<Vec3> back =
            direction_to_eye(soup.vertices, soup.facets, place.where, 0.01 * radius,
                             mean_normal(soup.vertices, soup.facets, facets), context_.camera.back());
        context_.state.selection = {};
        context_.actions.camera.fly_to(place.where, radius, back.value_or(Vec3::Zero()));
    }

    UiContext& context_;
    RepairMemory& memory_;
    const RepairReport& report_;
    const Palette& colors_;
};

void draw_ending(UiContext& context, RepairMemory& memory, ParametersMemory& parameters) {
    Session& session = context.session;
    const Document& document = session.document();
    if (!document.surface_saved_as.empty())
        show_wrapped("Saved as " + document.surface_saved_as, palette(context.state.theme).dim);
    if (memory.save_of != document.path) {
        memory.save_of = document.path;
        memory.save_to = std::filesystem::path(document.path).stem().string() + "_repaired.obj";
    }
    context.widgets.input_text("Save to", &memory.save_to);
    ImGui::BeginDisabled(!session.repairs().can_repair() || memory.save_to.empty());
    if (context.widgets.small_button("Save surface",
                                     "Writes it, as kerf repair does: .obj or .vtp with patches, .ply, .off, or .stl"))
        session.repairs().save(memory.save_to);
    ImGui::EndDisabled();
    const bool has_run = document.trace || !document.folder.empty();
    if (has_run || document.has_problems() || document.progress.running) return;
    ImGui::SameLine();
    if (context.widgets.small_button("Mesh it", "Cuts and meshes the repaired surface, with the options of Parameters"))
        start_edited_run(context, parameters, document.options.volume);
}

}  // namespace

void draw_repairs_of(UiContext& context, DefectKind kind) {
    const std::span<const RepairKind> steps = repairs_for(kind);
    if (steps.empty() || !context.session.document().checked) return;
    std::string words, what;
    for (const RepairKind step : steps) {
        const RepairStepRow& row = repair_step_rows()[static_cast<std::size_t>(step)];
        words += fmt::format("{}{}", words.empty() ? "" : ",", row.name);
        what += fmt::format("{}{}", what.empty() ? "" : "; ", row.help);
    }
    ImGui::PushID(static_cast<int>(kind));
    draw_step_button(context, "Repair: " + words, words, what);
    ImGui::PopID();
}

void draw_repairs(UiContext& context, RepairMemory& memory, ParametersMemory& parameters) {
    const Document& document = context.session.document();
    const bool is_there = context.session.repairs().can_repair() || context.session.repairs().is_repairing();
    if (!is_there || !document.checked || !document.error.empty()) return;
    const auto checked = document.checked;  // a button may exchange it
    if (checked->diagnosis.defects.empty() && document.options.input_options.repairs.plan.empty() &&
        !document.unrepaired)
        return;
    draw_levels(context);
    draw_plan(context, memory);
    const bool is_repaired = document.unrepaired != nullptr;
    if (is_repaired) draw_before_and_after(context);
    if (checked->wrapped) show_wrapped("wrap: " + to_text(*checked->wrapped), palette(context.state.theme).text);
    if (!checked->ladder.steps.empty()) ActionList(context, memory, checked->ladder).draw();
    if (is_repaired) draw_ending(context, memory, parameters);
    ImGui::Spacing();
}

}  // namespace kerf::view

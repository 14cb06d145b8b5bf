// The problems of the surface: errors and notes, the repairs, and the list of defects. Defects of one kind and severity
// are a group, because they have one remedy; a click on a group lists only its defects, a click on a defect flies to it
// and turns the camera to a side from which no facet hides it. Options that a text names become buttons
// (model/advice.h) with a field where the text leaves the value to the reader; the options are checked when a value
// changes, not in every frame. A button may exchange the document while the panel is drawn, so that texts are copied,
// and the checked surface is held, before any button is drawn.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/core/ids.h"
#include "viewer/model/advice.h"
#include "viewer/model/line_of_sight.h"
#include "viewer/model/repaired_places.h"
#include "viewer/panels/inside/parts.h"

namespace kerf::view {

namespace {

const ImVec4& color_of(Severity severity, const Palette& colors) {
    return severity == Severity::error ? colors.bad : severity == Severity::warning ? colors.warning : colors.good;
}

std::string measure_of(const Defect& defect) {
    if (!std::isfinite(defect.measure)) return "";
    if (defect.kind == DefectKind::needle) return fmt::format("{:.3g} deg", defect.measure);
    if (defect.kind == DefectKind::open_edge)
        return fmt::format("{} edges, length {:.5g}", defect.facets.size(), defect.measure);
    if (defect.kind == DefectKind::short_edge) return fmt::format("length {:.3g}", defect.measure);
    return "";
}

// Draws a button that runs again with an option, or opens again a file that could not be opened, and before it a field
// for the value if the text left that to the reader.
void draw_option(UiContext& context, ProblemsMemory& memory, OptionText advice) {
    const Document& document = context.session.document();
    const bool opens = !document.error.empty();
    ImGui::PushID(advice.name.c_str());
    ImGui::BeginDisabled(document.progress.running);
    auto [found, is_new] = memory.advised.try_emplace(advice.name + " " + advice.text, AdvisedRun{advice.text, "", {}});
    AdvisedRun& run = found->second;
    if (advice.text.empty()) {
        if (is_new) run.value = usual_value(advice.name, document.options, document.checked.get());
        context.widgets.input_text(("--" + advice.name).c_str(), &run.value);
        advice.text = run.value;
    }
    if (run.value != run.made_for)
        run.options = run.value.empty() ? std::nullopt : options_with(document.options, advice);
    run.made_for = run.value;
    const std::optional<RunRequest>& options = run.options;
    const char* does = opens ? "Reads the file again" : "Checks the surface and runs again";
    const std::string tip = options ? fmt::format("{} with --{} {}", does, advice.name, advice.text)
                                    : fmt::format("Needs a value of --{}", advice.name);
    ImGui::BeginDisabled(!options);
    const std::string label = words_of(advice, opens ? "Open" : "Run") + "###run";
    if (context.widgets.small_button(label.c_str(), tip.c_str()) && options) {
        if (opens)
            context.actions.files.open_again(*options);
        else
            context.actions.runs.start_run(*options, options->volume);
    }
    ImGui::EndDisabled();
    ImGui::EndDisabled();
    ImGui::PopID();
}

// Draws a button for each option that a text advises and the run did not have. A file that could not be opened needs
// the options by which it is read. Repairs have buttons of their own where the surface is at hand.
void draw_advice(UiContext& context, ProblemsMemory& memory, const std::string& text) {
    const Document& document = context.session.document();
    const bool opens = !document.error.empty(), repairs = context.session.repairs().can_repair();
    ImGui::PushID(text.c_str());  // several texts may advise the same
    for (const OptionText& advice : advised_options(text))
        if (!is_set(document.options, advice) && (!opens || is_input_option(advice.name)) &&
            (!repairs || advice.name != "repair") && memory.drawn.insert(advice.name + " " + advice.text).second)
            draw_option(context, memory, advice);
    ImGui::PopID();
}

class ProblemList {
 public:
    ProblemList(UiContext& context, ProblemsMemory& memory, ListKeys& keys, const CheckedSoup& checked)
        : context_(context), memory_(memory), keys_(keys), checked_(checked), colors_(palette(context.state.theme)) {}

    void draw() {
        draw_groups();
        ImGui::Spacing();
        const auto& defects = checked_.diagnosis.defects;
        for (int i = 0; i < count_of(defects); ++i)
            if (memory_.group < 0 || group_of(defects[i]) == memory_.group) listed_.push_back(i);
        if (context_.widgets.small_button("Copy list", "All that is listed below, with places and remedies"))
            context_.actions.window.copy(text());
        ImGui::SameLine();
        show(fmt::format("{} listed; click to fly there", listed_.size()), colors_.dim);
        explain("Up and Down go on from there.");
        draw_entries();
    }

 private:
    // The defects of one kind and severity, which have one remedy.
    struct Group {
        const Defect* first = nullptr;
        std::int64_t count = 0;
    };
    static int group_of(const Defect& defect) {
        return static_cast<int>(defect.severity) * static_cast<int>(defect_kind_count) + static_cast<int>(defect.kind);
    }

    // The groups of the defects, errors first.
    std::map<int, Group> groups() const {
        std::map<int, Group> groups;
        for (const Defect& defect : checked_.diagnosis.defects) {
            Group& group = groups[group_of(defect)];
            if (group.count++ == 0) group.first = &defect;
        }
        for (auto& [key, group] : groups)  // of some kinds more were found than are listed
            if (group.first->severity == Severity::warning || group.first->kind == DefectKind::self_intersection)
                group.count = std::max(group.count, checked_.diagnosis.count(group.first->kind));
        return groups;
    }

    // Draws a line for each group; a click lists only its defects. The remedies of many groups would leave no room for
    // the list.
    void draw_groups() {
        const std::map<int, Group> all = groups();
        for (const auto& [key, group] : all) draw_group(key, group, all.size() <= 4 || memory_.group == key);
    }

    void draw_group(int key, const Group& group, bool with_advice) {
        const Defect& first = *group.first;
        const bool chosen = memory_.group == key;
        const std::string label = fmt::format("{} {}", name(first.severity), name(first.kind));
        if (ImGui::Selectable(("##" + label).c_str(), chosen)) memory_.group = chosen ? -1 : key;
        context_.widgets.record(label);
        explain(fmt::format("To do: {}.\n{}", advice(first),
                            chosen ? "A click lists all again." : "A click lists only these."));
        ImGui::SameLine(0, 0);
        draw_dot(first.severity);
        show(kerf::counted(group.count, first.kind), colors_.text);
        ImGui::SameLine();
        show_right(name(first.severity), color_of(first.severity, colors_));
        if (first.severity == Severity::error) {
            ImGui::Indent(1.1f * em());
            draw_repairs_of(context_, first.kind);
            ImGui::Unindent(1.1f * em());
        }
        if (!with_advice) return;
        ImGui::Indent(1.1f * em());
        show_wrapped(fmt::format("To do: {}.", advice(first)), colors_.dim);
        draw_advice(context_, memory_, advice(first));
        ImGui::Unindent(1.1f * em());
    }

    void draw_dot(Severity severity) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float r = 0.28f * em();
        ImGui::GetWindowDrawList()->AddCircleFilled({at.x + 1.3f * r, at.y + ImGui::GetTextLineHeight() / 2}, r,
                                                    packed(color_of(severity, colors_)));
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 1.1f * em());
    }

    void draw_entries() {
        constexpr float least_entries = 5;  // the list has at least so many, even where the groups take all the room
        ImGui::BeginChild("##defects", {0, std::max(ImGui::GetContentRegionAvail().y, least_entries * entry_height())},
                          true);
        if (ImGui::IsWindowHovered() && ImGui::IsMouseClicked(0)) keys_.list = ListKeys::List::defects;
        take_steps();
        ImGuiListClipper clipper;
        clipper.Begin(count_of(listed_), entry_height() + ImGui::GetStyle().ItemSpacing.y);
        while (clipper.Step())
            for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) draw_entry(listed_[i]);
        const bool scrolls = memory_.frames_to_scroll > 0;
        if (scrolls) show_chosen();
        ImGui::EndChild();
        if (!scrolls) return;
        --memory_.frames_to_scroll;
        ImGui::SetScrollHereY(1);
    }

    // The selection below takes room of the list when it opens.
    void show_chosen() {
        const auto at = std::find(listed_.begin(), listed_.end(), memory_.chosen);
        const float height = entry_height() + ImGui::GetStyle().ItemSpacing.y;
        if (at != listed_.end()) scroll_to_row(static_cast<float>(at - listed_.begin()) * height, 2 * height);
    }

    // Goes on in the list as far as keys have asked for, and brings the entry into sight.
    void take_steps() {
        const int steps = listed_.empty() ? 0 : keys_.take(ListKeys::List::defects);
        if (steps == 0) return;
        const std::int64_t last = std::ssize(listed_) - 1;
        const auto at = std::find(listed_.begin(), listed_.end(), memory_.chosen);
        const std::int64_t next =
            at == listed_.end() ? 0 : std::clamp<std::int64_t>(at - listed_.begin() + steps, 0, last);
        fly_to(listed_[next]);
    }

    static float entry_height() { return 2 * ImGui::GetTextLineHeight() + 0.2f * em(); }

    void draw_entry(int index) {
        const Defect& defect = checked_.diagnosis.defects[index];
        ImGui::PushID(index);
        const ImVec2 start = ImGui::GetCursorPos();
        if (ImGui::Selectable("##defect", memory_.chosen == index, 0, {0, entry_height()})) fly_to(index);
        context_.widgets.record(fmt::format("defect {}", index + 1));
        const ImVec2 end = ImGui::GetCursorPos();
        const std::string where = place(defect, checked_.soup);
        if (ImGui::IsItemHovered())
            explain(fmt::format("{}: {}.\nTo do: {}.", name(defect.kind), where, advice(defect)));
        ImGui::SetCursorPos(start);
        draw_dot(defect.severity);
        show(name(defect.kind), colors_.text);
        ImGui::SameLine();
        show_right(measure_of(defect), colors_.dim);
        ImGui::SetCursorPos({start.x + 1.1f * em(), start.y + ImGui::GetTextLineHeight() + 0.1f * em()});
        show(shortened(where, ImGui::GetContentRegionAvail().x), colors_.dim);
        ImGui::SetCursorPos(end);
        ImGui::PopID();
    }

    void fly_to(int index) {
        const Defect& defect = checked_.diagnosis.defects[index];
        memory_.chosen = index;
        memory_.frames_to_scroll = 3;  // two until the selection has its room, and one more
        if (!defect.where.allFinite()) return;
        const Soup& soup = checked_.soup;
        const double radius =
            radius_around(soup, defect.facets, defect.where, diagonal_of(context_.session.document()));
        const Vec3 outward = mean_normal(soup.vertices, soup.facets, defect.facets);
        const std::optional<Vec3> back =
            direction_to_eye(soup.vertices, soup.facets, defect.where, 0.01 * radius, outward, context_.camera.back());
        context_.actions.camera.fly_to(defect.where, radius, back.value_or(Vec3::Zero()));
        context_.state.selection = {Selection::Kind::defect, context_.state.node, index, defect.where};
    }

    std::string text() const {
        std::string all;
        for (const int i : listed_) {
            const Defect& defect = checked_.diagnosis.defects[i];
            const std::string measure = measure_of(defect);
            all += fmt::format("{} {}: {}{}{}; {}.\n", name(defect.severity), name(defect.kind),
                               place(defect, checked_.soup), measure.empty() ? "" : ", ", measure, advice(defect));
        }
        return all;
    }

    UiContext& context_;
    ProblemsMemory& memory_;
    ListKeys& keys_;
    const CheckedSoup& checked_;
    const Palette& colors_;
    std::vector<int> listed_;  // indices of defects
};

void draw_message(const char* head, const std::string& text, const Palette& colors) {
    show_wrapped(head, colors.bad);
    show_wrapped(text, colors.text);
    ImGui::Spacing();
}

void draw_remarks(UiContext& context, ProblemsMemory& memory) {
    const Document& document = context.session.document();
    const Palette& colors = palette(context.state.theme);
    if (!document.error.empty()) {
        draw_message((document.title + " could not be opened.").c_str(), document.error, colors);
        draw_advice(context, memory, std::string(document.error));
        show_wrapped("Correct the file and press Ctrl+R, or open another one with Ctrl+O.", colors.dim);
    }
    if (!document.progress.running && !document.progress.message.empty())
        draw_message("The run has ended.", document.progress.message, colors);
    // A run that is started here changes what the document says.
    const std::string message = document.progress.message;
    const std::vector<std::string> notes = document.notes;
    draw_advice(context, memory, message);
    for (const std::string& note : notes) {
        show_wrapped("Note: " + note, colors.dim);
        draw_advice(context, memory, note);
    }
    if (!notes.empty()) ImGui::Spacing();
}

}  // namespace

void draw_problems(UiContext& context, ProblemsMemory& memory, Dialogs& dialogs) {
    const Document& document = context.session.document();
    const Palette& colors = palette(context.state.theme);
    if (std::string key = key_of(document); memory.advised_for != key) {
        memory.advised_for = std::move(key);
        memory.advised.clear();
    }
    memory.drawn.clear();
    if (memory.of != document.checked.get()) {
        memory.of = document.checked.get();
        memory.group = memory.chosen = memory.repairs.action = memory.repairs.place = -1;
    }
    if (document.checked && document.error.empty()) {
        const bool clean = document.checked->diagnosis.clean();
        show_wrapped(clean ? "This surface can be meshed." : "This surface cannot be meshed as it is.",
                     clean ? colors.good : colors.bad);
        ImGui::Spacing();
    }
    draw_remarks(context, memory);
    draw_repairs(context, memory.repairs, dialogs.parameters);
    const auto checked = document.checked;  // a button may exchange it
    if (checked && !checked->diagnosis.defects.empty()) ProblemList(context, memory, dialogs.list, *checked).draw();
}

}  // namespace kerf::view

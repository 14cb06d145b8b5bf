// The timeline of a node: buttons that go through steps and nodes, the text of the present step, and a row of steps. A
// stage is a button as wide as its words, a refused try a red tick between its neighbours. Where words and ticks do not
// fit, ticks lie in a strip above, which may make them narrower than a pixel; where the words alone do not fit, they
// are broken into two rows of about equal length. During a guided tour the bar shows the tour's text and buttons, and
// the steps only if they fit into one row; a click on a step is then a stop of the tour.
#include <algorithm>

#include <fmt/format.h>

#include "base/core/ids.h"
#include "viewer/panels/inside/icons.h"
#include "viewer/panels/inside/parts.h"

namespace kerf::view {

namespace {

class TimelineBar {
 public:
    TimelineBar(UiContext& context, TimelineMemory& memory, Dialogs& dialogs)
        : context_(context),
          memory_(memory),
          dialogs_(dialogs),
          steps_(context.steps),
          colors_(palette(context.state.theme)),
          current_(nearest_step(steps_, context.state.step)) {}

    void draw() {
        if (dialogs_.tour.node != no_node) {
            draw_tour(context_, dialogs_);
            const bool has_room = width_of_buttons() <= ImGui::GetContentRegionAvail().x;  // for the steps in one row
            if (has_room) draw_steps();
            return;
        }
        draw_controls();
        draw_heading();
        draw_text();
        draw_steps();
    }

 private:
    static float step_height() { return 1.9f * em(); }
    void show_step(std::size_t index) {
        const Step& step = steps_[index];
        if (dialogs_.tour.node != no_node && step.refused_try < 0 && step.stage >= Stage::input)
            dialogs_.tour.go_to = TourStop{step.stage};
        else
            context_.state.step = step;
    }

    bool control(const char* label, Icon icon, const char* tip, bool enabled = true) {
        ImGui::BeginDisabled(!enabled);
        const ImVec4& color = enabled ? colors_.accent : colors_.dim;
        const bool pressed = icon_button(context_.widgets, label, icon, 1.5f * em(), packed(color), tip);
        ImGui::EndDisabled();
        ImGui::SameLine(0, 0.1f * em());
        return pressed;
    }

    void draw_controls() {
        const bool playing = context_.facts.playing;
        if (control("previous step", Icon::left, "Previous step (left arrow)", current_ > 0)) show_step(current_ - 1);
        if (control("play", playing ? Icon::pause : Icon::play, playing ? "Pause (space)" : "Play all steps (space)"))
            context_.actions.play.toggle_play();
        if (control("next step", Icon::right, "Next step (right arrow)", current_ + 1 < steps_.size()))
            show_step(current_ + 1);
        const Tree& tree = context_.session.document().tree;
        const NodeId node = context_.state.node, before = next_node(tree, node, -1), after = next_node(tree, node, 1);
        ImGui::SameLine(0, 0.6f * em());
        if (control("previous node", Icon::up, "Previous node (up arrow)", before != node))
            go_to_node(context_, before);
        if (control("next node", Icon::down, "Next node (down arrow)", after != node)) go_to_node(context_, after);
        ImGui::SameLine(0, 0.6f * em());
    }

    // Draws the title of the step beside the buttons, and buttons for places of a refused try and for missing stages.
    void draw_heading() {
        ImGui::AlignTextToFramePadding();
        show(fmt::format("Node {}: {}", context_.state.node.value(), title(steps_[current_])), colors_.text);
        draw_places();
        if (!has_no_stages(context_.session.document(), context_.state.node)) return;
        ImGui::SameLine(0, 1.2f * em());
        show("No stages were recorded.", colors_.warning);
        ImGui::SameLine(0, 0.6f * em());
        if (context_.widgets.button("Re-run cut",
                                    "Makes all cuts again, in another process, and records their stages; "
                                    "the parts are not meshed"))
            record_stages(context_);
    }

    // Draws buttons that go from place to place where a try has failed.
    void draw_places() {
        const Step& step = steps_[current_];
        const std::vector<FailurePlace> places = failure_places(context_.session.document(), context_.state.node, step);
        if (places.empty()) return;
        if (memory_.node != context_.state.node || memory_.step != step ||
            memory_.chosen >= count_of(places))  // a cut that was made again has others
            memory_.chosen = -1;
        memory_.node = context_.state.node;
        memory_.step = step;
        const int count = count_of(places), chosen = memory_.chosen;
        ImGui::SameLine(0, 1.2f * em());
        if (control("previous place", Icon::left, "Fly to the place before", chosen > 0)) fly_to(places, chosen - 1);
        if (control("next place", Icon::right, "Fly to the next place where it failed", chosen + 1 < count))
            fly_to(places, chosen + 1);
        ImGui::AlignTextToFramePadding();
        show(chosen < 0 ? number_of(count, "place") : fmt::format("place {} of {}", chosen + 1, count), colors_.dim);
    }

    void fly_to(const std::vector<FailurePlace>& places, int index) {
        memory_.chosen = index;
        const FailurePlace& place = places[index];
        const double diagonal = diagonal_of(context_.session.document());
        context_.actions.camera.fly_to(place.where, place.radius > 0 ? 1.5 * place.radius : 0.02 * diagonal,
                                       Vec3::Zero());
    }

    void draw_text() {
        const Step& step = steps_[current_];
        show_wrapped(describe_step(context_.session.document(), context_.state.node, step),
                     step.refused_try >= 0 ? colors_.bad : colors_.dim);
    }

    static float width_of_button(const Step& step) { return width_of(title(step)) + 0.5f * em(); }
    float width_of_buttons() const {
        float width = 0;
        for (const Step& step : steps_)
            if (step.refused_try < 0) width += width_of_button(step);
        return width;
    }

    // A row of steps: as wide as their words, and wider where there is room.
    struct StepRow {
        std::size_t first = 0, last = 0;  // indices in `steps_`, `last` one behind the end
        float words = 0;                  // their width without additional room, in pixels
        float stages = 0;                 // number of steps that are no refused tries
    };
    // The steps in one row, or in two where the words need more room. `tick`: width of each refused try between them.
    std::vector<StepRow> rows_of_steps(float room, float tick) const {
        std::vector<StepRow> rows(1);
        float all = 0;
        for (const Step& step : steps_) all += step.refused_try < 0 ? width_of_button(step) : tick;
        for (std::size_t i = 0; i < steps_.size(); ++i) {
            const bool is_stage = steps_[i].refused_try < 0;
            const float width = is_stage ? width_of_button(steps_[i]) : tick;
            if (all > room && rows.size() == 1 && rows[0].words + width > std::min(room, all / 2 + 3 * em()))
                rows.push_back({i, i, 0, 0});
            rows.back().last = i + 1;
            rows.back().words += width;
            rows.back().stages += is_stage ? 1.f : 0.f;
        }
        return rows;
    }

    // Draws the steps. Refused tries lie between their neighbours as long as there is room, else in a strip of their
    // own above.
    void draw_steps() {
        const float tries =
            std::count_if(steps_.begin(), steps_.end(), [](const Step& step) { return step.refused_try >= 0; });
        const float room = ImGui::GetContentRegionAvail().x, words = width_of_buttons();
        const bool apart = words + 0.6f * em() * tries > room;
        const float tick = tries > 0 ? std::min(0.9f * em(), (apart ? room : room - words) / tries) : 0;
        const std::vector<StepRow> rows = rows_of_steps(room, apart ? 0 : tick);
        const float height = rows.size() > 1 ? 1.4f * em() : step_height();
        const float bottom = ImGui::GetWindowPos().y + ImGui::GetWindowHeight() - ImGui::GetStyle().WindowPadding.y;
        const ImVec2 start = {ImGui::GetCursorScreenPos().x, bottom - height * rows.size()};
        float y = start.y, tick_x = start.x;
        for (const StepRow& row : rows) {
            const float left = room - row.words;
            const float more = row.stages > 0 ? std::clamp(left / row.stages, 0.f, 3 * em()) : 0;
            const float scale = left < 0 ? room / row.words : 1;
            float x = start.x;
            for (std::size_t i = row.first; i < row.last; ++i) {
                const bool refused = steps_[i].refused_try >= 0;
                const float width = refused ? tick : scale * width_of_button(steps_[i]) + more;
                if (refused && apart)
                    draw_step(i, {tick_x, start.y - 0.8f * em()}, {tick_x + tick, start.y});
                else
                    draw_step(i, {x, y}, {x + width, y + height});
                (refused && apart ? tick_x : x) += width;
            }
            y += height;
        }
    }

    void draw_step(std::size_t index, const ImVec2& from, const ImVec2& to) {
        const Step& step = steps_[index];
        const bool refused = step.refused_try >= 0;
        const std::string label = "step " + name(step);
        ImGui::SetCursorScreenPos(from);
        if (ImGui::InvisibleButton(("##" + label).c_str(), {std::max(1.f, to.x - from.x), to.y - from.y}))
            show_step(index);
        context_.widgets.record(label);
        const bool hovered = ImGui::IsItemHovered();
        if (hovered && !explained_) explain_step(step);  // ticks may be narrower than a pixel
        explained_ |= hovered;
        refused ? draw_try(from, to, index == current_, hovered) : draw_stage(step, from, to, index, hovered);
    }

    void explain_step(const Step& step) {
        explain(title(step) + "\n" + describe_step(context_.session.document(), context_.state.node, step));
    }

    // Draws a refused try: a red tick, taller if it is the current one.
    void draw_try(const ImVec2& from, const ImVec2& to, bool current, bool hovered) {
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const float x = (from.x + to.x) / 2, inset = (current || hovered ? 0.05f : 0.28f) * (to.y - from.y);
        const float half = std::max(0.5f, std::min(0.22f * em(), 0.35f * (to.x - from.x)));
        list.AddRectFilled({x - half, from.y + inset}, {x + half, to.y - inset},
                           packed(current ? colors_.bad : faded(colors_.bad, hovered ? 0.8f : 0.55f)), half);
    }

    // Draws a stage. Those up to the current one are tinted, as in a progress bar.
    void draw_stage(const Step& step, const ImVec2& from, const ImVec2& to, std::size_t index, bool hovered) {
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const bool current = index == current_;
        const ImVec4 ground = current            ? colors_.accent
                              : hovered          ? faded(colors_.accent, 0.35f)
                              : index < current_ ? faded(colors_.accent, 0.2f)
                                                 : colors_.frame;
        list.AddRectFilled({from.x + 1, from.y}, {to.x - 1, to.y}, packed(ground), 0.2f * em());
        const std::string text = shortened(title(step), to.x - from.x - 0.2f * em());
        const ImVec2 size = ImGui::CalcTextSize(text.c_str());
        list.AddText({(from.x + to.x - size.x) / 2, (from.y + to.y - size.y) / 2},
                     packed(current ? colors_.on_accent : colors_.text), text.c_str());
    }

    UiContext& context_;
    TimelineMemory& memory_;
    Dialogs& dialogs_;
    const std::vector<Step>& steps_;
    const Palette& colors_;
    std::size_t current_;
    bool explained_ = false;
};

}  // namespace

// Every run that is started here leaves a trace. The open folder stays as it is.
void record_stages(UiContext& context) {
    RunRequest options = context.session.document().options;
    options.output.clear();
    options.outputs.trace_file.clear();
    context.actions.runs.start_run(options, false);
}

void draw_timeline(UiContext& context, TimelineMemory& memory, Dialogs& dialogs) {
    TimelineBar(context, memory, dialogs).draw();
}

}  // namespace kerf::view

#include <algorithm>

#include <fmt/format.h>

#include "viewer/panels/icons.h"
#include "viewer/panels/parts.h"

namespace kerf::view {

namespace {

class TimelineBar {
 public:
    explicit TimelineBar(UiContext& context)
        : context_(context),
          steps_(context.steps),
          colors_(palette(context.state.theme)),
          current_(steps_.empty() ? 0 : nearest_step(steps_, context.state.step)) {}

    void draw() {
        draw_controls();
        draw_description();
        ImGui::SetCursorPosY(ImGui::GetWindowHeight() - ImGui::GetStyle().WindowPadding.y - step_height());
        draw_steps();
    }

 private:
    static float step_height() { return 1.9f * em(); }
    void show_step(std::size_t index) { context_.state.step = steps_[index]; }

    bool control(const char* label, Icon icon, const char* tip, bool enabled = true) {
        ImGui::BeginDisabled(!enabled);
        const ImVec4& color = enabled ? colors_.accent : colors_.dim;
        const bool pressed = icon_button(context_.widgets, label, icon, 1.5f * em(), packed(color), tip);
        ImGui::EndDisabled();
        ImGui::SameLine(0, 0.1f * em());
        return pressed;
    }

    void draw_controls() {
        const bool playing = context_.facts.playing, any = !steps_.empty();
        if (control("previous step", Icon::left, "Previous step (left arrow)", any && current_ > 0))
            show_step(current_ - 1);
        if (control("play", playing ? Icon::pause : Icon::play, playing ? "Pause (space)" : "Play all steps (space)"))
            context_.actions.toggle_play();
        if (control("next step", Icon::right, "Next step (right arrow)", any && current_ + 1 < steps_.size()))
            show_step(current_ + 1);
        const Tree& tree = context_.session.document().tree;
        const NodeId node = context_.state.node, before = next_node(tree, node, -1), after = next_node(tree, node, 1);
        ImGui::SameLine(0, 0.6f * em());
        if (control("previous node", Icon::up, "Previous node (up arrow)", before != node))
            go_to_node(context_, before);
        if (control("next node", Icon::down, "Next node (down arrow)", after != node)) go_to_node(context_, after);
        ImGui::SameLine(0, 0.6f * em());
    }

    void draw_description() {
        if (steps_.empty()) return show("This node has not been cut.", colors_.dim);
        const Step& step = steps_[current_];
        const bool refused = step.refused_try >= 0;
        ImGui::BeginGroup();
        show(fmt::format("Node {}: {}", context_.state.node, title(step)), colors_.text);
        const std::string text = describe_step(context_.session.document(), context_.state.node, step);
        show(shortened(text, ImGui::GetContentRegionAvail().x), refused ? colors_.bad : colors_.dim);
        explain(text);
        ImGui::EndGroup();
    }

    static float width_of_button(const Step& step) { return width_of(title(step)) + 0.5f * em(); }
    float width_of_buttons() const {
        float width = 0;
        for (const Step& step : steps_)
            if (step.refused_try < 0) width += width_of_button(step);
        return width;
    }

    // Refused tries lie between their neighbours as long as there is room, else in a strip of their own above.
    void draw_steps() {
        const auto tries = static_cast<float>(
            std::count_if(steps_.begin(), steps_.end(), [](const Step& step) { return step.refused_try >= 0; }));
        const float stages = static_cast<float>(steps_.size()) - tries;
        const float room = ImGui::GetContentRegionAvail().x;
        const float words = width_of_buttons();
        const bool apart = words + 0.6f * em() * tries > room;
        const float tick = tries > 0 ? std::min(0.9f * em(), (apart ? room : room - words) / tries) : 0;
        const float left = room - words - (apart ? 0 : tick * tries);  // makes all of them wider, or narrower
        const float more = stages > 0 ? std::clamp(left / stages, 0.f, 3 * em()) : 0;
        const float scale = left < 0 ? 1 + left / words : 1;
        const ImVec2 start = ImGui::GetCursorScreenPos();
        float x = start.x, tick_x = start.x;
        for (std::size_t i = 0; i < steps_.size(); ++i) {
            if (steps_[i].refused_try < 0) {
                const float width = scale * width_of_button(steps_[i]) + more;
                draw_step(i, {x, start.y}, {x + width, start.y + step_height()});
                x += width;
            } else {
                float& at = apart ? tick_x : x;
                const float top = apart ? start.y - 0.95f * em() : start.y;
                draw_step(i, {at, top}, {at + tick, apart ? start.y : start.y + step_height()});
                at += tick;
            }
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

    // A red tick, taller if it is the current one.
    void draw_try(const ImVec2& from, const ImVec2& to, bool current, bool hovered) {
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const float x = (from.x + to.x) / 2, inset = (current || hovered ? 0.05f : 0.28f) * (to.y - from.y);
        const float half = std::max(0.5f, std::min(0.22f * em(), 0.35f * (to.x - from.x)));
        list.AddRectFilled({x - half, from.y + inset}, {x + half, to.y - inset},
                           packed(current ? colors_.bad : faded(colors_.bad, hovered ? 0.8f : 0.55f)), half);
    }

    // Steps up to the current one are tinted, as of a progress bar.
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
    const std::vector<Step>& steps_;
    const Palette& colors_;
    std::size_t current_;
    bool explained_ = false;
};

}  // namespace

void draw_timeline(UiContext& context) { TimelineBar(context).draw(); }

}  // namespace kerf::view

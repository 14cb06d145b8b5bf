// How a solution is drawn: its case or mode, its deformation and how that moves, lines and arrows.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/core/ids.h"
#include "viewer/panels/inside/parts.h"

namespace kerf::view {

namespace {

constexpr double most_of_good = 4;  // the slider ends at so many times the deformation that is well seen

void draw_cases(UiContext& context, const Solution& solution) {
    if (solution.cases.size() < 2) return;
    Deformation& deformation = context.state.deformation;
    ColorBy& color = context.state.coloring.by;
    std::vector<std::string> names;
    for (const Solution::Case& one : solution.cases) names.push_back(one.title());
    deformation.load_case = std::min(deformation.load_case, count_of(names) - 1);
    context.widgets.combo(solution.has_modes() ? "Case or mode" : "Case", &deformation.load_case, names);
    if (solution.cases[deformation.load_case].is_mode() && needs_load_case(color))
        color = ColorBy::displacement;  // a mode has nothing else
}

void draw_motion(UiContext& context) {
    Deformation& deformation = context.state.deformation;
    static const std::vector<std::string> titles = {"Still", "To both sides", "From nothing to all"};
    int motion = static_cast<int>(deformation.motion);
    if (context.widgets.combo("Motion", &motion, titles)) deformation.motion = static_cast<Motion>(motion);
    if (deformation.motion == Motion::still) return;
    context.widgets.slider("Phase", &deformation.phase, 0, 1);
    context.widgets.slider("Speed", &deformation.speed, 0.1, 2, "%.1f / s");
}

void draw_deformation(UiContext& context, const Solution& solution) {
    Deformation& deformation = context.state.deformation;
    const std::size_t number = deformation.load_case;
    const double diagonal = context.session.document().box.diagonal().norm();
    const double good =
        number < solution.cases.size() ? good_deformation(solution.cases[number].largest_displacement, diagonal) : 0;
    context.widgets.input_number("Deform", &deformation.factor);
    if (good > 0)
        context.widgets.slider("Amount", &deformation.factor, std::min(0., deformation.factor),
                               std::max(most_of_good * good, deformation.factor), "%.4g x");
    if (context.widgets.button("Auto", "So that the largest displacement is well seen") && good > 0)
        deformation.factor = good;
    ImGui::SameLine();
    if (context.widgets.button(context.facts.moving ? "Pause" : "Play", "The deformation moves")) {
        if (deformation.factor == 0) deformation.factor = good;
        context.actions.play.toggle_motion();
    }
    if (deformation.factor != 0) draw_motion(context);
}

}  // namespace

void draw_solution(UiContext& context) {
    ViewState& state = context.state;
    const Document& document = context.session.document();
    if (!document.solution) return;
    draw_cases(context, *document.solution);
    draw_deformation(context, *document.solution);
    const float half = ImGui::GetContentRegionAvail().x / 2;
    context.widgets.checkbox("Vectors", &state.deformation.vectors, "Displacements as arrows");
    if (!is_at_vertices(state.coloring.by)) return;
    context.widgets.checkbox("Isolines", &state.coloring.isolines,
                             "Lines where values are alike, at tenths of the range");
    if (!state.coloring.isolines) return;
    ImGui::SameLine(half);
    context.widgets.checkbox("Numbers on lines", &state.look.numbers, "The values of the lines");
}

}  // namespace kerf::view

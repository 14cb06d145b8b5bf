#include "surface/repair/repair_report.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/core/number_text.h"
#include "surface/repair/repair_step.h"

namespace kerf {

void RepairAction::add(RepairPlace place) {
    ++count;
    if (places.size() < most_places) places.push_back(std::move(place));
}

RepairAction refused_action(const char* one, const char* many, const char* measure, const char* because) {
    RepairAction action{one, many, measure};
    action.refused_because = because;
    return action;
}

bool StepReport::changed() const {
    return std::any_of(actions.begin(), actions.end(), [](const RepairAction& action) {
        return action.count > 0 && action.changes_surface && *action.refused_because == '\0';
    });
}

bool RepairReport::changed() const {
    const auto has_changed = [](const StepReport& step) { return step.changed(); };
    return std::any_of(preparations.begin(), preparations.end(), has_changed) ||
           std::any_of(steps.begin(), steps.end(), has_changed);
}

double RepairReport::largest_move() const {
    double largest = 0;
    for (const StepReport& step : steps) largest = std::max(largest, step.largest_move);
    return largest;
}

std::int64_t RepairReport::done_by(RepairKind kind) const {
    std::int64_t count = 0;
    for (const StepReport& step : is_preparation(kind) ? preparations : steps)
        for (const RepairAction& action : step.actions)
            if (step.kind == kind && *action.refused_because == '\0') count += action.count;
    return count;
}

StepReport RepairReport::preparation(RepairKind kind) const {
    const auto found = std::find_if(preparations.begin(), preparations.end(),
                                    [&](const StepReport& step) { return step.kind == kind; });
    return found == preparations.end() ? StepReport{kind, {}} : *found;
}

std::string to_text(const RepairAction& action) {
    std::string text = fmt::format("{} {}", grouped(action.count), action.count == 1 ? action.one : action.many);
    if (!action.places.empty()) {
        const RepairPlace& first = action.places.front();
        text += fmt::format("{} near {}", action.count == 1 ? "," : ", the first", place_text(first.where));
        if (*action.measure != '\0') text += fmt::format(", {:.6g} {}", first.measure, action.measure);
    }
    return *action.refused_because == '\0' ? text : fmt::format("{}; left: {}", text, action.refused_because);
}

std::string to_text(const RepairReport& report, const std::string& indent) {
    std::string text;
    for (const StepReport& step : report.steps)
        for (const RepairAction& action : step.actions)
            text += fmt::format("{}{:<14}{}\n", indent, name(step.kind), to_text(action));
    return text;
}

}  // namespace kerf

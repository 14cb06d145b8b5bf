#include "repair/repair_report.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "repair/repair_step.h"

namespace kerf {

void RepairAction::add(RepairPlace place) {
    ++count;
    if (places.size() < most_places) places.push_back(std::move(place));
}

bool StepReport::changed() const {
    return std::any_of(actions.begin(), actions.end(), [](const RepairAction& action) {
        return action.count > 0 && action.changes_surface && *action.refused_because == '\0';
    });
}

bool RepairReport::changed() const {
    return std::any_of(steps.begin(), steps.end(), [](const StepReport& step) { return step.changed(); });
}

double RepairReport::largest_move() const {
    double largest = 0;
    for (const StepReport& step : steps) largest = std::max(largest, step.largest_move);
    return largest;
}

std::string to_text(const RepairReport& report, const std::string& indent) {
    std::string text;
    for (const StepReport& step : report.steps)
        for (const RepairAction& action : step.actions) {
            if (action.count == 0) continue;
            text += fmt::format("{}{:<14}{} {}", indent, name(step.kind), action.count,
                                action.count == 1 ? action.one : action.many);
            if (!action.places.empty()) {
                const RepairPlace& place = action.places.front();
                text += fmt::format("{} near ({:.9g}, {:.9g}, {:.9g})", action.count == 1 ? "," : ", the first",
                                    place.where.x(), place.where.y(), place.where.z());
                if (*action.measure != '\0') text += fmt::format(", {:.6g} {}", place.measure, action.measure);
            }
            if (*action.refused_because != '\0') text += fmt::format("; left: {}", action.refused_because);
            text += '\n';
        }
    return text;
}

}  // namespace kerf

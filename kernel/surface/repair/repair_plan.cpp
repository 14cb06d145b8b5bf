// A plan is parsed word by word, from left to right, by the table of steps (surface/repair/repair_step.h), which also
// makes the words of help and errors: a new step needs nothing here. A level adds only steps that the plan does not
// have, so that an amount given before it stays; "no-NAME" takes out the step if it is there by then, so that it must
// follow the level. Steps are kept ascending by kind, which is the order in which they are done.
#include "surface/repair/repair_plan.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/core/error.h"
#include "surface/repair/repair_step.h"

namespace kerf {

namespace {

constexpr std::array level_names = {"none", "exact", "near", "full"};
static_assert(level_names.size() == static_cast<std::size_t>(RepairLevel::full) + 1);

class PlanParser {
 public:
    explicit PlanParser(std::string_view option) : option_(option) {}

    void take(std::string_view word) {
        const std::size_t equals = word.find('=');
        const std::string_view key = word.substr(0, equals);
        const std::string_view value = equals == std::string_view::npos ? "" : word.substr(equals + 1);
        const bool has_value = equals != std::string_view::npos;
        if (const auto level = std::find(level_names.begin(), level_names.end(), key);
            level != level_names.end() && !has_value)
            add_level(static_cast<RepairLevel>(level - level_names.begin()));
        else if (key == "bound" && has_value)
            plan_.bound = length(key, value);
        else if (key == "bodies" && (value == "unite" || value == "regions"))
            plan_.bodies = value == "unite" ? BodyRepair::unite : BodyRepair::regions;
        else if (!take_step(key, value, has_value))
            throw Error(ErrorCode::usage,
                        fmt::format("--{} has '{}', which is no repair. {}", option_, word, repair_words()));
    }

    RepairPlan plan() { return std::move(plan_); }

 private:
    void add_level(RepairLevel level) {
        for (const RepairStep& step : plan_of(level).steps)
            if (plan_.find(step.kind) == nullptr) plan_.put(step);
    }
    bool take_step(std::string_view key, std::string_view value, bool has_value) {
        const bool leaves_out = key.starts_with("no-") && !has_value;
        if (leaves_out) key.remove_prefix(3);
        for (const RepairStepRow& row : rows_with_words()) {
            if (row.name != key || (has_value && row.amount == AmountKind::none)) continue;
            RepairStep step{row.kind};
            if (has_value && row.amount == AmountKind::length) step.amount = length(key, value);
            if (has_value && row.amount == AmountKind::count) step.amount = count(key, value);
            if (leaves_out)
                std::erase_if(plan_.steps, [&](const RepairStep& own) { return own.kind == row.kind; });
            else
                plan_.put(step);
            return true;
        }
        return false;
    }
    Length length(std::string_view key, std::string_view value) const {
        return parse_length(named(key), value,
                            {"a positive length in units of the input, or with % of its diagonal", 0,
                             std::numeric_limits<double>::infinity(), false, true});
    }
    Length count(std::string_view key, std::string_view value) const {
        return parse_number<std::int32_t>(named(key), value, {"a whole number of at least 3", 3});
    }
    std::string named(std::string_view key) const { return fmt::format("{} {}", option_, key); }

    std::string_view option_;
    RepairPlan plan_;
};

}  // namespace

const char* name(RepairLevel level) { return level_names[static_cast<std::size_t>(level)]; }

const RepairStep* RepairPlan::find(RepairKind kind) const {
    const auto found =
        std::find_if(steps.begin(), steps.end(), [&](const RepairStep& step) { return step.kind == kind; });
    return found == steps.end() ? nullptr : &*found;
}

void RepairPlan::put(const RepairStep& step) {
    const auto place =
        std::find_if(steps.begin(), steps.end(), [&](const RepairStep& s) { return s.kind >= step.kind; });
    if (place != steps.end() && place->kind == step.kind)
        *place = step;
    else
        steps.insert(place, step);
}

RepairPlan plan_of(RepairLevel level) {
    RepairPlan plan;
    for (const RepairStepRow& row : repair_step_rows())
        if (row.level != RepairLevel::none && row.level <= level) plan.steps.push_back({row.kind});
    return plan;
}

RepairPlan parse_repair_plan(std::string_view option, std::string_view text) {
    PlanParser parser(option);
    while (!text.empty()) {
        const std::size_t comma = std::min(text.find(','), text.size());
        parser.take(text.substr(0, comma));
        text.remove_prefix(std::min(comma + 1, text.size()));
    }
    return parser.plan();
}

std::string repair_words() {
    std::string words = "Give none, exact, near or full, and steps: ";
    for (const RepairStepRow& row : rows_with_words())
        words += fmt::format("{}{}, ", row.name,
                             row.amount == AmountKind::none    ? ""
                             : row.amount == AmountKind::count ? "=N"
                                                               : "=TOL");
    return words + "no-STEP, bound=D, bodies=unite|regions; with commas between.";
}

}  // namespace kerf

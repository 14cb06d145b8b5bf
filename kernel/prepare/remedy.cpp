#include "prepare/remedy.h"

#include <algorithm>

#include "prepare/input_files.h"
#include "repair/repair_advice.h"
#include "repair/wrap.h"

namespace kerf {

namespace {

bool has_all_steps(const RepairPlan& plan, RepairLevel level) {
    const RepairPlan wanted = plan_of(level);
    return std::all_of(wanted.steps.begin(), wanted.steps.end(),
                       [&](const RepairStep& step) { return plan.find(step.kind) != nullptr; });
}

// Neither steps nor a wrap can compute with it.
bool is_beyond_numbers(const Diagnosis& diagnosis) {
    return std::any_of(diagnosis.defects.begin(), diagnosis.defects.end(),
                       [](const Defect& defect) { return defect.kind == DefectKind::absurd_magnitude; });
}

bool is_too_much_to_try(const CheckedSoup& checked) {
    const std::int64_t crossings = checked.diagnosis.count(DefectKind::self_intersection);
    return checked.soup.facets.size() > most_tried || crossings >= most_crossings_tried;
}

// The least level that makes it fit. Kinds do not tell: facets along a crack cross each other, which is gone once it is
// closed. `done`: what was asked for already.
std::optional<Remedy> try_levels(const InputFiles& files, const InputOptions& options, const RepairPlan& done,
                                 StageListener* listener) {
    for (RepairLevel level = RepairLevel::exact; level <= RepairLevel::full;
         level = static_cast<RepairLevel>(static_cast<int>(level) + 1)) {
        if (has_all_steps(done, level)) continue;
        InputOptions with = options;
        with.repair = name(level);
        try {
            const CheckedSoup repaired = check_files(files, with, 0, poll_of(listener));
            if (!repaired.diagnosis.clean()) continue;
            Remedy remedy{.level = level, .was_tried = true, .largest_move = repaired.ladder.largest_move()};
            for (const StepReport& step : repaired.ladder.steps)
                for (const RepairAction& action : step.actions)
                    if (action.is_loss) remedy.losses.push_back(to_text(action));
            return remedy;
        } catch (const Error& error) {  // what was repaired fits no region that is asked for
            if (error.code() != ErrorCode::input) throw;
        }
    }
    return std::nullopt;
}

Remedy wrap_remedy(const Soup& soup) {
    try {
        return {.wrap_distance = estimated_wrap_distance(soup)};
    } catch (const Error&) {  // there is nothing to wrap
        return {};
    }
}

}  // namespace

std::optional<Remedy> find_remedy(const std::string& path, const InputOptions& options, const CheckedSoup& checked,
                                  StageListener* listener) {
    if (is_beyond_numbers(checked.diagnosis)) return std::nullopt;
    if (!checked.soup.sides.empty() || checked.soup.is_of_model || checked.soup.facets.empty()) return Remedy{};
    const RepairLevel needed = level_for(checked.diagnosis);
    const RepairPlan done = repair_plan_of(options);
    if (is_too_much_to_try(checked)) {
        const bool is_more = needed != RepairLevel::none && !has_all_steps(done, needed);
        return is_more ? Remedy{.level = needed} : wrap_remedy(checked.soup);
    }
    const InputFiles files = read_input_files(path, options);
    if (options.voids == Voids::as_given && checked.diagnosis.count(DefectKind::ambiguous_shell) > 0) {
        InputOptions with = options;
        with.voids = Voids::parity;
        if (std::optional<Remedy> found = try_levels(files, with, RepairPlan{}, listener)) {
            found->takes_parity = true;
            return found;
        }
    }
    if (std::optional<Remedy> found = try_levels(files, options, done, listener)) return found;
    return wrap_remedy(checked.soup);
}

}  // namespace kerf

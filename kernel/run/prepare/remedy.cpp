// A remedy is found by trying, because kinds of defects do not tell which level of repairs helps: facets along a crack
// cross each other, which is over once the crack is closed. Each way is a set of options, checked in full on a copy of
// the files (check_files()); the first whose surface is clean wins, so ways are ordered from the least change to the
// largest. Ways that ask for nothing more than the user's options are left out. With open edges each way is tried with
// caps first, and without them if no opening takes one. If nothing helps, a wrap is proposed, with an estimate of its
// distance.
#include "run/prepare/remedy.h"

#include <algorithm>

#include "run/prepare/input_files.h"
#include "surface/repair/repair_advice.h"
#include "surface/wrap/wrap.h"

namespace kerf {

namespace {

// The plan for bodies of several files, and for bodies that do not fit each other, which stay bodies.
constexpr const char* regions_plan = "full,snap,bodies=regions";

bool are_bodies(const InputOptions& given, const Diagnosis& diagnosis) {
    return !given.more_files.empty() ||
           std::any_of(diagnosis.defects.begin(), diagnosis.defects.end(), is_between_bodies);
}

bool asks_for_more(const InputOptions& options, const InputOptions& given) {
    const RepairPlan plan = repair_plan_of(options), done = repair_plan_of(given);
    return options.voids != given.voids || (plan.bodies != BodyRepair::as_found && plan.bodies != done.bodies) ||
           std::any_of(plan.steps.begin(), plan.steps.end(),
                       [&](const RepairStep& step) { return done.find(step.kind) == nullptr; });
}

// Returns ways in the order of find_remedy(), but for caps. Kinds of defects do not tell which level helps: facets
// along a crack cross each other, which is over once it is closed.
std::vector<InputOptions> ways_to_try(const InputOptions& given, const Diagnosis& diagnosis) {
    std::vector<std::string> plans;
    if (are_bodies(given, diagnosis)) plans.emplace_back(regions_plan);
    for (const RepairLevel level : {RepairLevel::exact, RepairLevel::near, RepairLevel::full})
        plans.emplace_back(name(level));
    std::vector<Voids> voids = {given.voids};
    if (given.voids == Voids::as_given && diagnosis.count(DefectKind::ambiguous_shell) > 0)
        voids.insert(voids.begin(), Voids::parity);
    std::vector<InputOptions> ways;
    for (const Voids v : voids)
        for (const std::string& plan : plans) {
            InputOptions way = given;
            way.voids = v;
            way.repairs.plan = plan;
            if (asks_for_more(way, given)) ways.push_back(std::move(way));
        }
    return ways;
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

// The outcome of one way.
struct Trial {
    bool fits = false;
    Remedy remedy;
};

Trial try_way(const InputFiles& files, const InputOptions& way, StageListener* listener) {
    Trial trial{false, {.options = way, .was_tried = true}};
    try {
        const CheckedSoup repaired = check_files(files, way, 0, cancellation_check(listener));
        const bool is_region_missing =  // where facets part no bodies, all is united
            repair_plan_of(way).bodies == BodyRepair::regions && repaired.soup.region_names.size() < 2;
        trial.fits = repaired.diagnosis.clean() && !is_region_missing;
        trial.remedy.caps = repaired.ladder.done_by(RepairKind::caps);
        trial.remedy.options.repairs.cap = trial.remedy.caps > 0;
        trial.remedy.largest_move = repaired.ladder.largest_move();
        for (const StepReport& step : repaired.ladder.steps)
            for (const RepairAction& action : step.actions)
                if (action.is_loss) trial.remedy.losses.push_back(to_text(action));
    } catch (const Error& error) {  // the repaired surface fits no region that is asked for
        if (error.code() != ErrorCode::input) throw;
    }
    return trial;
}

Trial try_with_and_without_caps(const InputFiles& files, InputOptions way, bool may_cap, StageListener* listener) {
    if (may_cap) {
        way.repairs.cap = true;
        Trial capped = try_way(files, way, listener);
        if (capped.fits || capped.remedy.caps == 0) return capped;
        way.repairs.cap = false;
    }
    return try_way(files, way, listener);
}

Remedy wrap_remedy(const InputOptions& given, const Soup& soup) {
    Remedy remedy{.options = given};
    remedy.options.wrap = true;
    remedy.options.repairs.plan.clear();
    remedy.options.repairs.cap = false;
    if (!soup.sides.empty() || soup.is_of_model || soup.facets.empty()) return remedy;
    try {
        remedy.wrap_distance = estimated_wrap_distance(soup);
    } catch (const Error&) {  // there is nothing to wrap
    }
    return remedy;
}

// Returns a remedy by the kinds of the defects, and caps by a try of that step alone.
Remedy untried_remedy(const std::string& path, const InputOptions& given, const CheckedSoup& checked, bool may_cap,
                      StageListener* listener) {
    InputOptions way = given;
    way.repairs.plan = are_bodies(given, checked.diagnosis) ? regions_plan : name(level_for(checked.diagnosis));
    if (!asks_for_more(way, given)) return wrap_remedy(given, checked.soup);
    Remedy remedy{.options = way};
    if (!may_cap) return remedy;
    InputOptions capping = given;
    capping.repairs.cap = true;
    remedy.caps = try_way(read_input_files(path, given), capping, listener).remedy.caps;
    remedy.options.repairs.cap = remedy.caps > 0;
    return remedy;
}

}  // namespace

std::optional<Remedy> find_remedy(const std::string& path, const InputOptions& options, const CheckedSoup& checked,
                                  StageListener* listener) {
    const Diagnosis& diagnosis = checked.diagnosis;
    const Soup& soup = checked.soup;
    if (is_beyond_numbers(diagnosis)) return std::nullopt;
    if (!soup.sides.empty() || soup.is_of_model || soup.facets.empty()) return wrap_remedy(options, soup);
    const bool may_cap = !options.repairs.cap && diagnosis.count(DefectKind::open_edge) > 0;
    if (is_too_much_to_try(checked)) return untried_remedy(path, options, checked, may_cap, listener);
    const InputFiles files = read_input_files(path, options);
    for (const InputOptions& way : ways_to_try(options, diagnosis))
        if (Trial trial = try_with_and_without_caps(files, way, may_cap, listener); trial.fits)
            return std::move(trial.remedy);
    return wrap_remedy(options, soup);
}

}  // namespace kerf

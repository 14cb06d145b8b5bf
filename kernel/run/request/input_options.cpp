// Options of the input are texts where their meaning has a form of its own: steps of a repair, points of regions. They
// are parsed once, into InputChoices. All spellings of a step that mends the surface end in the one plan.
#include "run/request/input_options.h"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "base/core/error.h"

namespace kerf {

namespace {

// Returns the seed of NAME=x,y,z; the name may have any character, and the last = counts.
RegionSeed seed_of(const std::string& text) {
    const std::size_t mark = text.rfind('=');
    RegionSeed seed{text.substr(0, mark), Vec3::Zero()};
    const char *at = text.data() + (mark == std::string::npos ? text.size() : mark + 1), *const end =
                                                                                             text.data() + text.size();
    bool is_point = !seed.name.empty();
    for (int i = 0; i < 3 && is_point; ++i) {
        const auto [stop, error] = std::from_chars(at, end, seed.point[i]);
        is_point =
            error == std::errc() && std::isfinite(seed.point[i]) && (i < 2 ? stop < end && *stop == ',' : stop == end);
        at = stop + (i < 2);
    }
    if (!is_point)
        throw Error(ErrorCode::usage, fmt::format("'{}' is no value of --region. It has the form NAME=x,y,z, such as "
                                                  "cement=0,1.5,-2; coordinates are in units after --scale.",
                                                  text));
    return seed;
}

}  // namespace

InputChoices::InputChoices(const InputOptions& given)
    : options(given), seeds(seeds_of(given)), repairs(repair_plan_of(given)) {}

void take_inputs(const std::vector<std::string>& files, std::string& input, InputOptions& options) {
    if (files.empty()) return;
    input = files[0];
    options.more_files.insert(options.more_files.begin(), files.begin() + 1, files.end());
}

std::vector<std::string> files_of(const std::string& input, const InputOptions& options) {
    std::vector<std::string> files = {input};
    files.insert(files.end(), options.more_files.begin(), options.more_files.end());
    return files;
}

RepairPlan repair_plan_of(const InputOptions& options) {
    const RepairOptions& asked = options.repairs;
    RepairPlan plan = parse_repair_plan("repair", asked.plan);
    plan.are_walls = !options.regions.empty();
    plan.voids_are_parity = options.voids == Voids::parity;
    plan.outside_is_meshed = options.air.encloses();
    if (asked.weld_tolerance.number() > 0) plan.put({RepairKind::merge, asked.weld_tolerance});
    if (asked.keep_largest) plan.put({RepairKind::largest});
    if (asked.fill_hole_edges > 0) plan.put({RepairKind::span, Length(asked.fill_hole_edges)});
    if (asked.cap) plan.put({RepairKind::caps});
    if (asked.thicken.number() > 0) plan.put({RepairKind::thicken, asked.thicken});
    return plan;
}

InputOptions without_repairs(InputOptions options) {
    options.repairs = {};
    options.wrap = false;
    options.wrapping = {};
    return options;
}

std::vector<RegionSeed> seeds_of(const InputOptions& options) {
    std::vector<RegionSeed> seeds;
    for (const std::string& text : options.regions) seeds.push_back(seed_of(text));
    return seeds;
}

}  // namespace kerf

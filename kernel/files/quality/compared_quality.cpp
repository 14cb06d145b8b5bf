// Two meshes are measured with one length scale, the larger of their diagonals. One list has all measures that limits
// can name, of cells, of cells that the surface does not force, and of boundary triangles; with a mesh each comes with
// its distribution. A measure says itself which of its ends is bad, so that --fail-below and --fail-above can refuse
// the wrong one. A limit is compared with the exact least or largest value, which a distribution keeps beside its bins,
// and missed only beyond it; a mesh without such cells misses none. The region of the worst cell is found by that
// value, since the extremes of regions are percentiles 0 and 1 of the same numbers.
#include "files/quality/compared_quality.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/core/error.h"
#include "files/io/json.h"
#include "files/quality/quality_json.h"
#include "files/quality/quality_sheet.h"

namespace kerf {

ComparedQuality compare_quality(const std::string& mesh, const std::string& other) {
    const MeasurableMesh measurable(mesh);
    if (other.empty()) return {measurable.measure(measurable.diagonal()), {}};
    const MeasurableMesh beside(other);
    const double length_scale = std::max(measurable.diagonal(), beside.diagonal());
    return {measurable.measure(length_scale), beside.measure(length_scale)};
}

std::string option_name(const Measure& measure) {
    std::string name = measure.name;
    if (name.ends_with("_deg")) name.resize(name.size() - 4);
    std::replace(name.begin(), name.end(), '_', '-');
    return name;
}

namespace {

struct Named {
    std::string name;
    const Measure* measure;
    const Distribution* distribution;  // nullptr: only the measure is asked for
};

std::vector<Named> all_measures(const MeshQuality* quality) {
    std::vector<Named> all;
    for (std::size_t i = 0; i < quality_measures.size(); ++i)
        all.push_back({option_name(quality_measures[i]), &quality_measures[i],
                       quality ? &quality->cells.all.measures[i] : nullptr});
    all.push_back(
        {option_name(unforced_measure), &unforced_measure, quality ? &quality->cells.angles.unforced : nullptr});
    for (std::size_t i = 0; i < triangle_measures.size(); ++i)
        all.push_back({option_name(triangle_measures[i]), &triangle_measures[i],
                       quality ? &quality->boundary.measures[i] : nullptr});
    return all;
}

Named find_named(const MeshQuality* quality, const std::string& name) {
    std::vector<Named> all = all_measures(quality);
    const auto found = std::find_if(all.begin(), all.end(), [&](const Named& each) { return each.name == name; });
    if (found == all.end())
        throw Error(ErrorCode::usage,
                    fmt::format("'{}' is no measure of quality. There are {} (--fail-below) and {} (--fail-above).",
                                name, limit_names(BadEnd::small), limit_names(BadEnd::large)));
    return *found;
}

QualityLimit parse_limit(std::string_view text, BadEnd end) {
    const std::size_t equals = text.find('=');
    QualityLimit limit{std::string(text.substr(0, equals)), 0};
    const Measure& measure = *find_named(nullptr, limit.measure).measure;
    const char* option = measure.small_is_bad ? "--fail-below" : "--fail-above";
    if (measure.small_is_bad != (end == BadEnd::small))
        throw Error(ErrorCode::usage, fmt::format("Of {} the {} values are the bad ones: use {}.", limit.measure,
                                                  measure.small_is_bad ? "small" : "large", option));
    const std::string_view number = equals == text.npos ? std::string_view() : text.substr(equals + 1);
    const auto [rest, error] = std::from_chars(number.data(), number.data() + number.size(), limit.value);
    if (error != std::errc() || rest != number.data() + number.size() || !std::isfinite(limit.value))
        throw Error(ErrorCode::usage, fmt::format("{} needs a number behind {}, as in {} {}=5, not '{}'.", option,
                                                  limit.measure, option, limit.measure, number));
    return limit;
}

// Returns a sentence with the region of the worst cell, if there are several: " It is in the region 'bone'."
std::string region_of_worst(const MeshQuality& quality, const Measure& measure, double worst) {
    const auto found = std::find_if(quality_measures.begin(), quality_measures.end(),
                                    [&](const Measure& each) { return &each == &measure; });
    if (found == quality_measures.end()) return "";
    const std::size_t i = found - quality_measures.begin();
    for (const RegionQuality& region : quality.regions)
        if ((measure.small_is_bad ? region.measures[i].front() : region.measures[i].back()) == worst)
            return fmt::format(" It is in the region '{}'.", region.name);
    return "";
}

}  // namespace

std::string limit_names(BadEnd end) {
    std::string names;
    for (const Named& each : all_measures(nullptr))
        if (each.measure->small_is_bad == (end == BadEnd::small)) names += (names.empty() ? "" : ", ") + each.name;
    return names;
}

std::vector<QualityLimit> parse_limits(std::string_view list, BadEnd end) {
    std::vector<QualityLimit> limits;
    while (!list.empty()) {
        const std::size_t comma = std::min(list.size(), list.find(','));
        limits.push_back(parse_limit(list.substr(0, comma), end));
        list.remove_prefix(std::min(list.size(), comma + 1));
    }
    return limits;
}

std::vector<std::string> missed_limits(const MeshQuality& quality, const std::vector<QualityLimit>& limits,
                                       BadEnd end) {
    std::vector<std::string> missed;
    for (const QualityLimit& limit : limits) {
        const Named named = find_named(&quality, limit.measure);
        const double worst = end == BadEnd::small ? named.distribution->min() : named.distribution->max();
        const bool holds = end == BadEnd::small ? worst >= limit.value : worst <= limit.value;
        if (named.distribution->count() == 0 || holds) continue;
        missed.push_back(fmt::format("The worst {} is {:.6g}{}{}, {} the limit {:.6g}.", named.measure->title, worst,
                                     *named.measure->unit ? " " : "", named.measure->unit,
                                     end == BadEnd::small ? "below" : "above", limit.value) +
                         region_of_worst(quality, *named.measure, worst));
    }
    return missed;
}

QualityGate QualityGate::parse(std::string_view fail_below, std::string_view fail_above) {
    return {parse_limits(fail_below, BadEnd::small), parse_limits(fail_above, BadEnd::large)};
}

std::vector<std::string> QualityGate::missed_by(const MeshQuality& quality) const {
    std::vector<std::string> missed = missed_limits(quality, below, BadEnd::small);
    for (std::string& sentence : missed_limits(quality, above, BadEnd::large)) missed.push_back(std::move(sentence));
    return missed;
}

std::string to_json(const ComparedQuality& quality, const std::vector<std::string>& missed) {
    nlohmann::ordered_json json = quality_json(quality.mesh);
    if (quality.other) json["compared_with"] = quality_json(*quality.other);
    json["missed_limits"] = missed;
    return json_text(json, 2) + "\n";
}

std::string to_text(const ComparedQuality& quality, QualityDetail detail) {
    return quality.other ? comparison_text(quality.mesh, *quality.other, detail) : quality_text(quality.mesh, detail);
}

std::string to_picture(const ComparedQuality& quality) {
    return quality.other ? comparison_sheet(quality.mesh, *quality.other) : quality_sheet(quality.mesh);
}

}  // namespace kerf

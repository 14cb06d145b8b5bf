#include "files/quality/compared_quality.h"

#include <algorithm>

#include <nlohmann/json.hpp>

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

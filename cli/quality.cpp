#include "cli/quality.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "io/output_file.h"
#include "io/standard_streams.h"
#include "quality/measured_mesh.h"
#include "quality/quality_gate.h"
#include "quality/quality_json.h"
#include "quality/quality_sheet.h"
#include "quality/quality_text.h"

namespace kerf {

namespace {

using Json = nlohmann::ordered_json;

struct Compared {
    MeshQuality mesh;
    std::optional<MeshQuality> other;
};

Compared measure(const QualityRequest& request) {
    const MeasurableMesh mesh(request.mesh);
    if (request.compare.empty()) return {mesh.measure(mesh.diagonal()), {}};
    const MeasurableMesh other(request.compare);
    const double length_scale = std::max(mesh.diagonal(), other.diagonal());
    return {mesh.measure(length_scale), other.measure(length_scale)};
}

std::vector<std::string> missed_by(const MeshQuality& quality, const std::vector<QualityLimit>& below,
                                   const std::vector<QualityLimit>& above) {
    std::vector<std::string> missed = missed_limits(quality, below, BadEnd::small);
    for (std::string& sentence : missed_limits(quality, above, BadEnd::large)) missed.push_back(std::move(sentence));
    return missed;
}

std::string json_text(const Compared& compared, const std::vector<std::string>& missed) {
    Json json = quality_json(compared.mesh);
    if (compared.other) json["compared_with"] = quality_json(*compared.other);
    json["missed_limits"] = missed;
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string text_of(const Compared& compared, const QualityRequest& request) {
    const QualityDetail detail = request.verbose ? QualityDetail::all : QualityDetail::brief;
    const std::string text =
        compared.other ? comparison_text(compared.mesh, *compared.other, detail) : quality_text(compared.mesh, detail);
    if (request.verbose) return text;
    return text + (request.picture.empty() ? "Histograms: -v prints, --picture FILE.svg draws them.\n"
                                           : "Histograms: " + request.picture + "\n");
}

}  // namespace

int show_quality(const QualityRequest& request) {
    const std::vector<QualityLimit> below = parse_limits(request.fail_below, BadEnd::small),
                                    above = parse_limits(request.fail_above, BadEnd::large);
    for (const std::string& input : {request.mesh, request.compare})
        refuse_to_overwrite(input, "--picture", request.picture);
    require_writable("--picture", request.picture);
    const Compared compared = measure(request);
    const std::vector<std::string> missed = missed_by(compared.mesh, below, above);
    if (!request.picture.empty())
        write_output_file(request.picture, compared.other ? comparison_sheet(compared.mesh, *compared.other)
                                                          : quality_sheet(compared.mesh));
    if (request.json)
        print_data(json_text(compared, missed));
    else
        print_data(text_of(compared, request));
    for (const std::string& sentence : missed) tell(fmt::format("kerf: {}\n", sentence));
    return missed.empty() ? 0 : static_cast<int>(ErrorCode::quality);
}

}  // namespace kerf

#include "cli/quality.h"

#include <fmt/format.h>

#include "core/error.h"
#include "io/output_file.h"
#include "io/standard_streams.h"
#include "quality/compared_quality.h"

namespace kerf {

namespace {

std::string text_of(const ComparedQuality& compared, const QualityRequest& request) {
    if (request.verbose) return to_text(compared, QualityDetail::all);
    return to_text(compared, QualityDetail::brief) + (request.picture.empty()
                                                          ? "Histograms: -v prints, --picture FILE.svg draws them.\n"
                                                          : "Histograms: " + request.picture + "\n");
}

}  // namespace

int show_quality(const QualityRequest& request) {
    const QualityGate gate = QualityGate::parse(request.fail_below, request.fail_above);
    for (const std::string& input : {request.mesh, request.compare})
        refuse_to_overwrite(input, "--picture", request.picture);
    require_writable("--picture", request.picture);
    const ComparedQuality compared = compare_quality(request.mesh, request.compare);
    const std::vector<std::string> missed = gate.missed_by(compared.mesh);
    if (!request.picture.empty()) write_output_file(request.picture, to_picture(compared));
    print_data(request.json ? to_json(compared, missed) : text_of(compared, request));
    for (const std::string& sentence : missed) tell(fmt::format("kerf: {}\n", sentence));
    return missed.empty() ? 0 : static_cast<int>(ErrorCode::quality);
}

}  // namespace kerf

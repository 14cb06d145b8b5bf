#include "cli/check.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "io/surface_reader.h"
#include "surface/diagnosis.h"
#include "surface/orientation.h"

namespace kerf {

namespace {

nlohmann::ordered_json to_json(const Defect& defect) {
    return {{"kind", name(defect.kind)},
            {"facets", defect.facets},
            {"vertices", defect.vertices},
            {"where", {defect.where.x(), defect.where.y(), defect.where.z()}}};
}

std::string describe(const OrientationReport& orientation) {
    std::string text = fmt::format("{} shell{}", orientation.shells, orientation.shells == 1 ? "" : "s");
    if (orientation.void_shells) text += fmt::format(", {} of them voids", orientation.void_shells);
    if (orientation.facets_flipped) text += fmt::format(", {} facets to be turned", orientation.facets_flipped);
    if (orientation.shells_flipped) text += fmt::format(", {} shells to be turned", orientation.shells_flipped);
    return text;
}

}  // namespace

int check_surface(const std::string& path, bool json) {
    Soup soup = read_surface(path);
    weld_exactly(soup);
    const Diagnosis diagnosis = diagnose(soup);
    if (json) {
        nlohmann::ordered_json report = {{"path", path},
                                         {"vertices", soup.vertices.size()},
                                         {"faces", soup.facets.size()},
                                         {"defects", nlohmann::ordered_json::array()}};
        for (const Defect& defect : diagnosis.defects) report["defects"].push_back(to_json(defect));
        fmt::print("{}\n", report.dump(2));
    } else if (!diagnosis.clean()) {
        fmt::print("{}: {}\nkerf check --json lists all {} defects.\n", path, diagnosis.summary(),
                   diagnosis.defects.size());
    }
    if (!diagnosis.clean()) return static_cast<int>(ErrorCode::input);
    const OrientationReport orientation = orient(soup);
    if (!json)
        fmt::print("{}: {} facets, {} vertices, {}. It can be meshed.\n", path, soup.facets.size(),
                   soup.vertices.size(), describe(orientation));
    return 0;
}

}  // namespace kerf

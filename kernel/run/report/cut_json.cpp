#include "run/report/cut_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/core/error.h"

namespace kerf {

namespace {

// Calls visit(name, number) for each number of a cut, in the order of the report.
template <class Summary, class Visit>
void for_each_number(Summary& cut, Visit visit) {
    visit("tries", cut.tries);
    visit("loops", cut.loops);
    visit("contour_edges", cut.contour_edges);
    visit("contour_length", cut.contour_length);
    visit("max_deviation", cut.max_deviation);
    visit("load_fraction", cut.place.fraction);
    visit("axis", cut.place.axis);
    visit("section_gain", cut.place.section_gain);
    visit("section_area", cut.section_area);
    visit("interface_area", cut.interface_area);
    visit("interface_faces", cut.interface_faces);
    visit("min_interface_angle_deg", cut.quality.angle_deg);
    visit("min_dihedral_deg", cut.quality.dihedral_deg);
    visit("min_gap_rel", cut.quality.gap_rel);
    visit("seconds", cut.seconds);
}

// Returns the value up to `last` that has this name. Throws Error(input) if none has.
template <class Enum>
Enum value_named(const std::string& text, Enum last) {
    for (int i = 0; i <= static_cast<int>(last); ++i)
        if (name(static_cast<Enum>(i)) == text) return static_cast<Enum>(i);
    throw Error(ErrorCode::input, fmt::format("The report calls a cut '{}', which no cut is.", text));
}

Vec3 vector_named(const nlohmann::json& json, const char* name) {
    const auto numbers = json.at(name).get<std::array<double, 3>>();
    return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace

nlohmann::ordered_json json_of_cut(const CutSummary& cut) {
    const Vec3 &p = cut.plane.origin, &n = cut.plane.normal;
    nlohmann::ordered_json json = {{"plane", {{"point", {p.x(), p.y(), p.z()}}, {"normal", {n.x(), n.y(), n.z()}}}},
                                   {"method", name(cut.method)},
                                   {"rung", name(cut.strategy)}};
    for_each_number(cut, [&](const char* what, const auto& number) { json[what] = number; });
    return json;
}

CutSummary cut_of_json(const nlohmann::json& json) {
    CutSummary cut;
    const nlohmann::json& plane = json.at("plane");
    cut.plane = Plane(vector_named(plane, "point"), vector_named(plane, "normal"));
    cut.method = value_named(json.at("method").get<std::string>(), ContourMethod::straight);
    cut.strategy = value_named(json.at("rung").get<std::string>(), CutStrategy::whole);
    for_each_number(cut, [&](const char* what, auto& number) {
        const auto found = json.find(what);
        const bool known = found != json.end() && found->is_number();
        number = known ? found->get<std::decay_t<decltype(number)>>() : -1;
    });
    return cut;
}

}  // namespace kerf

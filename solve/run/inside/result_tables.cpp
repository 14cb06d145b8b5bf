#include "solve/run/inside/result_tables.h"

#include <fmt/format.h>

namespace kerf {

namespace {

// A field, in quotes where it has to be.
std::string field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == text.npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + '"';
}
std::string fields(const Vec3& v) { return fmt::format("{},{},{}", v.x(), v.y(), v.z()); }
std::string fields(const Extreme& extreme) { return fmt::format("{},{}", extreme.value, fields(extreme.place)); }
std::string fields(const std::optional<Extreme>& extreme) { return extreme ? fields(*extreme) : ",,,"; }

std::string reaction_row(const std::string& of_case, const std::string& region, const Reacting& reacting,
                         const ForceAndMoment& reaction) {
    return fmt::format("{},{},{},{},{},{}\n", field(of_case), field(reacting.name), field(region),
                       fields(reaction.force), fields(reaction.moment), fields(reacting.place));
}

}  // namespace

std::string results_csv(const std::vector<CaseReport>& cases) {
    std::string text =
        "case,region,load_x,load_y,load_z,strain_energy,max_displacement,max_displacement_at_x,max_displacement_at_y,"
        "max_displacement_at_z,max_von_mises,max_von_mises_at_x,max_von_mises_at_y,max_von_mises_at_z,"
        "least_safety_factor,least_safety_factor_at_x,least_safety_factor_at_y,least_safety_factor_at_z,"
        "relative_error,imbalance,iterations,residual\n";
    for (const CaseReport& one : cases) {
        text += fmt::format("{},,{},{},{},{},{},{},{},{},{}\n", field(one.name), fields(one.load),
                            one.norms.solution * one.norms.solution / 2, fields(one.displacement),
                            fields(one.von_mises), fields(one.safety), one.norms.relative(), one.imbalance,
                            one.outcome.iterations, one.outcome.residual);
        for (const RegionResult& region : one.regions)
            text += fmt::format("{},{},,,,{},,,,,{},{},,,,\n", field(one.name), field(region.name), region.energy,
                                fields(region.von_mises), fields(region.safety));
    }
    return text;
}

std::string reactions_csv(const std::vector<CaseReport>& cases, const std::vector<Reacting>& reacting) {
    std::string text =
        "case,support,region,force_x,force_y,force_z,moment_x,moment_y,moment_z,about_x,about_y,about_z\n";
    for (const CaseReport& one : cases)
        for (std::size_t s = 0; s < reacting.size(); ++s) {
            text += reaction_row(one.name, "", reacting[s], one.reactions[s]);
            for (const RegionResult& region : one.regions)
                text += reaction_row(one.name, region.name, reacting[s], region.reactions[s]);
        }
    return text;
}

}  // namespace kerf

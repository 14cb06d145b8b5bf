// A solution as report.json, as lines for people and as tables. The JSON is in the order in which it is put together
// here, and sealed (files/io/run_manifest.h); members that only some solutions have (modes, regions, inertia, safety
// factors) are left out elsewhere, so that readers must not expect them. Names of users and paths go through
// path_text(), because they may be no UTF-8. Lines have a word of up to twelve characters and a text; of many regions
// only those with the largest stresses have one.
#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/core/number_text.h"
#include "base/core/version.h"
#include "files/io/json.h"
#include "files/io/path_text.h"
#include "solve/run/inside/solve_run.h"

namespace kerf {

namespace {

using SolveJson = nlohmann::ordered_json;

SolveJson vector_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
SolveJson extreme_json(const Extreme& extreme) {
    return {{"value", extreme.value}, {"at", vector_json(extreme.place)}};
}

SolveJson reactions_json(const std::vector<ForceAndMoment>& reactions, const std::vector<Reacting>& reacting) {
    SolveJson json = SolveJson::array();
    for (std::size_t s = 0; s < reacting.size(); ++s)
        json.push_back({{"support", path_text(reacting[s].name)},
                        {"reaction", vector_json(reactions[s].force)},
                        {"moment", vector_json(reactions[s].moment)},
                        {"about", vector_json(reacting[s].place)}});
    return json;
}

SolveJson inertia_json(const CaseReport& of_case) {
    SolveJson bodies = SolveJson::array();
    for (const BodyInertia& body : of_case.relieved)
        bodies.push_back({{"centre", vector_json(body.centre)},
                          {"acceleration", vector_json(body.acceleration)},
                          {"angular_acceleration", vector_json(body.angular_acceleration)}});
    return {{"force", vector_json(of_case.inertia)}, {"bodies", bodies}};
}

SolveJson case_json(const CaseReport& of_case, const std::vector<Reacting>& reacting) {
    SolveJson json = {{"name", path_text(of_case.name)},
                      {"converged", of_case.outcome.converged},
                      {"reason", of_case.outcome.reason},
                      {"iterations", of_case.outcome.iterations},
                      {"residual", of_case.outcome.residual},
                      {"backward_error", of_case.outcome.backward_error},
                      {"refinements", of_case.outcome.refinements},
                      {"load", vector_json(of_case.load)},
                      {"reactions", reactions_json(of_case.reactions, reacting)},
                      {"imbalance", of_case.imbalance},
                      {"energy_norm", of_case.norms.solution},
                      {"error_norm", of_case.norms.error},
                      {"relative_error", of_case.norms.relative()},
                      {"max_displacement", extreme_json(of_case.displacement)},
                      {"max_von_mises", extreme_json(of_case.von_mises)}};
    if (of_case.safety) json["least_safety_factor"] = extreme_json(*of_case.safety);
    if (!of_case.relieved.empty()) json["inertia"] = inertia_json(of_case);
    for (const auto& [name, factor] : of_case.factors) json["combination"][path_text(name)] = factor;
    for (const RegionResult& region : of_case.regions) {
        SolveJson of_region = {{"name", path_text(region.name)},
                               {"reactions", reactions_json(region.reactions, reacting)},
                               {"strain_energy", region.energy},
                               {"max_von_mises", extreme_json(region.von_mises)}};
        if (region.safety) of_region["least_safety_factor"] = extreme_json(*region.safety);
        json["regions"].push_back(of_region);
    }
    return json;
}

SolveJson materials_json(const ElasticCase& wanted) {
    SolveJson materials = SolveJson::array();
    for (const MaterialUse& use : wanted.materials) {
        materials.push_back({{"name", path_text(use.material.name)},
                             {"young", use.material.young},
                             {"poisson", use.material.poisson},
                             {"density", use.material.density}});
        if (use.material.expansion > 0) materials.back()["expansion"] = use.material.expansion;
        if (use.material.yield > 0) materials.back()["yield"] = use.material.yield;
        if (!use.source.empty()) materials.back()["source"] = use.source;
    }
    return materials;
}

SolveJson units_json(CaseUnits units) {
    if (units == CaseUnits::unknown) return nullptr;
    return units == CaseUnits::mm ? "mm" : "m";
}

SolveJson seconds_json(const SolveSeconds& s) {
    return {{"read", s.read},   {"number", s.number}, {"conditions", s.conditions}, {"assemble", s.assemble},
            {"setup", s.setup}, {"solve", s.solve},   {"modes", s.modes},           {"recover", s.recover},
            {"write", s.write}, {"wall", s.wall}};
}

std::string vector_text(const Vec3& v) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x(), v.y(), v.z()); }

std::string line_of(const char* name, const std::string& text) { return fmt::format("{:<12}{}\n", name, text); }

// Returns a line for each region; of many regions for those with the largest stresses.
std::string region_lines(std::vector<RegionResult> regions) {
    constexpr std::size_t most = 10;
    const std::size_t count = regions.size();
    if (count > most) {
        std::stable_sort(regions.begin(), regions.end(), [](const RegionResult& a, const RegionResult& b) {
            return a.von_mises.value > b.von_mises.value;
        });
        regions.resize(most);
    }
    std::string text;
    for (const RegionResult& region : regions) {
        Vec3 sum = Vec3::Zero();
        for (const ForceAndMoment& reaction : region.reactions) sum += reaction.force;
        text += line_of(
            "region",
            fmt::format(
                "{}: reaction {}, strain energy {:.6g}, max von Mises {:.6g} at {}{}", region.name, vector_text(sum),
                region.energy, region.von_mises.value, vector_text(region.von_mises.place),
                region.safety ? fmt::format(", least safety factor {:.4g}", region.safety->value) : std::string()));
    }
    if (count > most) text += line_of("", fmt::format("and {} more regions: see report.json", count - most));
    return text;
}

const char* units_text(CaseUnits units) {
    if (units == CaseUnits::mm) return "mm, N, MPa, t, s";
    if (units == CaseUnits::m) return "m, N, Pa, kg, s";
    return "those of the surface and of the case file: mm, N and MPa go together, and so do m, N and Pa";
}

std::string solver_text(const SolveOutcome& outcome) {
    const int refinements = outcome.refinements;
    const std::string refined =
        refinements > 0 ? fmt::format(" with {} refinement{}", refinements, refinements == 1 ? "" : "s") : "";
    return fmt::format("{} iterations{}, residual {:.1e}, backward error {:.0e}{}", outcome.iterations, refined,
                       outcome.residual, outcome.backward_error,
                       outcome.is_of_rounding ? ": rounding keeps the residual above rtol" : "");
}

std::string factors_text(const std::vector<std::pair<std::string, double>>& factors) {
    std::string text;
    for (const auto& [name, factor] : factors)
        text += fmt::format("{}{:g} {}", text.empty() ? "" : " + ", factor, name);
    return text;
}

std::string case_text(const CaseReport& of_case, const std::vector<Reacting>& reacting) {
    std::string text;
    if (!of_case.name.empty()) text += line_of("case", of_case.name);
    if (of_case.factors.empty())
        text += line_of("solver", solver_text(of_case.outcome));
    else
        text += line_of("sum of", factors_text(of_case.factors));
    text += line_of("load", vector_text(of_case.load));
    for (const BodyInertia& body : of_case.relieved)
        text += line_of("inertia", fmt::format("acceleration {} of {}, angular {}", vector_text(body.acceleration),
                                               vector_text(body.centre), vector_text(body.angular_acceleration)));
    for (std::size_t s = 0; s < reacting.size(); ++s)
        text += line_of("reaction", fmt::format("{} at {}, moment {} about {}", vector_text(of_case.reactions[s].force),
                                                reacting[s].name, vector_text(of_case.reactions[s].moment),
                                                vector_text(reacting[s].place)));
    text += line_of("balance", fmt::format("{:.1e} of the load", of_case.imbalance));
    text += line_of("displacement", fmt::format(" max {:.6g} at {}", of_case.displacement.value,
                                                vector_text(of_case.displacement.place)));
    text += line_of("von Mises",
                    fmt::format("max {:.6g} at {}", of_case.von_mises.value, vector_text(of_case.von_mises.place)));
    if (of_case.safety)
        text += line_of("safety", fmt::format("min {:.4g} against yield, at {}", of_case.safety->value,
                                              vector_text(of_case.safety->place)));
    text += region_lines(of_case.regions);
    return text +
           line_of("error", fmt::format("{:.1f} % in the energy norm, estimated", 100 * of_case.norms.relative()));
}

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

std::string to_json(const SolveReport& report) {
    const SolverOptions& solver = report.wanted.solver;
    SolveJson cases = SolveJson::array(), files = SolveJson::array();
    for (const CaseReport& of_case : report.cases) cases.push_back(case_json(of_case, report.reacting));
    for (const RunFile& file : report.files)
        files.push_back({{"path", file.path}, {"bytes", file.bytes}, {"hash", file.hash}});
    SolveJson solve = {{"mesh", path_text(path_from(report.request.output, report.request.folder))},
                       {"case_file", path_text(report.request.case_file)},
                       {"order", solver.order},
                       {"preconditioner", solver.preconditioner},
                       {"rtol", solver.rtol},
                       {"units", units_json(report.wanted.units)},
                       {"materials", materials_json(report.wanted)},
                       {"nodes", report.nodes},
                       {"unknowns", 3 * report.nodes - report.held},
                       {"held", report.held},
                       {"relative_error", report.relative_error()},
                       {"cases", cases}};
    for (const Mode& mode : report.modes)
        solve["modes"].push_back({{"frequency", mode.frequency},
                                  {"rigid", mode.is_rigid},
                                  {"residual", mode.residual},
                                  {"max_displacement", extreme_json(mode.displacement)}});
    if (!report.modes.empty()) solve["mode_iterations"] = report.mode_iterations;
    if (report.wanted_of_next > 0) solve["error_wanted_of_next_mesh"] = report.wanted_of_next;
    const SolveJson json = {{"kerf", version},
                            {"schema", 1},
                            {"exit_code", report.exit_code},
                            {"solve", solve},
                            {"ranks", report.ranks},
                            {"totals", {{"parts", report.parts}, {"tets", report.tets}, {"vertices", report.vertices}}},
                            {"seconds", seconds_json(report.seconds)},
                            {"peak_rss_bytes", report.peak_rss_bytes},
                            {"files", files}};
    return sealed(json_text(json, 2) + "\n");
}

namespace {

// Returns where a material is; empty where it is alone.
std::string place_of_material(const MaterialUse& use, const SolveReport& report) {
    if (!use.regions.empty()) return fmt::format(", in {}", fmt::join(use.regions, ", "));
    if (!use.patches.empty()) return fmt::format(", in the bodies at {}", fmt::join(use.patches, ", "));
    if (!use.parts.empty()) return fmt::format(", in {} of the parts", use.parts.size());
    if (report.wanted.materials.size() < 2) return "";
    const bool is_of_region = !report.cases.empty() &&
                              std::any_of(report.cases.front().regions.begin(), report.cases.front().regions.end(),
                                          [&](const RegionResult& region) { return region.name == use.material.name; });
    return is_of_region ? fmt::format(", in {}", use.material.name) : ", in all that has no other material";
}

// Tells an error that is large, or larger than was asked for, and what lowers it.
std::string line_of_error(const SolveReport& report) {
    constexpr double large = 0.1;
    const double error = report.relative_error();
    const char* help = report.wanted.solver.order < 2 ? "order = 2 in [solver], or a finer mesh, lowers it"
                                                      : "a finer mesh lowers it, where it is needed by --adapt";
    const std::optional<double>& target = report.request.target_error;
    if (target && *target > 0 && error > *target)
        return line_of("note", fmt::format("the error is {:.1f} %, not {:.1f} % as asked for: {}", 100 * error,
                                           100 * *target, help));
    return error > large ? line_of("note", fmt::format("the error is large: {}", help)) : "";
}

std::string material_text(const MaterialUse& use, const SolveReport& report) {
    const Material& material = use.material;
    return fmt::format("{}{}: young {:g}, poisson {:g}, density {:g}{}{}", material.name,
                       place_of_material(use, report), material.young, material.poisson, material.density,
                       material.expansion > 0 ? fmt::format(", expansion {:g}", material.expansion) : "",
                       use.source.empty() ? "" : "; " + use.source);
}

}  // namespace

std::string to_text(const SolveReport& report) {
    const SolveSeconds& s = report.seconds;
    std::string text = line_of("mesh", fmt::format("{} tetrahedra of order {} in {} parts, {} nodes, {} unknowns",
                                                   grouped(report.tets), report.wanted.solver.order, report.parts,
                                                   grouped(report.nodes), grouped(3 * report.nodes - report.held)));
    for (const MaterialUse& use : report.wanted.materials) text += line_of("material", material_text(use, report));
    for (const std::string& note : report.wanted.notes) text += line_of("note", note);
    for (const CaseReport& of_case : report.cases) text += case_text(of_case, report.reacting);
    text += to_text(report.modes);
    if (!report.cases.empty()) text += line_of_error(report);
    if (report.wanted_of_next > 0)
        text +=
            line_of("next mesh", fmt::format("for an error of {:.1f} %: kerf mesh ... --surface remesh --size-field "
                                             "{}/{}",
                                             100 * report.wanted_of_next, report.request.output, size_field_file));
    text += line_of("units", units_text(report.wanted.units));
    text += line_of("time", fmt::format("{:.2f} s: read {:.2f}, number {:.2f}, conditions {:.2f}, assemble {:.2f}, "
                                        "setup {:.2f}, solve {:.2f}, modes {:.2f}, recover {:.2f}, write {:.2f}",
                                        s.wall, s.read, s.number, s.conditions, s.assemble, s.setup, s.solve, s.modes,
                                        s.recover, s.write));
    return text + line_of("processes", fmt::format("{} rank{}, {} with {}, peak memory {:.0f} MB", report.ranks,
                                                   report.ranks == 1 ? "" : "s",
                                                   report.modes.empty() ? "conjugate gradients" : "LOBPCG",
                                                   report.wanted.solver.preconditioner, report.peak_rss_bytes * 1e-6));
}

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

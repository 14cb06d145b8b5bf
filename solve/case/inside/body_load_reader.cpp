#include "solve/case/inside/body_load_reader.h"

namespace kerf {

Gravity read_gravity(const std::string& path, const toml::table& values) {
    const CaseTable table(path, "gravity");
    Gravity gravity;
    bool has_acceleration = false;
    table.read(values, {{"acceleration",
                         [&](const toml::node& n) {
                             gravity.acceleration = table.vector(n, "acceleration");
                             has_acceleration = true;
                         }},
                        {"case", [&](const toml::node& n) { gravity.load_case = table.case_name(n); }}});
    if (!has_acceleration) table.refuse(values, "gravity needs acceleration = [x, y, z].");
    return gravity;
}

Rotation read_rotation(const std::string& path, const toml::table& values) {
    const CaseTable table(path, "rotation");
    Rotation rotation;
    bool has_axis = false, has_omega = false;
    table.read(values, {{"axis",
                         [&](const toml::node& n) {
                             rotation.axis = table.axis(n);
                             has_axis = true;
                         }},
                        {"omega",
                         [&](const toml::node& n) {
                             rotation.omega = table.number(n, "omega");
                             has_omega = true;
                         }},
                        {"case", [&](const toml::node& n) { rotation.load_case = table.case_name(n); }}});
    if (!has_axis || !has_omega)
        table.refuse(values,
                     "rotation needs axis = {point = [x, y, z], direction = [x, y, z]} and omega, in radians per "
                     "second.");
    return rotation;
}

Temperature read_temperature(const std::string& path, const toml::table& values) {
    const CaseTable table(path, "a temperature");
    Temperature temperature;
    bool has_difference = false;
    table.read(values, {{"difference",
                         [&](const toml::node& n) {
                             temperature.difference = table.number(n, "difference");
                             has_difference = true;
                         }},
                        {"material", [&](const toml::node& n) { temperature.materials = table.texts(n, "material"); }},
                        {"region", [&](const toml::node& n) { temperature.regions = table.texts(n, "region"); }},
                        {"case", [&](const toml::node& n) { temperature.load_case = table.case_name(n); }}});
    if (!has_difference)
        table.refuse(values, "a temperature needs difference: by how much it is warmer than where no stress is.");
    return temperature;
}

Combination read_combination(const std::string& path, const toml::table& values, const std::vector<std::string>& cases,
                             const std::vector<Combination>& others) {
    const CaseTable table(path, "a combination");
    Combination combination;
    const auto read_factors = [&](const toml::node& node) {
        for (const auto& [name, factor] : table.table(node, "cases = {dead = 1.35, wind = 1.5}")) {
            const std::string wanted(name.str());
            if (std::find(cases.begin(), cases.end(), wanted) == cases.end())
                table.refuse(factor, fmt::format("there is no case '{}', but {}.", wanted,
                                                 cases.empty() ? std::string("none with a name")
                                                               : fmt::format("'{}'", fmt::join(cases, "', '"))));
            combination.factors.emplace_back(wanted, table.number(factor, "a factor"));
        }
    };
    table.read(values, {{"name", [&](const toml::node& n) { combination.name = table.case_name(n); }},
                        {"cases", read_factors}});
    if (combination.name.empty() || combination.factors.empty())
        table.refuse(values, "a combination needs a name and cases = {dead = 1.35, wind = 1.5}: cases and factors.");
    if (std::find(cases.begin(), cases.end(), combination.name) != cases.end())
        table.refuse(values, fmt::format("'{}' is a case already.", combination.name));
    if (std::any_of(others.begin(), others.end(), [&](const Combination& one) { return one.name == combination.name; }))
        table.refuse(values,
                     fmt::format("'{}' is a combination already. Give this one another name.", combination.name));
    return combination;
}

}  // namespace kerf

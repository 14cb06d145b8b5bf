#include "files/part/run_names.h"

#include <nlohmann/json.hpp>

#include "files/io/path_text.h"

namespace kerf {

RunNames RunNames::of_report(const nlohmann::json& report) {
    RunNames names;
    const nlohmann::json& input = report.at("input");
    for (const auto& name : input.value("patches", nlohmann::json::array()))
        names.patches.push_back(path_of_text(name.get<std::string>()));
    for (const auto& region : input.value("regions", nlohmann::json::array()))
        names.regions.push_back(path_of_text(region.at("name").get<std::string>()));
    for (const auto& type :
         report.value("options", nlohmann::json::object()).value("patch-type", nlohmann::json::array()))
        names.patch_types.push_back(path_of_text(type.get<std::string>()));
    return names;
}

}  // namespace kerf

#include "viewer/app/settings.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

namespace kerf::view {

namespace {

constexpr std::size_t most_recent = 10;

constexpr double smallest_side = 100, largest_side = 16384;  // of a window, in pixels at scale 1

// The default for what no window can be.
WindowSize window_from(const nlohmann::json& settings) {
    const nlohmann::json window = settings.value("window", nlohmann::json::object());
    const auto number = [&](const char* name) {
        return window.contains(name) && window[name].is_number() ? window[name].get<double>() : 0;
    };
    if (!window.is_object()) return {};
    const double width = number("width"), height = number("height"), scale = number("scale");
    if (!(scale >= 0.5 && scale <= 8)) return {};
    for (const double side : {width / scale, height / scale})
        if (!(side >= smallest_side && side <= largest_side)) return {};
    return {static_cast<int>(width), static_cast<int>(height), scale};
}

std::string settings_file(const std::string& folder) { return folder + "/viewer.json"; }

}  // namespace

std::string user_config_folder() {
    if (const char* config = std::getenv("XDG_CONFIG_HOME"); config && *config) return std::string(config) + "/kerf";
    if (const char* home = std::getenv("HOME"); home && *home) return std::string(home) + "/.config/kerf";
    return "";
}

Settings load_settings(const std::string& folder) {
    Settings settings;
    if (folder.empty()) return settings;
    std::ifstream file(settings_file(folder));
    const auto json = nlohmann::json::parse(file, nullptr, false);
    if (!json.is_object()) return settings;
    try {
        settings.theme = json.value("theme", "light") == "dark" ? Theme::dark : Theme::light;
        settings.recent = json.value("recent", std::vector<std::string>());
        settings.browser_folder = json.value("browser_folder", "");
        const auto panels = json.value("panels", nlohmann::json::object());
        const auto size = [&](const char* name) {
            const float ems = panels.value(name, 0.f);
            return ems > 0 && ems < 1000 ? ems : 0;
        };
        settings.panels = {size("left"), size("right"), size("timeline")};
        settings.window = window_from(json);
    } catch (const nlohmann::json::exception&) {
        return {};
    }
    return settings;
}

void save_settings(const std::string& folder, const Settings& settings) {
    if (folder.empty()) return;
    std::error_code ignored;
    std::filesystem::create_directories(folder, ignored);
    nlohmann::ordered_json json = {{"theme", settings.theme == Theme::dark ? "dark" : "light"},
                                   {"recent", settings.recent},
                                   {"browser_folder", settings.browser_folder}};
    const PanelSizes& panels = settings.panels;
    json["panels"] = {{"left", panels.left}, {"right", panels.right}, {"timeline", panels.timeline}};
    const WindowSize& window = settings.window;
    json["window"] = {{"width", window.width}, {"height", window.height}, {"scale", window.scale}};
    const std::string path = settings_file(folder), partial = path + ".partial";
    {
        std::ofstream file(partial);
        file << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
        if (!file.flush()) return;
    }
    std::filesystem::rename(partial, path, ignored);
}

void remember(Settings& settings, const std::string& path) {
    std::error_code error;
    const std::string full = std::filesystem::absolute(path, error).lexically_normal().string();
    std::erase(settings.recent, error ? path : full);
    settings.recent.insert(settings.recent.begin(), error ? path : full);
    if (settings.recent.size() > most_recent) settings.recent.resize(most_recent);
}

}  // namespace kerf::view
